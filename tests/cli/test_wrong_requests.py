#!/usr/bin/python3
"""Requests that cannot happen, and results that are none: refused by name, or said where the result stands."""
import csv
import json
import re
import shutil

from programs import SOURCE, UCS, ProgramTest, main, run

QUICK = ("--threads", "1", "--set", "output.frames=0")
PACK = '[specimen]\ndiameter = "50 mm"\nheight = "100 mm"\n[specimen.pack]\nspheres = 60\nseed = 7\n'
SIEVES = """[specimen]
diameter = "50 mm"
height = "100 mm"
[specimen.pack]
porosity = 0.30
sizes = { kind = "sieves", openings = ["4 mm", "8 mm", "12 mm"], passing = [0, 0.5, 1.0] }
"""
SHEAR = UCS.replace("stop_strain = 0.006", 'confinement = ["1 MPa"]\nstop_strain = 0.003')


def test(lines):
    """The case of a test with other lines in [test]."""
    return UCS.replace("stop_strain = 0.006", lines)


class Case(ProgramTest):
    def go(self, program, text, *options, code=0):
        """Runs a case and gives its summary."""
        result = run(program, self.write("case.toml", text), "--out", self.out, "--force", *QUICK, *options)
        self.assertEqual(result.returncode, code, result.stderr)
        self.said = result.stdout
        return json.loads((self.out / "summary.json").read_text())

    def refused(self, program, text, *words, options=()):
        result = run(program, self.write("case.toml", text), "--out", self.out, *options)
        self.check_one_line(result, 2, f"breccia-{program}: ", *words)
        self.assertFalse(self.out.exists())

    def explained(self, program, text, *options):
        result = run(program, self.write("case.toml", text), "--explain", "--threads", "1", *options)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def curve(self, number=0):
        with (self.out / f"curve-{number}.csv").open() as file:
            return [{key: float(value or "nan") for key, value in row.items()} for row in csv.DictReader(file)]


class Peaks(Case):
    """A swing of the stress is no strength, and no line goes through what is none."""

    def test_swing_under_high_confinement(self):
        """Bonds that break one by one let a deviator of 1 MPa under 100 MPa fall by half: the test goes on."""
        folder = SOURCE / "tests" / "cases" / "swing-under-confinement"
        shutil.copy(folder / "specimen.csv", self.work)
        summary = self.go("triaxial", (folder / "case.toml").read_text())
        for one, strength in zip(summary["runs"], (133e6, 141e6)):
            self.assertEqual(one["stopped_by"], "strain")
            self.assertGreater(one["peak_stress_Pa"], 0.995 * strength)
            self.assertFalse(one["peak_reached"])
        self.assertNotIn("mohr_coulomb", summary)
        self.assertIn("a line needs two", summary["no_mohr_coulomb"])
        self.assertIn("Mohr-Coulomb: none", self.said)
        # at rest under its pressure: the deviator begins at zero
        for number, pressure in enumerate((100e6, 110e6)):
            first = self.curve(number)[0]
            self.assertLess(abs(first["axial_stress_Pa"] - pressure), 0.003 * pressure)

    def test_no_strength_left(self):
        """Bonds that are broken before the test begins carry no deviator that could be a strength."""
        weak = test('confinement = ["20 MPa", "30 MPa"]\nplaten_speed = "0.4 m/s"\nstop_strain = 0.002').replace(
            "[test]", 'tensile_strength = "1 kPa"\nshear_strength = "1 kPa"\nfriction_static = 0\nfriction_dynamic = 0\n[test]')
        summary = self.go("triaxial", weak)
        for one in summary["runs"]:
            self.assertFalse(one["peak_reached"])
        self.assertNotIn("mohr_coulomb", summary)

    def test_true_peaks_are_fitted(self):
        summary = self.go("triaxial", test('confinement = ["0 MPa", "4 MPa"]\nplaten_speed = "0.2 m/s"\nstop_strain = 0.01\n'
                                           "stop_after_peak = 0.1"))
        self.assertTrue(all(one["peak_reached"] for one in summary["runs"]))
        self.assertEqual(summary["mohr_coulomb"]["peaks"], 2)
        self.assertNotIn("no_mohr_coulomb", summary)


class Tables(Case):
    """Values of a material between two tabulated confinements lie on straight lines."""
    CEMENT = test('confinement = {}\nplaten_speed = "0.2 m/s"\nstop_strain = 0.001').replace('"concrete"', '"cement"')

    def limits(self, confinement, *options):
        text = self.explained("triaxial", self.CEMENT.format(confinement), *options)
        found = re.search(r'MPa: (.*): limit_compressive_stress \["(.*) MPa", "(.*) MPa", "(.*) MPa"\](.*)', text)
        return found[1], [float(found[k]) for k in (2, 3, 4)], found[5]

    def test_pounds_in_pascals(self):
        self.assertEqual(self.limits('["1000 psi"]'), ("those at 6.895 MPa", [10, 11, 14], ""))
        where, limits, warning = self.limits('["6.89 MPa"]')
        self.assertEqual(where, "between those at 3.447 MPa and 6.895 MPa")
        for here, there in zip(limits, (10, 11, 14)):
            self.assertAlmostEqual(here, there, delta=0.002)
        self.assertEqual(warning, "")

    def test_between(self):
        self.assertEqual(self.limits('["1500 psi"]')[1], [11.5, 12.5, 14.5])
        self.assertEqual(self.limits('["250 psi"]')[1], [9, 10, 12])

    def test_beyond(self):
        where, limits, warning = self.limits('["5000 psi"]')
        self.assertEqual((where, limits), ("those at 27.58 MPa", [21, 23, 26]))
        self.assertIn("table ends at 27.58 MPa", warning)

    def test_summary_and_resolved_case(self):
        summary = self.go("triaxial", self.CEMENT.format('["0 MPa", "1500 psi", "30 MPa"]'))
        self.assertEqual([one["material_values"] for one in summary["runs"]],
                         ["those at 0 MPa", "between those at 6.895 MPa and 13.79 MPa", "those at 27.58 MPa"])
        self.assertEqual([any("table ends" in w for w in one["warnings"]) for one in summary["runs"]], [False, False, True])
        self.assertIn("between those at", (self.out / "case.toml").read_text())
        hashes = [one["state_hash"] for one in summary["runs"]]
        shutil.copy(self.out / "case.toml", self.work / "again.toml")
        again = self.go("triaxial", (self.work / "again.toml").read_text())
        self.assertEqual([one["state_hash"] for one in again["runs"]], hashes)

    def test_of_the_case(self):
        own = test('confinement = ["5 MPa", "20 MPa"]\nstop_strain = 0.001').replace(
            "[test]", '[[material.at]]\nconfinement = "20 MPa"\nlimit_compressive_stress = ["30 MPa", "50 MPa", "80 MPa"]\n[test]')
        text = self.explained("triaxial", own)
        self.assertIn('5 MPa: between those at 0 MPa and 20 MPa: limit_compressive_stress ["22.5 MPa", "46.25 MPa", "72.5 MPa"]', text)
        self.assertIn('20 MPa: those at 20 MPa: limit_compressive_stress ["30 MPa", "50 MPa", "80 MPa"]', text)
        unused = test('confinement = "2 MPa"').replace("[test]", """[[material.at]]
confinement = "5 MPa"
friction_static = 1
[[material.at]]
confinement = "30 MPa"
friction_static = 1
[test]""")
        self.refused("triaxial", unused, "case.toml:11: material.at: no run has confinement 30 MPa")

    def test_one_key_or_the_other(self):
        self.refused("triaxial", test('confinement = "5 MPa"').replace(
            "[test]", '[[material.at]]\nconfinement = "10 MPa"\nfracture_energy_normal = 50\n[test]'),
                     "case.toml:9", "material.fracture_energy_normal", "give the same one at both")


class Sieves(Case):
    """Openings are lengths."""

    def passing(self, *options):
        result = run("pack", self.write("case.toml", SIEVES), "--out", self.out, "--force", *options)
        self.assertEqual(result.returncode, 0, result.stderr)
        with (self.out / "specimen.csv").open() as file:
            diameters = [2e3 * float(row["r_m"]) for row in csv.DictReader(file)]
        mass = [d**3 for d in diameters]
        return max(diameters), min(diameters), lambda opening: sum(m for d, m in zip(diameters, mass) if d <= opening) / sum(mass)

    def test_sizes_are_kept(self):
        largest, least, passing = self.passing()
        self.assertLessEqual(largest, 12)
        self.assertGreaterEqual(least, 4)
        self.assertAlmostEqual(passing(8), 0.5, delta=0.02)
        number = (self.out / "specimen.csv").read_text().count("\n") - 1
        solid = sum(4 / 3 * 3.141592653589793 * float(line.split(",")[4])**3
                    for line in (self.out / "specimen.csv").read_text().splitlines()[1:])
        self.assertAlmostEqual(1 - solid / (3.141592653589793 * 0.025**2 * 0.1), 0.30, delta=1e-6)
        self.passing("--set", f"specimen.pack.spheres={number}")

    def test_fines_left_out(self):
        largest, least, passing = self.passing("--set", 'specimen.pack.sizes.finest="8 mm"')
        self.assertLessEqual(largest, 12)
        self.assertGreaterEqual(least, 8)

    def test_numbers_that_contradict(self):
        with_number = SIEVES.replace("porosity", "spheres = 200\nporosity")
        self.refused("pack", with_number, "case.toml:5: specimen.pack.spheres: ", "spheres, not 200", "sizes.finest")
        self.refused("ucs", with_number + '[material]\npreset = "concrete"\n', "case.toml:5: specimen.pack.spheres: ")
        self.refused("pack", with_number.replace("200", "2000"), "specimen.pack.spheres", "not 2000; write ")
        self.refused("pack", SIEVES.replace("porosity = 0.30", 'genesis_pressure = 0.05').replace(
            "[specimen]", '[specimen]\ndimensions = 2\nshape = "box"'), "case.toml:7", "specimen.pack.genesis_pressure", "lengths")
        self.refused("pack", PACK + 'sizes.finest = "1 mm"\n', "case.toml:7", "specimen.pack.sizes.finest", "sieves")


class Servo(Case):
    """What a servo holds is measured, and the difference is said."""

    def test_normal_stress_of_a_shear_box(self):
        one = self.go("shear", SHEAR)["runs"][0]
        rows = self.curve()
        peak = max(range(len(rows)), key=lambda k: rows[k]["axial_stress_Pa"])
        first = last = peak
        while first > 0 and rows[first - 1]["axial_stress_Pa"] > 0.95 * rows[peak]["axial_stress_Pa"]:
            first -= 1
        while last + 1 < len(rows) and rows[last + 1]["axial_stress_Pa"] > 0.95 * rows[peak]["axial_stress_Pa"]:
            last += 1
        held = [row["confining_stress_Pa"] for row in rows[first:last + 1]]
        self.assertAlmostEqual(one["confining_stress_at_peak_Pa"], sum(held) / len(held), delta=1)
        self.assertAlmostEqual(one["confining_stress_at_peak_Pa"] / 1e6, 1, delta=0.1)
        mean = sum(row["confining_stress_Pa"] for row in rows) / len(rows)
        self.assertAlmostEqual(mean / 1e6, 1, delta=0.1)
        off = abs(rows[peak]["confining_stress_Pa"] / 1e6 - 1)
        way = (sum((row["confining_stress_Pa"] / 1e6 - 1)**2 for row in rows[:peak + 1]) / (peak + 1))**0.5
        wrong = max(off, way, abs(one["confining_stress_at_peak_Pa"] / 1e6 - 1)) > 0.05
        self.assertEqual(wrong, any("normal stress" in warning for warning in one["warnings"]))

    def test_line_through_measured_stresses(self):
        summary = self.go("shear", SHEAR.replace('["1 MPa"]', '["1 MPa", "4 MPa"]'))
        x, y = zip(*((one["confining_stress_at_peak_Pa"], one["peak_stress_Pa"]) for one in summary["runs"]))
        slope = (y[1] - y[0]) / (x[1] - x[0])
        self.assertAlmostEqual(summary["mohr_coulomb"]["cohesion_Pa"] / 1e6, (y[0] - slope * x[0]) / 1e6, places=6)


class Impossible(Case):
    """A request that cannot happen is refused by name, or leaves a warning."""

    def test_unloading_beyond_the_end(self):
        self.refused("ucs", test("stop_strain = 0.004\nunload_at = [0.001, 0.5]"), "case.toml:9: test.unload_at: ",
                     "0.5 lies beyond test.stop_strain 0.004")

    def test_unloading_that_never_came(self):
        one = self.go("ucs", test('platen_speed = "0.2 m/s"\nstop_strain = 0.01\nunload_at = [0.0005, 0.0095]'))["runs"][0]
        self.assertEqual((one["stopped_by"], len(one["cycles"])), ("peak drop", 1))
        self.assertIn("test.unload_at 0.0095 was not reached: the run had ended (peak drop)", one["warnings"])
        self.assertIn("0.0095 was not reached", self.said)

    def test_a_confinement_twice(self):
        self.refused("triaxial", test('confinement = ["5 MPa", "5000 kPa"]'), "case.toml:8: test.confinement: 5 MPa stands twice")

    def test_what_the_bonds_cannot_do(self):
        self.refused("ucs", UCS.replace('file = "specimen.csv"', "pack.spheres = 20") + "[bonds]\ncoordination = 29\n",
                     "case.toml:12: bonds.coordination: ", "cannot be reached")
        self.refused("shear", SHEAR.replace('file = "specimen.csv"', "pack.spheres = 40").replace("100 mm", "60 mm"),
                     "case.toml:4: specimen.height: ", "five mean radii")

    def test_keys_that_nothing_reads(self):
        for lines, place, word in (
                (test("unload_to = 0.2"), "case.toml:8: test.unload_to: ", "test.unload_at"),
                (UCS + "[time]\nmass_factor = 3\n", "case.toml:12: time.mass_factor: ", "mass_scaling"),
                (UCS + '[damping]\ncontact = 0\nscheme = "capped"\n', "case.toml:13: damping.scheme: ", "no dashpot"),
                (UCS + '[damping]\ncontact = 0\nform = "paper"\n', "case.toml:13: damping.form: ", "no dashpot"),
                (UCS + "[damping]\nrotation = 0.2\n[features]\nrotation = false\n", "case.toml:12: damping.rotation: ", "spins"),
                (UCS.replace("frames = 3", "frames = 0\nstress = true"), "case.toml:11: output.stress: ", "frames")):
            with self.subTest(key=place):
                self.refused("ucs", lines, place, word, "leave it out")

    def test_strength_of_the_ends(self):
        packed = UCS.replace('file = "specimen.csv"', "pack.spheres = 800")
        for platens, said in (("smooth", True), ("rough", False)):
            run_ = self.go("ucs", packed.replace("stop_strain = 0.006", f'platens = "{platens}"\nstop_strain = 0.004'))["runs"][0]
            self.assertEqual(any("a strength of the ends" in line for line in run_["warnings"]), said, run_["warnings"])

    def test_strips_and_stage_1(self):
        disc = UCS.replace('diameter = "50 mm"\nheight = "100 mm"', 'shape = "disc"\ndiameter = "50 mm"\nheight = "25 mm"').replace(
            'file = "specimen.csv"', "pack.spheres = 200")
        for lines, word in (('strip_width = "40 mm"', "test.strip_width: 40 mm is more than half"),
                            ('strip_depth = "20 mm"', "test.strip_depth: 20 mm is more than half"),
                            ('strips = "planes"\nstrip_depth = "2 mm"', "test.strip_depth: planes hold no spheres"),
                            ('strips = "planes"\nplatens = "rough"', "test.platens: planes hold nothing sideways"),
                            ('strip_width = "5 mm"\nstrip_angle = 10', "test.strip_"),
                            ("strip_angle = 100", "test.strip_angle: must be above 0 to 90")):
            self.refused("bts", disc.replace("stop_strain = 0.006", lines), word)
        self.refused("ucs", test('strip_width = "5 mm"'), "test.strip_width: strips press a disc")
        pressed = 'confinement = ["5 MPa"]\n'
        self.refused("ucs", test('hydrostatic_branch = "law"'), "test.hydrostatic_branch: ")
        self.refused("triaxial", test('hydrostatic_branch = "law"'), "test.hydrostatic_branch: without a confinement")
        self.refused("triaxial", test(pressed + 'hydrostatic_branch = "law"') + "[features]\nplasticity = false\n",
                     "test.hydrostatic_branch: with features.plasticity = false")
        self.refused("triaxial", test(pressed + 'hydrostatic_branch = "elastic"').replace('preset = "concrete"', 'preset = "concrete-high-confinement"'),
                     "test.hydrostatic_branch: law \"exponential\" has no limits")
        self.refused("ucs", UCS.replace('preset = "concrete"', 'preset = "concrete"\nlaw = "kdem"\nshear_under_yield = "elastic"'),
                     "material.shear_under_yield: law \"kdem\" has no shear_under_yield")
        self.refused("ucs", UCS.replace('preset = "concrete"', 'preset = "concrete"\nshear_under_yield = "elastic"') + "[features]\nplasticity = false\n",
                     "material.shear_under_yield: with features.plasticity = false nothing yields")
        preset = 'preset = "concrete"'
        self.refused("ucs", UCS.replace(preset, preset + '\nunloading_modulus = "20 GPa"'),
                     "material.unloading_modulus: must be at least material.young_modulus, 28 GPa, not 20")
        self.refused("ucs", UCS.replace(preset, preset + '\nyield_stress = "1 MPa"'),
                     "material.yield_stress: must be at least the first limit_compressive_stress, 20 MPa, not 1")
        self.refused("ucs", UCS.replace(preset, preset + "\nrolling_friction = 0.1") + '[run]\nprecision = "single"\n',
                     'material.rolling_friction: resistance to rolling is not built for run.precision = "single"')
        self.refused("ucs", UCS.replace(preset, preset + '\nyield_stress = "40 MPa"') + "[features]\nplasticity = false\n",
                     "material.yield_stress: with features.plasticity = false nothing yields")

    def test_of_a_box_under_pressure(self):
        block = UCS.replace('file = "specimen.csv"', 'pack = { spheres = 300 }\nshape = "box"\ndepth = "40 mm"')
        box = lambda *lines: block.replace("[test]\n", "\n".join(["[test]", *lines, ""]))
        two = 'confinement = ["1 MPa", "3 MPa"]'
        self.refused("triaxial", box(two, 'intermediate_stress = ["2 MPa"]'), "test.intermediate_stress: 2 MPa is below the confinement 3 MPa")
        self.refused("triaxial", box(two, 'intermediate_stress = ["5 MPa", "6 MPa", "7 MPa"]'), "test.intermediate_stress: has 3 values where")
        self.refused("triaxial", box('intermediate_stress = "5 MPa"'), "test.intermediate_stress: needs a test.confinement above 0 Pa")
        self.refused("triaxial", box(two, 'skin_weights = "voronoi"'), "test.skin_weights: the faces of a box")
        self.refused("triaxial", test(two + "\nintermediate_stress = \"5 MPa\""), "test.intermediate_stress: acts on two faces of a box")
        self.refused("hydrostatic", box('confinement = "5 MPa"', 'intermediate_stress = "5 MPa"').replace("stop_strain = 0.006", ""),
                     "test.intermediate_stress: this test has no pressure")

    def test_of_cutting(self):
        block = UCS.replace('file = "specimen.csv"', 'pack = { spheres = 300 }\nshape = "box"\ndepth = "30 mm"').replace(
            '"100 mm"', '"40 mm"')
        cut = lambda *lines: block.replace("[test]\nstop_strain = 0.006", "\n".join(["[test]", *lines]))
        self.refused("cut", cut(), "test.cut_depth: missing")
        self.refused("cut", cut('cut_depth = "30 mm"'), "test.cut_depth: ", "half the block's height")
        self.refused("cut", cut('cut_depth = "5 mm"', 'cut_width = "31 mm"'), "test.cut_width: ", "the block's depth")
        self.refused("cut", cut('cut_depth = "5 mm"', "rake_angle = 50", "clearance_angle = 40"), "test.rake_angle: 50 and")
        self.refused("cut", cut('cut_depth = "5 mm"', "stop_after_peak = 0.3"), "test.stop_after_peak: this test does not end with a peak")
        self.refused("cut", cut('cut_depth = "5 mm"', 'platens = "smooth"'), "test.platens: ")
        self.refused("cut", cut('cut_depth = "5 mm"').replace('"box"', '"cylinder"').replace('depth = "30 mm"\n', ""), 'specimen.shape "cylinder" does not go with breccia-cut; valid: "box"')
        self.refused("ucs", test('cut_depth = "5 mm"'), "test.cut_depth: only breccia-cut has a tool")

    def test_resolved_cases_stay_accepted(self):
        self.go("ucs", test('platen_speed = "0.4 m/s"\nstop_strain = 0.001'))
        shutil.copy(self.out / "case.toml", self.work / "again.toml")
        self.go("ucs", (self.work / "again.toml").read_text())


class Packing(Case):
    """Messages of the packing name file, line and key; --help has the ranges that are taken."""

    def test_messages(self):
        self.refused("pack", PACK + "porosity = 0.1\n", "case.toml:7: specimen.pack.porosity: must be from 0.15 to 0.6")
        self.refused("pack", PACK + "sizes.spread = 0.8\n", "case.toml:7: specimen.pack.sizes.spread: must be from 0 to 0.7")
        self.refused("pack", PACK + 'sizes = { kind = "uniform", spread = 0.95 }\n', "specimen.pack.sizes.spread: must be from 0 to 0.9")
        self.refused("pack", PACK.replace("60", "1"), "case.toml:5: specimen.pack.spheres: the largest sphere")
        self.refused("ucs", PACK.replace("60", "1") + '[material]\npreset = "concrete"\n', "case.toml:5: specimen.pack.spheres: ")
        self.refused("pack", PACK, "--set: specimen.pack.spheres: the largest", options=("--set", "specimen.pack.spheres=1"))

    def test_help(self):
        text = run("pack", "--help").stdout
        self.assertIn("from 0.02 to 0.6 (dimensions 3: from 0.15 to 0.6)", text)
        self.assertIn("from 0 to 0.9 (kind lognormal: from 0 to 0.7)", text)

    def test_defaults_of_a_law_and_of_a_dimension(self):
        text = run("ucs", "--help").stdout
        for words in ("0.26; 2-D: 0.11", "minimum; kdem: polyhedron", "0.8; fast: 0.95; reference: 0.4"):
            self.assertIn(words, text)
        text = self.explained("ucs", UCS.replace("[test]", 'law = "kdem"\n[time]\naccuracy = "fast"\n[test]'))
        self.assertIn('bonds.area = "polyhedron" (material.law; otherwise minimum)', text)
        self.assertIn("time.safety = 0.95 (time.accuracy; otherwise 0.8)", text)


class Impact(Case):
    SCENE = """[time]
duration = "1 ms"
[materials.glass]
density = 2500
young_modulus = "70 GPa"
poisson_ratio = 0.2
[[particle]]
position = [0, 0, "20 mm"]
radius = "10 mm"
velocity = [0, 0, "-1 m/s"]
material = "glass"
[[wall]]
kind = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
material = "glass"
"""

    def test_messages(self):
        self.refused("impact", self.SCENE.replace("1 ms", "1e9 s"), "case.toml:2: time.duration: ", "steps of", "time.safety")
        self.refused("impact", self.SCENE.replace("20 mm", "5 mm"), "case.toml:8: particle.position: ", "wall 1")
        self.refused("impact", self.SCENE.replace("-1 m/s", "0 m/s"), "case.toml:10: particle.velocity: nothing moves")
        self.refused("impact", self.SCENE + "[materials.steel]\nyoung_modulus = 1\npoisson_ratio = 0\n", "materials.steel", "leave it out")


class Files(Case):
    def named(self):
        line = [one for one in self.said.splitlines() if one.startswith("files: ")][-1]
        return re.split(", | to ", line.removeprefix("files: "))

    def test_only_what_was_written(self):
        case = test('platen_speed = "0.4 m/s"\nstop_strain = 0.001')
        for frames in (0, 1):
            self.go("ucs", case, "--set", f"output.frames={frames}")
            names = self.named()
            for name in names:
                self.assertTrue((self.work / name).exists(), name)
            self.assertEqual(any("results.h5" in name for name in names), frames > 0)
            self.assertEqual(any(".pvd" in name for name in names), frames > 0)
            self.assertTrue(any("cracks-0.csv" in name for name in names))

    def test_of_packing_and_impact(self):
        self.said = run("pack", self.write("pack.toml", PACK), "--out", self.out).stdout
        self.assertEqual([name.rsplit("/", 1)[1] for name in self.named()], ["case.toml", "specimen.csv"])
        self.said = run("impact", self.write("scene.toml", Impact.SCENE), "--out", self.out, "--force").stdout
        for name in self.named():
            self.assertTrue((self.work / name).exists(), name)


if __name__ == "__main__":
    main()
