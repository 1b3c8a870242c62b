#!/usr/bin/env python3
"""How a program or a shared library was hardened, by what readelf says: docs/hardening.md.

    check_hardening.py READELF FILE PROPERTY...     fails where a property is missing

    relro       tables that are filled at the start are read-only afterwards
    now         all of them are filled at the start
    stack       the stack cannot be executed
    pie         a program that lies anywhere
    protector   functions with arrays watch their stack
    fortify     copies of the C library that know the size of their target
"""
import re
import subprocess
import sys


def said(readelf, *arguments):
    return subprocess.run([readelf, "--wide", *arguments], text=True, capture_output=True, check=True).stdout


def properties(readelf, path):
    segments, dynamic, symbols = (said(readelf, word, path) for word in ("--program-headers", "--dynamic", "--dyn-syms"))
    stack = re.search(r"GNU_STACK.* (\S+)\s+0x\S+$", segments, re.MULTILINE)
    return {
        "relro": "GNU_RELRO" in segments,
        "now": bool(re.search(r"\((FLAGS|BIND_NOW)\).*BIND_NOW|\(FLAGS_1\).*\bNOW\b", dynamic)),
        "stack": bool(stack) and "E" not in stack.group(1),
        "pie": bool(re.search(r"\(FLAGS_1\).*\bPIE\b", dynamic)),
        "protector": "__stack_chk_fail" in symbols,
        "fortify": bool(re.search(r"\b__\w+_chk\b", symbols.replace("__stack_chk_fail", ""))),
    }


def main():
    readelf, path, *wanted = sys.argv[1:]
    found = properties(readelf, path)
    unknown = [name for name in wanted if name not in found]
    if unknown or not wanted:
        sys.exit(f"no such property: {unknown}\n{__doc__}")
    print(", ".join(f"{name} {'yes' if has else 'no'}" for name, has in found.items()))
    missing = [name for name in wanted if not found[name]]
    if missing:
        sys.exit(f"{path} was built without: {', '.join(missing)}; toolchains/SphcModule.cmake has the flags")


if __name__ == "__main__":
    main()
