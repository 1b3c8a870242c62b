#!/usr/bin/env python3
"""What the device library asks of its surroundings: shown, and held against a list of what it may; and nothing that it
defines has a name of other people's library, whose functions of this name a linker would take for ours, or ours for theirs.

    check_symbols.py NM LIBRARY
"""
import re
import subprocess
import sys

# Without an operating system, a device still has these: the compiler's own helpers, memory blocks, sorting's throw-free
# parts, and what picks the SIMD instructions.
ALLOWED = [
    r"mem(cpy|move|set|cmp)", r"str(len|cmp|ncmp)", r"sqrtf?", r"bcmp",
    r"_GLOBAL_OFFSET_TABLE_", r"__stack_chk_fail", r"__cpu_model", r"__cpu_indicator_init",
    r"_Unwind_Resume", r"__gxx_personality_v0",  # unwind tables; nothing throws
    r"sphc_(map_init|status_name)",  # of the runtime, for the libraries of signatures and of encrypted maps
    r"hwy::.*", r"_ZN3hwy.*", r"_ZTV.*N10__cxxabiv1.*",
    r"__(asan|ubsan|tsan|sanitizer|msan|lsan|sancov)_.*", r"__start___sancov.*", r"__stop___sancov.*", r"__sancov.*",
]
# Named apart so that a mistake in ALLOWED cannot let them in.
FORBIDDEN = [
    r"(m|c|re)alloc", r"free", r"posix_memalign", r"aligned_alloc", r"operator (new|delete).*", r"_Zn[wa].*", r"_Zd[la].*",
    r"__cxa_(throw|rethrow|allocate_exception|begin_catch|guard_.*|atexit|pure_virtual).*", r"std::__throw_.*",
    r"(v|s|f|sn|vsn|vf)?printf", r"puts|putchar|fputs|fwrite|fopen.*|open|read|write|close", r"pthread_.*", r"mtx_.*",
    r"(clock|time|gettimeofday|clock_gettime|nanosleep|usleep)", r"(abort|exit|_exit)", r"getenv", r"__errno_location",
    r"(sin|cos|tan|atan2?|exp|log|pow|fma|floor|ceil|round|lround|fmod)f?",  # libm: not the same bits everywhere
]


# Of Eigen, under its own name.
TAKEN = re.compile(r"(?<!\w)Eigen::")


def symbols(nm, library):
    """(names that the archive asks for, names that it defines)."""
    text = subprocess.run([nm, "-C", library], check=True, capture_output=True, text=True).stdout
    wanted, defined = set(), set()
    for line in text.splitlines():
        match = re.match(r"^(?:[0-9a-f]+)?\s+([A-Za-z])\s(.+)$", line)
        if match:
            (wanted if match.group(1) in "Uw" else defined).add(match.group(2))
    return wanted, defined


def undefined(nm, library):
    """Names the whole archive leaves undefined; those one member defines for another are not asked for."""
    wanted, defined = symbols(nm, library)
    return sorted(wanted - defined)


def taken(nm, library):
    """Names that it defines, and that are another library's."""
    return sorted(name for name in symbols(nm, library)[1] if TAKEN.search(name))


def among(name, patterns):
    return any(re.fullmatch(pattern, name) for pattern in patterns)


def faults(names):
    return [name for name in names if among(name, FORBIDDEN) or not among(name, ALLOWED)]


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    names, theirs = undefined(*sys.argv[1:]), taken(*sys.argv[1:])
    bad = faults(names)
    for name in theirs:
        print("NOT OURS     " + name)
    for name in names:
        print(("NOT ALLOWED  " if name in bad else "             ") + name)
    if not names:
        sys.exit("no symbols: is this the library?")
    sys.exit(1 if bad or theirs else 0)


if __name__ == "__main__":
    main()
