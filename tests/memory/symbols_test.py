#!/usr/bin/env python3
"""The runtime's archive asks nobody for memory, threads, files or exceptions: reads its undefined symbols.

    symbols_test.py NM LIBSPHERECLOUD.A
"""
import subprocess
import sys

# All that the runtime may take from outside; whatever is new here needs a reason.
ALLOWED = {
    "memcpy", "memmove", "memset", "memcmp", "strlen",  # compilers emit these by themselves
    "sqrt", "sqrtf",                                    # correctly rounded by IEEE 754
    "_GLOBAL_OFFSET_TABLE_",
}
ALLOWED_PREFIXES = ("hwy::",)  # picks the instruction set


def main():
    nm, archive = sys.argv[1:]
    lines = subprocess.run([nm, "-C", archive], check=True, capture_output=True, text=True).stdout.splitlines()
    undefined, defined = set(), set()
    for line in lines:
        fields = line.split(None, 2)
        if len(fields) == 2 and fields[0] == "U":
            undefined.add(fields[1])
        elif len(fields) >= 2 and fields[0] == "U":
            undefined.add(" ".join(fields[1:]))
        elif len(fields) == 3:
            defined.add(fields[2])
    outside = sorted(undefined - defined)
    foreign = [name for name in outside if name not in ALLOWED and not name.startswith(ALLOWED_PREFIXES)]
    print("taken from outside:", ", ".join(outside))
    if not outside or not defined:
        sys.exit("nothing was read from %s" % archive)
    if foreign:
        sys.exit("not allowed: " + ", ".join(foreign))


main()
