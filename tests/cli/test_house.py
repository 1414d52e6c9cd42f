#!/usr/bin/python3
"""The house: folders are rooms of one concept, includes run one way, the code is formatted."""
import collections
import re
import shutil
import subprocess
import unittest
from pathlib import Path

from programs import SOURCE, main

FLOORS = ["kernels", "core", "io", "drivers"]  # lowest first
MOST_FILES = 25  # of a room
WIDEST_COMMENT = 100


def sources(*folders):
    return [path.relative_to(SOURCE) for folder in folders for path in sorted((SOURCE / folder).rglob("*.?pp"))]


def includes(path):
    return [Path(name) for name in re.findall(r'^#include "([^"]+)"', (SOURCE / path).read_text(), re.MULTILINE)]


def circles(arrows):
    """Groups of more than one that reach each other (Tarjan)."""
    index, low, stack, found = {}, {}, [], []

    def visit(node):
        index[node] = low[node] = len(index)
        stack.append(node)
        for other in sorted(arrows[node]):
            if other not in index:
                visit(other)
            if other in stack:
                low[node] = min(low[node], low[other])
        if low[node] == index[node]:
            group = stack[stack.index(node):]
            del stack[stack.index(node):]
            if len(group) > 1:
                found.append(group)

    for node in sorted(arrows):
        if node not in index:
            visit(node)
    return found


class House(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.files = sources(*FLOORS)
        assert len(cls.files) > 200, "where is the source?"
        cls.arrows = [(path, to) for path in cls.files for to in includes(path)]

    def test_every_include_exists(self):
        self.assertEqual([(str(a), str(b)) for a, b in self.arrows if not (SOURCE / b).is_file()], [])

    def test_rooms_are_small(self):
        rooms = collections.Counter(path.parent for path in self.files)
        self.assertEqual({str(room): n for room, n in rooms.items() if n > MOST_FILES}, {})
        flat = [str(path) for path in self.files if len(path.parts) == 2 and path.parts[0] != "drivers"]
        self.assertEqual(flat, [], "a file of kernels, core or io lies in a room")

    def test_no_include_runs_up_the_house(self):
        up = [(str(a), str(b)) for a, b in self.arrows if FLOORS.index(a.parts[0]) < FLOORS.index(b.parts[0])]
        self.assertEqual(up, [])

    def test_no_circle_between_rooms(self):
        arrows = collections.defaultdict(set)
        for a, b in self.arrows:
            if a.parent != b.parent:
                arrows[str(a.parent)].add(str(b.parent))
                arrows[str(b.parent)]
        self.assertEqual(circles(arrows), [])

    def test_no_circle_between_files(self):
        arrows = collections.defaultdict(set)
        for a, b in self.arrows:
            arrows[str(a)].add(str(b))
            arrows[str(b)]
        self.assertEqual(circles(arrows), [])

    def test_a_circle_would_be_seen(self):
        self.assertEqual(circles({"a": {"b"}, "b": {"c"}, "c": {"a"}, "d": {"a"}}), [["a", "b", "c"]])
        self.assertEqual(circles({"a": {"b", "c"}, "b": {"c"}, "c": set()}), [])

    def test_studies_are_not_linked_into_every_program(self):
        into = [(str(a), str(b)) for a, b in self.arrows
                if "studies" in b.parts and "studies" not in a.parts and len(a.parts) > 2]
        self.assertEqual(into, [])

    def test_no_code_asks_for_the_name_of_a_test(self):
        # what differs between tests is a fact in their table, so that a new one is a new row
        table = (SOURCE / "core/loading/laboratory_tests.hpp").read_text()
        names = re.findall(r'\.name = "(\w+)"', table)
        self.assertGreater(len(names), 7)
        word = re.compile("== *\"(" + "|".join(names) + ")\"|\"(" + "|".join(names) + ")\" *==")
        asks = [f"{path}:{number}" for path in sources("core", "io", "drivers/programs")
                for number, line in enumerate((SOURCE / path).read_text().splitlines(), 1) if word.search(line)]
        self.assertEqual(asks, [])

    def test_a_type_has_one_definition(self):
        # the linker does not notice two of a name (one-definition rule): only what lies in a source
        # file's own namespace may share one
        homes = collections.defaultdict(set)
        for path in sources(*FLOORS):
            text = (SOURCE / path).read_text()
            space = (re.findall(r"^namespace ([\w:]+) \{", text, re.MULTILINE) or [""])[-1]
            own = "namespace {" in text
            for name in re.findall(r"^(?:template <[^\n]*>\n)?(?:struct|class|enum class|enum) (?:alignas\([^)]*\)+ )?(\w+)[^;\n]*\{", text, re.MULTILINE):
                if path.suffix == ".hpp" or not own:
                    homes[f"{space}::{name}"].add(str(path))
        self.assertGreater(len(homes), 100)
        self.assertEqual({name: where for name, where in homes.items() if len(where) > 1}, {})

    @unittest.skipUnless(shutil.which("clang-format"), "clang-format is not installed")
    def test_format(self):
        files = sources(*FLOORS, "tests")
        done = subprocess.run(["clang-format", "--dry-run", "-Werror", *files], cwd=SOURCE, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr[:2000])

    def test_comments_are_no_wider_than_a_page(self):
        wide = [f"{path}:{number}" for path in sources(*FLOORS)
                for number, line in enumerate((SOURCE / path).read_text().splitlines(), 1)
                if line.lstrip().startswith("//") and len(line) > WIDEST_COMMENT]
        self.assertEqual(wide, [])


if __name__ == "__main__":
    main()
