#!/usr/bin/python3
"""docs/case-reference.md is what the declarations of the keys say, --help names the same keys and defaults."""
import difflib
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

from programs import BIN, SOURCE, run

TESTS = "ucs triaxial bts usc hydrostatic tension shear biaxial".split()


class CaseReference(unittest.TestCase):
    def test_is_current(self):
        made = subprocess.run([SOURCE / "scripts" / "case-reference", "--bin", BIN, "--out", "-"], capture_output=True, text=True)
        self.assertEqual((made.returncode, made.stderr), (0, ""))
        committed = (SOURCE / "docs" / "case-reference.md").read_text()
        if made.stdout != committed:
            lines = difflib.unified_diff(committed.splitlines(), made.stdout.splitlines(), "committed", "made now", lineterm="", n=0)
            self.fail("docs/case-reference.md is not what the programs say: run scripts/case-reference\n" + "\n".join(lines))

    def test_help_has_the_same_keys_and_every_default(self):
        rows = {}
        table = ""
        for line in run("ucs", "--keys-markdown").stdout.splitlines():
            if line.startswith("### "):
                table = line.strip("# `[]")
            if match := re.match(r"\| `(\w+)` \| .* \| (.*?) \| (.*?) \| .* \|$", line):
                rows[f"{table}.{match[1]}"] = match[2], match[3]
        self.assertIn("specimen.pack.sizes.kind", rows)
        for test in TESTS:
            text, table, found = run(test, "--help").stdout, "", {}
            for line in text.splitlines():
                if line.startswith("["):
                    table = line.strip("[]")
                if match := re.match(r"  (\w+)  +", line):
                    found[f"{table}.{match[1]}"] = line
            found = {key: line for key, line in found.items() if key in rows}
            taken = {key for key, (_, programs) in rows.items()
                     if key.startswith("material.") or programs.startswith("all tests") or test in programs.replace(",", "").split()
                     and not programs.startswith("all but") or programs.startswith("all but")
                     and test not in programs.replace(",", "").split()}
            self.assertEqual(set(found), taken, test)
            for key, line in found.items():
                for value in re.findall(r"; (?:law|accuracy) [\w-]+ `([^`]+)`", rows[key][0]):
                    self.assertIn(value, line, f"{test}: {key}")

    def test_defaults_that_differ(self):
        def line(test, key):
            return next(line for line in run(test, "--help").stdout.splitlines() if line.startswith(f"  {key} "))

        self.assertIn("law kdem polyhedron", line("ucs", "area"))
        self.assertIn("in 2-D 0.11", line("ucs", "porosity"))
        self.assertNotIn("2-D 0.11", line("triaxial", "porosity"))  # has three dimensions
        self.assertRegex(line("biaxial", "porosity"), r" 0\.11 ")
        self.assertRegex(line("biaxial", "shape"), r'"box" +box ')
        self.assertIn("accuracy reference 0.05 m/s", line("ucs", "platen_speed"))
        self.assertRegex(line("ucs", "hardening_rate"), r" 16 ")

    def test_explain_names_defaults_that_are_not_the_usual_ones(self):
        """Of a law, of its own keys, of a recipe, in two dimensions; none where all are the usual ones."""
        with tempfile.TemporaryDirectory() as folder:
            case = Path(folder) / "c.toml"

            def unusual(test, specimen, *sets):
                case.write_text(f'[specimen]\ndiameter = "50 mm"\n{specimen}\n[material]\npreset = "concrete"\n')
                ended = run(test, case, "--explain", *(word for one in sets for word in ("--set", one)))
                self.assertEqual((ended.returncode, ended.stderr), (0, ""))
                parts = ended.stdout.split("defaults that are not the usual ones\n")
                return [line.strip() for line in parts[1].split("\n\n")[0].splitlines()] if len(parts) > 1 else []

            solid = 'height = "100 mm"\npack.spheres = 200'
            self.assertEqual(unusual("ucs", solid), [])
            self.assertEqual(unusual("ucs", solid, "material.law=kdem", "bonds.alpha=1.2"),
                             ["material.normal_factor = 1 (law kdem)", "material.shear_factor = 1 (law kdem)",
                              'bonds.area = "polyhedron" (law kdem)'])
            self.assertEqual(unusual("ucs", solid, "time.accuracy=reference"),
                             ["time.safety = 0.4 (accuracy reference)", 'test.platen_speed = "0.05 m/s" (accuracy reference)'])
            self.assertEqual(unusual("biaxial", solid), ['specimen.shape = "box" (in 2-D)', "specimen.pack.porosity = 0.11 (in 2-D)"])


if __name__ == "__main__":
    unittest.main()
