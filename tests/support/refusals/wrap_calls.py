#!/usr/bin/env python3
"""Writes wrappers of the C functions of a header: each calls the function and writes a failure down (record.h).

    wrap_calls.py HEADER WRAPPERS.cpp OPTIONS.txt

OPTIONS.txt is for the compiler that links (@OPTIONS.txt), and tells the linker to bring calls of a function to its wrapper.
Wrapped are functions that give a status and explain it: by a parameter `message`, or by a function OBJECT_message of their
first parameter.
"""
import re
import sys
from pathlib import Path

FUNCTION = re.compile(r"\bsphc_status (sphc_\w+)\(([^;]*?)\);")
MESSAGE_OF = re.compile(r"\bconst char \*(sphc_\w+)_message\(const \1 \*")


def name_of(parameter):
    return re.search(r"(\w+)(\[\w*\])?$", parameter)[1]


def body(name, parameters, explained):
    """What a wrapper calls; None where nothing explains a failure."""
    names = [name_of(parameter) for parameter in parameters]
    if names[-1] == "message":
        passed = ", ".join(names[:-1] + ["told"])
        return f'recordedCall("{name}", message, [&](sphc_message *told) {{ return __real_{name}({passed}); }})'
    owner = re.match(r"(?:const )?(sphc_\w+) \*(\w+)$", parameters[0])
    if owner and owner[1] in explained:
        call = f"[&] {{ return __real_{name}({', '.join(names)}); }}"
        return f'recordedCallOf("{name}", static_cast<const {owner[1]} *>({owner[2]}), {owner[1]}_message, {call})'
    return None


def main():
    header, wrappers, options = map(Path, sys.argv[1:])
    text = re.sub(r"/\*.*?\*/", "", header.read_text(encoding="utf-8"), flags=re.DOTALL)
    explained = set(MESSAGE_OF.findall(text))
    code, wrapped = [], []
    for name, inside in FUNCTION.findall(text):
        parameters = [" ".join(parameter.split()) for parameter in inside.split(",")]
        called = body(name, parameters, explained)
        if called:
            declared = ", ".join(parameters)
            code.append(f"sphc_status __real_{name}({declared});\n"
                        f"sphc_status __wrap_{name}({declared}) {{\n  return sphc::test::{called};\n}}\n")
            wrapped.append(f"-Wl,--wrap={name}\n")
    wrappers.write_text(f'#include "{header}"\n#include "tests/support/refusals/record.h"\n\nextern "C" {{\n'
                        + "\n".join(code) + "}\n", encoding="utf-8")
    options.write_text("".join(wrapped), encoding="utf-8")


if __name__ == "__main__":
    main()
