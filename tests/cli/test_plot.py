#!/usr/bin/python3
"""scripts/plot on small made-up run folders: the pictures are there and show something, the numbers in them are those
that were planted, wrong folders are refused."""
import csv
import json
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import h5py
import numpy as np
from PIL import Image

from programs import HANG, SOURCE, main, plot

sys.path.insert(0, str(SOURCE / "scripts"))
from breccia_plot import PICTURES, cracks, curves, envelope, events, read_series  # noqa: E402
from breccia_plot.body import Body  # noqa: E402
from breccia_plot.style import new_figure, run_styles  # noqa: E402

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


def rewrite(path, **columns):
    """Puts other values into columns of a curve."""
    header, *lines = path.read_text().splitlines()
    names, rows = header.split(","), [line.split(",") for line in lines]
    for name, values in columns.items():
        for row, value in zip(rows, values):
            row[names.index(name)] = value if isinstance(value, str) else f"{value:.9g}"
    path.write_text("\n".join([header] + [",".join(row) for row in rows]) + "\n")


def column(folder, name, k=0):
    with (folder / f"curve-{k}.csv").open() as file:
        return np.array([float(row[name]) for row in csv.DictReader(file)])


BOND = 0.03  # m, of the lattice of write_results


CRACK_COLUMNS = ("time_s,axial_strain,gid_lo,gid_hi,x_m,y_m,z_m,nx,ny,nz,mode,normal_force_N,shear_force_N,"
                 "area_m2,energy_J")


def plant(folder, rows, k=0):
    """A record of cracks: rows of (time s, position m, normal, mode, energy J)."""
    time, position, normal, mode, energy = (np.array(values) for values in zip(*sorted(rows, key=lambda row: row[0])))
    lines = [CRACK_COLUMNS]
    for t, x, n, m, e in zip(time, position, normal, mode, energy):
        numbers = [t, 0.004 * t / 199, 10, 12, *x, *n, int(m), 1e3, 2e3, 7e-4, e]
        lines.append(",".join(repr(number) for number in numbers))
    (folder / f"cracks-{k}.csv").write_text("\n".join(lines) + "\n")


def energy_of(magnitude):
    return 10 ** (1.5 * magnitude + 4.8)


def plot_only(folder, *names):
    """These pictures alone, beside those of cracks."""
    with mock.patch.dict(PICTURES, {name: PICTURES[name] for name in names}, clear=True):
        return plot(folder)


class PlotTest(unittest.TestCase):
    def setUp(self):
        self.work = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.work)

    def check_pictures(self, folder, names):
        self.assertEqual(sorted(path.name for path in folder.glob("*.png")), sorted(names))
        for name in names:
            self.assertLess((folder / name).stat().st_size, 300_000, name)
            picture = np.asarray(Image.open(folder / name).convert("RGB"))
            self.assertGreaterEqual(picture.shape[1], 1000, name)
            red, green, blue = np.moveaxis(picture, 2, 0)
            least = np.minimum(np.minimum(red, green), blue)
            inked = np.mean(least < 230)
            self.assertGreater(inked, 0.01, name)
            self.assertLess(inked, 0.9, name)
            colour = np.maximum(np.maximum(red, green), blue) - least
            self.assertGreater(np.mean(colour > 76), 1e-3, f"{name} has no colour")

    def check_refused(self, result, code, word):
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertIn(word, result.stderr)


class Plot(PlotTest):
    def test_series(self):
        folder = make_run(self.work / "run")
        result = subprocess.run([SOURCE / "scripts" / "plot", folder], capture_output=True, text=True, timeout=HANG)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual(len(result.stdout.splitlines()), 4)
        self.check_pictures(folder, ["curves.png", "envelope.png", "specimen.png", "energy.png"])

    def test_one_run_without_ledger(self):
        folder, out = make_run(self.work / "run", (0.0,), "ucs", ledger=False), self.work / "deep" / "out"
        result = plot(folder, "--out", out)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("no envelope.png", result.stderr)
        self.check_pictures(out, ["curves.png", "specimen.png", "energy.png"])
        self.assertEqual(list(folder.glob("*.png")), [])

    def test_envelope_without_fit_draws_circles(self):
        folder = make_run(self.work / "run")
        summary = json.loads((folder / "summary.json").read_text())
        del summary["mohr_coulomb"]
        (folder / "summary.json").write_text(json.dumps(summary))
        self.assertIn("circles alone", plot_only(folder, "envelope.png").stdout)

    def test_interrupted(self):
        folder = make_run(self.work / "run", (4.5e6,))
        (folder / "summary.json").unlink()
        with (folder / "curve-0.csv").open("a") as curve:
            curve.write("200,0.0041,0.00")  # a row cut short
        with h5py.File(folder / "results.h5", "a") as file:
            file["run-0"].create_group("frame-002")  # a frame that was being written
        result = plot(folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("summary.json is absent", result.stderr)
        self.check_pictures(folder, ["curves.png", "specimen.png", "energy.png"])

    def test_without_results(self):
        folder = make_run(self.work / "run")
        (folder / "results.h5").unlink()
        result = plot(folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("no specimen.png: results.h5 is absent", result.stderr)
        self.check_pictures(folder, ["curves.png", "envelope.png", "energy.png"])

    def test_nothing_broken_yet(self):
        folder = make_run(self.work / "run", (0.0,), "ucs")
        with h5py.File(folder / "results.h5", "a") as file:
            del file["run-0/frame-001"]
        self.assertIn("specimen.png", plot_only(folder, "specimen.png").stdout)

    def test_refusals(self):
        self.check_refused(plot(self.work / "absent"), 2, "no such folder")
        self.check_refused(plot(self.work), 2, "not the folder of a run")
        self.check_refused(plot(), 2, "DIR")
        foreign = self.work / "foreign"
        foreign.mkdir()
        (foreign / "summary.json").write_text('{"loss": 0.1}')
        self.check_refused(plot(foreign), 2, "summary.json")
        (foreign / "summary.json").unlink()
        (foreign / "curve-0.csv").write_text("a,b\n1,2\n")
        self.check_refused(plot(foreign), 2, "axial_strain")

    def test_pictures_that_cannot_be_written(self):
        folder = make_run(self.work / "run", (0.0,), "ucs")
        (self.work / "file").write_text("")
        self.check_refused(plot(folder, "--out", self.work / "file" / "below"), 4, "cannot be written")


class Tests(PlotTest):
    """Each test of the laboratory has curves of its own."""

    def drawn(self, folder, draw, *arguments):
        """The panel that a function draws, for its numbers."""
        series = read_series(folder)
        figure, axes = new_figure(series, 5, 4, nrows=1, ncols=1)
        draw(axes[0, 0], series, series.with_curves(), run_styles(series.runs), *arguments)
        return axes[0, 0]

    def curve_of(self, axes, line=0):
        return axes.get_lines()[line].get_data()

    def check_all(self, folder, pictures):
        # energies are drawn the same way whatever the test, but for the names of the runs of a shear test
        result = plot_only(folder, *(name for name in PICTURES if name in pictures))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.check_pictures(folder, pictures)

    def test_brazilian(self):
        folder = make_run(self.work / "run", (0.0,), "bts")
        axes = self.drawn(folder, curves.draw_stress)
        np.testing.assert_allclose(self.curve_of(axes)[1], column(folder, "axial_stress_Pa") / 1e6)
        self.assertIn("platen travel over diameter", axes.get_xlabel())
        self.assertIn("2P / πLD", axes.get_ylabel())
        self.assertIn("peak 40 MPa", [text.get_text() for text in axes.texts])
        broken = self.drawn(folder, curves.draw_broken)
        self.assertEqual([line.get_ydata()[-1] for line in broken.get_lines()], [199, 99])
        self.check_all(folder, ["curves.png", "specimen.png"])

    def test_uniaxial_strain(self):
        folder = make_run(self.work / "run", (0.0,), "usc")
        axial = column(folder, "axial_stress_Pa")
        rewrite(folder / "curve-0.csv", confining_stress_Pa=0.25 * axial)
        np.testing.assert_allclose(self.curve_of(self.drawn(folder, curves.draw_stress))[1], 0.75 * axial / 1e6, rtol=1e-6)
        x, y = self.curve_of(self.drawn(folder, curves.draw_lateral))
        np.testing.assert_allclose((x, y), (0.25 * axial / 1e6, axial / 1e6), rtol=1e-6)
        self.check_all(folder, ["curves.png", "specimen.png"])

    def test_hydrostatic(self):
        folder = make_run(self.work / "run", (0.0,), "hydrostatic")
        rewrite(folder / "curve-0.csv", confining_stress_Pa=[f"{1e5 * i}" for i in range(200)],
                axial_stress_Pa=[f"{1.3e5 * i}" for i in range(200)])
        axes = self.drawn(folder, curves.draw_stress)
        x, y = self.curve_of(axes)
        np.testing.assert_allclose(x, 100 * column(folder, "volumetric_strain"))
        np.testing.assert_allclose(y, 0.11 * np.arange(200))
        self.assertIn("volumetric strain", axes.get_xlabel())
        self.check_all(folder, ["curves.png", "specimen.png"])

    def test_tension(self):
        folder = make_run(self.work / "run", (0.0,), "tension")
        axes = self.drawn(folder, curves.draw_stress)
        self.assertIn("tension positive", axes.get_ylabel())
        self.assertGreater(self.curve_of(axes)[1].max(), 0)
        self.check_all(folder, ["curves.png", "specimen.png"])

    def test_shear(self):
        normal = (1e6, 2e6, 4e6)
        folder = make_run(self.work / "run", normal, "shear")
        for k, stress in enumerate(normal):
            rewrite(folder / f"curve-{k}.csv", axial_stress_Pa=(3e6 + 0.75 * stress) * np.sin(np.linspace(0, 2.5, 200)),
                    volumetric_strain=np.linspace(0, 0.001, 200))
        axes = self.drawn(folder, curves.draw_stress)
        self.assertIn("shear displacement over diameter", axes.get_xlabel())
        np.testing.assert_allclose([self.curve_of(axes, k)[1].max() for k in range(3)], [3.75, 4.5, 6], rtol=1e-4)
        sigma, tau, reached = envelope.shear_points(read_series(folder).runs)
        np.testing.assert_allclose(sigma, [1, 2, 4])
        np.testing.assert_allclose(tau, [3.75, 4.5, 6], rtol=1e-4)
        self.assertEqual(reached, [True] * 3)
        dilation = self.drawn(folder, curves.draw_volume)
        self.assertEqual(dilation.get_ylabel(), "dilation (%)")
        self.assertAlmostEqual(self.curve_of(dilation)[1][-1], -0.1)  # the column counts contraction positive
        self.check_all(folder, ["curves.png", "envelope.png", "specimen.png", "energy.png"])

    def test_biaxial(self):
        folder = make_run(self.work / "run", (0.0, 5e6), "biaxial")
        with h5py.File(folder / "results.h5", "a") as file:
            for run in file.values():
                for place in (run["particles/reference_position"], run["frame-001/particles/position"]):
                    place[:, 1] = 0
        self.check_all(folder, ["curves.png", "envelope.png", "specimen.png"])

    def test_unloading_is_drawn_in_the_order_of_time(self):
        folder = make_run(self.work / "run", (0.0,), "ucs")
        strain = np.linspace(0, 0.004, 200) + 0.0005 * np.sin(np.linspace(0, 30, 200))
        rewrite(folder / "curve-0.csv", axial_strain=strain)
        self.assertLess(np.diff(strain).min(), 0)
        np.testing.assert_allclose(self.curve_of(self.drawn(folder, curves.draw_stress))[0], 100 * strain, rtol=1e-6)
        self.assertTrue(cracks.goes_back(strain))
        self.assertFalse(cracks.goes_back(np.linspace(0, -0.004, 200)))
        plant(folder, [(float(i), (0, 0, 0), (1, 0, 0), 1, 1.0) for i in range(30)])
        self.check_all(folder, ["cracks-0.png", "curves.png", "specimen.png"])

    def test_platens_where_the_gauge_has_nothing(self):
        folder = make_run(self.work / "run", (0.0,), "triaxial")
        for gap in ("", "nan"):
            rewrite(folder / "curve-0.csv", axial_strain=[gap] * 200, platen_strain=np.linspace(0, 0.005, 200))
            axes = self.drawn(folder, curves.draw_stress)
            np.testing.assert_allclose(self.curve_of(axes)[0], np.linspace(0, 0.5, 200), atol=1e-7)
            self.assertIn("of the platens", axes.get_xlabel())
            self.check_all(folder, ["curves.png", "specimen.png"])

    def test_gauge_is_kept_where_it_lacks_one_row(self):
        folder = make_run(self.work / "run", (0.0,), "ucs")
        rewrite(folder / "curve-0.csv", axial_strain=["nan"])
        self.assertNotIn("platens", self.drawn(folder, curves.draw_stress).get_xlabel())


class Cracks(PlotTest):
    """Clusters, magnitudes, b and orientations that were planted come out again."""

    def setUp(self):
        super().setUp()
        self.folder = make_run(self.work / "run", (0.0,), "ucs")  # no case.toml: 1/200 of the record is the window

    def read_events(self):
        with (self.folder / "events-0.csv").open() as file:
            return list(csv.DictReader(file))

    def test_planted_clusters(self):
        apart, rows = 2.5 * BOND, []
        # 10 s apart, of 3 to 12 cracks, each 1.9 bonds and 0.9 windows from the one before: chains, not balls
        window = 199.0 / 200
        for i in range(10):
            for j in range(3 + i):
                rows.append((10.0 + 12 * i + 0.9 * window * j, (0.0, 0.0, 1.9 * BOND * j), (1, 0, 0), 1 + (j == 0), 0.1 * (i + 1)))
        # at one time: one pair near enough, one not
        rows += [(180.0, (0, 0, 0), (1, 0, 0), 1, 1.0), (180.0, (1.99 * BOND, 0, 0), (1, 0, 0), 1, 1.0)]
        rows += [(190.0, (0, 0, 0), (1, 0, 0), 1, 0.0), (190.0, (apart, 0, 0), (1, 0, 0), 1, 1.0)]
        # at one place: one pair soon enough, one not
        rows += [(0.0, (0, 0.5, 0), (1, 0, 0), 1, 1.0), (0.99 * window, (0, 0.5, 0), (1, 0, 0), 1, 1.0)]
        rows += [(197.0, (0, 0.5, 0), (1, 0, 0), 1, 1.0), (199.0, (0, 0.5, 0), (1, 0, 0), 1, 1.0)]
        plant(self.folder, rows)
        result = plot_only(self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn(f"{len(rows)} cracks in 16 events", result.stdout)
        self.check_pictures(self.folder, ["cracks-0.png"])
        found = self.read_events()
        self.assertEqual([int(row["cracks"]) for row in found], [2, *range(3, 13), 2, 1, 1, 1, 1])
        for i, row in enumerate(found[1:11]):
            self.assertEqual(int(row["cracks_shear"]), 1)
            self.assertAlmostEqual(float(row["start_time_s"]), 10 + 12 * i)
            self.assertAlmostEqual(float(row["duration_s"]), 0.9 * window * (2 + i), places=6)
            self.assertAlmostEqual(float(row["z_m"]), 1.9 * BOND * (2 + i) / 2, places=6)
            energy = 0.1 * (i + 1) * (3 + i)
            self.assertAlmostEqual(float(row["energy_J"]), energy, places=6)
            self.assertAlmostEqual(float(row["magnitude"]), (np.log10(energy) - 4.8) / 1.5, places=6)
        self.assertEqual(sorted(row["magnitude"] == "" for row in found), [False] * 15 + [True])

    def test_planted_b(self):
        """Magnitudes at the middle quantiles of the Gutenberg-Richter law with b = 1.3 from M = -6."""
        n, b = 2000, 1.3
        magnitude = -6 - np.log10(1 - (np.arange(n) + 0.5) / n) / b
        small = -6 - 0.2 * np.linspace(0.01, 3, 100)  # below the completeness; fewer there
        every = np.concatenate([magnitude, small])
        plant(self.folder, [(1.0 + 2 * i, (0, 0, 0), (0, 0, 1), 1, energy_of(m)) for i, m in enumerate(every)])
        record, length, _ = cracks.read_record(self.folder / "results.h5", 0)
        self.assertAlmostEqual(length, BOND)
        found = events.events_of(record, 2 * length, 1.0)
        self.assertEqual(found.cracks.size, n + 100)
        np.testing.assert_allclose(np.sort(found.magnitude), np.sort(every), atol=1e-9)
        law = events.gutenberg_richter(found.magnitude)
        self.assertAlmostEqual(law.completeness, -6)
        self.assertEqual(law.events, n)
        self.assertAlmostEqual(law.b, np.log10(np.e) / (magnitude.mean() + 6), places=9)  # Aki's estimate
        self.assertAlmostEqual(law.b, b, delta=0.002)  # the quantiles' own error is ln 2 / 2n
        self.assertAlmostEqual(law.error, law.b / np.sqrt(n))
        self.assertIsNone(events.gutenberg_richter(magnitude[:19]))
        self.assertIsNone(events.gutenberg_richter(np.full(100, np.nan)))

    def test_one_event_is_the_same_as_pairs_one_by_one(self):
        """Against the plain search for chains, at random places and times, ties among them."""
        random = np.random.default_rng(5)
        for distance, window in ((0.2, 3.0), (0.25, 5.0), (0.5, 0.0)):
            place, time = random.uniform(-1, 1, (300, 3)), np.sort(random.integers(0, 40, 300).astype(float))
            near = (np.linalg.norm(place[:, None] - place, axis=2) <= distance) & (np.abs(time[:, None] - time) <= window)
            label = np.full(300, -1)
            for first in range(300):
                if label[first] < 0:
                    label[first], todo = label.max() + 1, [first]
                    while todo:
                        joined = np.flatnonzero(near[todo.pop()] & (label < 0))
                        label[joined] = label[first]
                        todo += joined.tolist()
            found = events.linked(place, time, distance, window)
            np.testing.assert_array_equal(found, label)
            self.assertGreater(np.bincount(label).max(), 2)

    def test_time_window_is_that_of_a_shear_wave(self):
        material = {"young_modulus": "28 GPa", "poisson_ratio": 0.2, "density": "2500 kg/m^3"}
        speed = np.sqrt(28e9 / 2.4 / 2500)
        self.assertAlmostEqual(cracks.time_window(material, 0.06, None), 0.06 / speed)

    def test_planted_orientations(self):
        degrees = np.concatenate([np.full(7, 5), np.full(4, 45), np.full(2, 85)])
        angle, turn = np.radians(degrees), np.linspace(0, 5, degrees.size)
        normal = np.stack([np.cos(angle) * np.cos(turn), np.cos(angle) * np.sin(turn), np.sin(angle)], axis=1)
        normal[::2] *= -1  # a plane has two normals
        np.testing.assert_allclose(cracks.plane_angle(normal), degrees, atol=1e-9)
        count, random = cracks.rose(normal, np.arange(0, 91, 10))
        self.assertEqual(count.tolist(), [7, 0, 0, 0, 4, 0, 0, 0, 2])
        self.assertAlmostEqual(random.sum(), degrees.size)
        self.assertAlmostEqual(random[:3].sum(), degrees.size / 2)  # 30 degrees halve the hemisphere

    def test_random_orientations_follow_the_line(self):
        normal = np.random.default_rng(2).normal(size=(40000, 3))
        count, random = cracks.rose(normal, np.arange(0, 91, 10))
        np.testing.assert_array_less(np.abs(count - random) / np.sqrt(random), 4)  # standard deviations

    def test_modes_on_their_sides_of_the_rose(self):
        plant(self.folder, [(1.0, (0, 0, 0), (1, 0, 0), 1, 1.0), (2.0, (0, 0, 0), (0, 0, 1), 2, 1.0), 
                            (3.0, (0, 0, 0), (0, 1, 0), 1, 1.0)])
        record, _, _ = cracks.read_record(self.folder / "results.h5", 0)
        figure, _ = new_figure(read_series(self.folder), 5, 4)
        axes = figure.add_subplot(projection="polar")
        cracks.draw_rose(axes, record, False)
        bars = {round(np.degrees(bar.get_x() + bar.get_width() / 2)): bar.get_height() for bar in axes.patches}
        bars = {angle: share for angle, share in bars.items() if share}
        self.assertEqual(bars, {5: 100, -85: 100})

    def test_silent_without_record_and_with_an_empty_one(self):
        (self.folder / "cracks-0.csv").write_text(CRACK_COLUMNS + "\n")
        result = plot_only(self.folder, "curves.png")
        self.assertEqual(result.returncode, 0)
        self.assertNotIn("cracks", result.stdout + result.stderr)
        self.assertEqual(list(self.folder.glob("events-*")), [])

    def test_damaged_record(self):
        (self.folder / "cracks-0.csv").write_text("time_s,axial_strain\n1.0,0.001\n")
        result = plot_only(self.folder, "curves.png")
        self.assertEqual(result.returncode, 2)
        self.assertIn("cracks-0.csv: cannot be read", result.stderr)

    def test_one_crack(self):
        plant(self.folder, [(1.0, (0, 0, 0), (0, 0, 1), 1, 0.0)])
        self.assertIn("1 crack in 1 event\n", plot_only(self.folder).stdout)

    def test_disc_is_seen_along_y(self):
        spheres = lambda: None  # noqa: E731
        grid = np.stack(np.meshgrid(*(np.linspace(-1, 1, 9),) * 3), axis=-1).reshape(-1, 3) * [0.05, 0.02, 0.05]
        spheres.reference, spheres.radius = grid, np.full(len(grid), 0.001)
        body = Body.of("", spheres)
        self.assertEqual(body.shape, "disc")
        np.testing.assert_allclose(body.half, [0.051, 0.021, 0.051])
        rim = body.rim(np.linspace(0, 6, 5), 1)
        np.testing.assert_allclose(rim[:, 1], 0.021)
        np.testing.assert_allclose(np.hypot(rim[:, 0], rim[:, 2]), 0.051)


if __name__ == "__main__":
    main()
