#!/usr/bin/env python3
"""The linker script of the shared library: what it exports, each function with the node of the release that brought it.

    write_exports.py [--check] [--sdk FOLDER] [--kept FOLDER]     writes sdk/runtime/exports.map, or compares it with the headers

While SPHC_ABI is 0, all of spherecloud.h is in one node.  From 1 on a function is in the node of the first header in
tests/abi/headers that has it, or else of today's version.  What spherecloud_capture.h has is in a node of this version alone.
"""
import argparse
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
NODE = "{name} {{\n  global:\n{symbols}{rest}}}{before};\n"
ABOUT = """/* What the shared library exports, and since when (docs/abi.md).  Made of the headers by toolchains/write_exports.py: build
 * the target abi_results. */
"""


class Header:
    def __init__(self, path):
        self.path = path
        text = re.sub(r"/\*.*?\*/", "", path.read_text(encoding="utf-8"), flags=re.S).replace("\\\n", " ")
        self.functions = set(re.findall(r"^SPHC_API [^;(]*?(sphc_\w+)\(", text, flags=re.M))
        numbers = dict(re.findall(r"#define SPHC_(VERSION_MAJOR|VERSION_MINOR|VERSION_PATCH|ABI)\s+(\d+)", text))
        self.abi = int(numbers.get("ABI", -1))
        self.version = tuple(int(numbers.get("VERSION_" + part, 0)) for part in ("MAJOR", "MINOR", "PATCH"))

    def node(self):
        return "SPHERECLOUD_%d.%d" % self.version[:2] if self.abi else "SPHERECLOUD_0"


def nodes_of(sdk, kept):
    """[(node, its functions)] in the order of the releases, and the unstable one behind them."""
    today = Header(sdk / "include" / "spherecloud" / "spherecloud.h")
    if today.abi != today.version[0]:
        sys.exit(f"SPHC_ABI is {today.abi} in version %d.%d.%d: it must be the major version" % today.version)
    older = [Header(path) for path in kept.glob("*/spherecloud/spherecloud.h")]
    older = sorted((h for h in older if h.abi == today.abi), key=lambda h: h.version)
    nodes, placed = {}, set()
    for header in older + [today]:
        gone = sorted(header.functions - today.functions)
        if gone:
            sys.exit(f"{header.path} has {', '.join(gone)}: an export is never removed")
        nodes.setdefault(header.node(), set()).update(header.functions - placed)
        placed |= header.functions
    capture = Header(sdk / "include" / "spherecloud" / "spherecloud_capture.h")
    return [(name, names) for name, names in nodes.items() if names] + [
        ("SPHERECLOUD_UNSTABLE_%d.%d" % today.version[:2], capture.functions)]


def script(nodes):
    text, before = ABOUT, ""
    for i, (name, names) in enumerate(nodes):
        unstable = "UNSTABLE" in name
        text += "\n" + NODE.format(name=name, symbols="".join(f"    {n};\n" for n in sorted(names)),
                                   rest="" if i else "  local:\n    *;\n", before="" if unstable else before)
        before = " " + name
    return text


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--sdk", type=pathlib.Path, default=ROOT / "sdk")
    parser.add_argument("--kept", type=pathlib.Path, default=ROOT / "tests" / "abi" / "headers")
    options = parser.parse_args()
    out = options.sdk / "runtime" / "exports.map"
    now = script(nodes_of(options.sdk, options.kept))
    if not options.check:
        out.write_text(now, encoding="utf-8")
    elif out.read_text(encoding="utf-8") != now:
        sys.exit(f"{out.name} is not that of the headers: build the target abi_results, look at the difference and commit it")


if __name__ == "__main__":
    main()
