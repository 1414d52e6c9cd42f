#!/usr/bin/python3
"""A small unconfined test from case to plots: every file that is promised, and what stands in it."""
import csv
import json
import xml.etree.ElementTree as xml

import h5py

from programs import UCS, ProgramTest, main, plot, run, tree

FILES = ["case.toml", "cracks-0.csv", "curve-0.csv", "frames/run-0.pvd", "results.h5", "summary.json"]
CURVE = ("time_s,axial_strain,platen_strain,axial_stress_Pa,radial_strain,volumetric_strain,confining_stress_Pa,"
         "broken_tension,broken_shear,kinetic_J,stored_J,dissipated_J,work_J").split(",")
RUN = ("confinement_Pa confinement_measured_Pa peak_stress_Pa peak_deviator_Pa peak_reached strain_at_peak "
       "young_modulus_Pa young_modulus_50_Pa poisson_ratio crack_initiation_stress_Pa crack_damage_stress_Pa "
       "tensile_strength_Pa alpha alpha_affine mantle_cover particles loose_particles pieces bonds coordination "
       "dropped_bonds short_bonds broken_tension broken_shear localisation contact_searches length_quantum_m force_quantum_N steps time_step_s lowest_time_step_s "
       "critical_time_step_s step_estimates local_step_estimates mass_factor scaled_particles run_time_s phases_s bond_updates_per_s "
       "bond_pass_per_s energy_error rate_error step_error sampling_error kinetic_ratio platen_mismatch state_hash "
       "stopped_by warnings files").split()


class Ucs(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.folder = cls.shelf / "run"
        case = cls.shelf / "ucs.toml"
        case.write_text(UCS.replace("specimen.csv", "packed/specimen.csv"))
        cls.result = run("ucs", case, "--out", cls.folder, "--threads", "1")

    def setUp(self):
        super().setUp()
        self.assertEqual((self.result.returncode, self.result.stderr), (0, ""))

    def read_summary(self, folder=None):
        return json.loads(((folder or self.folder) / "summary.json").read_text())

    def read_curve(self):
        with (self.folder / "curve-0.csv").open(newline="") as file:
            return list(csv.DictReader(file))

    def test_files(self):
        files = sorted(tree(self.folder))
        frames = [name for name in files if name.endswith(".vtp")]
        self.assertEqual([name for name in files if name not in frames], FILES)
        count = len(frames) // 2
        self.assertIn(count, (2, 3, 4))
        self.assertEqual(frames, [f"frames/run-0/{what}-{k:03d}.vtp" for what in ("bonds", "particles") for k in range(count)])
        listed = xml.parse(self.folder / "frames" / "run-0.pvd").findall("Collection/DataSet")
        self.assertEqual(sorted("frames/" + entry.get("file") for entry in listed), frames)

    def test_report(self):
        for word in ("300 spheres", "bonds", "alpha", "peak", "MPa", "time", "summary.json", "run-0.pvd"):
            self.assertIn(word, self.result.stdout)

    def test_summary(self):
        summary = self.read_summary()
        self.assertEqual(list(summary), ["test", "version", "threads", "ranks", "inputs", "runs"])
        self.assertEqual([summary[key] for key in ("test", "threads", "ranks")], ["ucs", 1, 1])
        (result,) = summary["runs"]
        self.assertEqual(list(result), RUN)
        self.assertEqual((result["confinement_Pa"], result["particles"], result["peak_reached"]), (0, 300, True))
        self.assertAlmostEqual(result["young_modulus_Pa"] / 28e9, 1, delta=0.03)
        self.assertTrue(20e6 < result["peak_stress_Pa"] < 60e6)
        self.assertLess(result["time_step_s"], result["critical_time_step_s"])
        self.assertLessEqual(sum(result["phases_s"].values()), 1.001 * result["run_time_s"])
        self.assertRegex(result["state_hash"], "^[0-9a-f]{16}$")
        self.assertEqual(result["stopped_by"], "peak drop")

    def test_curve(self):
        rows = self.read_curve()
        self.assertEqual(list(rows[0]), CURVE)
        self.assertGreaterEqual(len(rows), 500)
        stress = [float(row["axial_stress_Pa"]) for row in rows]
        self.assertAlmostEqual(max(stress), self.read_summary()["runs"][0]["peak_stress_Pa"], delta=1e3)
        self.assertLess(stress[-1], 0.6 * max(stress))
        time = [float(row["time_s"]) for row in rows]
        self.assertEqual(time, sorted(time))

    def test_results(self):
        summary = self.read_summary()["runs"][0]
        with h5py.File(self.folder / "results.h5") as file:
            self.assertEqual(file.attrs["case"], (self.folder / "case.toml").read_text())
            one = file["run-0"]
            self.assertEqual((one["particles/radius"].size, one["bonds/area"].size), (300, summary["bonds"]))
            last = one[sorted(name for name in one if name.startswith("frame-"))[-1]]
            state = last["bonds/state"][:]
            self.assertEqual([(state == kind).sum() for kind in (1, 2)], [summary["broken_tension"], summary["broken_shear"]])

    def test_resolved_case_gives_the_same_bits(self):
        again = self.work / "again"
        result = run("ucs", self.folder / "case.toml", "--out", again, "--threads", "1", "--quiet")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual((again / "case.toml").read_text(), (self.folder / "case.toml").read_text())
        self.assertEqual(self.read_summary(again)["runs"][0]["state_hash"], self.read_summary()["runs"][0]["state_hash"])
        self.assertEqual((again / "curve-0.csv").read_text(), (self.folder / "curve-0.csv").read_text())

    def test_moduli_of_a_cyclic_test_are_of_the_first_loading(self):
        out = self.work / "cyclic"
        result = run("ucs", self.case, "--out", out, "--threads", "1", "--quiet", "--set", "test.unload_at=[0.001, 0.0016]",
                     "--set", "output.frames=0")
        self.assertEqual(result.returncode, 0, result.stderr)
        (summary,) = self.read_summary(out)["runs"]
        self.assertEqual(len(summary["cycles"]), 2)
        self.assertAlmostEqual(summary["young_modulus_Pa"] / 28e9, 1, delta=0.03)
        self.assertIsNone(summary["young_modulus_50_Pa"])

    def test_same_bits_for_any_number_of_threads_with_gather(self):
        hashes = set()
        for threads in (1, 2, 3):
            out = self.work / f"threads-{threads}"
            result = run("ucs", self.case, "--out", out, "--threads", threads, "--set", 'run.scatter="gather"',
                         "--set", "output.frames=0")
            self.assertEqual(result.returncode, 0, result.stderr)
            hashes.add(self.read_summary(out)["runs"][0]["state_hash"])
        self.assertEqual(len(hashes), 1)

    def test_paraview_files(self):
        try:
            from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
        except ImportError:
            self.skipTest("python3-vtk9 is not installed")
        for what, count, column in (("particles", 300, "displacement"), ("bonds", self.read_summary()["runs"][0]["bonds"], "state")):
            reader = vtkXMLPolyDataReader()
            reader.SetFileName(str(self.folder / "frames" / "run-0" / f"{what}-001.vtp"))
            reader.Update()
            data = reader.GetOutput()
            self.assertEqual(data.GetNumberOfCells(), count)
            columns = data.GetPointData() if what == "particles" else data.GetCellData()
            self.assertTrue(columns.HasArray(column))

    def test_plots(self):
        pictures = self.work / "pictures"
        result = plot(self.folder, "--out", pictures)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(sorted(path.name for path in pictures.iterdir()), ["cracks-0.png", "curves.png", "energy.png", "events-0.csv", "specimen.png"])


if __name__ == "__main__":
    main()
