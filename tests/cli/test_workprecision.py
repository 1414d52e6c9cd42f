#!/usr/bin/python3
"""A tiny work-precision study: files and columns that are promised, numbers that follow from each other, an interrupted
study that goes on, refusals. Nothing is said about how long anything takes."""
import csv
import json
import math
import signal
import statistics

from programs import UCS, ProgramTest, command, finish, main, plot, run, tree

TINY = ("--grid", "small", "--only", "damping,sizes", "--spheres", "100,150", "--seeds", "2", "--floor", "2", "--reference-step", "0.8",
        "--reference-speed", "0.3", "--threads", "2", "--set", 'test.platen_speed="0.5 m/s"', "--set", "test.stop_strain=0.004")
COLUMNS = ("purpose family step platen_speed_m_s scheme mass_factor damping_translation damping_rotation precision scatter spheres "
           "packing_seed perturbation perturbation_size threads timed_alone status steps time_step_s run_time_s peak_deviator_Pa "
           "young_modulus_Pa strain_at_peak error_peak error_young error_strain_at_peak error_curve kinetic_ratio platen_mismatch").split()
MEASURES = ("peak", "young", "strain_at_peak", "curve")
READINGS = {"peak": "peak_deviator_Pa", "young": "young_modulus_Pa", "strain_at_peak": "strain_at_peak"}
FILES = ["case.toml", "runs.jsonl", "workprecision.csv", "workprecision.json"]


def study(*arguments, **options):
    return run("workprecision", *arguments, *TINY, **options)


def read_csv(folder):
    with (folder / "workprecision.csv").open(newline="") as file:
        return list(csv.DictReader(file))


def read_json(folder):
    return json.loads((folder / "workprecision.json").read_text())


def untimed(rows):
    return [{name: value for name, value in row.items() if name != "run_time_s"} for row in rows]


class WorkPrecision(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.folder = cls.shelf / "study"
        (cls.shelf / "ucs.toml").write_text(UCS.replace("specimen.csv", "packed/specimen.csv"))
        cls.result = study(cls.shelf / "ucs.toml", "--out", cls.folder)

    def setUp(self):
        super().setUp()
        self.assertEqual((self.result.returncode, self.result.stderr), (0, ""))

    def test_files(self):
        self.assertEqual(sorted(tree(self.folder)), FILES)

    def test_runs(self):
        rows = read_csv(self.folder)
        self.assertEqual(list(rows[0]), COLUMNS)
        found = [tuple(row[name] for name in ("purpose", "step", "platen_speed_m_s", "damping_translation", "spheres", "packing_seed", "perturbation", "threads"))
                 for row in rows]
        self.assertEqual(found, [("half_speed", "0.8", "0.15", "0.1", "300", "0", "0", "1"), ("half_step", "0.4", "0.3", "0.1", "300", "0", "0", "1")] +
                         [("reference", "0.8", "0.3", "0.1", "300", "0", str(k), "1") for k in (0, 1)] +
                         [("recipe", "0.8", "0.5", damping, "300", "0", "0", "2") for damping in ("0.1", "0.0", "0.2")] +
                         [("size", "0.8", "0.5", "0.1", spheres, seed, "0", "1") for spheres in ("150", "100") for seed in ("1", "2")])

    def test_both_files_agree(self):
        rows, runs = read_csv(self.folder), read_json(self.folder)["runs"]
        self.assertEqual(list(runs[0]), COLUMNS + ["failure", "critical_time_step_s", "bonds"])
        for row, one in zip(rows, runs, strict=True):
            for name, text in row.items():
                value = one[name]
                read = text if isinstance(value, str) else json.loads(text) if text else None
                self.assertEqual(read, value, name)

    def test_errors_follow_from_the_readings(self):
        content = read_json(self.folder)
        runs, reference = content["runs"], content["reference"]
        first, second = (one for one in runs if one["purpose"] == "reference")
        for measure, name in READINGS.items():
            mean = reference[name]
            self.assertAlmostEqual(mean, (first[name] + second[name]) / 2, delta=1e-9 * mean)
            for one in runs:
                self.assertAlmostEqual(one[f"error_{measure}"], one[name] / mean - 1, places=9)
            self.assertAlmostEqual(content["floor"][measure], statistics.stdev([first[name], second[name]]) / mean, places=9)
            self.assertEqual(reference["half_step"][measure], runs[1][f"error_{measure}"])
            bar = max(abs(runs[0][f"error_{measure}"]), abs(runs[1][f"error_{measure}"]), content["floor"][measure] / math.sqrt(2))
            self.assertAlmostEqual(reference["error_bar"][measure], bar, places=12)
            self.assertAlmostEqual(reference["resolution"][measure], max(bar, content["floor"][measure]), places=12)
        for one in runs:
            self.assertGreaterEqual(one["error_curve"], 0)
            self.assertEqual(one["status"], "ok")
        # perturbed, but by so little that the modulus is the same
        self.assertNotEqual(first["young_modulus_Pa"], second["young_modulus_Pa"])
        self.assertAlmostEqual(first["young_modulus_Pa"] / second["young_modulus_Pa"], 1, places=6)

    def test_fronts_and_cheapest(self):
        content = read_json(self.folder)
        runs = content["runs"]
        recipes = [k for k, one in enumerate(runs) if one["purpose"] == "recipe"]
        for measure in MEASURES:
            limit = content["reference"]["resolution"][measure]
            point = {k: (runs[k]["run_time_s"], max(abs(runs[k][f"error_{measure}"]), limit)) for k in recipes}
            front = [k for k in recipes if not any(p != point[k] and p[0] <= point[k][0] and p[1] <= point[k][1] for p in point.values())]
            self.assertEqual(sorted(content["fronts"][measure]), front)
            for choice in content["cheapest"]:
                if choice["measure"] == measure:
                    fit = [k for k in recipes if abs(runs[k][f"error_{measure}"]) + limit <= choice["tolerance"]]
                    self.assertEqual(choice["run"], min(fit, key=lambda k: runs[k]["run_time_s"]) if fit else None)
        self.assertEqual([c["tolerance"] for c in content["cheapest"]], 5 * [0.05, 0.02, 0.01])

    def test_the_lines_of_a_recipe_are_a_case(self):
        chosen = [c for c in read_json(self.folder)["cheapest"] if c["case"]]
        self.assertTrue(chosen)
        lines = chosen[0]["case"].replace("[test]\n", "[test]\nstop_strain = 0.001\n")
        result = run("ucs", self.write("pasted.toml", UCS.partition("[test]")[0] + lines), "--dry-run")
        self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_sizes(self):
        content = read_json(self.folder)
        for group in content["sizes"]["groups"]:
            peaks = [one["error_peak"] for one in content["runs"] if one["purpose"] == "size" and one["spheres"] == group["spheres"]]
            self.assertEqual((group["seeds"], len(peaks)), (2, 2))
            self.assertAlmostEqual(group["mean"]["peak"], statistics.mean(peaks), places=12)
            self.assertAlmostEqual(group["spread"]["peak"], statistics.stdev(peaks), places=12)
        (small, large) = content["sizes"]["groups"]
        exponent = math.log(large["spread"]["peak"] / small["spread"]["peak"]) / math.log(1.5)
        self.assertAlmostEqual(content["sizes"]["fits"]["peak"]["exponent"], exponent, places=9)

    def test_report(self):
        for word in ("noise floor", "half the step", "half the speed", "error bar", "recipes:", "other specimens", "peak within 1 %", "all within 5 %",
                     "workprecision.json"):
            self.assertIn(word, self.result.stdout)

    def test_plot(self):
        pictures = self.work / "pictures"
        result = plot(self.folder, "--out", pictures)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("3 recipes, 4 specimens", result.stdout)
        self.assertEqual([path.name for path in pictures.iterdir()], ["workprecision.png"])
        self.assertLess((pictures / "workprecision.png").stat().st_size, 300_000)
        content = read_json(self.folder)
        for damaged in ("{", json.dumps(content | {"fronts": {}}), json.dumps({k: v for k, v in content.items() if k != "reference"})):
            (self.work / "workprecision.json").write_text(damaged)
            self.check_one_line(plot(self.work), 2, "workprecision.json")

    def test_resume_of_a_finished_study_runs_nothing(self):
        before = (self.folder / "runs.jsonl").read_bytes()
        rows = read_csv(self.folder)
        result = study(self.shelf / "ucs.toml", "--out", self.folder, "--resume")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual((self.folder / "runs.jsonl").read_bytes(), before)
        self.assertEqual(read_csv(self.folder), rows)

    def test_interrupted_and_resumed(self):
        process = self.start_and_hold("measurement:1", *command("workprecision", self.shelf / "ucs.toml", *TINY, "--out", self.out))
        process.send_signal(signal.SIGINT)
        out, err = finish(process)
        self.assertEqual((process.returncode, err), (130, ""))
        self.assertIn("--resume goes on", out)
        done = (self.out / "runs.jsonl").read_bytes()
        self.assertIn(len(read_csv(self.out)), (1, 2))  # two at a time: the other may have been over too
        with (self.out / "runs.jsonl").open("ab") as file:
            file.write(b'{"key":"a line that a kill has cut')
        self.check_one_line(study(self.shelf / "ucs.toml", "--out", self.out), 2, "--force")
        result = study(self.shelf / "ucs.toml", "--out", self.out, "--resume")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertTrue((self.out / "runs.jsonl").read_bytes().startswith(done))
        self.assertEqual(untimed(read_csv(self.out)), untimed(read_csv(self.folder)))


class Options(ProgramTest):
    def refused(self, *words, options, case=None):
        result = run("workprecision", case or self.case, *options, "--out", self.out)
        self.check_one_line(result, 2, "breccia-workprecision: ", *words)
        self.assertFalse(self.out.exists())

    def test_refusals(self):
        self.refused("--grid", 'did you mean "small"', options=("--grid", "smal"))
        self.refused("--only", 'did you mean "speed"', options=("--only", "step,sped"))
        self.refused("--spheres", "50 to", options=("--spheres", "100,7"))
        self.refused("--floor", "2 to 1000", options=("--floor", 1))
        self.refused("--seeds", "1 to 1000", options=("--seeds", 0))
        self.refused("--reference-step", "0.01 to 0.95", options=("--reference-step", 1.5))
        self.refused("--reference-speed", "1e-06 to 10", options=("--reference-speed", 0))
        self.refused("--perturbation", "1e-15", options=("--perturbation", 1))
        self.refused("--resume", "--force", options=("--resume", "--force"))
        self.refused("--resum", "--help", options=("--resum",))
        self.refused("no-such.toml", options=(), case=self.work / "no-such.toml")
        self.refused("test.platen_speed", options=("--set", 'test.platen_speed="0 m/s"'))

    def test_help(self):
        result = run("workprecision", "--help")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        for word in ("--resume", "[1e-12]", "noise floor", "combinations", "workprecision.json", "runs.jsonl", "[out/CASE-workprecision]"):
            self.assertIn(word, result.stdout)

    def test_dry_run_of_a_packed_triaxial_case(self):
        case = self.write("pack.toml", UCS.replace('file = "specimen.csv"', "pack = { spheres = 200 }"))
        result = run("workprecision", case, "--dry-run", "--set", 'test.confinement=["5 MPa", "10 MPa"]', "--out", self.out)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        for word in ("breccia-triaxial", "only the first of 2 confinements", "half_speed", "combinations", "70000 spheres, seed 1", "summed, mass 4,", "times 1 + 1e-12 u"):
            self.assertIn(word, result.stdout)
        self.assertFalse(self.out.exists())

    def test_resume_with_another_case(self):
        tiny = (*TINY, "--out", self.out)
        self.out.mkdir()
        (self.out / "runs.jsonl").write_text(json.dumps({"study": "workprecision", "version": "0.1.0", "case": "0123456789abcdef"}) + "\n")
        before = tree(self.out)
        self.check_one_line(run("workprecision", self.case, *tiny, "--resume"), 2, "runs.jsonl", "another", "--out")
        self.assertEqual(tree(self.out), before)
        self.check_one_line(run("workprecision", self.case, *tiny), 2, self.out, "--force")
        self.assertEqual(tree(self.out), before)


if __name__ == "__main__":
    main()
