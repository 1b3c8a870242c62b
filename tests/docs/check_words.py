#!/usr/bin/env python3
"""No private word (private_words.txt) stands in the docs or in what the built commands print as help.

    check_words.py ROOT [COMMAND...]
"""
import re
import sys
from pathlib import Path

from commands import help_texts
from markdown import pages, report


def private_words():
    """(pattern, the word to use, pattern of files where it may stand or None)"""
    rows = []
    for line in (Path(__file__).parent / "private_words.txt").read_text(encoding="utf-8").splitlines():
        if not line.strip() or line.startswith("#"):
            continue
        pattern, use, where = (field.strip() for field in line.rsplit("|", 2))
        rows.append((re.compile(pattern, re.IGNORECASE), use, re.compile(where) if where else None))
    return rows


PRIVATE_WORDS = private_words()


def faults_in(text, name):
    """Private words in a text; a word may be broken over two lines."""
    faults = []
    lines = text.split("\n")
    words = [(pattern, use) for pattern, use, where in PRIVATE_WORDS if not (where and where.search(name))]
    for number, line in enumerate(lines, 1):
        for pattern, use in words:
            following = line + " " + (lines[number].lstrip() if number < len(lines) else "")
            for match in pattern.finditer(following):
                if match.start() < len(line):
                    faults.append(f"{name}:{number}: \"{match.group(0)}\"; say: {use}")
    return faults


def all_faults(root, commands):
    root, faults = Path(root).resolve(), []
    for page in pages(root):
        faults += faults_in("\n".join(page.lines), str(page.path.relative_to(root)))
    notice = root / "NOTICE"
    if notice.exists():
        faults += faults_in(notice.read_text(encoding="utf-8"), notice.name)
    for command in commands:
        for name, text in help_texts(command).items():
            faults += faults_in(text, f"{name} --help")
    return faults


if __name__ == "__main__":
    sys.exit(report(all_faults(sys.argv[1], sys.argv[2:])))
