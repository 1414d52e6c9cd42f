#!/usr/bin/python3
"""Full and read-only disks, through the programs as a user calls them. Root alone may mount them."""
import json

from programs import ProgramTest, command, finish, main, run


class Disks(ProgramTest):
    def test_read_only(self):
        place = self.mount("disk", "size=1m,ro")
        self.check_one_line(run("ucs", self.case, "--out", place / "out"), 4, place, "Read-only", "--out")
        self.check_one_line(run("ucs", self.case, "--out", place), 4, place, "Read-only", "--out")

    def test_full(self):
        """Whatever the size of the disk: exit code 4, and what is there can be read."""
        for size in (4, 64, 256, 500):
            place = self.mount(f"disk-{size}", f"size={size}k")
            with self.subTest(size=f"{size} kB"):
                self.check_one_line(run("ucs", self.case, "--out", place / "out"), 4, place, "No space")
                self.assertEqual(sorted(place.rglob("*.part")), [])
                self.check_readable(place / "out")

    def test_a_full_one_keeps_the_last_checkpoint(self):
        """It fills up after the second checkpoint; the third one, of the next row, has no room."""
        def options(out, every):
            return ("triaxial", self.case, "--set", 'test.confinement=["8 MPa"]', "--set", 'run.scatter="gather"', "--set",
                    "output.frames=0", "--set", f'run.checkpoint_every="{every}"', "--threads", "1", "--out", out)

        disk = self.mount("disk", "size=6m")
        self.out, whole = disk / "out", self.work / "whole"
        process = self.start_and_hold("checkpoint:2", *command(*options(self.out, "1 us")))
        before = (self.out / "checkpoint.h5").read_bytes()
        filler = disk / "filler"
        with filler.open("wb", buffering=0) as file:
            try:
                while file.write(bytes(4096)):
                    pass
            except OSError:
                pass
        self.let_go()
        _, errors = finish(process)
        self.assertEqual(process.returncode, 4, errors)
        self.assertEqual(errors.count("\n"), 1, errors)
        self.assertIn("checkpoint.h5", errors)
        self.assertEqual((self.out / "checkpoint.h5").read_bytes(), before)
        self.assertEqual(list(self.out.glob("*.part")), [])
        filler.unlink()
        result = run(*options(self.out, "5 min"), "--resume")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("goes on from step", result.stdout)
        self.assertEqual(run(*options(whole, "5 min")).returncode, 0)
        ours, theirs = (json.loads((folder / "summary.json").read_text())["runs"] for folder in (self.out, whole))
        self.assertEqual([one["state_hash"] for one in ours], [one["state_hash"] for one in theirs])


if __name__ == "__main__":
    main()
