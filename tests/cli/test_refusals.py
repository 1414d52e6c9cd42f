#!/usr/bin/python3
"""Wrong input, interrupts and options, through the programs as a user calls them."""
import json
import os
import signal

import h5py

from programs import UCS, ProgramTest, command, finish, main, run, tree

ROWS = "id,x_m,y_m,z_m,r_m\n1,0,0,-0.04,0.01\n2,0,0,-0.02,0.01\n3,0,0,0,0.01\n4,0,0,0.02,0.01\n5,0,0,0.04,0.01\n"


class BadInput(ProgramTest):
    """One line that names file, line and key; exit code 2; nothing written."""

    def refused(self, *words, case=UCS, program="ucs", options=()):
        path = self.write("case.toml", case)
        before = tree(self.work)
        result = run(program, path, "--out", self.out, *options)
        self.check_one_line(result, 2, f"breccia-{program}: ", *words)
        self.assertEqual(tree(self.work), before)
        self.assertFalse(self.out.exists())

    def refused_specimen(self, text, *words, name="specimen.csv"):
        self.write(name, text)
        self.refused(*words, case=UCS.replace("specimen.csv", name))

    def test_unknown_key(self):
        self.refused("case.toml:6", "material.prest", '"material.preset"', case=UCS.replace("preset", "prest"))

    def test_unknown_preset(self):
        self.refused("case.toml:6", "material.preset", '"concrete"', case=UCS.replace('"concrete"', '"concret"'))

    def test_unit_of_wrong_dimension(self):
        self.refused("case.toml:3", "specimen.diameter", "a length", case=UCS.replace("50 mm", "50 MPa"))

    def test_negative_stiffness(self):
        self.refused("case.toml:7", "material.young_modulus", "more than 0",
                     case=UCS.replace("[test]", 'young_modulus = "-28 GPa"\n[test]'))

    def test_confinement_without_confinement(self):
        self.refused("case.toml:8", "test.confinement", "triaxial", case=UCS.replace("[test]", '[test]\nconfinement = "1 MPa"'))

    def test_broken_toml(self):
        self.refused("case.toml:3", case=UCS.replace('"50 mm"', '"50 mm'))

    def test_empty_case(self):
        self.refused("case.toml", "specimen.file", "missing", case="")

    def test_missing_case(self):
        self.check_one_line(run("ucs", self.work / "absent.toml", "--out", self.out), 2, "absent.toml", "no such file")
        self.assertFalse(self.out.exists())

    def test_missing_specimen(self):
        self.refused("case.toml:2", "specimen.file", 'did you mean "specimen.csv"', case=UCS.replace("specimen.csv", "specimn.csv"))

    def test_unknown_type_of_specimen(self):
        self.refused("case.toml:2", "specimen.file", '".csv"', case=UCS.replace("specimen.csv", "specimen.xls"))

    def test_empty_specimen(self):
        self.refused_specimen("", "specimen.csv", "empty")
        self.refused_specimen(ROWS.splitlines()[0] + "\n", "specimen.csv", "no sphere")

    def test_not_a_number(self):
        self.refused_specimen(ROWS.replace("2,0,", "2,zero,"), "specimen.csv:3", "x_m", '"zero"')
        self.refused_specimen(ROWS.replace("0.02,0.01\n5", "nan,0.01\n5"), "specimen.csv:5", "z_m", '"nan"')

    def test_not_a_number_in_mdpa(self):
        self.refused_specimen("Begin Nodes\n1 0 0 0\n2 0 oops 0.02\nEnd Nodes\n", "specimen.mdpa:3", "oops", name="specimen.mdpa")

    def test_negative_radius(self):
        self.refused_specimen(ROWS.replace("0.02,0.01\n5", "0.02,-0.01\n5"), "specimen.csv:5", "radius")

    def test_same_id_twice(self):
        self.refused_specimen(ROWS.replace("\n5,", "\n4,"), "specimen.csv:6", "id 4", "line 5")

    def test_two_spheres_at_one_place(self):
        self.refused_specimen(ROWS.replace("5,0,0,0.04", "5,0,0,0.02"), "specimen.csv:6", "sphere 5", "sphere 4")

    def test_spheres_outside(self):
        self.refused("specimen.csv:", "specimen.diameter", "axis", case=UCS.replace("50 mm", "40 mm"))
        self.refused("specimen.csv:", "specimen.diameter", "axis", case=UCS.replace("[material]", 'axis = "x"\n[material]'))

    def test_no_bond(self):
        self.refused_specimen(ROWS.replace("0.01\n", "0.009\n"), "specimen.csv", "specimen.diameter", "5 pieces apart")

    def test_bad_set(self):
        self.refused("--set", "bonds.rnge", '"bonds.range"', options=["--set", "bonds.rnge=0.1"])
        self.refused("--set", "test.stop_strain", options=["--set", 'test.stop_strain="1 m"'])
        self.refused("--set", "table.key=value", options=["--set", "stop"])

    def test_triaxial(self):
        self.refused("case.toml:8", "test.confinement", program="triaxial",
                     case=UCS.replace("[test]", '[test]\nconfinement = ["0 MPa", "-1 MPa"]'))

    def test_law(self):
        kdem = UCS.replace("[test]", 'law = "kdem"\ndamage_normal = 0.2\n[test]')
        self.refused("case.toml:8", "material.damage_normal", '"kdem"', "has no damage_normal", case=kdem)
        self.refused("material.law", '"kdem"', '"coupled"', case=UCS.replace("[test]", 'law = "kdem"\ncriterion = "coupled"\n[test]'))
        cement = 'law = "parallel-bond"\n[run]\nprecision = "single"\n[test]'
        self.refused("run.precision", '"single"', '"parallel-bond"', case=UCS.replace("[test]", cement))
        glue = UCS.replace('preset = "concrete"', """density = 2500
law = "contact-bond"
friction_dynamic = 0.5
normal_stiffness = "20 GN/m"
shear_stiffness = "5 GN/m"
normal_strength = "8 kN"
bond_shear_strength = "20 kN"
[bonds]
alpha = "auto\"""")
        self.refused("case.toml:14", "bonds.alpha", '"contact-bond"', case=glue)
        self.refused("case.toml:7", "material.law", "dimensions", case=glue.replace('[bonds]\nalpha = "auto"\n', ""))

    def test_groups(self):
        def groups(text):
            return UCS.replace("[test]", text + "\n[test]")
        group = "[[material.group]]\ngroup = 2\n"
        self.refused("case.toml:8", "material.group", "no sphere of group 2", "it has 1", case=groups(group))
        self.refused("case.toml:7", "material.group", "group is missing", case=groups("[[material.group]]\ndensity = 2000"))
        self.refused("case.toml:10", "material.group", "group 2 is given twice", case=groups(group + group))
        self.refused("case.toml:9", "material.group.law", "whole material", case=groups(group + 'law = "kdem"'))
        self.refused("case.toml:9", "material.density", case=groups(group + 'density = "2 m"'))
        self.refused("case.toml:9", "material.densty", "density", case=groups(group + "densty = 2000"))
        self.refused("case.toml:8", "material.group", "fracture_energy_normal", "no mean",
                     case=groups(group + 'fracture_energy_normal = "50 J/m^2"'))
        self.refused("case.toml:8", "material.group.group", case=groups("[[material.group]]\ngroup = 0"))
        self.refused("case.toml:7", "material.contact_law", "new_contacts",
                     case=groups('contact_law = "hertz-mindlin"\n[features]\nnew_contacts = false'))

    def test_pack(self):
        pack = '[specimen]\ndiameter = "50 mm"\nheight = "100 mm"\npack.spheres = 300\npack.porosity = 1.2\n'
        self.refused("case.toml:5", "specimen.pack.porosity", program="pack", case=pack)
        self.refused("specimen.pack", program="pack", case="\n".join(pack.splitlines()[:3]))


class Options(ProgramTest):
    def test_unknown_option(self):
        self.check_one_line(run("ucs", self.case, "--fast"), 2, "--fast", "--help")
        self.check_one_line(run("ucs"), 2, "CASE.toml")
        self.check_one_line(run("ucs", self.case, "--threads", "0"), 2, "--threads")

    def test_help(self):
        for program in ("ucs", "triaxial", "pack"):
            result = run(program, "-h")
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            for word in ("--explain", "--force", "[specimen]", "diameter", "porosity", "a length"):
                self.assertIn(word, result.stdout)
            self.assertEqual("young_modulus" in result.stdout, program != "pack")

    def test_nothing_is_written(self):
        before = tree(self.work)
        for option in ("--dry-run", "--explain"):
            result = run("ucs", self.case, option, cwd=self.work)
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertIn("300 spheres", result.stdout)
            self.assertEqual("rotation" in result.stdout, option == "--explain")
        self.assertEqual(tree(self.work), before)
        self.assertFalse((self.work / "out").exists())

    def test_quiet(self):
        result = run("ucs", self.case, "--out", self.out, "--quiet")
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))
        self.assertTrue((self.out / "summary.json").exists())

    def test_default_folder(self):
        self.assertEqual(run("pack", self.shelf / "pack.toml", cwd=self.work).returncode, 0)
        self.assertEqual(sorted(tree(self.out)), ["pack/case.toml", "pack/specimen.csv"])

    def test_precedence(self):
        case = self.write("triaxial.toml", UCS.replace("[test]", """young_modulus = "20 GPa"
friction_static = 0.8
shear_strength = "15 MPa"
[[material.at]]
confinement = "2 MPa"
friction_static = 0.7
[test]
confinement = ["0 MPa", "2 MPa"]"""))
        result = run("triaxial", case, "--out", self.out, "--set", 'material.shear_strength="14 MPa"',
                     "--set", "test.stop_strain=0.0005", "--set", "output.frames=0")
        self.assertEqual(result.returncode, 0, result.stderr)
        resolved = (self.out / "case.toml").read_text()
        base, at = resolved.split("[[material.at]]")
        for line in ('density = "2500 kg/m^3"', 'young_modulus = "20 GPa"', "friction_static = 0.8",
                     'shear_strength = "14 MPa"', "stop_strain = 0.0005"):
            self.assertIn(line + "\n", resolved)
        self.assertIn("friction_static = 0.8", base)
        self.assertIn("friction_static = 0.7", at)
        runs = json.loads((self.out / "summary.json").read_text())["runs"]
        self.assertEqual([run["confinement_Pa"] for run in runs], [0, 2e6])
        self.assertAlmostEqual(runs[0]["young_modulus_Pa"] / 20e9, 1, delta=0.05)


class Folders(ProgramTest):
    def test_results_are_replaced_only_by_force(self):
        self.assertEqual(run("ucs", self.case, "--out", self.out).returncode, 0)
        first = tree(self.out)
        self.check_one_line(run("ucs", self.case, "--out", self.out), 2, self.out, "--force")
        self.assertEqual(tree(self.out), first)

        (self.out / "notes.txt").write_text("mine")
        (self.out / "frames" / "mine.pvd").write_text("mine")
        (self.out / "frames" / "run-0" / "bonds-009.vtp").write_text("left by a longer series")
        self.assertEqual(run("ucs", self.case, "--out", self.out, "--force", "--set", "output.frames=1").returncode, 0)
        second = tree(self.out)
        self.assertEqual(second["notes.txt"], b"mine")
        self.assertEqual(second["frames/mine.pvd"], b"mine")
        gone = sorted(set(first) - set(second))
        self.assertEqual(gone, ["frames/run-0/bonds-002.vtp", "frames/run-0/particles-002.vtp"])
        self.assertNotIn("frames/run-0/bonds-009.vtp", second)

    def test_below_a_file(self):
        place = self.write("file", "") / "out"
        for program, case in (("ucs", self.case), ("pack", self.shelf / "pack.toml")):
            self.check_one_line(run(program, case, "--out", place), 4, place, "--out")
        self.check_one_line(run("ucs", self.case, "--out", self.work / "file"), 4, "is not a folder", "--out")


class Interrupts(ProgramTest):
    def test_during_a_run(self):
        """At its second frame: curve, summary and frames up to there."""
        for kind in (signal.SIGINT, signal.SIGTERM, signal.SIGUSR1):
            with self.subTest(signal=kind.name):
                self.out = self.work / kind.name
                process = self.start_and_hold("frame:2", *command("ucs", self.case, "--out", self.out))
                process.send_signal(kind)
                out, err = finish(process)
                self.assertEqual((process.returncode, err), (130, ""))
                self.assertIn("interrupted", out)
                summary = json.loads((self.out / "summary.json").read_text())
                self.assertEqual(summary["runs"][0]["stopped_by"], "interrupted")
                self.assertGreater(len((self.out / "curve-0.csv").read_text().splitlines()), 10)
                self.check_readable(self.out)
                with h5py.File(self.out / "results.h5") as file:
                    self.assertEqual([name for name in file["run-0"] if name.startswith("frame-")], ["frame-000", "frame-001"])

    def test_before_the_run(self):
        """While spheres are packed nothing is lost: the program ends there and then."""
        self.case = self.write("pack.toml", UCS.replace('file = "specimen.csv"', "pack.spheres = 300"))
        process = self.start_and_hold("packing:1", *command("ucs", self.case, "--out", self.out))
        process.send_signal(signal.SIGINT)
        out, err = finish(process)
        self.assertEqual((process.returncode, out, err), (130, "packing 300 spheres\n", ""))
        self.assertFalse(self.out.exists())

    def test_a_hold_that_cannot_be(self):
        """A test that names no point of a program must not wait for it."""
        for text in ("row", "row:1", "row:=x", "row:0=x", "row:1x=x", "rows:1=x", "row:1="):
            result = run("ucs", self.case, "--out", self.out, env=os.environ | {"BRECCIA_HOLD": text})
            self.check_one_line(result, 2, "BRECCIA_HOLD", f'"{text}"')
        self.assertFalse(self.out.exists())


if __name__ == "__main__":
    main()
