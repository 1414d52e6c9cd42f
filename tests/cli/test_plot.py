#!/usr/bin/python3
"""scripts/plot on a small made-up run folder: the pictures are there and show something, wrong folders are refused."""
import json
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import h5py
import matplotlib.image
import numpy as np

SOURCE = Path(os.environ.get("BRECCIA_SOURCE", Path(__file__).resolve().parents[2]))
CURVE = ("time_s,axial_strain,platen_strain,axial_stress_Pa,radial_strain,volumetric_strain,confining_stress_Pa,"
         "broken_tension,broken_shear,kinetic_J,stored_J,dissipated_J,work_J")


def make_run(folder, confinements=(0.0, 4.5e6, 60e6), test="triaxial", ledger=True):
    """A run folder as the programs leave it, of a coarse lattice with a crack across it."""
    folder.mkdir(parents=True)
    runs = []
    with h5py.File(folder / "results.h5", "w") as file:
        for k, pressure in enumerate(confinements):
            peak = 40e6 + 3 * pressure
            write_curve(folder / f"curve-{k}.csv", pressure, peak, ledger)
            bonds = write_results(file.create_group(f"run-{k}"))
            runs.append({"confinement_Pa": pressure, "peak_stress_Pa": peak + pressure, "peak_deviator_Pa": peak,
                         "peak_reached": True, "particles": 243, "bonds": bonds})
    summary = {"test": test, "version": "0.1.0", "runs": runs}
    if len(runs) > 1:
        summary["mohr_coulomb"] = {"cohesion_Pa": 10e6, "friction_angle_deg": 36.9}
    (folder / "summary.json").write_text(json.dumps(summary))
    return folder


def write_curve(path, pressure, peak, ledger):
    strain = np.linspace(0, 0.004, 200)
    deviator = peak * np.sin(np.pi * strain / 0.005)
    stored = deviator**2 / 56e9 * 5e-3
    lines = [CURVE]
    for i, (e, s, w) in enumerate(zip(strain, deviator, stored)):
        energies = f"{1e-5 * w:.6g},{w:.6g}," + (f"{0.1 * w:.6g},{1.1 * w:.6g}" if ledger else ",")
        lines.append(f"{i},{e:.6g},{e:.6g},{s + pressure:.6g},{-0.3 * e:.6g},{0.4 * e:.6g},{pressure:.6g},{i},{i // 2},{energies}")
    path.write_text("\n".join(lines) + "\n")


def write_results(run):
    x, y, z = np.meshgrid(np.arange(-2, 3), np.arange(-2, 3), np.arange(-4, 5), indexing="ij")
    place = 0.03 * np.stack([x, y, z], axis=-1).reshape(-1, 3)
    n = len(place)
    lo, hi = np.nonzero(np.triu(np.linalg.norm(place[:, None] - place[None], axis=2) < 0.031, 1))
    middle = (place[lo] + place[hi]) / 2
    particles, bonds = run.create_group("particles"), run.create_group("bonds")
    particles["gid"] = 10 + 2 * np.arange(n, dtype=np.uint64)  # ids need not be rows
    particles["radius"], particles["mass"] = np.full(n, 0.015), np.full(n, 0.03)
    particles["reference_position"] = place
    bonds["gid_lo"], bonds["gid_hi"] = particles["gid"][:][lo], particles["gid"][:][hi]
    bonds["rest_length"], bonds["area"] = np.full(lo.size, 0.03), np.full(lo.size, 7e-4)
    crack = np.abs(middle[:, 2] - 1.5 * middle[:, 0]) < 0.02
    for number, strain in enumerate((0.0, 0.004)):
        frame = run.create_group(f"frame-{number:03d}")
        frame.attrs["time_s"], frame.attrs["step"], frame.attrs["axial_strain"] = strain, number, strain
        frame["particles/position"] = place * [1, 1, 1 - strain]
        frame["bonds/state"] = (crack * (1 + (lo % 2)) * number).astype(np.uint8)
    return lo.size


class Plot(unittest.TestCase):
    def setUp(self):
        self.work = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.work)

    def plot(self, *arguments):
        return subprocess.run([SOURCE / "scripts" / "plot", *arguments], capture_output=True, text=True)

    def check_pictures(self, folder, names):
        self.assertEqual(sorted(path.name for path in folder.glob("*.png")), sorted(names))
        for name in names:
            self.assertLess((folder / name).stat().st_size, 300_000, name)
            picture = matplotlib.image.imread(folder / name)[..., :3]
            self.assertGreaterEqual(picture.shape[1], 1000, name)
            inked = np.mean(picture.min(axis=2) < 0.9)
            self.assertGreater(inked, 0.01, name)
            self.assertLess(inked, 0.9, name)
            self.assertGreater(np.mean(np.ptp(picture, axis=2) > 0.3), 1e-3, f"{name} has no colour")

    def check_refused(self, result, code, word):
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertIn(word, result.stderr)

    def test_series(self):
        folder = make_run(self.work / "run")
        result = self.plot(folder)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual(len(result.stdout.splitlines()), 4)
        self.check_pictures(folder, ["curves.png", "envelope.png", "specimen.png", "energy.png"])

    def test_one_run_without_ledger(self):
        folder, out = make_run(self.work / "run", (0.0,), "ucs", ledger=False), self.work / "deep" / "out"
        result = self.plot(folder, "--out", out)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("no envelope.png", result.stderr)
        self.check_pictures(out, ["curves.png", "specimen.png", "energy.png"])
        self.assertEqual(list(folder.glob("*.png")), [])

    def test_envelope_without_fit_draws_circles(self):
        folder = make_run(self.work / "run")
        summary = json.loads((folder / "summary.json").read_text())
        del summary["mohr_coulomb"]
        (folder / "summary.json").write_text(json.dumps(summary))
        self.assertIn("circles alone", self.plot(folder).stdout)

    def test_interrupted(self):
        folder = make_run(self.work / "run", (4.5e6,))
        (folder / "summary.json").unlink()
        with (folder / "curve-0.csv").open("a") as curve:
            curve.write("200,0.0041,0.00")  # a row cut short
        with h5py.File(folder / "results.h5", "a") as file:
            file["run-0"].create_group("frame-002")  # a frame that was being written
        result = self.plot(folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("summary.json is absent", result.stderr)
        self.check_pictures(folder, ["curves.png", "specimen.png", "energy.png"])

    def test_without_results(self):
        folder = make_run(self.work / "run")
        (folder / "results.h5").unlink()
        result = self.plot(folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("no specimen.png: results.h5 is absent", result.stderr)
        self.check_pictures(folder, ["curves.png", "envelope.png", "energy.png"])

    def test_nothing_broken_yet(self):
        folder = make_run(self.work / "run", (0.0,), "ucs")
        with h5py.File(folder / "results.h5", "a") as file:
            del file["run-0/frame-001"]
        self.assertIn("specimen.png", self.plot(folder).stdout)

    def test_refusals(self):
        self.check_refused(self.plot(self.work / "absent"), 2, "no such folder")
        self.check_refused(self.plot(self.work), 2, "not the folder of a run")
        self.check_refused(self.plot(), 2, "DIR")
        foreign = self.work / "foreign"
        foreign.mkdir()
        (foreign / "summary.json").write_text('{"loss": 0.1}')
        self.check_refused(self.plot(foreign), 2, "summary.json")
        (foreign / "summary.json").unlink()
        (foreign / "curve-0.csv").write_text("a,b\n1,2\n")
        self.check_refused(self.plot(foreign), 2, "axial_strain")

    def test_pictures_that_cannot_be_written(self):
        folder = make_run(self.work / "run", (0.0,), "ucs")
        (self.work / "file").write_text("")
        self.check_refused(self.plot(folder, "--out", self.work / "file" / "below"), 4, "cannot be written")


if __name__ == "__main__":
    unittest.main()
