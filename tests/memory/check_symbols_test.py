#!/usr/bin/env python3
"""The symbol check must be able to fail: check_symbols_test.py NM CXX"""
import os
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.dont_write_bytecode = True
import check_symbols  # noqa: E402

NM, CXX = sys.argv[1:3]
BAD = {
    "malloc": "#include <cstdlib>\nvoid *f() { return std::malloc(3); }",
    "operator new": "int *f() { return new int[7]; }",
    "operator delete": "void f(int *p) { delete p; }",
    "__cxa_throw": "void f() { throw 1; }",
    "printf": "#include <cstdio>\nvoid f(int i) { std::printf(\"%d\", i); }",
    "std::__throw_": "#include <vector>\nint f(std::vector<int> &v) { return v.at(3); }",
    "sin": "#include <cmath>\ndouble f(double x) { return std::sin(x); }",
    "unheard_of": "void unheard_of(); void f() { unheard_of(); }",
}
GOOD = "#include <cstring>\nvoid f(char *a, const char *b, unsigned long n) { std::memcpy(a, b, n); }"


EIGENS = "namespace Eigen { struct M { void f(); }; void M::f() {} }"
OURS = "namespace sphc_eigen { struct M { void f(); }; void M::f() {} }"


def check(source, of=lambda binary: check_symbols.faults(check_symbols.undefined(NM, binary))):
    with tempfile.TemporaryDirectory() as folder:
        code, binary = os.path.join(folder, "x.cpp"), os.path.join(folder, "x.o")
        with open(code, "w", encoding="utf-8") as stream:
            stream.write(source)
        subprocess.run([CXX, "-O1", "-fPIC", "-fno-stack-protector", "-c", code, "-o", binary], check=True)
        return of(binary)


for word, source in BAD.items():
    found = check(source)
    assert any(word in name for name in found), (word, found)
assert check(GOOD) == []
assert check(EIGENS, lambda binary: check_symbols.taken(NM, binary)) == ["Eigen::M::f()"]
assert check(OURS, lambda binary: check_symbols.taken(NM, binary)) == []
print("every forbidden symbol is found")
