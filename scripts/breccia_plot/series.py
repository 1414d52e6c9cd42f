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
    "biaxial": "Biaxial compression",
    "impact": "Impact",
}
COMPRESSION_TO_FAILURE = {"ucs", "triaxial", "biaxial", ""}


@dataclass
class Run:
    index: int
    summary: dict = field(default_factory=dict)
    curve: dict = field(default_factory=dict)  # column name -> values; empty: no curve file

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
        """Row of the largest deviator, whatever its sign (direct tension may count it negative)."""
        return int(np.nanargmax(np.abs(self.curve["deviator_Pa"])))

    @property
    def peak_reached(self):
        """True where the stress has fallen since its peak; a test that was stopped while rising has none."""
        if "peak_reached" in self.summary:
            return bool(self.summary["peak_reached"])
        deviator = np.abs(self.curve["deviator_Pa"])
        return bool(deviator[-1] < 0.98 * deviator[self.peak_row])


@dataclass
class Series:
    folder: Path
    test: str = ""
    material: str = ""
    specimen: dict = field(default_factory=dict)  # diameter_m, height_m, shape; what is known
    mohr_coulomb: dict | None = None
    runs: list = field(default_factory=list)
    notes: list = field(default_factory=list)
    spheres: int | None = None
    bonds: int | None = None

    def with_curves(self):
        return [run for run in self.runs if run.curve]

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
    summaries = summary["runs"] if summary else []
    for k in sorted({*range(len(summaries)), *curves}):
        run = Run(k, summaries[k] if k < len(summaries) else {})
        if k in curves:
            run.curve = read_curve(curves[k])
        else:
            series.notes.append(f"curve-{k}.csv is absent")
        series.runs.append(run)

    series.test = summary.get("test") or ""
    series.mohr_coulomb = summary.get("mohr_coulomb")
    series.specimen = summary.get("specimen") or {}
    series.material = material_name(summary.get("material"), folder / "case.toml")
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
    """Columns of a curve by name, with the deviator added; {} while it holds fewer than two rows."""
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
    curve["deviator_Pa"] = curve["axial_stress_Pa"] - np.nan_to_num(curve["confining_stress_Pa"])
    return curve if np.isfinite(curve["deviator_Pa"]).any() else {}


def material_name(material, case):
    """From the summary, else the preset the case names."""
    if isinstance(material, str):
        return material
    if not material:
        try:
            material = tomllib.loads(case.read_text(encoding="utf-8")).get("material", {})
        except (OSError, ValueError):
            return ""
    return str(material.get("name") or material.get("preset") or "")
