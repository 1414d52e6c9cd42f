#!/usr/bin/python3
"""A tiny layout study: the files and columns that are promised, numbers that follow from each other, refusals. Nothing is
said about how long anything takes."""
import csv
import json
import signal
import statistics

from programs import ProgramTest, command, finish, main, plot, run, tree

TINY = ("--spheres", "500,300", "--threads", "2,1", "--repeat", "3", "--block", "0.001")
COLUMNS = ("spheres bonds threads precision bond_storage particle_storage sums numbers ns_per_bond_median ns_per_bond_least ns_per_bond_most "
           "bonds_per_s time_over_production limit_ns_per_bond limited_by fraction_of_limit difference colours "
           "passes_per_block".split())
WORDS = {"precision", "numbers", "bond_storage", "particle_storage", "sums", "limited_by"}
LAYOUTS = [("single", "blocks of 16", "records", sums, numbers) for sums, numbers in
           (("private", "int32"), ("atomic", "int32"), ("private", "int64"), ("private", "float"))]
LAYOUTS += [("double", bonds, particles, sums, "double") for bonds, particles, sums in
            (("columns", "records", "private"), ("records", "records", "private"), ("blocks of 8", "records", "private"),
             ("blocks of 16", "records", "private"), ("columns", "columns", "private"), ("columns", "records", "gather"),
             ("columns", "records", "atomic"), ("columns", "records", "all atomic"), ("columns", "records", "colours"))]


class Layouts(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.folder = cls.shelf / "study"
        cls.result = run("layouts", *TINY, "--out", cls.folder)

    def setUp(self):
        super().setUp()
        self.assertEqual((self.result.returncode, self.result.stderr), (0, ""))
        self.content = json.loads((self.folder / "layouts.json").read_text())

    def test_files(self):
        self.assertEqual(sorted(tree(self.folder)), ["layouts.csv", "layouts.json"])

    def test_rows(self):
        rows = [(r["spheres"], r["threads"], (r["precision"], r["bond_storage"], r["particle_storage"], r["sums"], r["numbers"])) for r in self.content["runs"]]
        self.assertEqual(rows, [(spheres, threads, layout) for spheres in (300, 500) for threads in (1, 2) for layout in LAYOUTS])

    def test_both_files_agree(self):
        with (self.folder / "layouts.csv").open(newline="") as file:
            rows = list(csv.DictReader(file))
        runs = self.content["runs"]
        self.assertEqual(list(rows[0]), COLUMNS)
        self.assertEqual(list(runs[0]), COLUMNS + ["block_ns_per_bond"])
        for row, one in zip(rows, runs, strict=True):
            self.assertEqual({name: text if name in WORDS else float(text) for name, text in row.items()},
                             {name: one[name] for name in COLUMNS})

    def test_times_follow_from_the_blocks(self):
        for one in self.content["runs"]:
            blocks = sorted(one["block_ns_per_bond"])
            self.assertEqual(len(blocks), 3)
            self.assertGreater(blocks[0], 0)
            self.assertEqual([one[f"ns_per_bond_{name}"] for name in ("least", "median", "most")],
                             [blocks[0], statistics.median(blocks), blocks[-1]])
            self.assertAlmostEqual(one["bonds_per_s"] * one["ns_per_bond_median"] / 1e9, 1, places=12)
            self.assertAlmostEqual(one["limit_ns_per_bond"] / one["ns_per_bond_median"] / one["fraction_of_limit"], 1, places=12)
            self.assertGreaterEqual(one["passes_per_block"], 1)

    def test_production_is_the_measure(self):
        runs = self.content["runs"]
        for k, one in enumerate(runs):
            production = runs[k - k % len(LAYOUTS)]
            ratio = one["ns_per_bond_median"] / production["ns_per_bond_median"]
            self.assertAlmostEqual(one["time_over_production"] / ratio, 1, places=12)

    def test_all_compute_the_same(self):
        for one in self.content["runs"]:
            self.assertLess(one["difference"], 1e-12 if one["precision"] == "double" else 1e-5)
            self.assertEqual(one["colours"] > 0, one["sums"] == "colours")

    def test_limits(self):
        operations = self.content["operations_per_bond"]
        self.assertEqual(list(operations), ["single", "double"])
        for of in operations.values():
            self.assertEqual(of["total"], sum(of[name] for name in ("additions", "multiplications", "divisions", "roots")))
        limits = {(one["spheres"], one["threads"], one["precision"]): one for one in self.content["limits"]}
        self.assertEqual(len(limits), 8)
        for one in limits.values():
            wider = 2 if one["precision"] == "single" else 1
            moved = one["read_bytes_per_bond"] + one["written_bytes_per_bond"]
            self.assertAlmostEqual(one["memory_ns_per_bond"] * one["bandwidth_bytes_per_s"] / (1e9 * moved), 1, places=12)
            total = operations[one["precision"]]["total"]
            self.assertAlmostEqual(wider * one["arithmetic_ns_per_bond"] * one["peak_operations_per_s"] / (1e9 * total), 1, places=12)
        for one in self.content["runs"]:
            limit = limits[one["spheres"], one["threads"], one["precision"]]
            by = max(("memory", "arithmetic"), key=lambda name: limit[f"{name}_ns_per_bond"])
            self.assertEqual(one["limited_by"], by)
            self.assertAlmostEqual(one["limit_ns_per_bond"] / limit[f"{by}_ns_per_bond"], 1, places=12)

    def test_machine(self):
        self.assertEqual(list(self.content), ["study", "version", "machine", "test", "operations_per_bond", "limits", "runs"])
        machine = self.content["machine"]
        self.assertEqual(list(machine), "cpu cores cores_online caches memory_bytes load_average compiler instruction_set".split())

    def test_report(self):
        for word in ("Mbond/s", "production", "difference", "GB/s", "blocks of 16", "all atomic", "packing 300", "layouts.json"):
            self.assertIn(word, self.result.stdout)

    def test_plot(self):
        pictures = self.work / "pictures"
        result = plot(self.folder, "--out", pictures)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("13 layouts, 2 sizes, 2 numbers of threads", result.stdout)
        self.assertEqual([path.name for path in pictures.iterdir()], ["layouts.png"])
        self.assertLess((pictures / "layouts.png").stat().st_size, 300_000)

    def test_plot_of_a_damaged_study(self):
        for text in ("{", "[]", '{"runs": []}', '{"study": "layouts", "runs": [{"threads": 1}]}'):
            (self.work / "layouts.json").write_text(text)
            result = plot(self.work)
            self.check_one_line(result, 2, "layouts.json")


class Refusals(ProgramTest):
    def test_help_and_version(self):
        for option, word in (("--help", "layouts.csv"), ("--version", ".")):
            result = run("layouts", option)
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertIn(word, result.stdout)

    def test_values_out_of_range(self):
        for option, value in (("--spheres", "50"), ("--spheres", "many"), ("--threads", "0"), ("--threads", "1,-2"),
                              ("--repeat", "0"), ("--block", "0"), ("--block", "100")):
            self.check_one_line(run("layouts", option, value, "--out", self.out), 2, option)
        self.assertFalse(self.out.exists())

    def test_unknown_words(self):
        self.check_one_line(run("layouts", self.case), 2, "ucs.toml")
        self.check_one_line(run("layouts", "--sphere", "300"), 2, "--sphere")

    def test_ranks(self):
        result = run("layouts", "--out", self.out, env={"OMPI_COMM_WORLD_SIZE": "2"})
        self.check_one_line(result, 2, "2 ranks")


class Folders(ProgramTest):
    ONE = ("--spheres", "300", "--threads", "1", "--repeat", "1", "--block", "0.001")

    def test_results_are_replaced_only_by_force(self):
        self.assertEqual(run("layouts", *self.ONE, "--out", self.out).returncode, 0)
        first = tree(self.out)
        self.check_one_line(run("layouts", *self.ONE, "--out", self.out), 2, self.out, "--force")
        self.assertEqual(tree(self.out), first)
        for name in ("layouts.png", "notes.txt"):
            (self.out / name).write_text("")
        with (self.out / ".breccia-files").open("a") as file:
            file.write("layouts.png\n")  # as scripts/plot does
        self.assertEqual(run("layouts", *self.ONE, "--out", self.out, "--force").returncode, 0)
        self.assertEqual(sorted(tree(self.out)), ["layouts.csv", "layouts.json", "notes.txt"])

    def test_quiet(self):
        result = run("layouts", *self.ONE, "--quiet", "--out", self.out)
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))

    def test_below_a_file(self):
        self.check_one_line(run("layouts", *self.ONE, "--out", self.write("file", "") / "out"), 4, "out")

    def test_interrupt_keeps_what_was_measured(self):
        process = self.start_and_hold("measurement:1", *command("layouts", *self.ONE[2:], "--spheres", "300,400", "--out", self.out))
        process.send_signal(signal.SIGINT)
        _, err = finish(process)
        self.assertEqual((process.returncode, err), (130, ""))
        self.assertEqual(len(json.loads((self.out / "layouts.json").read_text())["runs"]), len(LAYOUTS))


if __name__ == "__main__":
    main()
