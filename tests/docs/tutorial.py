#!/usr/bin/env python3
"""docs/tutorial.md, done as it says: its program is compiled by its line and run after its commands, and must print what
the page shows.

    tutorial.py ROOT --build BUILD --cc CC

What the page builds comes from BUILD.  The map's key is a given one, so that every run is the same.
"""
import argparse
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "pipeline"))
from private_key import private_key  # noqa: E402
from check_commands import logical_lines  # noqa: E402
from markdown import Page  # noqa: E402

POSE = re.compile(r"frame (\d+) at (\S+) (\S+) (\S+) m")
TOLERANCE_M = 0.05  # the simulated images may differ in a bit between C libraries


def blocks(page):
    """The program, and (command, what the page says it prints) in order."""
    program, commands = None, []
    for block in page.blocks:
        if block.info == "c":
            program = block.text
        elif block.info == "sh":
            commands += [[line, ""] for line in logical_lines(block.text) if line.strip()]
        elif block.info == "text":
            commands[-1][1] = block.text
    return program, commands


def differs(printed, shown):
    """Why a run's lines are not those of the page; empty: they are.  Positions count; sizes and confidences do not."""
    if len(printed) != len(shown):
        return f"{len(printed)} lines instead of {len(shown)}"
    for ours, wanted in zip(printed, shown):
        mine, its = POSE.match(ours), POSE.match(wanted)
        if bool(mine) != bool(its) or ours.split()[:2] != wanted.split()[:2] and not wanted.startswith("state"):
            return f"\"{ours}\" instead of \"{wanted}\""
        if mine and max(abs(float(a) - float(b)) for a, b in zip(mine.groups()[1:], its.groups()[1:])) > TOLERANCE_M:
            return f"\"{ours}\" is not within {TOLERANCE_M} m of \"{wanted}\""
    return ""


def run(command, folder):
    done = subprocess.run(command, shell=True, cwd=folder, text=True, capture_output=True, check=False)
    if done.returncode:
        sys.exit(f"failed with {done.returncode}: {command}\n{done.stdout}{done.stderr}")
    return done.stdout


def follow(root, build, compiler, folder):
    program, commands = blocks(Page(root / "docs" / "tutorial.md"))
    for name in ("sdk", "drivers"):
        (folder / name).symlink_to(root / name)
    (folder / "build").mkdir()
    (folder / "build" / "tutorial").symlink_to(build)
    (folder / "first_pose.c").write_text(program, encoding="utf-8")
    compared = 0
    for command, shown in commands:
        if command.startswith(("toolchains/", "cmake ")):
            continue  # BUILD has them
        if " build --model" in command:
            command += f" --key {private_key(folder)}"
        printed = run(re.sub(r"^cc ", f"{compiler} -Werror ", command), folder)
        print(command, printed, sep="\n")
        if shown:
            why = differs(printed.splitlines(), shown.splitlines())
            if why:
                sys.exit(f"{command}: {why}")
            compared += 1
    return compared


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("root", type=Path)
    parser.add_argument("--build", type=Path, required=True)
    parser.add_argument("--cc", default="cc")
    options = parser.parse_args()
    os.umask(0o077)
    with tempfile.TemporaryDirectory() as place:
        count = follow(options.root.resolve(), options.build.resolve(), options.cc, Path(place))
    sys.exit(0 if count == 2 else f"{count} outputs compared instead of 2")
