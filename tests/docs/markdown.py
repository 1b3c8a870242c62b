"""What the checks of the docs need of a Markdown page: its headings, links, code blocks and code spans."""
import re
from pathlib import Path

LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")
SPAN = re.compile(r"`([^`]+)`")


class Block:
    """A code block: its language line, its text, its first line, and the comment `<!-- before: ... -->` above it."""

    def __init__(self, info, line, before=""):
        self.info, self.line, self.before, self.text = info, line, before, ""


class Page:
    """A page, read once.  `prose` has all its lines, with empty ones for code blocks and comments."""

    def __init__(self, path):
        self.path = Path(path)
        self.lines = self.path.read_text(encoding="utf-8").split("\n")
        self.prose, self.blocks = [], []
        self._before = ""
        while len(self.prose) < len(self.lines):
            self._read_next()

    def _read_next(self):
        """Takes the next block, comment or line of prose."""
        begin = len(self.prose)
        line = self.lines[begin]
        if line.lstrip().startswith("```"):
            end = self._find(begin + 1, lambda other: other.strip() == "```")
            self._add_block(line.strip()[3:].strip(), begin, self.lines[begin + 1:end])
        elif line.startswith("<!--"):
            end = self._find(begin, lambda other: "-->" in other)
            comment = "\n".join(self.lines[begin:end + 1])[len("<!--"):].split("-->")[0].strip()
            self._before = comment[len("before:"):].strip() if comment.startswith("before:") else ""
        elif line.startswith("    ") and line.strip() and (begin == 0 or not self.lines[begin - 1].strip()):
            end = self._find(begin, lambda other: not other.startswith("    ")) - 1
            self._add_block("", begin, [other[4:] for other in self.lines[begin:end + 1]])
        else:
            self._before = "" if line.strip() else self._before
            self.prose.append(line)
            return
        self.prose += [""] * (end + 1 - begin)

    def _find(self, begin, wanted):
        """The first line from `begin` on that is wanted; the last one when none is."""
        return next((i for i in range(begin, len(self.lines)) if wanted(self.lines[i])), len(self.lines) - 1)

    def _add_block(self, info, begin, lines):
        block = Block(info, begin + 1, self._before)
        block.text = "".join(line + "\n" for line in lines)
        self.blocks.append(block)
        self._before = ""

    def links(self):
        """(line number, target) of every link."""
        for number, line in enumerate(self.prose, 1):
            for target in LINK.findall(SPAN.sub("code", line)):
                yield number, target

    def spans(self):
        """(line number, text) of every code span."""
        for number, line in enumerate(self.prose, 1):
            for text in SPAN.findall(line):
                yield number, text

    def anchors(self):
        """Names that a link may end with, as GitHub makes them of headings."""
        names = set()
        for line in self.prose:
            if not re.match(r"#+ ", line):
                continue
            words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", line.lstrip("#").strip())
            name = re.sub(r"[^\w\- ]", "", words.lower()).replace(" ", "-")
            unique, count = name, 0
            while unique in names:
                count += 1
                unique = f"{name}-{count}"
            names.add(unique)
        return names


def pages(root):
    """Every page of the project, read once."""
    root = Path(root)
    folders = [path for name in ("docs", "sdk", "drivers", "examples", "tests") for path in (root / name).rglob("*.md")]
    return [Page(path) for path in (root / "README.md", root / "CHANGELOG.md", *sorted(folders)) if path.exists()]


def report(faults):
    """Prints faults, one a line; the exit status of a check."""
    for fault in faults:
        print(fault)
    print(f"{len(faults)} faults" if faults else "no fault")
    return 1 if faults else 0
