"""What the tests of the programs share: where they are, how they are run and made to wait, a small
specimen, and full and read-only disks."""
import contextlib
import importlib.machinery
import importlib.util
import io
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path
from unittest import mock

import h5py

sys.dont_write_bytecode = True

SOURCE = Path(os.environ.get("BRECCIA_SOURCE", Path(__file__).resolve().parents[2]))
BIN = Path(os.environ.get("BRECCIA_BIN", SOURCE / "build" / "bin"))

# `file` stands in line 2, `preset` in line 6
UCS = """[specimen]
file = "specimen.csv"
diameter = "50 mm"
height = "100 mm"
[material]
preset = "concrete"
[test]
stop_strain = 0.006
[output]
frames = 3
"""
CONFINED = UCS.replace("stop_strain = 0.006", 'confinement = ["0 MPa", "8 MPa"]\nstop_strain = 0.005\nstop_after_peak = 0.2')
ENDLESS = ("--set", "test.stop_strain=0.5", "--set", "test.stop_after_peak=0", "--set", "output.frames=400")


# s. A guard against programs that hang, and nothing else: no test says how fast or how busy a machine has to be
HANG = 600
SKIPPED = 77  # exit code of a script whose tests were all skipped, as ctest is told


def command(program, *arguments):
    return [BIN / f"breccia-{program}", *map(str, arguments)]


def run(program, *arguments, **options):
    options = {"capture_output": True, "text": True, "timeout": HANG} | options
    return subprocess.run(command(program, *arguments), **options)


def load_plot():
    """scripts/plot as a module."""
    loader = importlib.machinery.SourceFileLoader("plot", str(SOURCE / "scripts" / "plot"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("plot", loader))
    loader.exec_module(module)
    return module


def plot(*arguments):
    """scripts/plot with these arguments, in this process: to start Python and load matplotlib anew
    takes longer than to draw. As a user calls it: test_plot.py, test_series."""
    out, errors = io.StringIO(), io.StringIO()
    words = ["plot", *map(str, arguments)]
    with mock.patch.object(sys, "argv", words), contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors):
        try:
            code = load_plot().main()
        except SystemExit as end:
            code = end.code
    return subprocess.CompletedProcess(words, code, out.getvalue(), errors.getvalue())


def wait_until(so, what):
    """Looks until so() is true. For what comes by itself: the time says nothing, see HANG."""
    end = time.monotonic() + HANG
    while not so():
        if time.monotonic() > end:
            raise TimeoutError(f"{what} did not come in {HANG} s")
        time.sleep(0.005)


def finish(process):
    """What a process says to its end: stdout, stderr."""
    return process.communicate(timeout=HANG)


def main():
    """unittest.main, that says what is skipped and why; a script that skipped all that it has says so by
    its exit code too."""
    program = unittest.main(verbosity=2, exit=False)
    skipped = {getattr(test, "test_case", test).id() for test, _ in program.result.skipped}
    if not program.result.wasSuccessful():
        sys.exit(1)
    sys.exit(SKIPPED if skipped and len(skipped) == program.test.countTestCases() else 0)


def tree(folder):
    """Every file below a folder, with its content; without the list that breccia keeps of its own."""
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*"))
            if path.is_file() and path.name != ".breccia-files"}


class ProgramTest(unittest.TestCase):
    """Each test has a folder of its own with specimen.csv, 300 packed spheres, and ucs.toml."""

    @classmethod
    def setUpClass(cls):
        cls.shelf = Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.shelf)
        (cls.shelf / "pack.toml").write_text(
            '[specimen]\ndiameter = "50 mm"\nheight = "100 mm"\npack = { spheres = 300, seed = 7 }\n')
        packed = run("pack", cls.shelf / "pack.toml", "--out", cls.shelf / "packed")
        assert packed.returncode == 0, packed.stderr

    def setUp(self):
        self.work = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.work)
        self.out = self.work / "out"
        shutil.copy(self.shelf / "packed" / "specimen.csv", self.work)
        self.case = self.write("ucs.toml", UCS)

    def write(self, name, text):
        path = self.work / name
        path.write_text(text)
        return path

    def start(self, *words, env=()):
        """Starts a program that the test's end ends too."""
        process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                   env=os.environ | dict(env))
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        return process

    def start_and_hold(self, point, *words, env=()):
        """Starts a program and returns when it waits at a point of its way, "row:30": core/base/hold.hpp.
        It goes on when it gets a signal, or after let_go()."""
        self.held = self.work / "held"
        self.let_go()
        process = self.start(*words, env={"BRECCIA_HOLD": f"{point}={self.held}"} | dict(env))
        wait_until(lambda: self.held.exists() or process.poll() is not None, point)
        if not self.held.exists():
            out, errors = finish(process)
            self.fail(f"ended with {process.returncode} and never came to {point}: {out}{errors}")
        self.held_process = int(self.held.read_text())
        return process

    def let_go(self):
        self.held.unlink(missing_ok=True)

    def mount(self, name, options):
        """A disk of its own below the test's folder."""
        if os.geteuid() != 0:
            self.skipTest("mounting a small disk needs root")
        place = self.work / name
        place.mkdir()
        made = subprocess.run(["mount", "-t", "tmpfs", "-o", options, "tmpfs", place], capture_output=True, text=True)
        if made.returncode != 0:
            self.skipTest(f"no small disk can be mounted here: {made.stderr.strip()}")
        self.addCleanup(subprocess.run, ["umount", place], check=True)
        return place

    def check_one_line(self, result, code, *words):
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        for word in words:
            self.assertIn(str(word), result.stderr)

    def check_readable(self, folder):
        for summary in folder.glob("summary.json"):
            json.loads(summary.read_text())
        for curve in folder.glob("curve-*.csv"):
            widths = {line.count(",") for line in curve.read_text().splitlines()}
            self.assertEqual(widths, {12})
        for results in folder.glob("results.h5"):
            with h5py.File(results) as file:
                read = []
                file.visititems(lambda _, item: read.append(item[()]) if isinstance(item, h5py.Dataset) else None)
