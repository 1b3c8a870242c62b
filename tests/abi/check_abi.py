#!/usr/bin/env python3
"""Compares the ABI with its results.

    check_abi.py layout PRINT_LAYOUT [--write]       struct layouts with layout.csv (64-bit machines)
    check_abi.py symbols LIBRARY NM READELF          what the shared library exports, and its name, with exports.map
    check_abi.py headers FOLDER                      every struct and field of the headers is in the results
"""
import os
import re
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
LAYOUT = os.path.join(HERE, "layout.csv")
EXPORTS = os.path.join(HERE, "..", "..", "sdk", "runtime", "exports.map")


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


def wanted_exports():
    with open(EXPORTS, encoding="utf-8") as stream:
        nodes = re.findall(r"^(SPHERECLOUD_\S+) \{(.*?)^\}", stream.read(), flags=re.M | re.S)
    return {f"{name}@@{node}" for node, body in nodes for name in re.findall(r"^    (sphc_\w+);", body, flags=re.M)}


def check_symbols(library, nm, readelf):
    lines = [line.split() for line in run(nm, "-D", "--defined-only", library).splitlines()]
    exported, wanted = {words[-1] for words in lines if words[-2] in "TDBRWVi"}, wanted_exports()
    faults = [f"{name} is not exported" for name in sorted(wanted - exported)]
    faults += [f"{name} is exported and not in exports.map" for name in sorted(exported - wanted)]
    abi = {re.match(r"SPHERECLOUD_(\d+)", name.split("@@")[1]).group(1) for name in wanted if "UNSTABLE" not in name}
    names = re.findall(r"SONAME.*\[(.*)\]", run(readelf, "-d", library))
    if names != [f"libspherecloud.so.{number}" for number in abi]:
        faults.append(f"the library is called {names}, its nodes are of ABI {', '.join(sorted(abi))}")
    if faults:
        sys.exit("\n".join(faults))


def check_headers(folder):
    text = ""
    for name in ("spherecloud.h", "spherecloud_capture.h"):
        with open(os.path.join(folder, name), encoding="utf-8") as stream:
            text += re.sub(r"/\*.*?\*/", "", stream.read(), flags=re.S)
    structs = {m.group(2): m.group(1) for m in re.finditer(r"typedef struct \w+ \{(.*?)\} (\w+);", text, re.S)}
    with open(LAYOUT, encoding="utf-8") as stream:
        rows = [line.split(",") for line in stream.read().split()[1:]]
    faults = sorted(set(structs) ^ {row[0] for row in rows})
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
        check_symbols(*sys.argv[2:5])
    elif what == "headers":
        check_headers(sys.argv[2])
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
