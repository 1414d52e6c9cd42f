#!/usr/bin/python3
"""Two scenes of the stability study, in short: the files and columns that are promised, verdicts that hold, refusals."""
import csv
import json
import math
import signal

from programs import ProgramTest, command, finish, main, plot, run, tree

COLUMNS = ("scene part fraction verdict spheres bonds steps time_step_s limit_s estimate_over_limit energy_error drift "
           "broken_bonds peak_stress_Pa peak_change amiss cause").split()
SCENES = ("xi-0", "two-spheres")


class Stability(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.folder = cls.shelf / "study"
        cls.result = run("stability", "--quick", "--only", ",".join(SCENES), "--threads", 2, "--out", cls.folder)

    def setUp(self):
        super().setUp()
        self.assertEqual((self.result.returncode, self.result.stderr), (0, ""))
        self.content = json.loads((self.folder / "stability.json").read_text())

    def test_files(self):
        self.assertEqual(sorted(tree(self.folder)), ["stability.csv", "stability.json"])

    def test_rows(self):
        rows = [(r["scene"], r["part"], r["fraction"]) for r in self.content["runs"]]
        self.assertEqual(rows, [("xi-0", "damped", f) for f in (0.5, 0.8, 0.99, 1.02, 1.1)] +
                         [("xi-0", "law", f) for f in (0.5, 0.8, 0.99, 1.5)] + [("two-spheres", "law", 0)])

    def test_both_files_agree(self):
        with (self.folder / "stability.csv").open(newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(list(rows[0]), COLUMNS)
        for row, one in zip(rows, self.content["runs"], strict=True):
            self.assertEqual(list(one), COLUMNS + ["stresses"])
            for name, text in row.items():
                value = one[name]
                self.assertEqual(text if isinstance(value, str) else json.loads(text) if text else None, value, name)

    def test_network_is_bounded_below_its_limit_and_blows_up_above(self):
        runs = [r for r in self.content["runs"] if r["part"] == "damped"]
        self.assertEqual([r["verdict"] for r in runs], ["stable"] * 3 + ["blew up"] * 2)
        for r in runs:
            self.assertAlmostEqual(r["time_step_s"] / r["limit_s"], r["fraction"], places=9)
            self.assertLess(r["estimate_over_limit"], 1)
            self.assertGreater(r["estimate_over_limit"], 0.95)
            # a guard of energy, or, before it looks, single precision's own of speeds
            found = any(words in r["cause"] for words in ("energy comes from nowhere", "more than its record can hold"))
            self.assertEqual(found, r["verdict"] == "blew up")
        for r in runs[3:]:
            self.assertLess(r["steps"], 400)

    def test_law_is_stopped_beyond_its_limit(self):
        runs = [r for r in self.content["runs"] if (r["scene"], r["part"]) == ("xi-0", "law")]
        self.assertEqual([r["verdict"] for r in runs], ["stable"] * 3 + ["stopped"])
        for r in runs[:3]:
            self.assertTrue(math.isclose(r["peak_change"], r["peak_stress_Pa"] / runs[0]["peak_stress_Pa"] - 1, abs_tol=1e-12))
        self.assertIn("try time.safety = 0.8", runs[3]["cause"])

    def test_refusal_names_its_reason(self):
        (one,) = (r for r in self.content["runs"] if r["scene"] == "two-spheres")
        self.assertEqual(one["verdict"], "refused")
        self.assertIn("no sphere between", one["cause"])

    def test_report(self):
        for word in ("verdict", "blew up", "estimate", "xi-0, law: 0.5 stable", "stability.json"):
            self.assertIn(word, self.result.stdout)
        self.assertNotIn("amiss", self.result.stdout)

    def test_plot(self):
        pictures = self.work / "pictures"
        result = plot(self.folder, "--out", pictures)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("2 scenes, 10 runs", result.stdout)
        self.assertLess((pictures / "stability.png").stat().st_size, 300_000)

    def test_plot_of_a_damaged_study(self):
        for text in ("{", "[]", '{"runs": []}', '{"study": "stability", "runs": [{"scene": "plain"}]}'):
            (self.work / "stability.json").write_text(text)
            result = plot(self.work)
            self.check_one_line(result, 2, "stability.json")


class Guard(ProgramTest):
    def test_nested_spheres_end_a_test_with_their_names(self):
        """Centres 1e-11 m apart: the direction of such a bond is noise as soon as anything moves."""
        lines = (self.work / "specimen.csv").read_text().splitlines()
        spheres = [line.split(",") for line in lines if line[:1].isdigit()][:8]
        nested = [f"{1000 + k},{float(x) + 1e-11!r},{y},{z},{float(r) / 2!r}" for k, (_, x, y, z, r, *_) in enumerate(spheres)]
        (self.work / "specimen.csv").write_text("\n".join(lines + nested) + "\n")
        result = run("ucs", self.case, "--quiet", "--out", self.out)
        self.check_one_line(result, 3, "breccia-ucs: at ", "bond ", "right angle", "nested", "take one away", "time.safety = 0.08")
        rows = (self.out / "curve-0.csv").read_text().splitlines()
        self.assertGreater(len(rows), 10)  # what there was is kept


class Options(ProgramTest):
    def refused(self, *words, options):
        result = run("stability", *options, "--out", self.out)
        self.check_one_line(result, 2, "breccia-stability: ", *words)
        self.assertEqual(result.stdout, "")
        self.assertFalse(self.out.exists())

    def test_refusals(self):
        self.refused("--only", 'did you mean "plain"', options=("--only", "plan"))
        self.refused("--steps", "100 to", options=("--steps", 7))
        self.refused("--steps", "--quick", options=("--steps", 1000, "--quick"))
        self.refused("--threads", "1 to 4096", options=("--threads", 0))
        self.refused("case.toml", "--help", options=("case.toml",))

    def test_list(self):
        result = run("stability", "--list", "--out", self.out)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        for word in ("plain ", "modulus-1e6 ", "rest-1e7 ", "(--long)"):
            self.assertIn(word, result.stdout)
        self.assertFalse(self.out.exists())

    def test_help(self):
        result = run("stability", "--help")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        for word in ("[100000]", "[out/stability]", "--long", "stability.json", "Exit code 1"):
            self.assertIn(word, result.stdout)

    def test_results_are_replaced_only_by_force(self):
        options = ("--only", "one-sphere", "--quiet", "--out", self.out)
        self.assertEqual(run("stability", *options).returncode, 0)
        self.check_one_line(run("stability", *options), 2, self.out, "--force")
        self.assertEqual(run("stability", *options, "--force").returncode, 0)

    def test_interrupt_keeps_what_was_run(self):
        process = self.start_and_hold("measurement:1", *command("stability", "--only", "one-sphere,two-spheres", "--threads", 1,
                                                                "--out", self.out))
        process.send_signal(signal.SIGINT)
        _, err = finish(process)
        self.assertEqual((process.returncode, err), (130, ""))
        self.assertEqual(len(json.loads((self.out / "stability.json").read_text())["runs"]), 1)


if __name__ == "__main__":
    main()
