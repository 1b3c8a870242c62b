#!/usr/bin/env python3
"""Checks that no two types of sdk/ and drivers/ have one name in one namespace.

    one_name.py ROOT     prints each name that two files define; exit code 1 when there is one

The compiler sees one file at a time and says nothing; the linker then takes one's functions for the other's.  Types in
namespaces without a name, and inside of other types, are nobody else's; other names of a type are no types.
"""
import collections
import pathlib
import re
import sys

OPENED = re.compile(r"^namespace\s*([\w:]*)\s*\{")
CLOSED = re.compile(r"^\}.*//\s*(?:anonymous )?namespace")
TYPE = re.compile(r"^(?:struct|class|union|enum(?: class)?)\s+(?:alignas\(\w+\)\s+)?(\w+)\s*(?:final\s*)?(?::[^:].*)?(?:\{.*|)$")


def types_of(text):
    """(namespace, name) of every type that the file defines for others to see."""
    inside = []
    for line in text.splitlines():
        opened = OPENED.match(line)
        if opened:
            inside.append(opened.group(1))
        elif CLOSED.match(line) and inside:
            inside.pop()
        elif inside and "" not in inside:
            found = TYPE.match(line)
            if found:
                yield "::".join(inside), found.group(1)


def faults(root):
    files = collections.defaultdict(set)
    for tree in ("sdk", "drivers"):
        for path in sorted((root / tree).rglob("*")):
            if path.suffix in (".h", ".hpp", ".cpp"):
                for name in types_of(path.read_text()):
                    files[name].add(str(path.relative_to(root)))
    for (namespace, name), where in sorted(files.items()):
        if len(where) > 1:
            yield "%s::%s: %s" % (namespace, name, ", ".join(sorted(where)))


def main(arguments):
    found = list(faults(pathlib.Path(arguments[0])))
    print("\n".join(found) if found else "every type has its own name")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
