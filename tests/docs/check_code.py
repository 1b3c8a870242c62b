#!/usr/bin/env python3
"""Every block of C and C++ in the docs compiles against the public headers.

    check_code.py ROOT --cc CC --cxx CXX

A block ```c is a whole file.  A block ```c fragment is put into a function; what it needs declared before it stands in a
comment `<!-- before: ... -->` above it, which readers do not see.  Lines of that comment that begin with `#` go to the
top of the file.  Static memory for the library says how it is aligned.
"""
import argparse
import re
import subprocess
import sys
from pathlib import Path

from markdown import pages, report

STRICT = ["-Wall", "-Wextra", "-Wpedantic", "-Werror", "-fsyntax-only"]
C_HEADERS = "#include <spherecloud/spherecloud.h>\n#include <stdio.h>\n"
CXX_HEADERS = "#include <spherecloud/spherecloud.hpp>\n#include <cstdio>\n"
# Memory for the library, in a static array of bytes; it is refused where no compiler happens to align it.
ARRAY = re.compile(r"^[^;]*\bstatic\b[^;]*\[SPHC_\w+_BYTES_MAX\b[^;]*;", re.MULTILINE)


def is_c(block):
    return block.info.split()[0] == "c"


def is_fragment(block):
    return "fragment" in block.info.split()


def source_of(block):
    """The file that a block is compiled as."""
    if not is_fragment(block):
        return block.text
    context = block.before.split("\n") if block.before else []
    top = "".join(line + "\n" for line in context if line.startswith("#"))
    declared = "".join(line + "\n" for line in context if not line.startswith("#"))
    headers = C_HEADERS if is_c(block) else CXX_HEADERS
    return f"{headers}{top}int fragment(void);\nint fragment(void) {{\n{declared}{block.text}return 0;\n}}\n"


def command_of(block, root, compilers):
    """How a block is compiled; its text comes by standard input."""
    language = [compilers[0], "-std=c99", "-x", "c"] if is_c(block) else [compilers[1], "-std=c++17", "-x", "c++"]
    relaxed = ["-Wno-unused"] if is_fragment(block) else []
    return [*language, *STRICT, *relaxed, "-I", root / "sdk" / "include", "-I", root / "sdk" / "signature" / "include", "-I", root / "sdk" / "encryption" / "include", "-I", root, "-I", root / "sdk", "-"]


def compile_block(block, root, compilers):
    """What the compiler says against a block; empty: it compiles."""
    run = subprocess.run(command_of(block, root, compilers), input=source_of(block), text=True, capture_output=True,
                         check=False)
    return run.stderr if run.returncode else ""


def lies_anywhere(block):
    """Whether a block hands out static memory that it does not align."""
    return any("align" not in array.lower() for array in ARRAY.findall(block.text))


def faults_of(root, compilers):
    root, faults, blocks = Path(root).resolve(), [], 0
    for page in pages(root):
        for block in page.blocks:
            if not re.match(r"(c|cpp|c\+\+)\b", block.info):
                continue
            blocks += 1
            said = compile_block(block, root, compilers)
            if said:
                faults.append(f"{page.path.relative_to(root)}:{block.line}: this block does not compile\n{said}")
            if lies_anywhere(block):
                faults.append(f"{page.path.relative_to(root)}:{block.line}: memory for the library is not aligned")
    print(f"{blocks} blocks compiled")
    return faults


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("root")
    parser.add_argument("--cc", default="cc")
    parser.add_argument("--cxx", default="c++")
    options = parser.parse_args()
    sys.exit(report(faults_of(options.root, (options.cc, options.cxx))))
