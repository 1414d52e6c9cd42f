#!/usr/bin/python3
"""Every example of README.md, CONTRIBUTING.md and docs/ is run, or, where it says why it cannot be, has its options and keys
checked; every relative link of the documentation points at a file and heading that are there. How a page marks its
examples: CONTRIBUTING.md."""
import re
import shlex
import shutil
import subprocess
import tempfile
import tomllib
import unittest
from functools import cache
from pathlib import Path

from docs_pages import blocks, code_words, headings, links, pages, programs_of
from programs import BIN, HANG, SOURCE, main, run

CASE_OF_ITS_OWN = {"impact"}
OTHER_OPTIONS = {"--allow-run-as-root", "--oversubscribe", "--bind-to", "--map-by", "--interleave"}  # of mpirun and numactl


@cache
def options_of(program):
    """The options that a program takes."""
    return set(re.findall(r"(?<![\w-])--[a-z-]+", run(program, "--help").stdout)) | {"--keys-markdown"}


@cache
def keys_of(program):
    """The keys of a case, with their tables: "test.platens"; of an impact "particle.position"."""
    table, found = "", set()
    for line in run("impact" if program in CASE_OF_ITS_OWN else "ucs", "--keys-markdown").stdout.splitlines():
        if line.startswith("### "):
            table = line.strip("# `[]").replace(".NAME]", "").strip("]")
        if match := re.match(r"\| `(\w+)` \|", line):
            found.add(f"{table}.{match[1]}")
    return found | {"material.at.confinement", "material.group.group"}


def flat(tree, prefix=""):
    """The full names of the keys of a case; elements of an array of tables count as their table."""
    for word, value in tree.items():
        name = prefix + word
        if isinstance(value, dict):
            yield from flat(value, name + ".")
        elif isinstance(value, list) and value and isinstance(value[0], dict):
            for one in value:
                yield from flat(one, name + ".")
        else:
            yield name


class Examples(unittest.TestCase):
    def test_there_are_some(self):
        """The pages are found, and so are their examples: a test of none would pass."""
        names = {page.name for page in pages()}
        self.assertLessEqual({"README.md", "tutorial.md", "running.md", "tests.md", "materials.md"}, names)
        kinds = [block.kind for page in pages() for block in blocks(page)]
        self.assertGreater(kinds.count("toml"), 4)
        self.assertGreater(kinds.count("sh"), 20)

    def test_every_block_says_what_it_is(self):
        for page in pages():
            for block in blocks(page):
                with self.subTest(block.place):
                    self.assertIn(block.kind, {"", "sh", "toml", "python"}, "toml, sh, python, or nothing for what is no example")
                    if block.kind == "":
                        self.assertNotIn("breccia-", block.text, "an example of a program is marked sh")
                    if block.skipped is not None:
                        self.assertGreater(len(block.skipped), 5, "# not run in the tests: and why")

    def test_options_and_keys_are_known(self):
        for page in pages():
            for block in blocks(page):
                for program, words in programs_of(block):
                    with self.subTest(block.place, program=program):
                        self.assertTrue((BIN / f"breccia-{program}").exists(), f"no program breccia-{program}")
                        self.check_words(program, words)
                if block.kind == "toml":
                    with self.subTest(block.place):
                        self.check_case(block.text)

    def check_words(self, program, words):
        for k, word in enumerate(words):
            if word.startswith("--"):
                self.assertTrue(word.split("=")[0] in options_of(program), f"no option {word}")
            if word == "--set":
                key = words[k + 1].split("=")[0]
                key = re.sub(r"^(particle|wall)\.\d+|^materials\.\w+", lambda m: m[1] or "materials", key)
                self.assertTrue(key in keys_of(program), f"no key {key}")

    def check_case(self, text):
        tree = tomllib.loads(text)
        if "source" in tree:  # a preset has the keys of the material at top level
            tree = {"material": {word: value for word, value in tree.items() if word != "source"}}
        program = "impact" if {"particle", "spheres", "wall"} & set(tree) else "ucs"
        for name in flat(tree):
            name = re.sub(r"^material\.(at\.(?!confinement)|group\.(?!group))", "material.", name)
            name = re.sub(r"^materials\.\w+", "materials", name)
            self.assertTrue(name in keys_of(program), f"no key {name}")

    def test_they_run(self):
        for page in pages():
            with self.subTest(page.name):
                self.run_page(page)

    def run_page(self, page):
        """All blocks of a page, in a folder with build/bin, data and scripts as they stand in the project's."""
        work = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, work)
        (work / "build").mkdir()
        (work / "build" / "bin").symlink_to(BIN)
        for name in ("data", "scripts"):
            (work / name).symlink_to(SOURCE / name)
        for block in blocks(page):
            if block.kind == "toml" and block.file:
                path = work / block.file
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(block.text)
            elif block.kind in {"sh", "python"} and block.skipped is None:
                words = ["bash", "-euo", "pipefail", "-c", block.command()] if block.kind == "sh" else ["python3", "-c", block.text]
                ended = subprocess.run(words, cwd=work, capture_output=True, text=True, timeout=HANG)
                self.assertEqual(ended.returncode, 0, f"{block.place}: {shlex.join(words[-1:])}\n{ended.stdout}\n{ended.stderr}")


class Words(unittest.TestCase):
    """What stands in `code` within the sentences."""
    TABLES = "specimen material bonds damping test time run features output".split()
    FOLDERS = "kernels core io drivers tests scripts data docs".split()

    def words(self):
        for page in pages():
            for line, text in code_words(page):
                yield f"{page.relative_to(SOURCE)}:{line}", text

    def test_keys(self):
        """`test.platens`, `test.platens = "rough"`; `--set test.platens=rough`."""
        found = 0
        for place, text in self.words():
            for key in re.findall(rf"^(?:--set )?'?((?:{'|'.join(self.TABLES)})(?:\.\w+)+)", text):
                if key.endswith((".png", ".csv", ".toml", ".h5")):
                    continue
                found += 1
                with self.subTest(place):
                    self.assertTrue(key in keys_of("ucs") | keys_of("impact"), f"no key {key}")
        self.assertGreater(found, 60)

    def test_options(self):
        programs = [path.name.removeprefix("breccia-") for path in BIN.glob("breccia-*")]
        known = set().union(*map(options_of, programs)) | OTHER_OPTIONS
        for place, text in self.words():
            for option in re.findall(r"(?<![\w-])--[a-z][a-z-]+", text):
                with self.subTest(place):
                    self.assertTrue(option in known, f"no program has the option {option}")

    def test_files(self):
        """`core/tables`, `drivers/ucs.cpp`, `core/base/error` for a header and its source; NAME is anyone's."""
        for place, text in self.words():
            if re.fullmatch(rf"(?:{'|'.join(self.FOLDERS)})/[\w./-]+", text) and "NAME" not in text:
                path = SOURCE / text
                with self.subTest(place):
                    self.assertTrue(path.exists() or list(path.parent.glob(path.name + ".?pp")), f"no {text}")


class Links(unittest.TestCase):
    def test_relative_links(self):
        found = 0
        for page in pages(with_data=True):
            for line, target in links(page):
                if re.match(r"[a-z]+:", target):
                    continue
                found += 1
                name, _, anchor = target.partition("#")
                path = (page.parent / name).resolve() if name else page
                with self.subTest(f"{page.relative_to(SOURCE)}:{line}", target=target):
                    self.assertTrue(path.exists(), "no such file")
                    if anchor:
                        self.assertIn(anchor, headings(path), "no such heading")
        self.assertGreater(found, 50)

    def test_every_page_is_linked(self):
        """From the README, or from a page that is."""
        reached, waiting = set(), [SOURCE / "README.md"]
        while waiting:
            page = waiting.pop()
            if page in reached or page.suffix != ".md":
                continue
            reached.add(page)
            waiting += [(page.parent / target.partition("#")[0]).resolve() for _, target in links(page)
                        if not re.match(r"[a-z]+:|#", target)]
        self.assertEqual({page for page in pages(with_data=True)} - reached, set())


if __name__ == "__main__":
    main()
