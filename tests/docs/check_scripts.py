#!/usr/bin/env python3
"""Every subcommand and option that the scripts of tests/pipeline give to our commands exists.

    check_scripts.py ROOT COMMAND COMMAND

The commands are the built `spherecloud` and `spherecloud-lab`.  Most scripts make a ledger in hours, so no test runs
them, and what they call may have gone since they ran.
"""
import ast
import re
import sys
from pathlib import Path

from commands import help_texts, options_of
from markdown import report

OPTION = re.compile(r"--[a-z0-9]+(-[a-z0-9]+)*$")
TOOLS = {"tool", "lab", "spherecloud"}  # names of what a call begins with: `tool`, `arguments.lab`


def named_tool(node):
    return getattr(node, "id", getattr(node, "attr", "")) in TOOLS


def words_of(nodes):
    """The strings among the elements, those of lists that are unpacked there too."""
    for node in nodes:
        if isinstance(node, ast.Starred):
            yield from words_of(getattr(node.value, "elts", []))
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            yield node.lineno, node.value


def call_faults(nodes, known):
    """What is wrong with one list that begins with a command and its subcommand."""
    (line, sub), *words = words_of(nodes[1:])
    if sub not in known:
        return {line: f"no command has the subcommand {sub}"}
    return {line: f"{sub} has no option {word}"
            for line, word in words if OPTION.match(word) and word not in known[sub]}


def own_options(tree):
    """What the script itself takes."""
    calls = (node for node in ast.walk(tree) if isinstance(node, ast.Call))
    return {word for call in calls if getattr(call.func, "attr", "") == "add_argument"
            for _, word in words_of(call.args)}


def script_faults(text, known):
    """What is wrong, by its line: subcommands that are not `known`, which has options by subcommand, and options."""
    tree = ast.parse(text)
    nodes = [*ast.walk(tree)]
    everywhere = set().union(*known.values()) | own_options(tree)
    faults = {line: f"no command has the option {word}" for line, word in words_of(nodes)
              if OPTION.match(word) and word not in everywhere}
    for node in nodes:
        if isinstance(node, ast.List) and node.elts and named_tool(node.elts[0]) and [*words_of(node.elts[1:2])]:
            faults |= call_faults(node.elts, known)
    return faults


def known_options(commands):
    """Options of each subcommand; those of one that both commands have, together."""
    known = {}
    for command in commands:
        for words, text in help_texts(command).items():
            known.setdefault(words.split()[-1], set()).update(options_of(text))
    return known


def all_faults(root, commands):
    root, known = Path(root).resolve(), known_options(commands)
    return [f"{path.relative_to(root)}:{line}: {words}"
            for path in sorted((root / "tests" / "pipeline").glob("*.py"))
            for line, words in sorted(script_faults(path.read_text(encoding="utf-8"), known).items())]


if __name__ == "__main__":
    sys.exit(report(all_faults(sys.argv[1], sys.argv[2:])))
