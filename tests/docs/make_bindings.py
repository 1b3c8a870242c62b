#!/usr/bin/env python3
"""Writes the table of languages and boards into README.md, between two lines that mark its place.

    make_bindings.py ROOT            writes the table
    make_bindings.py ROOT --check    compares it with the one that is there

Lines of code are counted in the first program of each language.  What a frame costs beside C is bindings/overhead.csv, which
`ninja overhead_results` measures; bytes are there too, and for boards in tests/portability/size.csv (`ninja size_results`).
"""
import csv
import re
import sys
from pathlib import Path

BEGIN = "<!-- Made by tests/docs/make_bindings.py: run `ninja bindings_table`. -->\n"
END = "<!-- The end of what is made. -->\n"
HEAD = """
| language or board | command to the first pose | lines of code | a frame beside C | bytes |
| --- | --- | --- | --- | --- |
"""
C_PROGRAM = "examples/firmware_c/main.c"
# Language, the name that scripts and the ledger know it by, its first program.
LANGUAGES = (("C", "c", C_PROGRAM),
             ("Python", "python", "bindings/python/examples/first_pose.py"),
             ("Rust", "rust", "bindings/rust/spherecloud/examples/first_pose.rs"),
             ("Java, Kotlin", "java", "bindings/java/examples/FirstPose.java"),
             ("C#, Unity", "csharp", "bindings/csharp/Samples~/FirstPose/FirstPose.cs"))
COMMENTS = {"py": re.compile(r'^""".*?"""$|^ *#[^\n]*$', re.MULTILINE | re.DOTALL),
            "others": re.compile(r"/\*.*?\*/|^ *//[^\n]*$", re.MULTILINE | re.DOTALL)}


def lines_of_code(path):
    """Lines that are neither empty nor a comment alone."""
    comments = COMMENTS["py" if path.suffix == ".py" else "others"]
    return sum(bool(line.strip()) for line in comments.sub("", path.read_text(encoding="utf-8")).split("\n"))


def read(path, key):
    with open(path, encoding="utf-8", newline="") as stream:
        return {row[key]: row for row in csv.DictReader(stream)}


def beside_c(row):
    """The median of the repeats, and their quartiles, in percent."""
    middle, low, high = (f"{round(100 * float(row[name]) - 100, 1) + 0:+.1f}" for name in ("ratio", "ratio_low", "ratio_high"))
    return f"{middle} % ({low} to {high})"


def table(root):
    overhead = read(root / "bindings" / "overhead.csv", "language")
    missing = [key for _, key, _ in LANGUAGES if key not in overhead]
    if missing:
        raise ValueError(f"bindings/overhead.csv has no row of {', '.join(missing)}; run `ninja overhead_results`")
    rows = [(name, f"`bindings/first_pose.sh {key}`", lines_of_code(root / program), beside_c(overhead[key]), overhead[key]["package_bytes"])
            for name, key, program in LANGUAGES]
    boards = read(root / "tests" / "portability" / "size.csv", "variant")
    rows += [(row["machine"], f"`tests/portability/variants.sh {variant}`", lines_of_code(root / C_PROGRAM), "it is C", row["text_bytes"])
             for variant, row in boards.items()]
    return HEAD + "".join("| " + " | ".join(map(str, row)) + " |\n" for row in rows) + "\n"


def page(root):
    """The README with the table in it."""
    text = (root / "README.md").read_text(encoding="utf-8")
    if text.count(BEGIN) != 1 or text.count(END) != 1 or text.index(BEGIN) > text.index(END):
        raise ValueError(f"README.md has no place for the table: it wants these two lines, once each:\n{BEGIN}{END}")
    return text[:text.index(BEGIN) + len(BEGIN)] + table(root) + text[text.index(END):]


def main(words):
    if len(words) not in (1, 2) or words[1:] not in ([], ["--check"]):
        print(__doc__)
        return 2
    root = Path(words[0])
    try:
        made = page(root)
    except ValueError as error:
        print(error)
        return 1
    if words[1:] == []:
        (root / "README.md").write_text(made, encoding="utf-8")
    elif made != (root / "README.md").read_text(encoding="utf-8"):
        print("README.md: the table of languages and boards is not that of the files; run `ninja bindings_table`")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
