#!/usr/bin/env python3
"""A section of docs/install.md, done as it says, with an installation that was made before.

    follow_page.py ROOT SECTION --folder FOLDER --prefix PREFIX --libdir LIBDIR --version VERSION [--static] [--cmake ARGUMENTS]

A block whose first line is a comment with the name of a file is that file; those of "Two programs" are there in every section.
Blocks of `sh` are run, in FOLDER, which is emptied before.  Each line that a program of the page prints must be the one that the page shows, with VERSION in it.
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "docs"))
from markdown import Page  # noqa: E402

FILE = re.compile(r"(?:/\*|//|#) ([\w.]+)(?: \*/)?\n")
HEADING = re.compile(r"###? ")
PROGRAMS = "Two programs"
ENVIRONMENT = dict(os.environ, CMAKE_GENERATOR="Ninja")
POSES = 6  # of the examples: as many as the section records


def section(page, title):
    """The blocks under a heading, up to the next one."""
    lines = [number for number, line in enumerate(page.lines, 1) if HEADING.match(line)] + [len(page.lines)]
    for begin, end in zip(lines, lines[1:]):
        if HEADING.sub("", page.lines[begin - 1]) == title:
            return [block for block in page.blocks if begin < block.line < end]
    sys.exit(f"{page.path} has no section \"{title}\"")


def here(text, options):
    """What a page shows, with our folders in place of its own."""
    places = (("/opt/spherecloud/lib", f"{options.prefix}/{options.libdir}"), ("/opt/spherecloud", str(options.prefix)),
              ("/src/spherecloud", str(options.root)), ("cmake -S . -B build", f"cmake -S . -B build {options.cmake}"))
    for shown, ours in places:
        text = text.replace(shown, ours)
    return text


def write_files(blocks, folder, options):
    for block in blocks:
        named = FILE.match(block.text)
        if named and block.info != "sh":
            (folder / named[1]).write_text(here(block.text, options), encoding="utf-8")


def run(script, folder, environment):
    done = subprocess.run(["bash", "-e", "-c", script], cwd=folder, env=environment, text=True, capture_output=True, check=False)
    if done.returncode:
        sys.exit(f"failed with {done.returncode}:\n{script}\n{done.stdout}{done.stderr}")
    return done.stdout


def follow_blocks(blocks, folder, options):
    """Writes the files that blocks are and runs those of `sh`; what these print."""
    write_files(blocks, folder, options)
    return "".join(run(here(block.text, options), folder, ENVIRONMENT) for block in blocks if block.info == "sh")


def libraries_of(program):
    return subprocess.run(["ldd", program], text=True, capture_output=True, check=True).stdout


def follow(options, folder):
    page = Page(options.root / "docs" / "install.md")
    programs = section(page, PROGRAMS)
    answer = next(block.text for block in programs if block.info == "text").strip()
    if not re.fullmatch(rf"spherecloud {re.escape(options.version)}(-rc\d+)?, ABI {options.version.split('.')[0]}", answer):
        sys.exit(f"the page shows \"{answer}\", and this is version {options.version}")

    blocks = section(page, options.section)
    write_files(programs, folder, options)
    printed = follow_blocks(blocks, folder, options)
    print(printed)

    if options.section.startswith("The examples"):
        poses = re.findall(r"^\d+ at ", printed, re.MULTILINE)
        runs = sum("room.sphc walk" in line for block in blocks for line in block.text.splitlines())
        if len(poses) != POSES * runs:
            sys.exit(f"{len(poses)} poses instead of {POSES * runs}")
        return
    answers = [line for line in printed.splitlines() if line.startswith("spherecloud ")]
    if answers != [answer] * 2:
        sys.exit(f"the programs say {answers} instead of \"{answer}\" each")
    for program in [path for path in folder.rglob("answer_c*") if path.name in ("answer_c", "answer_cpp") and path.is_file()]:
        if options.static == ("libspherecloud.so" in libraries_of(program)):
            sys.exit(f"{program.name} was to link the {'static' if options.static else 'shared'} library:\n{libraries_of(program)}")


def options_of(doc):
    """What the command line says; the folder is there, and empty."""
    parser = argparse.ArgumentParser(description=doc, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("root", type=Path)
    parser.add_argument("section")
    parser.add_argument("--folder", type=Path, required=True)
    parser.add_argument("--prefix", type=Path, required=True)
    parser.add_argument("--libdir", required=True)
    parser.add_argument("--version", required=True)
    parser.add_argument("--static", action="store_true", help="programs need no shared library of ours")
    parser.add_argument("--cmake", default="", help="more arguments for the page's cmake")
    options = parser.parse_args()
    shutil.rmtree(options.folder, ignore_errors=True)
    options.folder.mkdir(parents=True)
    return options


if __name__ == "__main__":
    chosen = options_of(__doc__)
    follow(chosen, chosen.folder)
