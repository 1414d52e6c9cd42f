#!/usr/bin/python3
"""A tiny scaling study: the files and columns that are promised, numbers that follow from each other, refusals. Nothing
is said about how long anything takes."""
import csv
import json
import signal
import statistics

from programs import ProgramTest, command, finish, main, plot, run, tree

TINY = ("--spheres", "300,500", "--spheres-per-thread", "300", "--threads", "2,1", "--steps", "20", "--repeat", "3", "--warm-up", "20")
PHASES = "search confinement halo bonds gather contacts platens ledger integrate measure output checkpoint".split()
COLUMNS = ("study precision scatter ranks threads spheres bonds broken_bonds steps repeats step_median_s step_least_s step_most_s ns_per_bond "
           "bond_updates_per_s speed_up efficiency halo_rows imbalance".split() + [f"share_{name}" for name in PHASES] +
           "share_other table_bytes_per_bond peak_rss_bytes".split())
ONLY_IN_JSON = "block_s phases_s alpha time_step_s table_bytes state_hash".split()
WORDS = {"study", "precision", "scatter"}


WAYS = (("single", "private"), ("double", "private"), ("double", "gather"))


class Scaling(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.folder = cls.shelf / "study"
        cls.result = run("scaling", *TINY, "--scatter", "private,gather", "--precision", "double,single", "--out", cls.folder)

    def setUp(self):
        super().setUp()
        self.assertEqual((self.result.returncode, self.result.stderr), (0, ""))

    def read_json(self, folder=None):
        return json.loads(((folder or self.folder) / "scaling.json").read_text())

    def read_csv(self):
        with (self.folder / "scaling.csv").open(newline="") as file:
            return list(csv.DictReader(file))

    def series(self, study, way):
        """Runs of one study, precision and scatter by spheres and threads."""
        return {(r["spheres"], r["threads"]): r for r in self.read_json()["runs"] if (r["study"], r["precision"], r["scatter"]) == (study, *way)}

    def test_files(self):
        self.assertEqual(sorted(tree(self.folder)), ["scaling.csv", "scaling.json"])

    def test_points(self):
        points = [tuple(row[name] for name in ("study", "precision", "scatter", "ranks", "threads", "spheres")) for row in self.read_csv()]
        strong = [("strong", *way, "1", threads, spheres) for spheres in ("300", "500") for way in WAYS for threads in ("1", "2")]
        weak = [("weak", *way, "1", threads, spheres) for threads, spheres in (("1", "300"), ("2", "600")) for way in WAYS]
        self.assertEqual(points, strong + weak)

    def test_both_files_agree(self):
        rows, runs = self.read_csv(), self.read_json()["runs"]
        self.assertEqual(list(rows[0]), COLUMNS)
        self.assertEqual(list(runs[0]), COLUMNS + ONLY_IN_JSON)
        for row, one in zip(rows, runs, strict=True):
            self.assertEqual({name: text if name in WORDS else float(text) for name, text in row.items()},
                             {name: one[name] for name in COLUMNS})

    def test_times_follow_from_the_blocks(self):
        for one in self.read_json()["runs"]:
            self.assertEqual((one["steps"], one["repeats"], len(one["block_s"])), (20, 3, 3))
            steps = sorted(seconds / 20 for seconds in one["block_s"])
            for name, wanted in (("step_least_s", steps[0]), ("step_median_s", statistics.median(steps)), ("step_most_s", steps[-1])):
                self.assertAlmostEqual(one[name] / wanted, 1, places=12)
            self.assertAlmostEqual(one["ns_per_bond"] * one["bonds"] / (1e9 * one["step_median_s"]), 1, places=12)
            self.assertAlmostEqual(one["bond_updates_per_s"] * one["ns_per_bond"] / 1e9, 1, places=12)

    def test_phases_fill_the_blocks(self):
        for one in self.read_json()["runs"]:
            self.assertEqual(list(one["phases_s"]), PHASES)
            shares = [one[f"share_{name}"] for name in PHASES + ["other"]]
            self.assertAlmostEqual(sum(shares), 1, places=12)
            self.assertTrue(all(share >= 0 for share in shares), shares)
            self.assertAlmostEqual(one["phases_s"]["bonds"] / sum(one["block_s"]), one["share_bonds"], places=12)

    def test_speed_up_of_strong_scaling(self):
        for way in WAYS:
            runs = self.series("strong", way)
            for (spheres, threads), one in runs.items():
                speed_up = runs[spheres, 1]["step_median_s"] / one["step_median_s"]
                self.assertAlmostEqual(one["speed_up"] / speed_up, 1, places=12)
                self.assertAlmostEqual(one["efficiency"] * threads / speed_up, 1, places=12)

    def test_speed_up_of_weak_scaling(self):
        for way in WAYS:
            runs = self.series("weak", way)
            first, second = runs[300, 1], runs[600, 2]
            speed_up = second["bond_updates_per_s"] / first["bond_updates_per_s"]
            self.assertEqual((first["speed_up"], first["efficiency"]), (1, 1))
            self.assertAlmostEqual(second["speed_up"] / speed_up, 1, places=12)
            self.assertAlmostEqual(second["efficiency"] / (speed_up / 2), 1, places=12)

    def test_memory(self):
        for one in self.read_json()["runs"]:
            self.assertAlmostEqual(one["table_bytes"] / one["bonds"], one["table_bytes_per_bond"], places=9)
            self.assertGreater(one["peak_rss_bytes"], one["table_bytes"])

    def test_every_point_runs_the_same_test(self):
        for way in (("single", "private"), ("double", "gather")):
            runs = self.series("strong", way)
            for spheres in (300, 500):
                self.assertEqual(runs[spheres, 1]["state_hash"], runs[spheres, 2]["state_hash"])
            self.assertNotEqual(runs[300, 1]["state_hash"], runs[500, 1]["state_hash"])
            self.assertEqual(self.series("weak", way)[300, 1]["state_hash"], runs[300, 1]["state_hash"])

    def test_machine(self):
        content = self.read_json()
        self.assertEqual(list(content), ["study", "version", "machine", "test", "runs", "published"])
        machine = content["machine"]
        self.assertEqual(list(machine), "cpu cores cores_online caches memory_bytes load_average compiler instruction_set".split())
        self.assertTrue(1 <= machine["cores"] <= machine["cores_online"])
        self.assertRegex(machine["compiler"], r"^(g\+\+|clang) \d+\.")
        for cache in machine["caches"]:
            self.assertEqual(list(cache), ["level", "type", "bytes", "shared_by"])

    def test_report(self):
        for word in ("strong scaling", "weak scaling", "Mbond/s", "B/bond", "not compared with Dempack", "scaling.json"):
            self.assertIn(word, self.result.stdout)

    def test_plot(self):
        pictures = self.work / "pictures"
        result = plot(self.folder, "--out", pictures)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("18 points", result.stdout)
        self.assertEqual([path.name for path in pictures.iterdir()], ["scaling.png"])
        self.assertLess((pictures / "scaling.png").stat().st_size, 300_000)

    def test_plot_of_a_damaged_study(self):
        for text in ("{", "[]", '{"runs": []}', '{"study": "scaling", "runs": [{"study": "weak"}]}'):
            (self.work / "scaling.json").write_text(text)
            result = plot(self.work)
            self.check_one_line(result, 2, "scaling.json")


class Published(ProgramTest):
    def test_times_beside_kdem(self):
        result = run("scaling", "--spheres", 13000, "--only", "strong", "--threads", 1, "--steps", 20, "--repeat", 1,
                     "--out", self.out)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        content = json.loads((self.out / "scaling.json").read_text())
        tables = {(p["code"], p["parallel"]): p for p in content["published"]}
        self.assertEqual(list(tables), [("Dempack", "OpenMP"), ("Dempack", "MPI"), ("KDEM", "OpenMP")])
        for table in tables.values():
            self.assertEqual(table["cores"], [1, 2, 4, 8, 12, 16])
            self.assertEqual(table["time_s"], sorted(table["time_s"], reverse=True))
        (row,) = (line.split() for line in result.stdout.splitlines() if line.split()[:2] == ["1", "325.56"])
        ours = 2000 * content["runs"][0]["step_median_s"]
        self.assertAlmostEqual(float(row[2]) / ours, 1, delta=1e-3)
        self.assertAlmostEqual(float(row[3]), 325.56 / ours, delta=0.051)
        self.assertIn("not compared with Dempack", result.stdout)


class Options(ProgramTest):
    def refused(self, *words, options):
        result = run("scaling", *options, "--out", self.out)
        self.check_one_line(result, 2, "breccia-scaling: ", *words)
        self.assertEqual(result.stdout, "")
        self.assertFalse(self.out.exists())

    def test_refusals(self):
        self.refused("--scatter", 'did you mean "private"', options=("--scatter", "gather,privat"))
        self.refused("--scatter", "--precision double", options=("--scatter", "gather"))
        self.refused("--precision", '"single", "double"', options=("--precision", "half"))
        self.refused("--only", '"strong", "weak"', options=("--only", "both"))
        self.refused("--steps", "multiple of 20", "200 or 220", options=("--steps", 210))
        self.refused("--warm-up", "multiple of 20", "nearest: 20", options=("--warm-up", 7))
        self.refused("--steps", '"many"', options=("--steps", "many"))
        self.refused("--steps", "at most 20000", options=("--steps", 10000))
        self.refused("--repeat", "1 to 1000", options=("--repeat", 0))
        self.refused("--threads", "1 to 4096", options=("--threads", "1,0"))
        self.refused("--threads", "1 to 4096", options=("--threads", "all"))
        self.refused("--spheres", "100 to", options=("--spheres", "13000,7"))
        self.refused("--spheres-per-thread", "at most 25000000", options=("--spheres-per-thread", 60000000, "--threads", 4))
        self.refused("--spheers", "--help", options=("--spheers", 3))
        self.refused("case.toml", "--help", options=("case.toml",))

    def test_help(self):
        result = run("scaling", "--help")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        for word in ("[13000,70000]", "[35000]", "[200]", "[5]", "[private]", "[out/scaling]", "seconds per step", "scaling.json"):
            self.assertIn(word, result.stdout)

    def test_one_study_quietly(self):
        for study in ("strong", "weak"):
            result = run("scaling", *TINY, "--only", study, "--quiet", "--force", "--out", self.out)
            self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))
            runs = json.loads((self.out / "scaling.json").read_text())["runs"]
            self.assertEqual({one["study"] for one in runs}, {study})
            self.assertEqual({one["scatter"] for one in runs}, {"private"})

    def test_more_threads_than_cores(self):
        result = run("scaling", "--spheres", 300, "--only", "strong", "--threads", 64, "--steps", 20, "--repeat", 1, "--out", self.out)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("warning: 64 threads share", result.stdout)
        (one,) = json.loads((self.out / "scaling.json").read_text())["runs"]
        self.assertEqual((one["speed_up"], one["efficiency"]), (1, 1))

    def test_gains_are_over_the_fewest_threads(self):
        result = run("scaling", "--spheres", 300, "--only", "strong", "--threads", "6,2", "--steps", 20, "--repeat", 1, "--out", self.out)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        first, second = json.loads((self.out / "scaling.json").read_text())["runs"]
        self.assertEqual((first["threads"], first["speed_up"], first["efficiency"]), (2, 1, 1))
        self.assertAlmostEqual(second["speed_up"] * second["step_median_s"] / first["step_median_s"], 1, places=12)
        self.assertAlmostEqual(second["efficiency"] * 3 / second["speed_up"], 1, places=12)


class Folders(ProgramTest):
    def test_results_are_replaced_only_by_force(self):
        tiny = (*TINY, "--only", "strong", "--out", self.out)
        self.assertEqual(run("scaling", *tiny).returncode, 0)
        first = tree(self.out)
        self.check_one_line(run("scaling", *tiny), 2, self.out, "--force")
        self.assertEqual(tree(self.out), first)
        for name in ("scaling.png", "notes.txt"):
            (self.out / name).write_text("")
        with (self.out / ".breccia-files").open("a") as file:
            file.write("scaling.png\n")  # as scripts/plot does
        self.assertEqual(run("scaling", *tiny, "--force").returncode, 0)
        self.assertEqual(sorted(tree(self.out)), ["notes.txt", "scaling.csv", "scaling.json"])

    def test_below_a_file(self):
        self.check_one_line(run("scaling", *TINY, "--out", self.write("file", "") / "out"), 4, "out")

    def test_interrupt_keeps_what_was_measured(self):
        process = self.start_and_hold("measurement:2", *command("scaling", *TINY, "--only", "strong", "--out", self.out))
        process.send_signal(signal.SIGINT)
        _, err = finish(process)
        self.assertEqual((process.returncode, err), (130, ""))
        self.assertEqual(len(json.loads((self.out / "scaling.json").read_text())["runs"]), 2)


if __name__ == "__main__":
    main()
