#!/usr/bin/python3
"""breccia-impact as a user calls it: files, repeatability, refusals."""
import csv
import json
import math
import subprocess

from programs import HANG, SOURCE, ProgramTest, main, run, tree

EXAMPLES = SOURCE / "data" / "cases"


class Impact(ProgramTest):
    def test_two_spheres(self):
        result = run("impact", EXAMPLES / "impact-two-spheres.toml", "--out", self.out)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual(sorted(tree(self.out)), ["case.toml", "curve-0.csv", "spheres.csv", "summary.json"])
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

    HEAP = """[materials.glass]
density = 2500
young_modulus = "5 MPa"
poisson_ratio = 0.25
restitution = 0.3
friction = 0.4
[spheres]
file = "FILE"
material = "glass"
[[wall]]
name = "cup"
kind = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
material = "glass"
velocity = [0, 0, "10 mm/s"]
[scene]
gravity = [0, 0, -9.81]
[time]
duration = "30 ms"
safety = 0.3
[output]
frames = 2
rows = 50
"""

    def heap(self, spheres, name="heap.toml"):
        return self.write(name, self.HEAP.replace("FILE", str(spheres)))

    def test_spheres_of_a_file_on_a_moving_wall(self):
        rows = "".join(f"{k + 1},{0.01 * (k % 3)},{0.01 * (k // 3)},0.0051,0.005\n" for k in range(9))
        spheres = self.write("nine.csv", "id,x_m,y_m,z_m,r_m\n" + rows)
        done = run("impact", self.heap(spheres), "--out", self.out)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual([name for name in tree(self.out) if not name.startswith("frames")],
                         ["case.toml", "curve-0.csv", "spheres.csv", "summary.json", "walls-0.csv"])
        self.assertTrue((self.out / "frames" / "run-0" / "particles-001.vtp").exists())
        summary = json.loads((self.out / "summary.json").read_text())
        self.assertEqual(len(summary["inputs"]), 2)
        (cup,) = summary["runs"][0]["walls"]
        weight = 9 * 2500 * 4 / 3 * math.pi * 0.005**3 * 9.81
        self.assertEqual(cup["name"], "cup")
        self.assertAlmostEqual(cup["mean_force_N"][2] / -weight, 1, delta=0.02)
        self.assertGreater(cup["work_J"], 0.5 * weight * 0.01 * 0.03)
        # where a run ends another begins: spheres that press each other a little
        again = run("impact", self.heap(self.out / "spheres.csv", "again.toml"), "--out", self.work / "again",
                    "--set", 'wall.1.point=[0, 0, "0.25 mm"]')
        self.assertEqual((again.returncode, again.stderr), (0, ""))
        drawn = subprocess.run([SOURCE / "scripts" / "plot", self.out], capture_output=True, text=True, timeout=HANG)
        self.assertEqual((drawn.returncode, drawn.stderr), (0, ""))
        self.assertTrue((self.out / "grains.png").exists())

    def test_walls_that_make_no_sense(self):
        spheres = self.write("one.csv", "id,x_m,y_m,z_m,r_m\n1,0,0,0.01,0.005\n")
        case = self.heap(spheres)
        for sets, words in [
            (["wall.1.velocity=[0, 0, 0]", "wall.1.stops=0.01"], "wall.stops: the wall does not move"),
            (["wall.1.starts=0.02", "wall.1.stops=0.01"], "wall.stops: must be later than wall.starts"),
            (["wall.1.starts=0.05"], "wall.starts: is not before the end"),
            (["wall.1.load=10"], "wall.mass: missing"),
            (["wall.1.mass=10"], "wall.load: missing"),
            (['wall.1.name="a,b"'], "wall.name: "),
            (["wall.1.velocty=[0, 0, 1]"], "wall.velocty: unknown key"),
            (['spheres.file="none.csv"'], "none.csv"),
            (['spheres.material="clay"'], "spheres.material: no [materials.clay]"),
        ]:
            words = [words] if isinstance(words, str) else words
            flags = [word for one in sets for word in ("--set", one)]
            self.check_one_line(run("impact", case, "--out", self.out, *flags), 2, *words)
        two = self.write("two.toml", self.heap(spheres).read_text() + case.read_text().split("[scene]")[0].split("[[wall]]")[1].join(
            ["[[wall]]", ""]).replace("10 mm/s", "20 mm/s"))
        self.check_one_line(run("impact", two, "--out", self.out), 2, 'wall.name: another wall "cup" moves otherwise')

    def test_help_lists_its_own_keys(self):
        help = run("impact", "--help").stdout
        self.assertIn("[[particle]]", help)
        self.assertNotIn("[bonds]", help)


if __name__ == "__main__":
    main()
