#!/usr/bin/python3
"""Several ranks: the same states and curves as one, whatever their number, threads and interruptions."""
import csv
import json
import os
import shutil
import signal
import subprocess
import unittest

import h5py
import numpy as np

from programs import CONFINED, UCS, ProgramTest, command, finish, main, run, wait_until

# platens so fast that a test takes some thousand steps: at every one of them ranks wait for each other
QUICK = ("--set", "test.platen_speed=1", "--set", "test.stop_strain=0.0035")
GATHER = (*QUICK, "--set", 'run.precision="double"', "--set", 'run.scatter="gather"')
# as root and with more ranks than cores, as in a container
ROOT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}

# books of ranks are added up in their order, and of bonds in registers of floats: the last digits differ
ENERGIES = ("dissipated_J", "work_J")


def mpirun(ranks, program, *arguments):
    # a rank that waits gives its core to one that works: there may be fewer cores than ranks
    return ["mpirun", "-n", str(ranks), "--oversubscribe", "--bind-to", "none", "--mca", "mpi_yield_when_idle", "1",
            *command(program, *arguments)]


@unittest.skipUnless(shutil.which("mpirun"), "mpirun is not installed")
class SeveralRanks(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.one = cls.shelf / "ranks.toml"
        cls.one.write_text(CONFINED.replace("specimen.csv", "packed/specimen.csv"))
        cls.alone = cls.shelf / "alone"
        result = run("triaxial", cls.one, *QUICK, "--out", cls.alone, "--threads", "1", "--quiet")
        assert result.returncode == 0, result.stderr

    def launch(self, ranks, program, *arguments):
        return self.start(*mpirun(ranks, program, *arguments), env=ROOT)

    def launch_and_hold(self, point, ranks, program, *arguments):
        """The root waits at a point of its way, and the others for it."""
        return self.start_and_hold(point, *mpirun(ranks, program, *arguments), env=ROOT)

    def finish(self, process, code=0):
        out, errors = finish(process)
        self.assertEqual(process.returncode, code, errors + out)
        return out, errors

    def rows(self, folder, run):
        with (folder / f"curve-{run}.csv").open(newline="") as file:
            return list(csv.DictReader(file))

    def check_same(self, folder):
        ours, theirs = (json.loads((f / "summary.json").read_text())["runs"] for f in (folder, self.alone))
        for key in ("state_hash", "peak_stress_Pa", "steps", "broken_tension", "broken_shear", "step_estimates", "time_step_s",
                    "lowest_time_step_s", "kinetic_ratio", "stopped_by", "length_quantum_m", "force_quantum_N"):
            self.assertEqual([one[key] for one in ours], [one[key] for one in theirs], key)
        for number in (0, 1):
            theirs = self.rows(self.alone, number)
            work = float(theirs[-1]["work_J"])
            for mine, other in zip(self.rows(folder, number), theirs, strict=True):
                for key in mine:
                    if key in ENERGIES:
                        self.assertAlmostEqual(float(mine[key]), float(other[key]), delta=1e-8 * abs(float(other[key])) + 1e-13 * work)
                    else:
                        self.assertEqual(mine[key], other[key], key)
            cracks = f"cracks-{number}.csv"
            self.assertEqual((folder / cracks).read_text(), (self.alone / cracks).read_text())
        self.assertEqual(sorted(path.name for path in folder.iterdir()), sorted(path.name for path in self.alone.iterdir()))

    def test_same_bits_in_doubles_with_gather(self):
        alone = self.work / "double-alone"
        result = run("triaxial", self.one, *GATHER, "--out", alone, "--threads", "2", "--quiet")
        self.assertEqual(result.returncode, 0, result.stderr)
        out = self.work / "double-ranks"
        self.finish(self.launch(3, "triaxial", self.one, *GATHER, "--out", out, "--threads", "1"))
        ours, theirs = (json.loads((f / "summary.json").read_text())["runs"] for f in (out, alone))
        for key in ("state_hash", "peak_stress_Pa", "steps", "broken_tension", "broken_shear", "kinetic_ratio"):
            self.assertEqual([one[key] for one in ours], [one[key] for one in theirs], key)
        self.assertGreater(ours[0]["broken_tension"], 50)
        self.assertEqual((out / "cracks-0.csv").read_text(), (alone / "cracks-0.csv").read_text())
        for number in (0, 1):
            work = float(self.rows(alone, number)[-1]["work_J"])
            for mine, other in zip(self.rows(out, number), self.rows(alone, number), strict=True):
                for key in ENERGIES:
                    self.assertAlmostEqual(float(mine[key]) / work, float(other[key]) / work, delta=1e-13)

    def test_same_bits_on_any_number_of_ranks(self):
        for ranks, threads in ((2, 2), (3, 1), (4, 1)):
            with self.subTest(ranks=ranks, threads=threads):
                out = self.work / f"ranks-{ranks}"
                text, _ = self.finish(self.launch(ranks, "triaxial", self.one, *QUICK, "--out", out, "--threads", threads))
                self.check_same(out)
                self.assertEqual(json.loads((out / "summary.json").read_text())["ranks"], ranks)
                self.assertEqual(text.count("300 spheres"), 1)

    def test_results_are_the_same_file_whoever_wrote_it(self):
        written = self.work / "ranks"
        extra = ("--set", "output.stress=true", "--set", "output.frames=2", "--set", 'test.confinement=["0 MPa"]', "--threads", "1")
        self.finish(self.launch(3, "triaxial", self.one, *QUICK, *extra, "--out", written, "--quiet"))
        alone = run("triaxial", self.one, *QUICK, *extra, "--out", self.out, "--quiet")
        self.assertEqual(alone.returncode, 0, alone.stderr)
        with h5py.File(written / "results.h5") as ours, h5py.File(self.out / "results.h5") as theirs:
            names = []
            theirs.visit(names.append)
            self.assertGreater(len(names), 40)
            for name in names:
                self.assertEqual(dict(ours[name].attrs), dict(theirs[name].attrs), name)
                if not isinstance(theirs[name], h5py.Dataset):
                    continue
                mine, other = ours[name][()], theirs[name][()]
                tensors = ("stress_", "rankine_", "mohr_coulomb_", "drucker_prager_")
                if any(word in name for word in (*tensors, "strain_")):  # summed in the order of a rank's bonds
                    np.testing.assert_allclose(mine, other, rtol=0, atol=(1e-14 if any(word in name for word in tensors) else 1e-13) * abs(other).max(), err_msg=name)
                else:
                    np.testing.assert_array_equal(mine, other, name)
                self.assertEqual((ours[name].chunks, ours[name].compression, ours[name].fletcher32),
                                 (theirs[name].chunks, theirs[name].compression, theirs[name].fletcher32), name)

    def test_ranks_without_a_sphere(self):
        # 300 spheres have five blocks: two of seven ranks own nothing
        short = (*QUICK, "--set", "test.stop_strain=0.0003", "--set", 'test.confinement=["0 MPa"]', "--quiet", "--threads", "1")
        self.finish(self.launch(7, "triaxial", self.one, *short, "--out", self.out))
        alone = run("triaxial", self.one, *short, "--out", self.work / "short")
        self.assertEqual(alone.returncode, 0, alone.stderr)
        ours, theirs = (json.loads((f / "summary.json").read_text())["runs"][0] for f in (self.out, self.work / "short"))
        self.assertEqual(ours["state_hash"], theirs["state_hash"])

    def test_options_that_keep_more(self):
        """Rolling, orientation, the surface as it is, lists every N steps: the same bits on three ranks as on one."""
        options = (*GATHER, "--set", "material.rolling_friction=0.5", "--set", "output.orientation=true", "--set", 'test.surface="current"',
                   "--set", "run.search_every=20", "--set", 'test.confinement=["8 MPa"]', "--set", "output.frames=1", "--threads", "1", "--quiet")
        self.finish(self.launch(3, "triaxial", self.one, *options, "--out", self.out))
        alone = run("triaxial", self.one, *options, "--out", self.work / "one")
        self.assertEqual(alone.returncode, 0, alone.stderr)
        ours, theirs = (json.loads((f / "summary.json").read_text())["runs"][0] for f in (self.out, self.work / "one"))
        for key in ("state_hash", "contact_searches", "localisation", "stage1_broken", "stage1_yielded", "broken_shear"):
            self.assertEqual(ours[key], theirs[key], key)
        self.assertGreater(ours["contact_searches"], 20)
        with h5py.File(self.out / "results.h5") as mine, h5py.File(self.work / "one" / "results.h5") as other:
            frame = sorted(name for name in other["run-0"] if name.startswith("frame"))[-1]
            name = f"run-0/{frame}/particles/orientation"
            np.testing.assert_array_equal(mine[name][()], other[name][()])
            self.assertGreater(abs(other[name][()]).max(), 1e-4)

    def test_cement_passes_moments_between_ranks(self):
        options = (*GATHER, "--set", "test.platen_speed=0.1", "--set", 'material.law="parallel-bond"', "--set", 'test.confinement=["0 MPa"]', "--threads", "1", "--quiet")
        case = self.write("cement.toml", self.one.read_text().replace("packed/", f"{self.shelf}/packed/").replace(
            'preset = "concrete"', 'density = 2500\nyoung_modulus = "28 GPa"\npoisson_ratio = 0.2\nfriction_static = 0.8\n'
            'friction_dynamic = 0.3\ntensile_strength = "6 MPa"\nshear_strength = "20 MPa"'))
        self.finish(self.launch(3, "triaxial", case, *options, "--out", self.out))
        alone = run("triaxial", case, *options, "--out", self.work / "one")
        self.assertEqual((alone.returncode, alone.stderr), (0, ""))
        ours, theirs = (json.loads((f / "summary.json").read_text())["runs"][0] for f in (self.out, self.work / "one"))
        for key in ("state_hash", "broken_tension"):
            self.assertEqual(ours[key], theirs[key], key)
        self.assertAlmostEqual(ours["energy_error"] / theirs["energy_error"], 1, delta=1e-6)  # added up rank by rank
        self.assertGreater(ours["broken_tension"], 20)
        self.assertLess(ours["energy_error"], 1e-3)
        self.assertAlmostEqual(ours["young_modulus_Pa"] / 28e9, 1, delta=0.02)

    def test_several_materials(self):
        """Three layers and Hertz contacts, stopped and taken up again on other ranks: the bits of one rank."""
        with (self.shelf / "packed" / "specimen.csv").open(newline="") as file:
            spheres = [row for row in csv.DictReader(line for line in file if not line.startswith("#"))]
        lines = [",".join([*row.values(), "2" if abs(float(row["z_m"])) < 0.015 else "7" if float(row["x_m"]) > 0 else "1"])
                 for row in spheres]
        self.write("specimen.csv", "\n".join(["id,x_m,y_m,z_m,r_m,group", *lines, ""]))
        case = self.write("layers.toml", UCS.replace("[test]", """contact_law = "hertz-mindlin"
[[material.group]]
group = 2
young_modulus = "14 GPa"
density = 2000
tensile_strength = "2 MPa"
[[material.group]]
group = 7
poisson_ratio = 0.1
shear_strength = "30 MPa"
friction_dynamic = 0.6
[test]"""))
        options = (*QUICK, "--threads", "1", "--quiet")
        process = self.launch_and_hold("crack:20", 3, "ucs", case, *options, "--out", self.out)
        process.send_signal(signal.SIGUSR1)
        self.finish(process, 130)
        self.finish(self.launch(2, "ucs", case, *options, "--out", self.out, "--resume"))
        alone = run("ucs", case, *options, "--out", self.work / "one")
        self.assertEqual(alone.returncode, 0, alone.stderr)
        ours, theirs = (json.loads((f / "summary.json").read_text())["runs"][0] for f in (self.out, self.work / "one"))
        for key in ("state_hash", "material_spheres", "material_broken", "broken_shear", "steps"):
            self.assertEqual(ours[key], theirs[key], key)
        self.assertEqual(sum(ours["material_spheres"]), len(spheres))
        self.assertGreater(ours["material_broken"][1], ours["material_broken"][2])  # the weak layer breaks
        self.assertLess(theirs["energy_error"], 1e-3)
        with h5py.File(self.out / "results.h5") as mine:
            np.testing.assert_array_equal(np.unique(mine["run-0/particles/material"][()]), [0, 1, 2])

    def test_ranks_without_a_contact(self):
        # bonds so long that nothing unbonded is near, but around one loose sphere, which is the second rank's
        with (self.shelf / "packed" / "specimen.csv").open(newline="") as file:
            spheres = [row for row in csv.DictReader(line for line in file if not line.startswith("#"))]
        loose = max((row for row in spheres if abs(float(row["z_m"])) < 0.03), key=lambda row: float(row["z_m"]))
        lines = [",".join([*row.values(), "0" if row is loose else "1"]) for row in spheres]
        self.write("specimen.csv", "\n".join(["id,x_m,y_m,z_m,r_m,group", *lines, ""]))
        case = self.write("loose.toml", UCS.replace("[test]", "[bonds]\nrange = 0.35\n[test]").replace("0.006", "0.001"))
        often = ("--set", 'run.checkpoint_every="1 us"', "--threads", "1", "--quiet")  # at every row
        self.finish(self.launch(2, "ucs", case, *QUICK, *often, "--out", self.out))
        alone = run("ucs", case, *QUICK, *often, "--out", self.work / "one")
        self.assertEqual(alone.returncode, 0, alone.stderr)
        ours, theirs = (json.loads((f / "summary.json").read_text())["runs"][0] for f in (self.out, self.work / "one"))
        self.assertEqual(ours["state_hash"], theirs["state_hash"])

    def test_every_way_of_summing_comes_to_the_same_strength(self):
        strength = [one["peak_stress_Pa"] for one in json.loads((self.alone / "summary.json").read_text())["runs"]]
        for scatter, number, confinement in (("private", 1, "8 MPa"), ("atomic", 0, "0 MPa")):
            self.finish(self.launch(2, "triaxial", self.one, *GATHER, "--set", f'run.scatter="{scatter}"', "--set",
                                    f'test.confinement=["{confinement}"]', "--out", self.out, "--threads", 2, "--force", "--quiet"))
            ours = json.loads((self.out / "summary.json").read_text())["runs"][0]["peak_stress_Pa"]
            self.assertAlmostEqual(ours / strength[number], 1, delta=0.05)

    def interrupt(self):
        """Two ranks, stopped while bonds break."""
        process = self.launch_and_hold("crack:20", 2, "triaxial", self.one, *QUICK, "--out", self.out, "--threads", 1, "--quiet")
        process.send_signal(signal.SIGUSR1)
        self.finish(process, 130)
        self.assertTrue((self.out / "checkpoint.h5").exists())

    def test_interrupted_and_taken_up_by_one(self):
        self.interrupt()
        result = run("triaxial", self.one, *QUICK, "--out", self.out, "--resume", "--threads", "1")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.check_same(self.out)

    def test_interrupted_taken_up_by_other_ranks_and_killed(self):
        self.interrupt()
        often = ("--set", 'run.checkpoint_every="1 us"')
        process = self.launch_and_hold("checkpoint-between:3", 4, "triaxial", self.one, *QUICK, *often, "--out", self.out,
                                       "--resume", "--threads", 1)
        for one in [*self.ranks_of(process), process.pid]:
            os.kill(one, signal.SIGKILL)
        finish(process)
        wait_until(lambda: not self.ranks_left(), "the end of the ranks")
        self.assertEqual(sorted(path.name for path in self.out.glob("checkpoint*")), ["checkpoint-before.h5", "checkpoint.h5.part"])
        result = run("triaxial", self.one, *QUICK, "--out", self.out, "--resume", "--threads", "1")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.check_same(self.out)

    def test_a_dead_rank_ends_the_job(self):
        process = self.launch_and_hold("row:5", 2, "triaxial", self.one, *QUICK, "--out", self.out, "--quiet")
        ranks = self.ranks_of(process)
        self.assertEqual(len(ranks), 2)
        (other,) = {*ranks} - {self.held_process}
        os.kill(other, signal.SIGKILL)
        _, errors = finish(process)
        self.assertNotEqual(process.returncode, 0)
        self.assertIn("signal 9", errors)

    def test_trouble_ends_all_ranks_with_one_word_of_ours(self):
        _, errors = self.finish(self.launch(2, "triaxial", self.one, "--set", "test.stop_strain=-1", "--out", self.out), 2)
        self.assertEqual([line for line in errors.splitlines() if line.startswith("breccia-")].__len__(), 1, errors)
        self.assertIn("test.stop_strain", errors)
        self.assertFalse(self.out.exists())

    def test_studies_run_on_one(self):
        process = self.launch(2, "layouts", "--out", self.out)
        _, errors = finish(process)
        self.assertNotEqual(process.returncode, 0)
        self.assertIn("2 ranks asked for; this program runs on one", errors)

    def ranks_of(self, process):
        found = subprocess.run(["pgrep", "-P", str(process.pid), "breccia"], capture_output=True, text=True, check=True)
        return [int(one) for one in found.stdout.split()]

    def ranks_left(self):
        return subprocess.run(["pgrep", "-f", f"^[^ ]*breccia-triaxial .*{self.out}"], capture_output=True, text=True).stdout.split()


if __name__ == "__main__":
    main()
