"""What a study is: cases that programs run, and a function that reads numbers from what they left."""
from dataclasses import dataclass, field
from typing import Callable


@dataclass(frozen=True)
class Case:
    """One run of one program."""

    name: str  # folder of the run, out/validation/STUDY/NAME
    program: str  # "ucs" is breccia-ucs
    file: str  # the case, in data/validation/cases
    set: tuple = ()  # "table.key=value", instead of the case's
    dry: bool = False  # --dry-run: bonds and elastic probe, no test; the study gets a Probe instead of a Result


@dataclass
class Row:
    """One line of a study's table; numbers in the unit that the quantity names, or text, or None where there is none."""

    quantity: str  # "peak, MPa"
    breccia: float | str | None
    experiment: float | str | None = None
    paper: float | str | None = None
    target: str = ""  # "2.9 MPa within 10 %"; "" : none, reported only
    met: bool | None = None  # None: no target
    error: float | None = None  # relative; None: against the experiment, where both are numbers
    run_time: float | None = None  # s


@dataclass
class Outcome:
    """What a study found."""

    rows: list
    text: str = ""  # Markdown below the table: what was done, what the numbers are, why a target is missed
    pictures: list = field(default_factory=list)  # file names in data/validation


@dataclass(frozen=True)
class Study:
    """`evaluate(results, pictures)`: results is {case name: Result}, pictures the folder for PNG files; gives an Outcome."""

    name: str
    title: str
    cases: tuple
    evaluate: Callable
    meshes: tuple = ()  # files of ../shared/specimens without which the study is skipped


@dataclass
class Page:
    """data/validation/NAME.md"""

    name: str
    title: str
    intro: str
    studies: list
    closing: str = ""  # Markdown after the studies


def within(value, target, fraction):
    """True where the value is within the fraction of the target."""
    return abs(value - target) <= fraction * abs(target)
