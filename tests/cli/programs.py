"""What the tests of the programs share: where they are, how they are run, a small specimen, and full and read-only disks."""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

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


def run(program, *arguments, **options):
    options = {"capture_output": True, "text": True, "timeout": 120} | options
    return subprocess.run([BIN / f"breccia-{program}", *map(str, arguments)], **options)


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
