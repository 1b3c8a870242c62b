"""What the checks of the docs need of a Markdown page: its headings, links, code blocks and code spans."""
import re
from pathlib import Path

FENCE = re.compile(r"^(\s*)```(.*)$")
INDENTED = re.compile(r"^ {4}\S")
LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")
SPAN = re.compile(r"`([^`]+)`")


class Block:
    """A code block: its language line, its text, its first line, and the comment `<!-- before: ... -->` above it."""

    def __init__(self, info, line, before):
        self.info, self.line, self.before, self.text = info, line, before, ""


class Page:
    """A page, read once.  `prose` has the lines outside code blocks; in it, code blocks are empty lines."""

    def __init__(self, path):
        self.path = Path(path)
        self.lines = self.path.read_text(encoding="utf-8").split("\n")
        self.prose, self.blocks = [], []
        self._read()

    def _read(self):
        block, before, comment = None, "", None
        for number, line in enumerate(self.lines, 1):
            fence = FENCE.match(line)
            if block is not None:
                if fence and not fence.group(2).strip():
                    block = None
                else:
                    block.text += line + "\n"
                self.prose.append("")
                continue
            if comment is not None or line.startswith("<!--"):
                comment = (comment or "") + line + "\n"
                if "-->" in line:
                    before, comment = self._context(comment), None
                self.prose.append("")
                continue
            if fence:
                block = Block(fence.group(2).strip(), number, before)
                self.blocks.append(block)
                before = ""
                self.prose.append("")
                continue
            if INDENTED.match(line) and (number == 1 or not self.lines[number - 2].strip() or self._indented(number - 1)):
                if not self._indented(number - 1):
                    self.blocks.append(Block("", number, ""))
                self.blocks[-1].text += line[4:] + "\n"
                self.prose.append("")
                continue
            if line.strip():
                before = ""
            self.prose.append(line)

    def _indented(self, number):
        """Whether line `number` was taken for an indented code block."""
        return number >= 1 and self.prose[number - 1] == "" and bool(INDENTED.match(self.lines[number - 1]))

    @staticmethod
    def _context(comment):
        inner = comment.replace("<!--", "", 1).split("-->")[0].strip()
        return inner[len("before:"):].strip() if inner.startswith("before:") else ""

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
            words = LINK.sub(lambda match: match.group(0)[1:].split("](")[0], line.lstrip("#").strip())
            name = re.sub(r"[^\w\- ]", "", words.replace("`", "").lower()).replace(" ", "-")
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
