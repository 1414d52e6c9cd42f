#!/usr/bin/python3
"""Specimens that are not what the case takes them for: refused with the value that would fit, or warned of.

A boundary condition that finds too few spheres must not be dropped, and calibration must not hide a defect."""
import json
import math
import re
import shutil

from programs import ProgramTest, main, run

HEADER = "id,x_m,y_m,z_m,r_m,group\n"
TRIAXIAL = """[specimen]
file = "specimen.csv"
diameter = "50 mm"
height = "100 mm"
[material]
preset = "concrete"
[test]
confinement = "5 MPa"
stop_strain = 0.001
[output]
frames = 0
"""
UCS = TRIAXIAL.replace('confinement = "5 MPa"\n', "")
DISCS = """[specimen]
dimensions = 2
diameter = "40 mm"
height = "80 mm"
pack = { spheres = 300, porosity = 0.12, seed = 3 }
"""


class Specimens(ProgramTest):
    def setUp(self):
        super().setUp()
        rows = (self.work / "specimen.csv").read_text().splitlines()
        self.spheres = [[int(row.split(",")[0]), *map(float, row.split(",")[1:5]), 1]
                        for row in rows if row[0].isdigit()]

    def place(self, spheres):
        self.write("specimen.csv", HEADER + "".join(",".join(map(repr, s)) + "\n" for s in spheres))

    def grouped(self, group):
        self.place([[*s[:5], group(*s[1:4])] for s in self.spheres])

    def moved(self, move):
        self.place([[s[0], *move(*s[1:4]), *s[4:]] for s in self.spheres])

    def kept(self, keep):
        self.place([s for s in self.spheres if keep(*s[1:4])])

    def refused(self, case, *words, program="triaxial", options=()):
        result = run(program, self.write("case.toml", case), "--out", self.out, *options)
        self.check_one_line(result, 2, *words)
        self.assertFalse(self.out.exists())
        return result.stderr

    def dry(self, case, program="triaxial", options=()):
        result = run(program, self.write("case.toml", case), "--dry-run", "--threads", "1", *options)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def summary(self, case, program="triaxial", options=()):
        result = run(program, self.write("case.toml", case), "--out", self.out, "--force", "--threads", "1", *options)
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads((self.out / "summary.json").read_text())["runs"][0]

    def check_warned(self, run_, *words):
        self.assertTrue(any(all(word in line for word in words) for line in run_["warnings"]), run_["warnings"])


class NominalBody(Specimens):
    """Pressure, gauges and platens are looked for at the nominal body: it must be the one that is there."""

    def test_good(self):
        self.assertNotIn("warning", self.dry(TRIAXIAL))

    def test_diameter(self):
        for program in ("triaxial", "hydrostatic"):
            for given in (55, 60, 44):
                case = TRIAXIAL.replace("50 mm", f"{given} mm")
                if program == "hydrostatic":
                    case = case.replace("stop_strain = 0.001\n", "")
                text = self.refused(case, "specimen.diameter", "would fit", program=program)
                fits = re.search(r"([\d.]+) mm would fit", text)
                self.assertAlmostEqual(float(fits[1]), 50, delta=1)
        for program in ("ucs", "usc", "tension"):
            self.refused(UCS.replace("50 mm", "55 mm"), "specimen.diameter", "would fit", program=program)
        self.assertIn("warning: specimen.diameter", self.dry(TRIAXIAL.replace("50 mm", "53 mm")))

    def test_value_that_would_fit(self):
        text = self.refused(TRIAXIAL.replace("50 mm", "55 mm"), "would fit")
        fits = re.search(r"([\d.]+ mm) would fit", text)[1]
        self.assertNotIn("warning", self.dry(TRIAXIAL.replace("50 mm", fits)))

    def test_height(self):
        for given in (108, 115, 95):
            text = self.refused(TRIAXIAL.replace("100 mm", f"{given} mm"), "specimen.height", "would fit")
            self.assertAlmostEqual(float(re.search(r"([\d.]+) mm would fit", text)[1]), 100, delta=2)
        # centres outside: said with what the spheres fill
        text = self.refused(TRIAXIAL.replace("100 mm", "90 mm"), "height", "along the axis the spheres fill")
        self.assertAlmostEqual(float(re.search(r"axis the spheres fill ([\d.]+) mm", text)[1]), 100, delta=3)
        self.refused(UCS.replace("100 mm", "108 mm"), "specimen.height", program="ucs")

    def test_centre(self):
        where = [0.3, -0.2, 0.1]
        self.moved(lambda x, y, z: (x + where[0], y + where[1], z + where[2]))
        self.assertNotIn("warning", self.dry(TRIAXIAL))
        for k, off in ((0, 0.0022), (1, -0.0025), (2, 0.003)):
            centre = [w + off * (i == k) for i, w in enumerate(where)]
            text = self.refused(TRIAXIAL.replace("[material]", f"centre = {centre}\n[material]"),
                                "specimen.centre", "would fit")
            fits = json.loads(re.search(r"(\[[^]]*\]) would fit", text)[1])
            for got, wanted in zip(fits, where):
                self.assertAlmostEqual(got, wanted, delta=5e-4)

    def test_axis(self):
        # what the message says of the centre is said in the file's own coordinates
        self.moved(lambda x, y, z: (y + 1, z, x))
        case = TRIAXIAL.replace("[material]", 'axis = "y"\ncentre = [1.0025, 0, 0]\n[material]')
        text = self.refused(case, "specimen.centre", "would fit")
        self.assertAlmostEqual(json.loads(re.search(r"(\[[^]]*\]) would fit", text)[1])[0], 1, delta=5e-4)

    def test_rectangle(self):
        self.assertEqual(run("pack", self.write("pack.toml", DISCS), "--out", self.work / "p").returncode, 0)
        (self.work / "specimen.csv").write_text((self.work / "p" / "specimen.csv").read_text())
        case = TRIAXIAL.replace('"50 mm"', '"40 mm"\ndimensions = 2').replace("100 mm", "80 mm")
        self.assertNotIn("warning", self.dry(case, "biaxial"))
        for given in (42, 44, 38):
            text = self.refused(case.replace("40 mm", f"{given} mm"), "specimen.diameter", program="biaxial")
            self.assertAlmostEqual(float(re.search(r"([\d.]+) mm would fit", text)[1]), 40, delta=0.4)
        self.refused(case.replace("80 mm", "84 mm"), "specimen.height", program="biaxial")

    def test_brazilian_disc(self):
        pack = '[specimen]\nshape = "disc"\ndiameter = "50 mm"\nheight = "25 mm"\npack = { spheres = 300, seed = 3 }\n'
        self.assertEqual(run("pack", self.write("pack.toml", pack), "--out", self.work / "p").returncode, 0)
        (self.work / "specimen.csv").write_text((self.work / "p" / "specimen.csv").read_text())
        case = UCS.replace('"50 mm"', '"50 mm"\nshape = "disc"\naxis = "z"').replace("100 mm", "25 mm")
        self.assertNotIn("warning", self.dry(case, "bts"))
        self.refused(case.replace("50 mm", "54 mm"), "specimen.diameter", program="bts")
        self.refused(case.replace("25 mm", "30 mm"), "specimen.height", program="bts")

    def test_core_cut_from_a_block(self):
        pack = ('[specimen]\nshape = "box"\ndiameter = "50 mm"\ndepth = "50 mm"\nheight = "100 mm"\n'
                "pack = { spheres = 1500, seed = 3 }\n")
        self.assertEqual(run("pack", self.write("pack.toml", pack), "--out", self.work / "p").returncode, 0)
        block = (self.work / "p" / "specimen.csv").read_text().splitlines()
        reach = lambda row: math.hypot(*map(float, row.split(",")[1:3])) + float(row.split(",")[4])
        self.write("specimen.csv", "\n".join(block[:1] + [row for row in block[1:] if reach(row) < 0.02]) + "\n")
        text = self.refused(TRIAXIAL.replace("50 mm", "40 mm"), "specimen.diameter", "would fit")
        fits = re.search(r"([\d.]+ mm) would fit", text)[1]
        self.assertIn("lateral surface and cover", self.dry(TRIAXIAL.replace("50 mm", fits)))

    def test_one_sphere_wide(self):
        self.place([[k, 0.0, 0.0, -0.09 + 0.02 * k, 0.01, 1] for k in range(10)])
        case = TRIAXIAL.replace("50 mm", "20 mm").replace("100 mm", "200 mm")
        self.refused(case, "one sphere wide")
        run_ = self.summary(case.replace('confinement = "5 MPa"\n', ""), "ucs")
        self.assertIsNone(run_["poisson_ratio"])
        self.assertAlmostEqual(run_["young_modulus_Pa"] / 28e9, 1, delta=0.02)

    def test_measured_pressure(self):
        run_ = self.summary(TRIAXIAL)
        self.assertAlmostEqual(run_["confinement_measured_Pa"] / 5e6, 1, delta=0.02)
        self.assertTrue(0.65 < run_["mantle_cover"] < 0.9, run_["mantle_cover"])
        column = [float(row.split(",")[6]) for row in (self.out / "curve-0.csv").read_text().splitlines()[1:]]
        for value in column:
            self.assertAlmostEqual(value / 5e6, 1, delta=0.02)
        hydrostatic = self.summary(TRIAXIAL.replace("stop_strain = 0.001\n", ""), "hydrostatic")
        self.assertAlmostEqual(hydrostatic["confinement_measured_Pa"] / 5e6, 1, delta=0.05)
        self.assertIsNone(self.summary(UCS, "ucs")["confinement_measured_Pa"])


class LooseSpheres(Specimens):
    """What hangs on nothing is in no gauge, no pressed surface and no box."""

    def test_hole(self):
        drilled = lambda text, size="28 mm": text.replace('height = "100 mm"', f'height = "100 mm"\nhole = "{size}"')
        self.refused(drilled(UCS), "specimen.hole = 28 mm: ", "spheres lie within it", program="ucs")
        self.refused(drilled(UCS, "45 mm"), "specimen.hole: 45 mm leaves a wall of less than a tenth", program="ucs")
        self.kept(lambda x, y, z: math.hypot(x, y) > 0.0145)
        self.assertIn("if the specimen has a hole, say specimen.hole = ", self.dry(UCS, "ucs"))
        self.assertNotIn("has a hole", self.dry(drilled(UCS), "ucs"))
        # the same load over what is left of the section
        fixed = ["--set", "bonds.alpha=1", "--set", 'material.shear_under_yield="elastic"']
        whole, rest = self.summary(UCS, "ucs", fixed), self.summary(drilled(UCS), "ucs", fixed)
        self.assertAlmostEqual(rest["peak_stress_Pa"] / whole["peak_stress_Pa"], 1 / (1 - (28 / 50)**2), delta=1e-9)

    def test_stray(self):
        self.place(self.spheres + [[999, 0.0, 0.0, 0.07, 0.002, 1]])
        self.refused(TRIAXIAL, "specimen.csv:302", "sphere 999", "stray", "remove")
        # within what is allowed outside it runs, and must not shift the middle of the others
        self.place(self.spheres + [[999, 0.0, 0.0, 0.0507, 0.0005, 1]])
        self.assertIn("1 sphere hangs on nothing", self.dry(UCS, "ucs"))
        # a speck in a hole, which moves with nothing
        self.place([s for s in self.spheres if math.hypot(*s[1:4]) > 0.012] + [[999, 0.0, 0.0, 0.0, 0.001, 1]])
        # 300 spheres around a hole: with an elastic shear stiffness equal runs differ little
        alike = ["--set", "bonds.alpha=1", "--set", 'material.shear_under_yield="elastic"']
        with_speck = self.summary(UCS, "ucs", alike)
        self.kept(lambda x, y, z: math.hypot(x, y, z) > 0.012)
        without = self.summary(UCS, "ucs", alike)
        self.assertEqual(with_speck["loose_particles"], 1)
        for key in ("young_modulus_Pa", "poisson_ratio", "peak_stress_Pa"):
            self.assertAlmostEqual(with_speck[key] / without[key], 1, delta=0.02)

    def test_unbonded_at_the_surface(self):
        self.grouped(lambda x, y, z: 0 if abs(z) < 0.02 and x > 0.014 else 1)
        run_ = self.summary(UCS, "ucs")
        self.assertGreater(run_["loose_particles"], 6)
        self.check_warned(run_, "hang on nothing", "without a bond")

    def test_loose_shell(self):
        self.grouped(lambda x, y, z: 0 if math.hypot(x, y) > 0.017 else 1)
        self.refused(TRIAXIAL, "reach the lateral surface", "specimen.diameter")


class Defects(Specimens):
    """Calibration to the material's modulus must not hide what is broken."""

    def test_flaw(self):
        self.kept(lambda x, y, z: not (abs(z - 0.6 * x) < 0.005 and abs(y) < 0.012))
        self.refused(UCS, "bonds.alpha", '"auto"', "intact", program="ucs")
        intact = re.search(r"alpha ([\d.]+) ", self.intact_dry())[1]
        self.kept(lambda x, y, z: not (abs(z - 0.6 * x) < 0.005 and abs(y) < 0.012))
        flawed = self.summary(UCS.replace("0.001", "0.004"), "ucs", ["--set", f"bonds.alpha={intact}"])
        self.check_warned(flawed, "young_modulus", "less than the material's")
        self.place(self.spheres)
        whole = self.summary(UCS.replace("0.001", "0.004"), "ucs")
        self.assertLess(flawed["peak_stress_Pa"], 0.8 * whole["peak_stress_Pa"])
        self.assertAlmostEqual(whole["alpha"] / whole["alpha_affine"], 1, delta=0.1)

    def intact_dry(self):
        self.place(self.spheres)
        return self.dry(UCS, "ucs")

    def test_nearly_severed(self):
        self.kept(lambda x, y, z: abs(z) > 0.006 or math.hypot(x, y) < 0.009)
        self.refused(UCS, "bonds.alpha", "intact", program="ucs")

    def test_severed(self):
        self.moved(lambda x, y, z: (x, y, z + math.copysign(0.004, z)))
        case = TRIAXIAL.replace("100 mm", "108 mm")
        for options in ((), ("--set", "bonds.alpha=1")):
            self.refused(case, "severed", "2 pieces", options=options)
        self.refused(case.replace('confinement = "5 MPa"\n', ""), "severed", program="tension")

    def test_joint(self):
        # two groups that touch: compression goes through, tension does not
        self.grouped(lambda x, y, z: 1 if z < 0 else 2)
        run_ = self.summary(TRIAXIAL, options=["--set", "bonds.alpha=0.9"])
        self.check_warned(run_, "surfaces that only touch", "2 pieces")
        self.assertEqual(run_["pieces"], 2)
        shutil.rmtree(self.out)
        self.refused(UCS, "severed", program="tension")

    def test_two_halves(self):
        self.moved(lambda x, y, z: (x + math.copysign(0.003, x), y, z))
        text = self.dry(TRIAXIAL)
        self.assertIn("warning: the bonds fall into 2 pieces", text)

    def test_thread(self):
        # most bonds taken away by the groups
        self.place([[*s[:5], k % 3] for k, s in enumerate(self.spheres)])
        result = run("ucs", self.write("case.toml", UCS), "--dry-run")
        text = result.stdout + result.stderr
        self.assertIn("pieces", text)
        self.assertTrue(result.returncode == 2 or "warning" in text, text)

    def test_modulus_with_unbonded_contacts(self):
        # what overlaps without a bond presses in the run, and in the probe
        for options in (["--set", "bonds.range=-0.03"], []):
            self.grouped(lambda x, y, z: 1)
            if not options:
                self.place([[*s[:5], 0 if k % 3 == 0 else 1] for k, s in enumerate(self.spheres)])
            run_ = self.summary(UCS, "ucs", options)
            modulus = run_["young_modulus_Pa"] / 28e9
            if abs(modulus - 1) > 0.1:
                self.check_warned(run_, "young_modulus")
            self.assertAlmostEqual(modulus, 1, delta=0.2)


class Units(Specimens):
    def scaled(self, factor):
        self.place([[s[0], *(factor * v for v in s[1:5]), 1] for s in self.spheres])

    def test_factor(self):
        for factor, word in ((1000, "in mm"), (100, "in cm"), (1 / 0.0254, "inches"), (25.4, "inches"), (10, "cm")):
            self.scaled(factor)
            self.refused(UCS, f"{factor:.4g} times the nominal size", word, program="ucs")
        for factor, word in ((0.001, "in mm"), (0.1, "cm"), (1 / 25.4, "inches")):
            self.scaled(factor)
            self.refused(UCS, f"{factor:.4g} times the nominal size", word, program="ucs")

    def test_radii(self):
        for radius, word in (("1e-100", "smaller"), ("1e-8", "smaller"), ("1000", "larger")):
            self.place(self.spheres)
            rows = (self.work / "specimen.csv").read_text().splitlines()
            parts = rows[5].split(",")
            rows[5] = ",".join(parts[:4] + [radius] + parts[5:])
            self.write("specimen.csv", "\n".join(rows) + "\n")
            for options in ((), ("--dry-run",)):
                self.refused(UCS, "specimen.csv:6", f"sphere {parts[0]}", "radius", word, program="ucs", options=options)
        self.place([[*s[:4], 1000 * s[4], 1] for s in self.spheres])
        self.refused(UCS, "specimen.csv:", "radius", program="ucs")


if __name__ == "__main__":
    main()
