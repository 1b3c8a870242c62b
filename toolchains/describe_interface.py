#!/usr/bin/env python3
"""The C interface as JSON, for those who make bindings: functions, structs with their layouts, enums, comments.

    describe_interface.py [--check]     writes sdk/include/spherecloud/spherecloud.json, or compares it with the headers

Needs the package libclang (python_packages.txt).  Layouts are those of the compiler for each machine below.
"""
import argparse
import json
import os
import pathlib
import re
import sys
import tempfile

from clang.cindex import CursorKind, Index, TypeKind

HEADERS = pathlib.Path(__file__).resolve().parent.parent / "sdk" / "include" / "spherecloud"
OUT = HEADERS / "spherecloud.json"
FILES = {"spherecloud.h": "frozen from SPHC_ABI 1 on", "spherecloud_capture.h": "unstable"}
MACHINES = ["x86_64-linux-gnu", "aarch64-linux-gnu", "riscv64-linux-gnu", "i686-linux-gnu", "armv7-linux-gnueabihf"]
# What the headers take of the standard library, from what every compiler knows by itself.
STANDARD = {
    "stddef.h": "typedef __SIZE_TYPE__ size_t;\n",
    "stdint.h": "".join(f"typedef __{sign}INT{bits}_TYPE__ {sign.lower()}int{bits}_t;\n"
                        for bits in (8, 16, 32, 64) for sign in ("", "U")) + "#define UINT64_C(x) x##ull\n",
}


def parse(machine, standard, headers):
    arguments = ["-x", "c", "-std=c99", f"--target={machine}", "-nostdinc", "-DSPHC_UNSTABLE=1", "-fparse-all-comments",
                 f"-I{standard}", f"-I{headers.parent}"]
    options = 1  # PARSE_DETAILED_PROCESSING_RECORD: macros too
    whole = [headers / name for name in reversed(FILES) if (headers / name).exists()][0]
    unit = Index.create().parse(str(whole), args=arguments, options=options)
    faults = [str(d) for d in unit.diagnostics if d.severity >= 3]
    if faults:
        sys.exit("\n".join(faults))
    return unit


def header_of(cursor):
    return os.path.basename(cursor.location.file.name) if cursor.location.file else None


def lines_of(cursor):
    return pathlib.Path(cursor.location.file.name).read_text().split("\n")


def plain(comment):
    """A comment without its frame; null for a headline."""
    text = re.sub(r"^/\*+<?|\*/$", "", (comment or "").strip())
    text = re.sub(r"\s+", " ", re.sub(r"\n\s*\* ?", "\n", text)).strip()
    return None if not text or text.startswith("----") else text


def comment_of(cursor):
    return plain(cursor.raw_comment)


def comment_around(cursor):
    """Behind the declaration on its last line, or above the macros that stand above it."""
    lines, begin, end = lines_of(cursor), cursor.extent.start.line - 2, cursor.extent.end.line - 1
    behind = re.search(r";\s*(/\*.*?\*/)\s*$", lines[end])
    if behind:
        return plain(behind.group(1))
    while lines[begin].startswith("#define"):
        begin -= 1
    if not lines[begin].endswith("*/"):
        return None
    first = begin
    while not lines[first].startswith("/*"):
        first -= 1
    return plain("\n".join(lines[first:begin + 1]))


def split_thread_class(comment):
    found = re.search(r"\s*\[(pure|shared|exclusive)\]$", comment or "")
    return (comment[:found.start()] or None, found.group(1)) if found else (comment, None)


def said_of(cursor, before):
    """`before`: the declarations in front of it, the nearest last; directly under one it shares its comment."""
    said = comment_of(cursor) or comment_around(cursor)
    if said or not before or before[-1].extent.end.line + 1 != cursor.extent.start.line:
        return said
    return said_of(before[-1], before[:-1])


def function(cursor, before):
    comment, threads = split_thread_class(said_of(cursor, before))
    return {"name": cursor.spelling, "header": header_of(cursor), "returns": cursor.result_type.spelling,
            "parameters": [{"name": p.spelling, "type": p.type.spelling} for p in cursor.get_arguments()],
            "threads": threads, "comment": comment}


def field(cursor):
    """A whole number that holds bits of an enum, or 0 and 1, says so in its comment."""
    told = {"name": cursor.spelling, "type": cursor.type.spelling, "comment": comment_of(cursor)}
    bits = re.match(r"(SPHC_[A-Z]+_) bits", told["comment"] or "")
    if bits:
        told["bits"] = bits.group(1)
    if (told["comment"] or "").startswith("1: "):
        told["boolean"] = True
    return told


def struct(cursor):
    fields = [field(f) for f in cursor.type.get_fields()]
    return {"name": cursor.spelling, "header": header_of(cursor), "grows": fields[0]["name"] == "struct_size",
            "fields": fields, "comment": comment_of(cursor), "layouts": {}}


def layout(cursor):
    return {"bytes": cursor.type.get_size(), "alignment": cursor.type.get_align(),
            "offsets": {f.spelling: cursor.type.get_offset(f.spelling) // 8 for f in cursor.type.get_fields()}}


def enum(cursor, before):
    """`before`: the declarations in front of it; the last names its type where it has one."""
    values, type_of = list(cursor.get_children()), before[-1] if before else cursor
    typed = type_of.kind == CursorKind.TYPEDEF_DECL and type_of.extent.end.line + 1 >= cursor.extent.start.line
    return {"type": type_of.spelling if typed else "uint32_t", "header": header_of(cursor),
            "prefix": os.path.commonprefix([v.spelling for v in values]).rsplit("_", 1)[0] + "_",
            "values": [{"name": v.spelling, "value": v.enum_value, "comment": comment_of(v)} for v in values],
            "comment": (comment_of(type_of) if typed else None) or comment_of(cursor)}


def macros(unit):
    """The constants that are macros, and the header of each."""
    found, headers = {}, {}
    for cursor in unit.cursor.get_children():
        if cursor.kind != CursorKind.MACRO_DEFINITION or header_of(cursor) not in FILES:
            continue
        words = [t.spelling for t in cursor.get_tokens()]
        if len(words) == 2 and re.fullmatch(r"(0x)?[0-9A-Fa-f.]+(e-?[0-9]+)?[uUlL]*", words[1]):
            number = words[1].rstrip("uUlL")
            headers[words[0]] = header_of(cursor)
            found[words[0]] = int(number, 0) if re.fullmatch(r"(0x[0-9A-Fa-f]+)|[0-9]+", number) else float(number)
    return found, headers


def declarations(unit):
    return [c for c in unit.cursor.get_children() if header_of(c) in FILES and not c.kind.is_preprocessing()]


def describe(headers=HEADERS):
    """The interface of a folder of headers; one that was kept has spherecloud.h alone."""
    with tempfile.TemporaryDirectory() as standard:
        for name, text in STANDARD.items():
            (pathlib.Path(standard) / name).write_text(text)
        return described(standard, headers)


def described(standard, headers):
    unit = parse(MACHINES[0], standard, headers)
    constants, constant_headers = macros(unit)
    number = constants.get("SPHC_VERSION_CANDIDATE")  # headers before 1.0 have none
    candidate = f"-rc{number}" if number else ""
    told = {"version": "%d.%d.%d" % tuple(constants["SPHC_VERSION_" + p] for p in ("MAJOR", "MINOR", "PATCH")) + candidate,
            "abi": constants["SPHC_ABI"], "headers": FILES, "constants": constants, "constant_headers": constant_headers, "types": {}, "callbacks": [],
            "opaque": [], "enums": [], "structs": [], "functions": []}
    every = declarations(unit)
    for i, cursor in enumerate(every):
        if cursor.kind == CursorKind.FUNCTION_DECL:
            told["functions"].append(function(cursor, every[:i]))
        elif cursor.kind == CursorKind.STRUCT_DECL and cursor.is_definition():
            told["structs"].append(struct(cursor))
        elif cursor.kind == CursorKind.STRUCT_DECL:
            told["opaque"].append(cursor.spelling)
        elif cursor.kind == CursorKind.ENUM_DECL:
            told["enums"].append(enum(cursor, every[:i]))
        elif cursor.kind == CursorKind.TYPEDEF_DECL and cursor.underlying_typedef_type.kind == TypeKind.POINTER:
            told["callbacks"].append({"name": cursor.spelling, "type": cursor.underlying_typedef_type.spelling,
                                      "comment": comment_of(cursor)})
        elif cursor.kind == CursorKind.TYPEDEF_DECL and re.fullmatch(r"u?int\d+_t", cursor.underlying_typedef_type.spelling):
            told["types"][cursor.spelling] = cursor.underlying_typedef_type.spelling
    defined = {s["name"] for s in told["structs"]}
    told["opaque"] = sorted(set(told["opaque"]) - defined)
    for machine in MACHINES:
        cursors = {c.spelling: c for c in declarations(parse(machine, standard, headers))
                   if c.kind == CursorKind.STRUCT_DECL and c.is_definition()}
        for one in told["structs"]:
            one["layouts"][machine] = layout(cursors[one["name"]])
    return told


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    now = json.dumps(describe(), indent=1) + "\n"
    if not options.check:
        OUT.write_text(now)
    elif not OUT.exists() or OUT.read_text() != now:
        sys.exit(f"{OUT.name} is stale: build the target interface_json, look at the difference and commit it")


if __name__ == "__main__":
    main()
