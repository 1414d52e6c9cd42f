#!/usr/bin/python3
"""What a run stands on: inputs that change, folders that two want, files that are not breccia's, limits of the system, and
inputs that are no files or nested without end. One line, the right exit code, nothing lost."""
import fcntl
import hashlib
import json
import os
import resource
import shutil
import signal
import socket
import subprocess
import unittest

from programs import BIN, HANG, SOURCE, UCS, ProgramTest, command, finish, main, run, tree

LIST = ".breccia-files"
SHORT = UCS.replace("stop_strain = 0.006", "stop_strain = 0.0002")
# the first run ends soon; the second one makes a checkpoint at every row, and has not ended when it is stopped
SERIES = UCS.replace("stop_strain = 0.006", 'confinement = ["0 MPa", "20 MPa"]\nstop_strain = 0.5\nstop_after_peak = 0.2\nplaten_speed = "0.4 m/s"')
SERIES = SERIES.replace("frames = 3", 'frames = 0\n[run]\nscatter = "gather"')
ENDLESS = SERIES.replace('["0 MPa", "20 MPa"]', '["20 MPa"]') + 'checkpoint_every = "1 us"\n'


def sha256(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


class WrongFiles(ProgramTest):
    def ucs(self, *options, case=SHORT, **more):
        return run("ucs", self.write("case.toml", case), "--out", self.out, "--threads", "1", *options, **more)

    def triaxial(self, *options):
        return run("triaxial", self.case, "--out", self.out, "--threads", "1", *options)

    def hold(self, point, *options):
        """A series that waits at a point of its way."""
        return self.start_and_hold(point, *command("triaxial", self.case, "--out", self.out, "--threads", "1", *options))

    def stop(self, process):
        process.send_signal(signal.SIGTERM)
        out, errors = finish(process)
        self.assertEqual((process.returncode, errors), (130, ""))
        return out

    def interrupted(self, case, point):
        """A series that was told to stop at a point of its way."""
        self.case = self.write("case.toml", case)
        self.stop(self.hold(point, "--quiet"))
        return tree(self.out)

    def go_on_and_stop(self):
        """--resume, told to stop after its first row."""
        self.assertIn("goes on from step", self.stop(self.hold("row:1", "--resume")))


class Changes(WrongFiles):
    """--resume goes on only from what there was."""

    def scale(self, factor, columns):
        specimen = self.work / "specimen.csv"
        head, *rows = specimen.read_text().splitlines()
        fields = [row.split(",") for row in rows]
        for row in fields:
            for k in columns:
                row[k] = repr(float(row[k]) * factor)
        specimen.write_text("\n".join([head, *map(",".join, fields)]) + "\n")

    def test_specimen_of_a_run_that_was_interrupted(self):
        before = self.interrupted(ENDLESS, "row:3")
        good = (self.work / "specimen.csv").read_bytes()
        for factor, columns in ((1.0001, (1, 2, 3, 4)), (0.999, (4,)), (1.0000001, (1,))):
            self.scale(factor, columns)
            self.check_one_line(self.triaxial("--resume"), 2, "specimen.csv: has changed since", "checkpoint.h5", "--force")
            (self.work / "specimen.csv").write_bytes(good)
        self.assertEqual(tree(self.out), before)

    def test_specimen_of_a_finished_series(self):
        self.assertEqual(self.ucs().returncode, 0)
        before = tree(self.out)
        self.assertIn("nothing to do", self.ucs("--resume").stdout)
        self.scale(0.999, (4,))
        self.check_one_line(self.ucs("--resume"), 2, "specimen.csv: has changed since", "case.toml")
        self.assertEqual(tree(self.out), before)

    def test_a_specimen_may_move(self):
        self.assertEqual(self.ucs().returncode, 0)
        (self.work / "specimen.csv").rename(self.work / "moved.csv")
        self.assertIn("nothing to do", self.ucs("--resume", case=SHORT.replace("specimen.csv", "moved.csv")).stdout)

    def test_preset(self):
        (self.work / "materials").mkdir()
        preset = self.work / "materials" / "mine.toml"
        shutil.copy(SOURCE / "data" / "materials" / "concrete.toml", preset)
        case = SHORT.replace('"concrete"', '"mine"')
        self.assertEqual(self.ucs(case=case).returncode, 0)
        inputs = json.loads((self.out / "summary.json").read_text())["inputs"]
        self.assertEqual({os.path.basename(name): digest for name, digest in inputs.items()},
                         {name.name: sha256(name) for name in (self.work / "case.toml", preset, self.work / "specimen.csv")})
        preset.write_text(preset.read_text() + "# a note changes nothing\n")
        self.assertIn("nothing to do", self.ucs("--resume", case=case).stdout)
        preset.write_text(preset.read_text().replace("2500 kg/m^3", "2400 kg/m^3"))
        self.check_one_line(self.ucs("--resume", case=case), 2, "material.density", "2400 kg/m^3", "was")

    def test_the_resolved_case_knows_its_specimen(self):
        self.assertEqual(self.ucs().returncode, 0)
        resolved, again = self.out / "case.toml", self.work / "again"
        self.assertIn(f'sha256 = "{sha256(self.work / "specimen.csv")}"', resolved.read_text())
        self.assertEqual(run("ucs", resolved, "--out", again, "--threads", "1").returncode, 0)
        one, two = (json.loads((folder / "summary.json").read_text())["runs"][0] for folder in (self.out, again))
        self.assertEqual(one["state_hash"], two["state_hash"])
        self.scale(1.001, (4,))
        self.check_one_line(run("ucs", resolved, "--dry-run"), 2, "case.toml:", "specimen.sha256", "specimen.csv has changed since")
        other = self.work / "other.csv"
        shutil.copy(self.work / "specimen.csv", other)
        self.assertEqual(run("ucs", resolved, "--dry-run", "--set", f"specimen.file={other}").returncode, 0)
        self.check_one_line(run("pack", self.write("pack.toml", '[specimen]\ndiameter = "50 mm"\nheight = "100 mm"\nsha256 = "0"\npack.spheres = 9\n')), 2,
                            "pack.toml:4", "specimen.sha256")

    def test_files_of_finished_runs(self):
        before = self.interrupted(SERIES, "run:1")
        runs = json.loads(before["summary.json"])["runs"]
        self.assertEqual(runs[0]["files"], {name: sha256(self.out / name) for name in ("curve-0.csv", "cracks-0.csv")})
        for name in ("curve-0.csv", "cracks-0.csv"):
            path = self.out / name
            for text, what in ((None, "has gone"), (b"", "has changed"), (before[name][:-20], "has changed"),
                               (before[name].replace(b"1", b"2", 1), "has changed")):
                path.unlink()
                if text is not None:
                    path.write_bytes(text)
                self.check_one_line(self.triaxial("--resume"), 2, f"{name}: {what} since", "--force")
                path.write_bytes(before[name])
        # a summary that is damaged is made again from the checkpoint, by the run that goes on
        (self.out / "summary.json").write_text("{")
        self.go_on_and_stop()
        self.assertEqual(json.loads((self.out / "summary.json").read_text())["runs"][0], runs[0])

    def test_files_of_a_finished_series(self):
        self.assertEqual(self.ucs().returncode, 0)
        before = tree(self.out)
        for name in ("curve-0.csv", "cracks-0.csv"):
            (self.out / name).write_bytes(before[name] + b"\n")
            self.check_one_line(self.ucs("--resume"), 2, f"{name}: has changed since")
            (self.out / name).unlink()
            self.check_one_line(self.ucs("--resume"), 2, f"{name}: has gone since")
            (self.out / name).write_bytes(before[name])
        for text in ("", "{}", before["summary.json"].decode()[:-100]):
            (self.out / "summary.json").write_text(text)
            self.check_one_line(self.ucs("--resume"), 2, "summary.json: damaged", "--force")
        (self.out / "summary.json").write_bytes(before["summary.json"])
        self.assertEqual(tree(self.out), before)

    def test_ids_keep_their_digits(self):
        """Up to 2^64 - 1, through a checkpoint too."""
        head, *rows = (self.work / "specimen.csv").read_text().splitlines()
        ids = [2**64 - 1 - 2 * k for k in range(len(rows))]
        (self.work / "specimen.csv").write_text("\n".join([head] + [f"{one},{row.split(',', 1)[1]}" for one, row in zip(ids, rows)]) + "\n")
        case = SERIES.replace('["0 MPa", "20 MPa"]', '["0 MPa"]').replace("stop_after_peak = 0.2", "stop_after_peak = 0")
        before = self.interrupted(case, "crack:20")
        self.go_on_and_stop()
        text = (self.out / "cracks-0.csv").read_bytes()
        self.assertTrue(text.startswith(before["cracks-0.csv"]))
        ends = [int(end) for line in text.decode().splitlines()[1:] for end in line.split(",")[2:4]]
        self.assertGreater(len(ends), 20)
        self.assertLessEqual(set(ends), set(ids))


class Folders(WrongFiles):
    """One run at a time; what is removed is breccia's own, and never what the run reads."""

    def test_two_runs_in_one_folder(self):
        self.assertEqual(self.ucs().returncode, 0)
        before = tree(self.out)
        with (self.out / LIST).open("r+") as other:
            fcntl.flock(other, fcntl.LOCK_EX)
            for option in ("--force", "--resume"):
                self.check_one_line(self.ucs(option), 2, self.out, "another run is writing there", "--out")
            self.check_one_line(run("pack", self.shelf / "pack.toml", "--out", self.out, "--force"), 2, "another run")
            self.assertEqual(self.ucs("--dry-run").returncode, 0)
            self.assertEqual(tree(self.out), before)
        self.assertEqual(self.ucs("--force").returncode, 0)  # the file that is left behind locks nobody out

    def test_a_run_holds_its_folder(self):
        self.case = self.write("case.toml", ENDLESS)
        process = self.hold("checkpoint:1", "--quiet")
        for option in ("--force", "--resume"):
            self.check_one_line(self.triaxial(option), 2, "another run is writing there")
        process.kill()
        finish(process)
        self.assertEqual(self.ucs("--force").returncode, 0)  # the lock went with the run

    def test_own_input_is_kept(self):
        job = self.work / "job"
        job.mkdir()
        shutil.copy(self.work / "specimen.csv", job)
        (job / "case.toml").write_text("# notes of the operator\n" + SHORT)
        (job / "mine.toml").write_text(SHORT)
        for name in ("curves.png", "energy.png", "specimen.png", "curve-7.csv"):
            (job / name).write_bytes(b"a picture")
        before = tree(job)
        for options in ((), ("--force",)):
            self.check_one_line(run("ucs", job / "case.toml", "--out", job, *options), 2, "case.toml", "this run reads it", "--out")
            # seen through a link the folder is the same
            (self.work / "link").unlink(missing_ok=True)
            (self.work / "link").symlink_to(job)
            self.check_one_line(run("ucs", job / "case.toml", "--out", self.work / "link", *options), 2, "this run reads it")
            # another case, which would be overwritten all the same
            self.check_one_line(run("ucs", job / "mine.toml", "--out", job, *options), 2, "case.toml", "breccia did not write it")
            self.check_one_line(run("pack", self.shelf / "pack.toml", "--out", job, *options), 2, "specimen.csv", "breccia did not write it")
        self.assertFalse((job / LIST).exists())
        self.assertEqual(tree(job), before)
        (job / "case.toml").unlink()
        for _ in range(2):
            self.assertEqual(run("ucs", job / "mine.toml", "--out", job, "--force").returncode, 0)
        after = tree(job)
        self.assertEqual({name: after[name] for name in before if name != "case.toml"},
                         {name: text for name, text in before.items() if name != "case.toml"})

    def test_links_to_what_is_read(self):
        self.assertEqual(self.ucs().returncode, 0)
        curve = self.out / "curve-0.csv"
        for link in (os.link, os.symlink):
            curve.unlink()
            link(self.work / "specimen.csv", curve)
            self.check_one_line(self.ucs("--force"), 2, "curve-0.csv", "this run reads it")
            self.assertTrue((self.work / "specimen.csv").exists())
        self.assertTrue(curve.is_symlink())

    def test_links_that_lead_elsewhere(self):
        self.out.mkdir()
        (self.out / "cracks-0.csv").symlink_to(self.write("precious.txt", "mine"))
        (self.out / "curve-0.csv").symlink_to(self.work / "nowhere")
        self.check_one_line(self.ucs("--force"), 2, "breccia did not write it")
        (self.out / "curve-0.csv").unlink()
        self.check_one_line(self.ucs("--force"), 2, "cracks-0.csv", "breccia did not write it")
        self.assertEqual((self.work / "precious.txt").read_text(), "mine")

    def test_the_list_leads_nowhere_else(self):
        precious = self.write("precious.txt", "mine")
        self.out.mkdir()
        (self.out / LIST).write_text(f"../precious.txt\n{precious}\nframes/../../precious.txt\nhalf a li")
        self.assertEqual(self.ucs("--force").returncode, 0)
        self.assertEqual(precious.read_text(), "mine")

    def test_a_resolved_case_runs_in_its_own_folder(self):
        self.assertEqual(self.ucs().returncode, 0)
        case = self.out / "case.toml"
        resolved = case.read_text()
        self.check_one_line(run("ucs", case, "--out", self.out), 2, "holds results already")
        self.assertEqual(run("ucs", case, "--out", self.out, "--force").returncode, 0)
        self.assertIn("nothing to do", run("ucs", case, "--out", self.out, "--resume").stdout)
        self.check_one_line(run("ucs", case, "--out", self.out, "--force", "--set", "time.safety=0.7"), 2, "this run reads it")
        self.assertEqual(case.read_text(), resolved)

    def test_plots(self):
        self.assertEqual(self.ucs(case=UCS).returncode, 0)
        (self.out / "energy.png").write_bytes(b"a picture")
        plot = subprocess.run(["/usr/bin/python3", SOURCE / "scripts" / "plot", self.out], capture_output=True, text=True)
        self.assertEqual(plot.returncode, 4, plot.stderr)
        self.assertIn("energy.png is there, and breccia did not draw it", plot.stderr)
        self.assertTrue((self.out / "curves.png").exists())
        self.assertEqual(self.ucs("--force").returncode, 0)
        self.assertFalse((self.out / "curves.png").exists())
        self.assertEqual((self.out / "energy.png").read_bytes(), b"a picture")


class NoFiles(WrongFiles):
    """Pipes, devices, sockets and folders are no input, and nobody waits for them."""

    def kinds(self, name):
        path = self.work / name
        os.mkfifo(path)
        yield path, "a pipe"
        path.unlink()
        here = os.open(".", os.O_RDONLY)
        os.chdir(self.work)  # the path of a socket must be short
        try:
            with socket.socket(socket.AF_UNIX) as one:
                one.bind(name)
        finally:
            os.fchdir(here)
            os.close(here)
        yield path, "a socket"
        path.unlink()
        path.mkdir()
        yield path, "a folder"
        path.rmdir()
        path.symlink_to("/dev/zero")
        yield path, "a device"
        path.unlink()
        path.symlink_to(path)
        yield path, ""
        path.unlink()

    def test_cases(self):
        for path, what in self.kinds("case.toml"):
            for program in ("ucs", "impact", "pack", "workprecision"):
                self.check_one_line(run(program, path, "--out", self.out), 2, path, what)

    def test_specimens(self):
        for path, what in self.kinds("other.csv"):
            self.check_one_line(run("ucs", self.write("ucs.toml", UCS.replace("specimen.csv", "other.csv")), "--out", self.out), 2,
                                "ucs.toml:2", "specimen.file", "other.csv", what)
        self.assertFalse(self.out.exists())

    def test_presets(self):
        (self.work / "materials").mkdir()
        for path, what in self.kinds("materials/mine.toml"):
            result = run("ucs", self.write("ucs.toml", UCS.replace('"concrete"', '"mine"')), "--out", self.out)
            self.check_one_line(result, 2, "mine", what)

    def test_results(self):
        for name in ("curve-0.csv", "results.h5", "case.toml", "frames/run-0.pvd"):
            self.out.mkdir()
            (self.out / "frames").mkdir()
            os.mkfifo(self.out / name)
            self.check_one_line(self.ucs("--force"), 2, name, "breccia did not write it")
            shutil.rmtree(self.out)
        self.out.mkdir()
        for name in ("checkpoint.h5", "summary.json"):
            os.mkfifo(self.out / name)
            self.check_one_line(self.ucs("--resume"), 2, name)
            (self.out / name).unlink()
        os.mkfifo(self.out / LIST)
        self.check_one_line(self.ucs(), 4, LIST)

    def test_a_place_that_is_no_utf_8(self):
        folder = os.fsencode(self.work) + b"/bad\xff"
        os.mkdir(folder)
        shutil.copy(os.fsencode(self.work / "specimen.csv"), folder)
        with open(folder + b"/ucs.toml", "w") as file:
            file.write(SHORT)
        result = run("ucs", os.fsdecode(folder + b"/ucs.toml"), "--out", self.out)
        self.check_one_line(result, 2, "ucs.toml:2", "specimen.file", "bad\\xff", "not UTF-8")
        self.assertFalse(self.out.exists())
        # results may lie there: the resolved case does not name the place
        self.assertEqual(run("ucs", self.write("ucs.toml", SHORT), "--quiet", "--out", os.fsdecode(folder + b"/out")).returncode, 0)
        again = run("ucs", os.fsdecode(folder + b"/out/case.toml"), "--dry-run")
        self.assertEqual((again.returncode, again.stderr), (0, ""))


class Nesting(WrongFiles):
    def test_cases(self):
        deep = 60000
        dots = ".".join(["a"] * deep)
        for text in (f"{dots} = 1\n", f"[{dots}]\n", f"[[{dots}]]\n", f"x = {{ {dots} = 1 }}\n", "x = " + "[" * deep, "x = " + "{a=" * deep,
                     "x = " + "[" * 200 + "]" * 200 + "\n", "\n".join(f"[{'.'.join(['a'] * k)}]" for k in (1, 2, 500)),
                     f'"{dots}".{dots} = 1\n', f"x = '''\n'''\n{dots} = 1\n"):
            path = self.write("case.toml", text)
            for program in ("ucs", "impact"):
                self.check_one_line(run(program, path), 2, "case.toml:", "nested")
        # what only looks nested is no reason
        text = UCS + f'# {dots}\n"{dots}" = 1\n'
        self.check_one_line(run("ucs", self.write("case.toml", text)), 2, "unknown key")

    def test_options(self):
        deep = 30000
        dots = ".".join(["a"] * deep)
        self.check_one_line(run("ucs", self.case, "--set", f"{dots}=1"), 2, "--set")
        self.check_one_line(run("ucs", self.case, "--set", "material.density=" + "[" * deep), 2, "material.density")
        self.check_one_line(run("ucs", self.case, "--set", f"material.density={{{dots}=1}}"), 2, "material.density")
        impact = SOURCE / "data" / "cases" / "impact-two-spheres.toml"
        self.check_one_line(run("impact", impact, "--set", f"{dots}=1"), 2, "--set", "nested")

    def test_mdpa(self):
        self.write("deep.mdpa", "Begin Nodes\nEnd Nodes\n" + "Begin Table\n" * 300000)
        self.check_one_line(run("ucs", self.write("ucs.toml", UCS.replace("specimen.csv", "deep.mdpa")), "--dry-run"), 2, "deep.mdpa:", "no End")

    def test_exponents(self):
        for number in ("0e2147483647", "0e-2147483648", "0e99999999999999999999", "1e-2147483648", "1e2147483647"):
            self.check_one_line(run("ucs", self.case, "--dry-run", "--set", f'material.young_modulus="{number} GPa"'), 2, "young_modulus")


class Messages(WrongFiles):
    def test_long_words(self):
        word = "word" * 15000
        for case in (UCS.replace("diameter", word), UCS.replace('"50 mm"', f'"{word}"'), UCS.replace("concrete", word),
                     UCS.replace("specimen.csv", word[:200] + ".csv"), UCS.replace('"50 mm"', f'"50 {word}"')):
            result = self.ucs(case=case)
            self.check_one_line(result, 2, "case.toml:", "...")
            self.assertLess(len(result.stderr), 2000)
        for options in (("--set", f"{word}=1"), ("--set", f"test.stop_strain={word}"), (f"--{word}",), ("--threads", word)):
            result = self.ucs(*options)
            self.check_one_line(result, 2, "...")
            self.assertLess(len(result.stderr), 2000)
        (self.work / "specimen.csv").write_text(f"id,x_m,{word}\n1,2,3\n")
        self.check_one_line(self.ucs(), 2, "specimen.csv:1", "wordword", '..."')
        (self.work / "specimen.csv").write_text("id x y z radius of every sphere in the packing, as measured by the operator of the scanner\n1,2,3\n")
        self.check_one_line(self.ucs(), 2, '"id x y z radius of every sphere in the packing, as measured by the operator of..."')

    @unittest.skipUnless(shutil.which("mpirun"), "mpirun is not installed")
    def test_several_ranks_say_it_once(self):
        def launch(*words):
            root = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
            return subprocess.run(["mpirun", "-n", "3", "--oversubscribe", "--bind-to", "none", BIN / "breccia-triaxial", *words],
                                  capture_output=True, text=True, env=os.environ | root, timeout=HANG)

        result = launch(self.case, "--nonsense")
        self.assertEqual((result.returncode, result.stderr.count("breccia-triaxial: ")), (2, 1), result.stderr)
        result = launch("--help")
        self.assertEqual((result.returncode, result.stdout.count("Usage:"), result.stderr), (0, 1, ""))
        result = launch("--version")
        self.assertEqual((result.returncode, len(result.stdout.split())), (0, 1), result.stdout)


class Limits(WrongFiles):
    """Of the system: what a program may not have is said in one line."""

    def test_size_of_a_file(self):
        self.case = self.write("case.toml", ENDLESS.replace("frames = 0", "frames = 3"))
        for kilobytes in (0, 1, 64, 300):
            result = self.triaxial("--force", "--quiet", preexec=kilobytes)
            self.check_one_line(result, 4, "File too large", "ulimit -f")

    def triaxial(self, *options, preexec=None, **more):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (preexec * 1024, preexec * 1024))

        return run("triaxial", self.case, "--out", self.out, "--threads", "1", *options, preexec_fn=None if preexec is None else limit, **more)

    def test_the_last_checkpoint_outlives_the_limit(self):
        before = self.interrupted(ENDLESS, "row:3")
        limit = len(before["checkpoint.h5"]) // 2048
        self.check_one_line(self.triaxial("--resume", "--quiet", preexec=limit), 4, "File too large")
        self.assertEqual(sorted(self.out.glob("*.part")), [])
        kept = {(self.out / name).read_bytes() for name in ("checkpoint.h5", "checkpoint-before.h5") if (self.out / name).exists()}
        self.assertIn(before["checkpoint.h5"], kept)

    def test_nobody_reads(self):
        self.case = self.write("case.toml", ENDLESS)
        reader, writer = os.pipe()
        os.close(reader)
        result = self.triaxial(capture_output=False, stdout=writer, stderr=subprocess.PIPE)
        os.close(writer)
        self.check_one_line(result, 4, "cannot write to the standard output: Broken pipe")
        for words in (("--help",), ("--version",), (self.case, "--dry-run"), (self.case, "--explain")):
            with open("/dev/full", "w") as full:
                self.check_one_line(run("triaxial", *words, capture_output=False, stdout=full, stderr=subprocess.PIPE), 4, "No space left")
        with open("/dev/full", "w") as full:
            self.check_one_line(run("stability", "--list", capture_output=False, stdout=full, stderr=subprocess.PIPE), 4, "No space left")

    def test_closed_streams(self):
        def close(*streams):
            return lambda: [os.close(stream) for stream in streams]

        plain = self.ucs("--set", "output.frames=2")
        self.assertEqual(plain.returncode, 0)
        wanted = tree(self.out)
        for streams in ((0,), (1,), (2,), (1, 2), (0, 1, 2)):
            result = self.ucs("--force", "--set", "output.frames=2", capture_output=False, preexec_fn=close(*streams),
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            self.assertEqual(result.returncode, 0, streams)
            there = tree(self.out)
            self.assertEqual(sorted(there), sorted(wanted))
            for name in ("case.toml", "curve-0.csv", "cracks-0.csv"):
                self.assertEqual(there[name], wanted[name], (streams, name))
            self.check_readable(self.out)
        for streams in ((2,), (0, 1, 2)):
            self.assertEqual(self.ucs("--nonsense", preexec_fn=close(*streams)).returncode, 2)

    def test_memory(self):
        """Whatever the limit, it ends in order: with its results, or with one line."""
        def limit(megabytes):
            return lambda: resource.setrlimit(resource.RLIMIT_AS, (megabytes << 20, megabytes << 20))

        for megabytes in (48, 64, 96):
            result = run("ucs", self.write("case.toml", SHORT), "--out", self.out, "--force", "--threads", "4", preexec_fn=limit(megabytes))
            if result.returncode not in (0, 127):  # 127: not even the libraries have room
                self.check_one_line(result, 3)
                self.assertRegex(result.stderr, "cannot start|not enough memory")
        result = run("ucs", self.case, "--out", self.out, "--threads", "512", preexec_fn=limit(1024))
        self.check_one_line(result, 3, "cannot start 512 threads", "--threads")

    def test_folders_that_cannot_be_looked_at(self):
        long = self.work / ("x" * 300)
        loop = self.work / "loop"
        loop.symlink_to(loop)
        for place in (long, loop, "/proc", "/dev/null", "/dev/null/below"):
            for options in ((), ("--force",), ("--resume",)):
                result = run("ucs", self.write("case.toml", SHORT), "--out", place, *options)
                self.assertIn(result.returncode, (2, 4), result.stderr)
                self.assertEqual(result.stderr.count("\n"), 1, result.stderr)

    @unittest.skipUnless(os.geteuid() == 0, "to be somebody else needs root")
    def test_folders_of_somebody_else(self):
        """lost+found of a disk is no reason to stop, a folder that may not be searched is."""
        nobody = {"user": 65534, "group": 65534, "extra_groups": []}
        for path in (self.work, self.out, self.out / "lost+found", self.work / "closed"):
            path.mkdir(exist_ok=True)
            path.chmod(0o755)
        os.chown(self.out, 65534, 65534)
        (self.out / "lost+found").chmod(0o700)
        (self.work / "closed").chmod(0o700)
        result = self.ucs(**nobody)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        for options in ((), ("--resume",)):
            self.check_one_line(run("ucs", self.work / "case.toml", "--out", self.work / "closed" / "out", *options, **nobody), 4, "closed")
            self.check_one_line(run("ucs", self.work / "case.toml", "--out", self.work / "closed", *options, **nobody), 4, "closed")
        (self.work / "specimen.csv").chmod(0o600)
        self.check_one_line(self.ucs("--force", **nobody), 2, "specimen.csv", "rights")


if __name__ == "__main__":
    main()
