#!/usr/bin/env python3
"""check_hardening.py sees what a program was built without.

    check_hardening_test.py CC READELF
"""
import subprocess
import sys
import tempfile
from pathlib import Path

from check_hardening import properties

PROGRAM = """
#include <stdio.h>
#include <string.h>
int main(int count, char **words) {
  char copy[64];
  strcpy(copy, words[count - 1]);
  return puts(copy) < 0;
}
"""
NAMES = ("relro", "now", "stack", "pie", "protector", "fortify")
HARD = ["-fPIE", "-fstack-protector-strong", "-U_FORTIFY_SOURCE", "-D_FORTIFY_SOURCE=2", "-pie", "-Wl,-z,relro,-z,now,-z,noexecstack"]
SOFT = {"relro": ("-Wl,-z,relro,-z,now,-z,noexecstack", "-Wl,-z,norelro,-z,now,-z,noexecstack"),
        "now": ("-Wl,-z,relro,-z,now,-z,noexecstack", "-Wl,-z,relro,-z,lazy,-z,noexecstack"),
        "stack": ("-Wl,-z,relro,-z,now,-z,noexecstack", "-Wl,-z,relro,-z,now,-z,execstack"),
        "pie": ("-pie", "-no-pie"),
        "protector": ("-fstack-protector-strong", "-fno-stack-protector"),
        "fortify": ("-D_FORTIFY_SOURCE=2", "-D_FORTIFY_SOURCE=0")}


def built(compiler, readelf, flags):
    with tempfile.TemporaryDirectory() as folder:
        source, program = Path(folder) / "program.c", Path(folder) / "program"
        source.write_text(PROGRAM, encoding="utf-8")
        subprocess.run([compiler, "-O2", "-w", *flags, str(source), "-o", str(program)], check=True)
        return properties(readelf, str(program))


def main():
    compiler, readelf = sys.argv[1:]
    faults = [f"{name} is not seen" for name, has in built(compiler, readelf, HARD).items() if not has]
    for name, (hard, soft) in SOFT.items():
        found = built(compiler, readelf, [soft if flag == hard else flag for flag in HARD])
        faults += [f"without {name}, {other} is said to be {has}" for other, has in found.items() if has == (other == name)]
    print("\n".join(faults))
    sys.exit(1 if faults or set(SOFT) != set(NAMES) else 0)


main()
