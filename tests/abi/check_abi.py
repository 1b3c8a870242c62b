#!/usr/bin/env python3
"""Compares the ABI with its results.

    check_abi.py layout PRINT_LAYOUT [--write]       struct layouts with layout.csv (64-bit machines)
    check_abi.py symbols LIBRARY NM [--write]        exported names of the shared library with symbols.txt
    check_abi.py headers FOLDER                      every struct, field and function of the headers is in the results
"""
import os
import re
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
LAYOUT, SYMBOLS = os.path.join(HERE, "layout.csv"), os.path.join(HERE, "symbols.txt")


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def compare(path, now):
    if "--write" in sys.argv:
        with open(path, "w", encoding="utf-8") as stream:
            stream.write(now)
        return
    with open(path, encoding="utf-8") as stream:
        pinned = stream.read()
    gone = sorted(set(pinned.splitlines()) - set(now.splitlines()))
    new = sorted(set(now.splitlines()) - set(pinned.splitlines()))
    for line in gone:
        print("- " + line)
    for line in new:
        print("+ " + line)
    if pinned != now:
        sys.exit(f"the ABI differs from {os.path.basename(path)}: read docs/abi.md, then build the target abi_results")


def exported(library, nm):
    lines = run(nm, "-D", "--defined-only", library).splitlines()
    names = [line.split()[-1].split("@")[0] for line in lines if line.split()[-2] in "TDBRWVi"]
    return "".join(name + "\n" for name in sorted(set(names)))


def check_headers(folder):
    text = ""
    for name in ("spherecloud.h", "spherecloud_capture.h"):
        with open(os.path.join(folder, name), encoding="utf-8") as stream:
            text += re.sub(r"/\*.*?\*/", "", stream.read(), flags=re.S)
    functions = set(re.findall(r"^SPHC_API [^;(]*?(sphc_\w+)\(", text, flags=re.M))
    with open(SYMBOLS, encoding="utf-8") as stream:
        symbols = set(stream.read().split())
    structs = {m.group(2): m.group(1) for m in re.finditer(r"typedef struct \w+ \{(.*?)\} (\w+);", text, re.S)}
    with open(LAYOUT, encoding="utf-8") as stream:
        rows = [line.split(",") for line in stream.read().split()[1:]]
    faults = sorted(functions ^ symbols) + sorted(set(structs) ^ {row[0] for row in rows})
    for name, body in structs.items():
        declared = re.sub(r"\([^()*]*\)\s*;", ";", body.replace("(*", " ").replace(")(", " ("))
        fields = {row[1] for row in rows if row[0] == name and row[1]}
        faults += [f"{name}.{f}" for f in fields if not re.search(rf"\b{f}\b", declared)]
        wanted = sum(d.count(",") * (0 if "(" in d else 1) + 1 for d in body.split(";") if d.strip())
        if wanted != len(fields):
            faults.append(f"{name} has {wanted} fields, layout.csv {len(fields)}")
    if faults:
        sys.exit("the headers and the results disagree about: " + ", ".join(faults))


def main():
    what = sys.argv[1]
    if what == "layout":
        compare(LAYOUT, run(sys.argv[2]))
    elif what == "symbols":
        compare(SYMBOLS, exported(sys.argv[2], sys.argv[3]))
    elif what == "headers":
        check_headers(sys.argv[2])
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
