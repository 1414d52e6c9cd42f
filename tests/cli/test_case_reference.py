#!/usr/bin/python3
"""docs/case-reference.md is what the declarations of the keys say, --help names the same keys and defaults."""
import difflib
import re
import subprocess
import unittest

from programs import BIN, SOURCE, main, run

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
                for of, value in re.findall(r"; (?:law|accuracy) ([\w-]+) `([^`]+)`", rows[key][0]):
                    self.assertIn(f"; {of}: {value}", line, f"{test}: {key}")

    def test_defaults_that_differ(self):
        def line(test, key):
            return next(line for line in run(test, "--help").stdout.splitlines() if line.startswith(f"  {key} "))

        self.assertIn(" minimum; kdem: polyhedron ", line("ucs", "area"))
        self.assertIn(" 0.26; 2-D: 0.11 ", line("ucs", "porosity"))
        self.assertNotIn("0.11", line("triaxial", "porosity"))  # has three dimensions
        self.assertRegex(line("biaxial", "porosity"), r" 0\.11 ")
        self.assertRegex(line("biaxial", "shape"), r'"box" +box ')
        self.assertIn(" 0.1 m/s; reference: 0.05 m/s ", line("ucs", "platen_speed"))
        self.assertRegex(line("ucs", "hardening_rate"), r" 16 ")


if __name__ == "__main__":
    main()
