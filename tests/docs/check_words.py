#!/usr/bin/env python3
"""No private word (private_words.txt) stands in the docs, in what the built commands print as help, or in the comments
and string literals of the sources.  allowed_words.txt has the places where one may stand, each with its reason.

    check_words.py ROOT [COMMAND...]
"""
import re
import sys
from pathlib import Path

from commands import help_texts
from markdown import pages, report
from source_text import said, sources

HERE = Path(__file__).parent


def rows_of(path):
    """The fields of each line that is no comment; the first one may have a "|" in it."""
    for line in path.read_text(encoding="utf-8").splitlines():
        if line.strip() and not line.startswith("#"):
            yield [field.strip() for field in line.rsplit("|", 2)]


def private_words():
    """(pattern, the word to use, pattern of files where it may stand or None)"""
    return [(re.compile(pattern, re.IGNORECASE), use, re.compile(where) if where else None)
            for pattern, use, where in rows_of(HERE / "private_words.txt")]


PRIVATE_WORDS = private_words()


def faults_in(text, name):
    """Private words in a text; a word may be broken over two lines."""
    faults = []
    lines = text.split("\n")
    words = [(pattern, use) for pattern, use, where in PRIVATE_WORDS if not (where and where.search(name))]
    for number, line in enumerate(lines, 1):
        if not line or line.isspace():  # most lines of a source say nothing to people
            continue
        following = line + " " + (lines[number].lstrip() if number < len(lines) else "")
        for pattern, use in words:
            for match in pattern.finditer(following):
                if match.start() < len(line):
                    faults.append(f"{name}:{number}: \"{match.group(0)}\"; say: {use}")
    return faults


def source_faults(root, allowed):
    """Of sources.  `allowed`: (file, words that may stand there or "*", reason)."""
    faults, used = [], set()
    for name, path in sources(root):
        text = said(path)
        for fault in faults_in(text, name):
            line = " ".join(text.split("\n")[int(fault.split(":")[1]) - 1:][:2])
            reasons = {(file, words) for file, words, _ in allowed if file == name and (words == "*" or words in line)}
            used |= reasons
            faults += [] if reasons else [fault]
    needless = [(file, words) for file, words, _ in allowed if (file, words) not in used]
    return faults + [f"allowed_words.txt: {file} needs no \"{words}\"" for file, words in needless]


def all_faults(root, commands, allowed=()):
    root, faults = Path(root).resolve(), source_faults(Path(root).resolve(), allowed)
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
    sys.exit(report(all_faults(sys.argv[1], sys.argv[2:], list(rows_of(HERE / "allowed_words.txt")))))
