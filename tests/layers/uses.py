#!/usr/bin/env python3
"""Checks that every file of sdk/ and drivers/ includes, itself or by what it includes, the headers whose names it uses.

    uses.py ROOT [TABLE]     prints each fault as FILE:LINE: what; exit code 1 when there is one

Builds that compile several sources as one hide an include that is missing, and the build of a user fails.  Asked are the
types, constants and functions that headers declare outside of types, wherever another file uses them by their bare name.
A header that the file may not include (layers.txt), or of a namespace that it does not see, is not meant.
"""
import collections
import functools
import os
import pathlib
import re
import sys

import layers

TREES = "sdk", "drivers"
SUFFIXES = ".h", ".hpp", ".cpp"
TO_LEAVE_OUT = re.compile(r'^[ ]*#[ ]*include[^\n]*|//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'', re.M | re.S)
NAMESPACE = re.compile(r"^namespace ([\w:]+)", re.M)
OF_TYPE = re.compile(r"^(?:struct|class|union|enum(?: class)?)\s+(?:alignas\(\w+\)\s+)?(\w+)|^using (\w+) =|^\} (\w+);|^typedef [^{]* (\w+);", re.M)
OF_CONSTANT = re.compile(r"^(?:inline |static )*constexpr [^;({]*?\b(k[A-Z]\w*)\b", re.M)
OF_FUNCTION = re.compile(r"^(?!return|else|using|static_assert|#)\w[\w:<>,*& ]*[ *&](\w+)\(", re.M)
# What a file itself calls so: a member, a variable, a parameter, a type inside of another, an enumerator.
OF_ANYTHING = re.compile(r"[\w>\])](?<!return)(?<!else)(?<!throw)(?<!case)[ *&]+(\w+)(?=[({;,=)\[]| =| :)"
                         r"|(?:struct|class|typename|using|define) (?:alignas\(\w+\) )?(\w+)|, (\w+) =", re.M)
OF_ENUM = re.compile(r"^ *enum [^{;]*\{([^}]*)\}", re.M)
USED = re.compile(r"(?<![\w.:>])(?:(?:sphc|host|tuning)::)*([A-Za-z]\w*)\b(\(?)")
WORDS = {"alignas", "__attribute__"}


def without_comments(text):
    """The text without comments, includes and what is quoted, of as many lines."""
    return TO_LEAVE_OUT.sub(lambda found: "\n" * found.group().count("\n"), text)


def names(patterns, text):
    found = {name for pattern in patterns for match in pattern.finditer(text) for name in match.groups() if name}
    return frozenset(found - WORDS)


class File:
    def __init__(self, root, name):
        text = (root / name).read_text()
        included = [layers.INCLUDE.match(line) for line in text.splitlines()]
        targets = [layers.resolve(str(root), name, found.group(1) or found.group(2)) for found in included if found]
        self.included = {target for target in targets if target}
        self.text = without_comments(text)
        self.namespaces = NAMESPACE.findall(self.text)
        self.declared = names((OF_TYPE, OF_CONSTANT, OF_FUNCTION), self.text)
        enumerators = " ".join(OF_ENUM.findall(self.text))
        self.known = self.declared | names((OF_ANYTHING,), self.text) | frozenset(re.findall(r"\w+", enumerators))

    def sees(self, other):
        return not other.namespaces or any((own + "::").startswith(theirs + "::") for own in self.namespaces for theirs in other.namespaces)


class Tree:
    def __init__(self, root, table):
        self.rows = layers.read_table(table)
        paths = [path for tree in TREES for path in sorted((root / tree).rglob("*")) if path.suffix in SUFFIXES]
        self.files = {name: File(root, name) for name in (path.relative_to(root).as_posix() for path in paths)}
        self.headers = collections.defaultdict(list)  # of each name, those that declare it
        for name, file in self.files.items():
            for declared in file.declared if not name.endswith(".cpp") else ():
                self.headers[declared].append(name)

    def all_included(self, name):
        seen, left = {name}, [name]
        while left:
            for target in (self.files[left.pop()].included & self.files.keys()) - seen:
                seen.add(target)
                left.append(target)
        return seen

    @functools.lru_cache(maxsize=None)
    def may_include(self, folder, other):
        row = layers.find_row(self.rows, folder)
        return row and row.permits(other, row.match(folder))

    def meant(self, name, used):
        return [header for header in self.headers.get(used, ()) if self.files[name].sees(self.files[header])
                and self.may_include(os.path.dirname(name), os.path.dirname(header))]

    def faults_of(self, name):
        known = set().union(*(self.files[other].known for other in self.all_included(name)))
        for number, line in enumerate(self.files[name].text.splitlines(), 1):
            for used, call in USED.findall(line):
                if used in known or (used[0].islower() and not call and not used.startswith("k")):
                    continue
                known.add(used)
                if self.meant(name, used):
                    yield "%s:%d: %s is declared in %s, which is not included" % (
                        name, number, used, " and ".join(self.meant(name, used)))

    def faults(self):
        return [fault for name in self.files for fault in self.faults_of(name)]


def main(arguments):
    root = pathlib.Path(arguments[0])
    table = arguments[1] if len(arguments) > 1 else pathlib.Path(__file__).with_name("layers.txt")
    tree = Tree(root, table)
    faults = tree.faults()
    for fault in faults:
        print(fault)
    print("%d files, %d faults" % (len(tree.files), len(faults)))
    return 1 if faults or not tree.files else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
