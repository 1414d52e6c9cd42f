#!/usr/bin/python3
"""Checkpoints: a run that was interrupted or killed, at whatever point of its way, goes on to the same curve, bit for
bit."""
import json
import shutil
import signal

from programs import CONFINED, ProgramTest, command, finish, main, run, tree

GATHER = ("--set", 'run.scatter="gather"', "--set", "output.frames=4")
ALWAYS, NEVER = "1 us", "1e9 s"  # between checkpoints: one at every row, none but when asked

BEGINS = "no checkpoint, begins at the start"
NEWEST, BEFORE = r"goes on from step \d+ of run \d \(.*/checkpoint.h5\)", r"goes on from step \d+ of run \d \(.*/checkpoint-before.h5\)"


def of_second(said):
    return said.replace(r"run \d", "run 2")


class Resume(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        case = cls.shelf / "ucs.toml"
        case.write_text(CONFINED.replace("specimen.csv", "packed/specimen.csv"))
        cls.whole = cls.shelf / "whole"
        result = run("triaxial", case, *GATHER, "--out", cls.whole, "--threads", "2", "--quiet")
        assert result.returncode == 0, result.stderr
        cls.rows, cls.cracks = ([len((cls.whole / f"{name}-{k}.csv").read_text().splitlines()) - 1 for k in (0, 1)]
                                for name in ("curve", "cracks"))

    def setUp(self):
        super().setUp()
        self.case = self.write("ucs.toml", CONFINED)

    def hold(self, point, *options, every=NEVER):
        """Starts the test, or takes it up, and returns when it waits."""
        every = ("--set", f'run.checkpoint_every="{every}"')
        return self.start_and_hold(point, *command("triaxial", self.case, *GATHER, *every, "--out", self.out, *options))

    def resume(self, *options):
        return run("triaxial", self.case, *GATHER, "--out", self.out, "--resume", *options)

    def interrupt(self, point, number=signal.SIGTERM, *options, every=NEVER):
        process = self.hold(point, "--threads", "1", *options, every=every)
        process.send_signal(number)
        out, errors = finish(process)
        self.assertEqual((process.returncode, errors), (130, ""), out)
        self.assertIn("--resume goes on from here", out)
        return out

    def interrupt_twice(self):
        """Two checkpoints, both from the midst of the second run, where bonds break."""
        self.interrupt(f"crack:{self.cracks[0] + self.cracks[1] // 2}")
        self.interrupt("row:10", signal.SIGTERM, "--resume")
        self.assertEqual(self.checkpoints(), ["checkpoint-before.h5", "checkpoint.h5"])

    def checkpoints(self):
        return sorted(path.name for path in self.out.glob("checkpoint*"))

    def check_same(self):
        """The same curves, cracks and states as the run that was never stopped; nothing is left behind."""
        for name in ("curve-0.csv", "curve-1.csv", "cracks-0.csv", "cracks-1.csv", "frames/run-1.pvd"):
            self.assertEqual((self.out / name).read_text(), (self.whole / name).read_text(), name)
        ours, theirs = (json.loads((folder / "summary.json").read_text())["runs"] for folder in (self.out, self.whole))
        for key in ("state_hash", "peak_stress_Pa", "steps", "energy_error", "step_estimates", "critical_time_step_s"):
            self.assertEqual([one[key] for one in ours], [one[key] for one in theirs], key)
        self.assertEqual(sorted(set(tree(self.out)) ^ set(tree(self.whole))), [])
        self.check_readable(self.out)

    def check_goes_on(self, *options, said=NEWEST):
        result = self.resume(*options)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertRegex(result.stdout, said)
        self.check_same()

    def test_every_signal_leaves_a_checkpoint_to_go_on_from(self):
        pressing, breaking = self.rows[0] + 20, self.cracks[0] + self.cracks[1] // 2
        for number, point, every, of in ((signal.SIGINT, f"row:{self.rows[0] // 2}", NEVER, 1),
                                         (signal.SIGTERM, f"row:{pressing}", NEVER, 2),
                                         (signal.SIGUSR1, f"crack:{breaking}", NEVER, 2),
                                         (signal.SIGTERM, "step:9", NEVER, 1),  # between two rows
                                         (signal.SIGTERM, "results-filled:3", NEVER, 1),  # in the midst of a frame
                                         (signal.SIGTERM, "checkpoint-begun:3", ALWAYS, 1)):  # and of a checkpoint
            with self.subTest(signal=number, point=point):
                self.interrupt(point, number, every=every)
                self.check_goes_on("--threads", "2", said=f"of run {of} ")  # another number of threads
                shutil.rmtree(self.out)

    def test_killed_wherever(self):
        """One run, killed at every point at which something is half done, and taken up each time."""
        part, newest, before = "checkpoint.h5.part", "checkpoint.h5", "checkpoint-before.h5"
        second = f"crack:{self.cracks[0] // 2 + self.cracks[1] // 2}"
        # where, checkpoints, signal; what the part before had left to go on from, what this one leaves
        way = (("checkpoint-begun:1", ALWAYS, signal.SIGKILL, "300 spheres", [part]),
               ("checkpoint-between:1", ALWAYS, signal.SIGKILL, BEGINS, [part]),
               ("checkpoint:1", ALWAYS, signal.SIGKILL, BEGINS, [newest]),
               ("step:3", NEVER, signal.SIGKILL, NEWEST, [newest]),
               ("results-claimed:1", NEVER, signal.SIGKILL, NEWEST, [newest]),
               ("results-filled:1", NEVER, signal.SIGKILL, NEWEST, [newest]),
               ("results-flushed:1", NEVER, signal.SIGKILL, NEWEST, [newest]),
               ("results-linked:1", NEVER, signal.SIGKILL, NEWEST, [newest]),
               ("frame:1", NEVER, signal.SIGKILL, NEWEST, [newest]),
               ("crack:9", NEVER, signal.SIGKILL, NEWEST, [newest]),
               (f"crack:{self.cracks[0] // 2}", NEVER, signal.SIGTERM, NEWEST, [before, newest]),
               ("checkpoint-filled:1", ALWAYS, signal.SIGKILL, NEWEST, [before, newest, part]),
               ("checkpoint-sealed:1", ALWAYS, signal.SIGKILL, NEWEST, [before, newest, part]),
               ("checkpoint-between:1", ALWAYS, signal.SIGKILL, NEWEST, [before, part]),
               ("step:2", NEVER, signal.SIGKILL, BEFORE, [before, part]),
               ("checkpoint:1", ALWAYS, signal.SIGKILL, BEFORE, [before, newest]),
               ("run:1", NEVER, signal.SIGKILL, NEWEST, [before, newest]),  # the first run is written
               (second, NEVER, signal.SIGTERM, NEWEST, [before, newest]),
               ("results-flushed:1", NEVER, signal.SIGKILL, of_second(NEWEST), [before, newest]),
               ("checkpoint-between:3", ALWAYS, signal.SIGKILL, of_second(NEWEST), [before, part]),
               ("run:1", NEVER, signal.SIGKILL, of_second(BEFORE), [before, part]))  # all is written
        for number, (point, every, kind, said, left) in enumerate(way):
            process = self.hold(point, "--threads", str(1 + number % 2), *(["--resume"] if number else []), every=every)
            process.send_signal(kind)
            out, errors = finish(process)
            where = f"stop {number} of the way, at {point}: {out}"
            self.assertEqual((process.returncode, errors), (130 if kind == signal.SIGTERM else -kind, ""), where)
            self.assertRegex(out, said, where)
            self.assertEqual(self.checkpoints(), sorted(left), where)
        self.check_goes_on("--threads", "2", said=of_second(BEFORE))

    def damage(self, name, change):
        path = self.out / name
        content = bytearray(path.read_bytes())
        change(content)
        path.write_bytes(content)

    def test_damaged_checkpoints_are_found_out(self):
        def flip(content):
            content[len(content) // 2] ^= 4

        self.interrupt_twice()
        kept = self.work / "kept"
        shutil.copytree(self.out, kept)
        for change in (flip, lambda content: content.__delitem__(slice(len(content) - 5000, None)), lambda content: content.clear()):
            self.damage("checkpoint.h5", change)
            self.check_goes_on(said=f"checkpoint.h5: damaged, not used.*\n(.*\n)*{BEFORE}")
            shutil.rmtree(self.out)
            shutil.copytree(kept, self.out)

    def test_without_a_good_checkpoint_it_begins_at_the_start(self):
        self.interrupt_twice()
        for name in ("checkpoint.h5", "checkpoint-before.h5"):
            self.damage(name, lambda content: content.clear())
        self.check_goes_on(said=BEGINS)

    def test_a_changed_case_is_refused(self):
        self.interrupt("row:10")
        before = tree(self.out)
        self.check_one_line(self.resume("--set", "time.safety=0.7"), 2, "checkpoint.h5", "time.safety = 0.7, was 0.8", "--force")
        self.case.write_text(CONFINED.replace("stop_strain = 0.005", "stop_strain = 0.006"))
        self.check_one_line(self.resume(), 2, "test.stop_strain = 0.006, was 0.005")
        self.assertEqual(tree(self.out), before)

    def test_another_specimen_is_refused(self):
        self.interrupt("row:10")
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

    def test_refusals(self):
        self.check_one_line(self.resume("--force"), 2, "--resume, --force")
        pack = self.write("pack.toml", '[specimen]\ndiameter = "50 mm"\nheight = "100 mm"\npack = { spheres = 50 }\n')
        self.check_one_line(run("pack", pack, "--resume", "--out", self.out), 2, "--resume", "no checkpoints")


if __name__ == "__main__":
    main()
