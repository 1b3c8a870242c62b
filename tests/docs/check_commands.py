#!/usr/bin/env python3
"""Every command, option and CMake target that the docs name exists.

    check_commands.py ROOT [COMMAND...]

COMMAND is a built `spherecloud` or `spherecloud-lab`; without one, its lines are not checked.  Targets are looked for in
the CMake files, since some are there only on machines that have what they measure.
"""
import re
import sys
from pathlib import Path

from commands import help_texts, options_of
from markdown import pages, report

CALL = re.compile(r"(?:^|[\s/])(spherecloud(?:-lab)?) +(?!-)([a-z]\S*)(.*)$")
BUILD_TOOL = re.compile(r"\s*(cmake|ninja)\b")
OPTION = re.compile(r"--[a-z][a-z0-9-]*$")
# Options of other programs that pages speak of by themselves.
OTHERS = {"--wrap"}
TARGETS = re.compile(r"(?:\bninja(?: -C \S+)?|--target)((?: [a-z]\w+)+)")


def logical_lines(text):
    """Lines of a shell block; one that ends with a backslash goes on in the next."""
    return re.sub(r"\\\n\s*", " ", text).split("\n")


def named_calls(page):
    """(line, text) wherever a page shows a command: lines of shell blocks, and code spans that begin with one."""
    for block in page.blocks:
        if not block.info or block.info in ("sh", "bash", "console"):
            for line in logical_lines(block.text):
                yield block.line, line
    for line, text in page.spans():
        if text.startswith(("spherecloud", "ninja ", "cmake ")):
            yield line, text


def call_faults(text, helps):
    """What is wrong with the calls of our commands in one line of text."""
    match = None if BUILD_TOOL.match(text) else CALL.search(text)
    if not match or match.group(1) not in helps:
        return []
    name, sub, rest = match.groups()
    known = helps[name]
    if f"{name} {sub}" not in known:
        return [f"{name} has no subcommand {sub}"]
    options = options_of(known[f"{name} {sub}"])
    used = re.findall(r"(?<!\S)(--[A-Za-z][\w-]*|-[A-Za-z])(?=[\s=]|$)", re.sub(r"  +[^-\s].*$", "", rest))
    return [f"{name} {sub} has no option {option}" for option in used if option not in options]


def bare_option_faults(page, helps):
    """Options that a page names by themselves, such as `--map`: one of our commands must have each."""
    known = OTHERS.union(*(options_of(text) for texts in helps.values() for text in texts.values()))
    return [(line, f"no command has the option {words[0]}")
            for line, words in ((line, re.split(r"[ =]", text)) for line, text in page.spans())
            if OPTION.match(words[0]) and words[0] not in known]


def targets_of(root):
    """Names of all targets that some CMake file may make."""
    made = re.compile(r"(?:add_custom_target|add_executable|add_library|sphc_module)\(\s*(\w+)")
    folders = ("sdk", "drivers", "examples", "tests", "bindings")
    modules = [*(root / "toolchains").glob("*.cmake"), *(root / "tests" / "bindings").glob("*.cmake")]
    files = [path for folder in folders for path in (root / folder).rglob("CMakeLists.txt")] + modules
    texts = [path.read_text(encoding="utf-8") for path in files]
    labels = {f"tests_{label}" for text in texts for label in re.findall(r"sphc_label\(\s*(\w+)", text)}
    return labels.union(*(made.findall(text) for text in texts))


def all_faults(root, commands):
    root, faults = Path(root).resolve(), []
    targets = targets_of(root)
    helps = {Path(command).name: help_texts(command) for command in commands}
    for page in pages(root):
        where = page.path.relative_to(root)
        if where.name == "CHANGELOG.md" or where.parent.name == "decisions":  # they also speak of what was
            continue
        for line, text in named_calls(page):
            faults += [f"{where}:{line}: {words}" for words in call_faults(text, helps)]
            faults += [f"{where}:{line}: the build has no target {name}"
                       for names in TARGETS.findall(text) for name in names.split() if name not in targets]
        if len(helps) == 2:  # with one command alone, the other's options are not known
            faults += [f"{where}:{line}: {words}" for line, words in bare_option_faults(page, helps)]
    return faults


if __name__ == "__main__":
    sys.exit(report(all_faults(sys.argv[1], sys.argv[2:])))
