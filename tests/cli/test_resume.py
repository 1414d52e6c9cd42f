#!/usr/bin/python3
"""Checkpoints: a run that was interrupted, killed or cut off by a full disk goes on to the same curve, bit for bit."""
import json
import os
import random
import signal
import subprocess
import time
import unittest

from programs import BIN, CONFINED, ProgramTest, run, tree

GATHER = ("--set", 'run.scatter="gather"', "--set", "output.frames=4")
OFTEN = ("--set", 'run.checkpoint_every="20 ms"')


class Resume(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        case = cls.shelf / "ucs.toml"
        case.write_text(CONFINED.replace("specimen.csv", "packed/specimen.csv"))
        cls.whole = cls.shelf / "whole"
        result = run("triaxial", case, *GATHER, "--out", cls.whole, "--threads", "2", "--quiet")
        assert result.returncode == 0, result.stderr

    def setUp(self):
        super().setUp()
        self.case = self.write("ucs.toml", CONFINED)

    def start(self, *options):
        return subprocess.Popen([BIN / "breccia-triaxial", self.case, *GATHER, *OFTEN, "--out", self.out, "--quiet", *options],
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def resume(self, *options):
        return run("triaxial", self.case, *GATHER, "--out", self.out, "--resume", *options)

    def wait_for(self, what, process):
        for _ in range(2000):
            if what.exists() or process.poll() is not None:
                break
            time.sleep(0.005)
        self.assertIsNone(process.poll(), "the run was over before it could be stopped")

    def interrupt(self, number=signal.SIGTERM, after=0.3):
        process = self.start("--threads", "1")
        self.wait_for(self.out / "checkpoint-before.h5", process)
        time.sleep(after)
        process.send_signal(number)
        process.communicate(timeout=60)
        return process.returncode

    def check_same(self):
        """The same curves, cracks and states as the run that was never stopped; nothing is left behind."""
        for name in ("curve-0.csv", "curve-1.csv", "cracks-0.csv", "cracks-1.csv", "frames/run-1.pvd"):
            self.assertEqual((self.out / name).read_text(), (self.whole / name).read_text(), name)
        ours, theirs = (json.loads((folder / "summary.json").read_text())["runs"] for folder in (self.out, self.whole))
        for key in ("state_hash", "peak_stress_Pa", "steps", "energy_error", "step_estimates", "critical_time_step_s"):
            self.assertEqual([one[key] for one in ours], [one[key] for one in theirs], key)
        self.assertEqual(sorted(set(tree(self.out)) ^ set(tree(self.whole))), [])

    def test_every_signal_leaves_a_checkpoint_to_go_on_from(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGUSR1):
            with self.subTest(signal=number):
                self.assertEqual(self.interrupt(number), 130)
                result = self.resume("--threads", "2")  # another number of threads
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertRegex(result.stdout, "goes on from step [0-9]+ of run")
                self.check_same()
                for path in sorted(self.out.rglob("*"), reverse=True):
                    path.rmdir() if path.is_dir() else path.unlink()

    def test_killed_again_and_again(self):
        chance = random.Random(7)
        kills = 0
        process = self.start("--threads", "2")
        for _ in range(12):
            try:
                process.wait(timeout=chance.uniform(0.05, 0.7))
                break
            except subprocess.TimeoutExpired:
                process.kill()
                process.communicate()
                kills += 1
                process = self.start("--threads", "2", "--resume")
        _, errors = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 0, errors)
        self.assertGreater(kills, 2)
        self.check_same()

    def damage(self, name, change):
        path = self.out / name
        content = bytearray(path.read_bytes())
        change(content)
        path.write_bytes(content)

    def test_damaged_checkpoints_are_found_out(self):
        def flip(content):
            content[len(content) // 2] ^= 4

        for change in (flip, lambda content: content.__delitem__(slice(len(content) - 5000, None)), lambda content: content.clear()):
            self.assertEqual(self.interrupt(), 130)
            self.damage("checkpoint.h5", change)
            result = self.resume()
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertRegex(result.stdout, "checkpoint.h5: damaged, not used")
            self.assertIn("checkpoint-before.h5", result.stdout)
            self.check_same()
            for path in sorted(self.out.rglob("*"), reverse=True):
                path.rmdir() if path.is_dir() else path.unlink()

    def test_without_a_good_checkpoint_it_begins_at_the_start(self):
        self.assertEqual(self.interrupt(), 130)
        for name in ("checkpoint.h5", "checkpoint-before.h5"):
            self.damage(name, lambda content: content.clear())
        result = self.resume()
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("no checkpoint, begins at the start", result.stdout)
        self.check_same()

    def test_a_changed_case_is_refused(self):
        self.assertEqual(self.interrupt(), 130)
        before = tree(self.out)
        self.check_one_line(self.resume("--set", "time.safety=0.7"), 2, "checkpoint.h5", "time.safety = 0.7, was 0.8", "--force")
        self.case.write_text(CONFINED.replace("stop_strain = 0.005", "stop_strain = 0.006"))
        self.check_one_line(self.resume(), 2, "test.stop_strain = 0.006, was 0.005")
        self.assertEqual(tree(self.out), before)

    def test_another_specimen_is_refused(self):
        self.assertEqual(self.interrupt(), 130)
        specimen = self.work / "specimen.csv"
        specimen.write_text("\n".join(specimen.read_text().splitlines()[:-1]) + "\n")
        self.check_one_line(self.resume(), 2, "checkpoint.h5", "specimen.csv: has changed since", "--force")

    def test_a_finished_run_is_left_alone(self):
        self.case, self.out = self.shelf / "ucs.toml", self.whole
        before = tree(self.out)
        result = self.resume()
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("finished, nothing to do", result.stdout)
        self.assertEqual(tree(self.out), before)
        self.check_one_line(self.resume("--set", "time.safety=0.7"), 2, "case.toml", "time.safety = 0.7, was 0.8")

    def test_a_full_disk_keeps_the_last_checkpoint(self):
        disk = self.mount("disk", "size=6m")
        self.out = disk / "out"
        process = self.start("--threads", "1", "--set", "output.frames=0")
        self.wait_for(self.out / "checkpoint-before.h5", process)
        filler = disk / "filler"
        with filler.open("wb", buffering=0) as file:
            try:
                while file.write(bytes(4096)):
                    pass
            except OSError:
                pass
        _, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 4, errors)
        self.assertEqual(errors.count("\n"), 1, errors)
        filler.unlink()
        result = self.resume("--set", "output.frames=0")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("goes on from step", result.stdout)
        ours, theirs = (json.loads((folder / "summary.json").read_text())["runs"] for folder in (self.out, self.whole))
        self.assertEqual([one["state_hash"] for one in ours], [one["state_hash"] for one in theirs])

    def test_refusals(self):
        self.check_one_line(self.resume("--force"), 2, "--resume, --force")
        pack = self.write("pack.toml", '[specimen]\ndiameter = "50 mm"\nheight = "100 mm"\npack = { spheres = 50 }\n')
        self.check_one_line(run("pack", pack, "--resume", "--out", self.out), 2, "--resume", "no checkpoints")


if __name__ == "__main__":
    unittest.main()
