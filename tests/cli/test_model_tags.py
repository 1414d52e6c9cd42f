#!/usr/bin/python3
"""The specification and the code, held against each other by the tags of their equations: (P46), (S4.31), (B12)."""
import re
import unittest

from programs import SOURCE, main

MODEL = SOURCE / "docs" / "model.md"
CODE = ("kernels", "core", "io", "drivers", "tests/reference")  # where each tag of the specification must be found

TAG = re.compile(r"\(([PSB]\d+(?:\.\d+)?)\)")
DEFINITION = re.compile(r"^(?:- )?\*\*\(([PSB]\d+(?:\.\d+)?)\)\*\*", re.MULTILINE)
SECTION = re.compile(r'docs/model\.md, ((?:(?:, | and )?"[^"]+")+)')
WRAPPED = re.compile(r"\n *//+<? ")  # a comment that goes on in the next line


def sources(*folders):
    return {str(path.relative_to(SOURCE)): path.read_text() for folder in folders for path in sorted((SOURCE / folder).rglob("*"))
            if path.suffix in (".hpp", ".cpp")}


def problems(document, code, citing=None):
    """What does not agree, a line each.

    @param code, citing  texts by their paths: those that must use each tag, and others that may
    """
    defined = DEFINITION.findall(document)
    used = {}
    for path, text in (code | (citing or {})).items():
        for tag in TAG.findall(text):
            used.setdefault(tag, path)
    in_code = {tag for text in code.values() for tag in TAG.findall(text)}
    found = [f"{path}: ({tag}) is not defined in docs/model.md" for tag, path in used.items() if tag not in defined]
    found += [f"docs/model.md: ({tag}) is cited and not defined" for tag in sorted(set(TAG.findall(document)) - set(defined))]
    found += [f"docs/model.md: ({tag}) is defined {defined.count(tag)} times" for tag in sorted(set(defined)) if defined.count(tag) > 1]
    found += [f"docs/model.md: no line of {', '.join(CODE)} has ({tag})" for tag in sorted(set(defined) - in_code)]
    return found


def unknown_sections(document, texts):
    headings = set(re.findall(r"^#+ (.+)$", document, re.MULTILINE))
    cited = [(path, name) for path, text in texts.items() for group in SECTION.findall(WRAPPED.sub(" ", text))
             for name in re.findall('"([^"]+)"', group)]
    return [f'{path}: docs/model.md has no section "{name}"' for path, name in cited if name not in headings], cited


class ModelTags(unittest.TestCase):
    def setUp(self):
        self.document = MODEL.read_text()
        self.code = sources(*CODE)
        self.citing = sources("tests")
        for path in sorted((SOURCE / "docs").rglob("*.md")):
            if path != MODEL:
                self.citing[str(path.relative_to(SOURCE))] = path.read_text()

    def test_code_and_specification_agree(self):
        found = problems(self.document, self.code, self.citing)
        self.assertFalse(found, "\n".join(found))
        self.assertGreater(len(DEFINITION.findall(self.document)), 100)

    def test_sections_that_are_cited_exist(self):
        found, cited = unknown_sections(self.document, self.code | self.citing)
        self.assertFalse(found, "\n".join(found))
        self.assertGreater(len(cited), 20)

    def test_a_tag_that_goes_missing_is_found(self):
        for tag in DEFINITION.findall(self.document):
            without = {path: text.replace(f"({tag})", "") for path, text in self.code.items()}
            self.assertIn(f"docs/model.md: no line of {', '.join(CODE)} has ({tag})", problems(self.document, without))
            unmarked = self.document.replace(f"**({tag})**", "")
            self.assertTrue(any(f"({tag}) is not defined" in line for line in problems(unmarked, self.code)), tag)

    def test_a_tag_defined_twice_is_found(self):
        tag = DEFINITION.findall(self.document)[0]
        self.assertIn(f"docs/model.md: ({tag}) is defined 2 times",
                      problems(f"{self.document}\n- **({tag})** once more\n", self.code))

    def test_no_paper_outside_the_project_is_cited(self):
        names = re.compile(r"\b(MODEL|DESIGN)\b(?!\s*=)")
        found = [f"{path}: {names.search(text)[0]}" for path, text in (self.code | sources("tests")).items()
                 if names.search(text)]
        self.assertFalse(found, "\n".join(found))


if __name__ == "__main__":
    main()
