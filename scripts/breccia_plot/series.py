"""Reads summary.json and curve-K.csv. An interrupted run may lack either, and its last row may be cut short."""
import csv
import json
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from .errors import BadInput

# what a test is called, and whether Mohr circles of its peaks make sense
TESTS = {
    "ucs": "Uniaxial compression",
    "triaxial": "Triaxial compression",
    "bts": "Brazilian splitting",
    "usc": "Uniaxial strain compression",
    "hydrostatic": "Hydrostatic compression",
    "tension": "Direct tension",
    "shear": "Direct shear",
    "biaxial": "Biaxial compression (2-D)",
    "cut": "Cutting",
    "impact": "Impact",
}
COMPRESSION_TO_FAILURE = {"ucs", "triaxial", "biaxial", ""}


@dataclass
class Run:
    index: int
    summary: dict = field(default_factory=dict)
    curve: dict = field(default_factory=dict)  # column name -> values; empty: no curve file
    platen_strain: bool = False  # the gauge's strain is lacking, and the platens' has taken its place

    @property
    def confinement(self):
        """Pa; from the curve while there is no summary."""
        if "confinement_Pa" in self.summary:
            return self.summary["confinement_Pa"]
        applied = self.curve.get("confining_stress_Pa", np.array([]))
        applied = applied[np.isfinite(applied)]
        return float(np.median(applied)) if applied.size else 0.0

    @property
    def peak_row(self):
        """Row of the largest stress, whatever its sign."""
        return int(np.nanargmax(np.abs(self.curve["stress_Pa"])))

    @property
    def peak_reached(self):
        """True where the stress has fallen since its peak; a test that was stopped while rising has none."""
        if "peak_reached" in self.summary:
            return bool(self.summary["peak_reached"])
        stress = np.abs(self.curve["stress_Pa"])
        return bool(stress[-1] < 0.98 * stress[self.peak_row])


@dataclass
class Series:
    folder: Path
    test: str = ""
    material: str = ""
    case: dict = field(default_factory=dict)  # case.toml
    mohr_coulomb: dict | None = None
    runs: list = field(default_factory=list)
    notes: list = field(default_factory=list)
    spheres: int | None = None
    bonds: int | None = None

    def with_curves(self):
        return [run for run in self.runs if run.curve]

    @property
    def shape(self):
        """Of the specimen; "" where the case does not say."""
        return self.case.get("specimen", {}).get("shape") or ("disc" if self.test == "bts" else "")

    @property
    def strain_name(self):
        """What the column axial_strain holds in this test, for the axes."""
        if self.test == "shear":
            return "shear displacement over diameter"
        if self.test == "bts":
            return "platen travel over diameter"
        if self.test == "cut":
            return "way of the tool over the block's width"
        platen = all(run.platen_strain for run in self.with_curves())
        return "axial strain" + (" (of the platens)" if platen else "")

    @property
    def title(self):
        what = TESTS.get(self.test, self.test.capitalize() or "Compression")
        if self.material:
            what += f" of {self.material}"
        counts = [f"{n:,} {name}" for n, name in ((self.spheres, "spheres"), (self.bonds, "bonds")) if n]
        return what + (f" – {', '.join(counts)}" if counts else "")


def read_series(folder):
    if not folder.is_dir():
        raise BadInput(f"{folder}: no such folder")
    series = Series(folder)
    summary = read_summary(folder, series.notes)
    curves = {int(path.stem[6:]): path for path in folder.glob("curve-*.csv") if path.stem[6:].isdigit()}
    if summary is None and not curves and not (folder / "results.h5").exists():
        raise BadInput(f"{folder} is not the folder of a run: neither summary.json, curve-0.csv nor results.h5 is there")

    summary = summary or {}
    series.test = summary.get("test") or ""
    summaries = summary["runs"] if summary else []
    for k in sorted({*range(len(summaries)), *curves}):
        run = Run(k, summaries[k] if k < len(summaries) else {})
        if k in curves:
            run.curve = read_curve(curves[k])
            complete(run, series.test)
        else:
            series.notes.append(f"curve-{k}.csv is absent")
        series.runs.append(run)

    series.mohr_coulomb = summary.get("mohr_coulomb")
    series.case = read_case(folder / "case.toml")
    series.material = material_name(summary.get("material"), series.case)
    if summaries:
        series.spheres, series.bonds = summaries[0].get("particles"), summaries[0].get("bonds")
    return series


def read_summary(folder, notes):
    path = folder / "summary.json"
    if not path.exists():
        notes.append("summary.json is absent: the run was interrupted or is still going on")
        return None
    try:
        summary = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as reason:
        raise BadInput(f"{path} cannot be read: {reason}") from reason
    if not isinstance(summary, dict) or not isinstance(summary.get("runs"), list) or "test" not in summary:
        raise BadInput(f'{path} was not written by breccia: it lacks "test" or "runs"')
    return summary


def read_curve(path):
    """Columns of a curve by name; {} while it holds fewer than two rows."""
    try:
        with path.open(encoding="utf-8", newline="") as file:
            header, *lines = csv.reader(file)
    except (OSError, ValueError) as reason:
        raise BadInput(f"{path} cannot be read as a curve") from reason
    missing = {"axial_strain", "axial_stress_Pa", "confining_stress_Pa"} - set(header)
    if missing:
        raise BadInput(f"{path} was not written by breccia: column {sorted(missing)[0]} is missing")
    try:
        rows = [[float(cell) if cell.strip() else np.nan for cell in line] for line in lines if len(line) == len(header)]
    except ValueError as reason:
        raise BadInput(f"{path}: {reason}") from reason
    if len(rows) < 2:
        return {}
    curve = dict(zip(header, np.array(rows).T))
    return curve if np.isfinite(curve["axial_stress_Pa"]).any() else {}


def complete(run, test):
    """Adds stress_Pa, the stress that the test is about, and puts the strain of the platens where the gauge has none."""
    if not run.curve:
        return
    axial, confining = run.curve["axial_stress_Pa"], np.nan_to_num(run.curve["confining_stress_Pa"])
    if test in ("bts", "tension", "shear", "cut"):
        run.curve["stress_Pa"] = axial
    elif test == "hydrostatic":
        run.curve["stress_Pa"] = (axial + 2 * confining) / 3
    else:
        run.curve["stress_Pa"] = axial - confining
    platen = run.curve.get("platen_strain", np.full(axial.size, np.nan))
    lacking = ~np.isfinite(run.curve["axial_strain"])
    # the two differ: a curve is of one or of the other, never patched
    if lacking.mean() > 0.01 and np.isfinite(platen).sum() > np.count_nonzero(~lacking):
        run.curve["axial_strain"], run.platen_strain = platen, True
    if not np.isfinite(run.curve["axial_strain"]).any():
        run.curve = {}


def read_case(path):
    """The case as it was run; {} where it is absent or damaged: it only names things."""
    try:
        case = tomllib.loads(path.read_text(encoding="utf-8"))
        return {name: section for name, section in case.items() if isinstance(section, dict)}
    except (OSError, ValueError):
        return {}


def material_name(material, case):
    """From the summary, else the preset the case names."""
    if isinstance(material, str):
        return material
    material = material or case.get("material", {})
    return str(material.get("name") or material.get("preset") or "")
