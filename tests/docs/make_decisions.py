#!/usr/bin/env python3
"""Writes docs/decisions/README.md, the index of the decisions, from the heads of their files.

    make_decisions.py ROOT            writes the index
    make_decisions.py ROOT --check    compares it with the one that is there, and the heads with their form:

        # NNNN: title

        Date: YYYY-MM-DD. Status: accepted.
"""
import re
import sys
from pathlib import Path

INTRO = """# Decisions

<!-- Made by tests/docs/make_decisions.py: run `ninja decisions_page`. -->

What was decided that is hard to change, and why. A decision that no longer holds is not rewritten: its status names the one that replaces
it.

| number | title | status | date |
| --- | --- | --- | --- |
"""
UNUSED = {number: "(the number was not used)" for number in ("0023", "0034", "0069")}


def head(path):
    """(title, status, date) of a decision; an error names what its head lacks."""
    lines = [line for line in path.read_text(encoding="utf-8").split("\n") if line] + [""] * 2
    title = re.fullmatch(rf"# {path.name[:4]}: (.+)", lines[0])
    if not title:
        raise ValueError(f"{path.name}:1: not `# {path.name[:4]}: title`")
    dated = re.match(r"Date: (\d{4}-\d{2}-\d{2})\. Status: ([^.]+)\.", lines[1])
    if not dated:
        raise ValueError(f"{path.name}: its second line is not `Date: YYYY-MM-DD. Status: ...`")
    return title[1], dated[2], dated[1]


def index(folder):
    rows = {number: f"| {number} | {words} | | |" for number, words in UNUSED.items()}
    for path in folder.glob("[0-9]*.md"):
        title, status, date = head(path)
        number = path.name[:4]
        if number in rows:
            raise ValueError(f"{path.name}: the number {number} is taken")
        rows[number] = f"| [{number}]({path.name}) | {title} | {status} | {date} |"
    return INTRO + "\n".join(rows[number] for number in sorted(rows)) + "\n"


def main():
    folder = Path(sys.argv[1]) / "docs" / "decisions"
    path = folder / "README.md"
    try:
        text = index(folder)
    except ValueError as error:
        print(error)
        return 1
    if "--check" not in sys.argv[2:]:
        path.write_text(text, encoding="utf-8")
        return 0
    if path.exists() and path.read_text(encoding="utf-8") == text:
        print("docs/decisions/README.md lists every decision")
        return 0
    print("docs/decisions/README.md is stale: run `ninja decisions_page` and commit it")
    return 1


if __name__ == "__main__":
    sys.exit(main())
