#!/usr/bin/env python3
"""Compares the binary interface of spherecloud.h with the committed one, by libabigail, for 64 and 32 bits.

    compare_abi.py CC [--write]     CC: a C compiler for x86-64; --write makes x86-64.abi and i686.abi anew, which from
                                    SPHC_ABI 1 on only additions may

The header is all there is of types, so they are read from a library of empty functions that is made of the header and of
exports.map; a release has no debug information.  Additions pass and are told, all else is a break.
"""
import pathlib
import re
import subprocess
import sys
import tempfile
from xml.etree import ElementTree

HERE = pathlib.Path(__file__).resolve().parent
SDK = HERE.parent.parent / "sdk"
MACHINES = {"x86-64": "-m64", "i686": "-m32"}
OFFSET = "layout-offset-in-bits"
SAME, ADDITION, BREAK = "same", "addition", "break"
# Nothing of a machine's paths or compiler; names of types that do not change when another one is added.
ABIDW = ["abidw", "--no-corpus-path", "--no-comp-dir-path", "--no-show-locs", "--no-elf-needed", "--no-write-default-sizes",
         "--type-id-style", "hash"]


def header_text(include):
    text = (include / "spherecloud" / "spherecloud.h").read_text(encoding="utf-8")
    return re.sub(r"/\*.*?\*/", "", text, flags=re.S)


def empty_functions(include):
    declared = re.findall(r"^SPHC_API ([^;]*);", header_text(include), flags=re.M)
    return "#include <spherecloud/spherecloud.h>\n" + "".join(f"{d} {{ __builtin_trap(); }}\n" for d in declared)


def growing(include):
    return re.findall(r"typedef struct (\w+) \{\s*uint32_t struct_size;", header_text(include)) + ["sphc_localizer_observation", "sphc_localizer_hypothesis"]


def abi_of(include):
    return int(re.search(r"#define SPHC_ABI[\s\\]*(\d+)u", header_text(include)).group(1))


def build(cc, machine, include, exports, library):
    subprocess.run([cc, "-x", "c", "-std=c99", "-g", "-O0", "-fPIC", "-fvisibility=hidden", "-ffreestanding", "-fno-stack-protector",
                    "-shared", "-nostdlib", MACHINES[machine], f"-I{include}", "-", "-o", str(library),
                    f"-Wl,--version-script={exports},-soname,libspherecloud.so.{abi_of(include)},--build-id=none"],
                   input=empty_functions(include), text=True, check=True)


def baseline(library):
    return subprocess.run(ABIDW + [str(library)], check=True, capture_output=True, text=True).stdout


def without_growth(now, before, grows):
    """`now` as `before` had it where structs grew by the rules: without fields behind its last one, and with its reserved ones.
    libabigail has suppressions for fields at the end, which also pass what else changed in the same struct."""
    now = ElementTree.fromstring(now)
    older = {struct.get("name"): struct for struct in ElementTree.fromstring(before).iter("class-decl")}
    for struct in now.iter("class-decl"):
        was = older.get(struct.get("name"))
        if struct.get("name") not in grows or was is None or not was.get("size-in-bits"):
            continue  # nor is a size there where a type is declared alone
        reserved = {field.get(OFFSET): field for field in was if field[0].get("name").startswith("reserved")}
        for i, field in reversed(list(enumerate(struct))):
            if int(field.get(OFFSET)) >= int(was.get("size-in-bits")):
                struct.remove(field)
            elif field.get(OFFSET) in reserved:
                struct[i] = reserved[field.get(OFFSET)]
        struct.set("size-in-bits", was.get("size-in-bits"))
    return ElementTree.tostring(now, encoding="unicode")


def differs(before, now, *options):
    with tempfile.TemporaryDirectory() as folder:
        paths = [pathlib.Path(folder) / name for name in ("before.abi", "now.abi")]
        for path, text in zip(paths, (before, now)):
            path.write_text(text, encoding="utf-8")
        told = subprocess.run(["abidiff", "--no-default-suppression", "--no-show-locs", "--harmless", *options, *paths],
                              capture_output=True, text=True)
    if told.returncode & 3:
        sys.exit(f"abidiff failed: {told.stderr}{told.stdout}")
    return told.stdout if told.returncode else ""


def compare(before, now, grows):
    """(SAME, ADDITION or BREAK, what libabigail says of it)."""
    broken = differs(before, without_growth(now, before, grows), "--no-added-syms")
    if broken:
        return BREAK, broken
    added = differs(before, now)
    return (ADDITION, added) if added else (SAME, "")


def renewed(before, now, grows):
    """The baseline to keep from now on: what breaks a frozen one takes another ABI number."""
    abi = re.search(r"soname='(libspherecloud.so.[1-9]\d*)'", before)
    if abi and abi.group(0) in now:
        verdict, report = compare(before, now, grows)
        if verdict == BREAK:
            sys.exit(f"the baseline of {abi.group(1)} is frozen, and this breaks programs:\n{report}")
    return now


def main():
    cc, write, broken, grows = sys.argv[1], "--write" in sys.argv, False, growing(SDK / "include")
    with tempfile.TemporaryDirectory() as folder:
        for machine in MACHINES:
            kept, library = HERE / f"{machine}.abi", pathlib.Path(folder) / f"{machine}.so"
            build(cc, machine, SDK / "include", SDK / "runtime" / "exports.map", library)
            before, now = kept.read_text(encoding="utf-8"), baseline(library)
            if write:
                kept.write_text(renewed(before, now, grows), encoding="utf-8")
                continue
            verdict, report = compare(before, now, grows)
            print(f"{machine}: {verdict}\n{report}")
            broken |= verdict == BREAK
    if broken:
        sys.exit("the binary interface is broken: read docs/abi.md")


if __name__ == "__main__":
    main()
