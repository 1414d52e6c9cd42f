#!/usr/bin/python3
"""breccia-impact as a user calls it: files, repeatability, refusals."""
import csv
import json

from programs import SOURCE, ProgramTest, main, run, tree

EXAMPLES = SOURCE / "data" / "cases"


class Impact(ProgramTest):
    def test_two_spheres(self):
        result = run("impact", EXAMPLES / "impact-two-spheres.toml", "--out", self.out)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual(sorted(tree(self.out)), ["case.toml", "curve-0.csv", "summary.json"])
        series = json.loads((self.out / "summary.json").read_text())
        self.assertEqual((series["test"], series["ranks"]), ("impact", 1))
        one = series["runs"][0]["particles"][0]
        self.assertAlmostEqual(one["largest_force_N"] / 10696.889, 1, delta=1e-3)
        self.assertAlmostEqual(one["velocity_m_s"][0], -10, delta=1e-5)
        with (self.out / "curve-0.csv").open(newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertGreater(len(rows), 1000)
        self.assertAlmostEqual(max(float(row["normal_force_N"]) for row in rows) / 10696.889, 1, delta=1e-3)

    def test_resolved_case_gives_the_same(self):
        again = self.work / "again"
        run("impact", EXAMPLES / "impact-wall.toml", "--out", self.out)
        run("impact", self.out / "case.toml", "--out", again, "--threads", "1")
        first, second = tree(self.out), tree(again)
        self.assertEqual(first["case.toml"], second["case.toml"])
        self.assertEqual(first["curve-0.csv"], second["curve-0.csv"])

    def test_results_are_not_overwritten(self):
        case = EXAMPLES / "impact-wall.toml"
        run("impact", case, "--out", self.out)
        self.check_one_line(run("impact", case, "--out", self.out), 2, "--force")
        self.assertEqual(run("impact", case, "--out", self.out, "--force").returncode, 0)

    def test_refused(self):
        case = self.write("case.toml", (EXAMPLES / "impact-wall.toml").read_text().replace("radius =", "radus ="))
        self.check_one_line(run("impact", case, "--out", self.out), 2, "case.toml:", "particle.radus", '"radius"')
        self.assertFalse(self.out.exists())

    def test_too_soft(self):
        result = run("impact", EXAMPLES / "impact-wall.toml", "--out", self.out, "--set", "materials.oxide.young_modulus=1e4",
                     "--set", "time.duration=1e-2", "--set", "time.safety=0.05")
        self.check_one_line(result, 3, "half its radius")
        self.assertTrue((self.out / "curve-0.csv").exists())

    def test_help_lists_its_own_keys(self):
        help = run("impact", "--help").stdout
        self.assertIn("[[particle]]", help)
        self.assertNotIn("[bonds]", help)


if __name__ == "__main__":
    main()
