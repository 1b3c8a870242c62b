"""The C interface as spherecloud.json tells it, for the generators of bindings: one for each language, beside this file.

    import interface
    told = interface.read()
    for struct in told.structs: ...
    interface.write(PATH, TEXT)        # or compares, where the generator was called with --check

A generator writes what a machine writes best (types, offsets, enums, declarations, comments); people write the rest.
"""
import dataclasses
import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
JSON = ROOT / "sdk" / "include" / "spherecloud" / "spherecloud.json"
FROZEN = "spherecloud.h"  # the other header may change from release to release


@dataclasses.dataclass(frozen=True)
class Type:
    """`base` is void, char, float, double, size_t, (u)intN_t, or a name of the interface; '' for a pointer to a
    function that has no name."""
    base: str
    const: bool
    pointers: int  # of an array parameter too, which C passes as one
    length: int | None  # of an array: a field holds so many, a parameter points to so many


def type_of(spelling):
    if "(*)" in spelling:
        return Type("", False, 1, None)
    array = re.fullmatch(r"(.*?)\[(\d+)\]", spelling)
    plain = array.group(1) if array else spelling
    base = plain.replace("const ", "").replace("*", "").strip()
    return Type(base, plain.startswith("const "), plain.count("*"), int(array.group(2)) if array else None)


@dataclasses.dataclass(frozen=True)
class Variable:
    """A field of a struct, or a parameter of a function, whose `comment` is null."""
    name: str
    type: Type
    comment: str | None
    bits: str | None = None  # a field that holds bits: what their names begin with, SPHC_FAULT_
    boolean: bool = False  # a field that is 0 or 1


@dataclasses.dataclass(frozen=True)
class Struct:
    name: str
    grows: bool  # its first field is struct_size
    fields: list
    comment: str | None
    layouts: dict  # machine: {"bytes": , "alignment": , "offsets": {field: }}


@dataclasses.dataclass(frozen=True)
class Enum:
    type: str  # uint32_t for bits
    prefix: str  # what its constants begin with: SPHC_FORMAT_
    values: list  # (name, value, comment)
    comment: str | None


@dataclasses.dataclass(frozen=True)
class Function:
    name: str
    returns: Type
    parameters: list
    threads: str  # pure, shared, exclusive
    comment: str | None


@dataclasses.dataclass(frozen=True)
class Interface:
    version: str
    abi: int
    constants: dict  # name: number
    types: dict  # name of an enum's type: int32_t
    callbacks: dict  # name: (its type in C, comment)
    opaque: list
    enums: list
    structs: list
    functions: list


def read(header=FROZEN):
    """What `header` declares; all headers with None."""
    with open(JSON, encoding="utf-8") as stream:
        told = json.load(stream)

    def here(entries):
        return [e for e in entries if header in (None, e["header"])]

    def variables(entries):
        return [Variable(e["name"], type_of(e["type"]), e.get("comment"), e.get("bits"), e.get("boolean", False))
                for e in entries]

    enums = [Enum(e["type"], e["prefix"], [(v["name"], v["value"], v["comment"]) for v in e["values"]], e["comment"])
             for e in here(told["enums"])]
    structs = [Struct(s["name"], s["grows"], variables(s["fields"]), s["comment"], s["layouts"])
               for s in here(told["structs"])]
    functions = [Function(f["name"], type_of(f["returns"]), variables(f["parameters"]), f["threads"], f["comment"])
                 for f in here(told["functions"])]
    named = {e.type for e in enums}
    used = {p.type.base for f in functions for p in f.parameters}
    return Interface(told["version"], told["abi"],
                     {n: v for n, v in told["constants"].items() if header in (None, told["constant_headers"][n])},
                     {name: base for name, base in told["types"].items() if name in named},
                     {c["name"]: (c["type"], c["comment"]) for c in told["callbacks"]},
                     [name for name in told["opaque"] if name in used], enums, structs, functions)


def write(path, text):
    """Replaces the file; with --check it only says whether the file has that text, and ends the program if not."""
    path = ROOT / path
    if "--check" not in sys.argv[1:]:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    elif not path.exists() or path.read_text(encoding="utf-8") != text:
        sys.exit(f"{path.relative_to(ROOT)} is not that of the interface; run: python3 {pathlib.Path(sys.argv[0]).name}")
