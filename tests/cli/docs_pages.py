"""The pages of the documentation, read: their code blocks, the programs that these call, headings and links."""
import re
import shlex
from dataclasses import dataclass, field
from pathlib import Path

from programs import SOURCE

SKIP = re.compile(r"# not run in the tests: *(.*)")
ADDS = re.compile(r"<!-- test adds: (.*?) -->")
FILE = re.compile(r"# ([\w./-]+\.toml)$")


@dataclass
class Block:
    """A fenced block of a page."""
    kind: str
    place: str
    adds: str = ""                                ## arguments that the test gives to each program
    lines: list = field(default_factory=list)

    @property
    def text(self):
        return "\n".join(self.lines) + "\n"

    @property
    def skipped(self):
        """Why it is not run; nothing where it is."""
        match = SKIP.match(self.lines[0]) if self.lines else None
        return match[1] if match else None

    @property
    def file(self):
        """Where a case is written; nothing where its first line names none."""
        match = FILE.match(self.lines[0]) if self.lines else None
        return match[1] if match else None

    def command(self):
        """The text with what the test adds, right behind the name of each program."""
        return re.sub(r"^(build/bin/breccia-\w+)", lambda m: f"{m[1]} {self.adds}", self.text, flags=re.M)


def pages(with_data=False):
    """README.md, CONTRIBUTING.md, CHANGELOG.md and docs/; also the pages of data/."""
    found = [SOURCE / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")]
    found += sorted((SOURCE / "docs").rglob("*.md"))
    return found + sorted((SOURCE / "data").rglob("*.md")) if with_data else found


def blocks(page):
    found, adds, inside = [], "", None
    for number, line in enumerate(page.read_text().splitlines(), 1):
        if inside is None and line.startswith("```"):
            inside = Block(line[3:].strip(), f"{page.relative_to(SOURCE)}:{number}", adds)
        elif inside is not None and line.startswith("```"):
            found.append(inside)
            inside, adds = None, ""
        elif inside is not None:
            inside.lines.append(line)
        elif match := ADDS.match(line):
            adds = match[1]
    assert inside is None, f"{inside.place}: the block has no end"
    return found


def programs_of(block):
    """(program, words) of each breccia program that a block of commands calls, comments left out."""
    if block.kind != "sh":
        return
    text = block.text.replace("\\\n", " ")
    for line in text.splitlines():
        words = shlex.split(line, comments=True)
        for k, word in enumerate(words):
            if match := re.fullmatch(r"(?:.*/)?breccia-(\w+)", word):
                yield match[1], words[k + 1:] + shlex.split(block.adds)


def prose(page):
    """Numbered lines outside of code blocks."""
    inside = False
    for number, line in enumerate(page.read_text().splitlines(), 1):
        if line.startswith("```"):
            inside = not inside
        elif not inside:
            yield number, line


def code_words(page):
    """(line, text) of each piece of `code` in the sentences and tables."""
    for number, line in prose(page):
        for text in re.findall(r"`([^`]+)`", line):
            yield number, text


def links(page):
    """(line, target) of each link and picture."""
    for number, line in prose(page):
        for target in re.findall(r"\]\(([^)\s]+)\)|src=\"([^\"]+)\"", re.sub(r"`[^`]*`", "", line)):
            yield number, target[0] or target[1]


def headings(page):
    """Anchors of a page, made of its headings as the usual viewers make them."""
    anchors = set()
    for _, line in prose(page):
        if match := re.match(r"#+ (.*)", line):
            text = re.sub(r"[^\w\- ]", "", re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", match[1]).lower())
            anchors.add(text.strip().replace(" ", "-"))
    return anchors
