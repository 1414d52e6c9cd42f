"""Runs the programs, and reads what they left. A run that is finished and whose case is the same is not made again."""
import csv
import hashlib
import json
import os
import re
import shlex
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

SOURCE = Path(__file__).resolve().parents[2]
CASES = SOURCE / "data" / "validation" / "cases"
SPECIMENS = SOURCE.parent / "shared" / "specimens"
REFERENCE = SOURCE.parent / "shared" / "reference"


class RunFailed(RuntimeError):
    pass


@dataclass
class Result:
    """Folder of a finished run."""

    folder: Path
    summary: dict

    def run(self, k=0):
        return self.summary["runs"][k]

    def curve(self, k=0):
        """Columns of curve-K.csv by name, as arrays; empty cells are nan."""
        with (self.folder / f"curve-{k}.csv").open(newline="") as file:
            header, *lines = csv.reader(file)
        values = np.array([[float(cell) if cell.strip() else np.nan for cell in line] for line in lines if len(line) == len(header)])
        return dict(zip(header, values.T))

    @property
    def run_time(self):
        """s, of all runs in the folder: the simulation itself, without packing and probe."""
        return sum(run["run_time_s"] for run in self.summary["runs"])

    @property
    def warnings(self):
        return [warning for run in self.summary["runs"] for warning in run["warnings"]]


@dataclass
class Probe:
    """What a dry run printed: the specimen as bonded and its answer to a small elastic strain."""

    bonds: float
    coordination: float
    mean_radius: float  # mm
    alpha: float
    young_modulus: float  # GPa
    poisson_ratio: float
    covered: float  # sum of the bonds' areas through a section, over the section

    run_time = None


NUMBER = r"(-?[\d.]+(?:e[-+]?\d+)?)"
PRINTED = {"bonds": rf"; {NUMBER} bonds within", "coordination": rf", {NUMBER} per (?:disc|sphere)",
           "mean_radius": rf"mean radius {NUMBER} mm", "alpha": rf"alpha {NUMBER}", "young_modulus": rf"specimen: E {NUMBER} GPa",
           "poisson_ratio": rf"GPa, nu {NUMBER} with", "covered": rf"cover a section {NUMBER} times"}


def read_probe(text):
    found = {name: re.search(pattern, text) for name, pattern in PRINTED.items()}
    absent = [name for name, match in found.items() if not match]
    if absent:
        raise RunFailed(f"the dry run does not print {', '.join(absent)}")
    return Probe(**{name: float(match[1]) for name, match in found.items()})


class Runner:
    def __init__(self, programs=None, out=None, threads=2, again=False, idle=False):
        self.programs = (programs or SOURCE / "build" / "bin").resolve()
        self.out = (out or SOURCE / "out" / "validation").resolve()
        self.threads, self.again, self.idle = threads, again, idle
        self.prefix = shlex.split(os.environ.get("BRECCIA_RUN_PREFIX", ""))

    def run(self, study, case):
        """Result of the case, made now or before; RunFailed with the program's message."""
        if case.dry:
            return self.dry_run(study, case)
        folder = self.out / study.name / case.name
        key_file, log_file = folder.parent / f"{case.name}.key", folder.parent / f"{case.name}.log"
        key = fingerprint(case)
        if not self.again and finished(folder) and key_file.exists() and key_file.read_text() == key:
            return read_result(folder)
        if self.idle:
            raise RunFailed(f"{case.name}: not there, and nothing is run with --pages")
        program = self.programs / f"breccia-{case.program}"
        if not program.exists():
            raise RunFailed(f"{program}: not there; build it, or name its folder with --bin")
        folder.parent.mkdir(parents=True, exist_ok=True)
        command = [*self.prefix, str(program), str(CASES / case.file), "--out", str(folder), "--force",
                   "--threads", str(self.threads)]
        for setting in case.set:
            command += ["--set", setting]
        environment = {**os.environ, "BRECCIA_DATA": str(SOURCE / "data")}  # presets of this source folder
        start = time.monotonic()
        with log_file.open("w") as log:
            code = subprocess.run(command, stdout=log, stderr=subprocess.STDOUT, env=environment).returncode
        if code or not finished(folder):
            lines = log_file.read_text().strip().splitlines()
            raise RunFailed(f"{case.name}: exit code {code}: {lines[-1] if lines else 'no message'}")
        key_file.write_text(key)
        print(f"{study.name}/{case.name}: {time.monotonic() - start:.0f} s", flush=True)
        return read_result(folder)


    def dry_run(self, study, case):
        """What the program prints about the case without running it; kept in out/validation/STUDY/NAME.txt."""
        kept = self.out / study.name / f"{case.name}.txt"
        key_file, key = kept.with_suffix(".key"), fingerprint(case)
        if not self.again and kept.exists() and key_file.exists() and key_file.read_text() == key:
            return read_probe(kept.read_text())
        if self.idle:
            raise RunFailed(f"{case.name}: not there, and nothing is run with --pages")
        kept.parent.mkdir(parents=True, exist_ok=True)
        command = [*self.prefix, str(self.programs / f"breccia-{case.program}"), str(CASES / case.file), "--dry-run",
                   "--threads", str(self.threads)]
        for setting in case.set:
            command += ["--set", setting]
        environment = {**os.environ, "BRECCIA_DATA": str(SOURCE / "data")}
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment)
        if done.returncode:
            raise RunFailed(f"{case.name}: exit code {done.returncode}: {(done.stdout.strip().splitlines() or ['no message'])[-1]}")
        kept.write_text(done.stdout)
        key_file.write_text(key)
        return read_probe(done.stdout)


def fingerprint(case):
    """Changes with whatever decides the run, but for the program itself: that is what --again is for."""
    text = (CASES / case.file).read_text()
    preset = re.search(r'^\s*preset\s*=\s*"([^"]+)"', text, re.MULTILINE)
    material = SOURCE / "data" / "materials" / f"{preset[1]}.toml" if preset else None
    parts = [case.program, text, *case.set, material.read_text() if material and material.exists() else ""]
    return hashlib.sha256("\0".join(parts).encode()).hexdigest() + "\n"


def finished(folder):
    try:
        runs = json.loads((folder / "summary.json").read_text())["runs"]
    except (OSError, ValueError, KeyError):
        return False
    return bool(runs) and all(run.get("stopped_by") != "interrupted" for run in runs)


def read_result(folder):
    return Result(folder, json.loads((folder / "summary.json").read_text()))
