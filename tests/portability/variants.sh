#!/bin/bash
# variants.sh [NAME...] - the same bytes from the runtime as many compilers, flags and machines build it; all of them
# without names.  The folder beside this file is built as a project of its own, that of somebody who uses the SDK by
# add_subdirectory.  Ends with "N passed, N failed" and status 1 where any failed.
set -uo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
cd "$root" || exit 1
export CCACHE_BASEDIR=$root CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=pch_defines,time_macros
clang=(-DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++)
release=(-DCMAKE_BUILD_TYPE=Release)
small_flags="-O2 -DNDEBUG -fno-asynchronous-unwind-tables" # as firmware: nothing unwinds
small=(-DCMAKE_BUILD_TYPE=Release "-DCMAKE_C_FLAGS_RELEASE=$small_flags" "-DCMAKE_CXX_FLAGS_RELEASE=$small_flags")
debug=(-DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_FLAGS_DEBUG=-O0 -DCMAKE_CXX_FLAGS_DEBUG=-O0) # asserts, no symbols
flags() { printf -- '-DCMAKE_C_FLAGS=%s\n-DCMAKE_CXX_FLAGS=%s\n' "$1" "$1"; }
machine() { printf -- '-DCMAKE_TOOLCHAIN_FILE=%s/toolchains/%s.cmake\n' "$root" "$1"; }

# arguments NAME: sets `arguments` for cmake.
arguments() {
  case $1 in
    scalar) arguments=("${small[@]}" -DSPHC_SIMD=scalar) ;;
    x86-64-v3) mapfile -t arguments < <(flags -march=x86-64-v3) && arguments+=("${small[@]}" -DSPHC_SIMD=static) ;;
    debug) arguments=("${debug[@]}" -DSPHC_SIMD=dispatch) ;;
    clang) arguments=("${release[@]}" "${clang[@]}" -DSPHC_SIMD=dispatch) ;;
    memory) # nothing is read before it was written; vectors read, and do not use, what lies behind a row
      mapfile -t arguments < <(flags '-O1 -g1 -fsanitize=memory')
      arguments+=(-DCMAKE_BUILD_TYPE=None "${clang[@]}" -DSPHC_SIMD=scalar -DSPHC_SANITIZE=memory) ;;
    clang-debug) # without any optimisation its vectors take ten times as long as gcc's, which show the same
      arguments=("${debug[@]//-O0/-O1}" "${clang[@]}" -DSPHC_SIMD=static) ;;
    aarch64) mapfile -t arguments < <(machine aarch64-linux-gnu) && arguments+=("${release[@]}") ;;
    armhf) # a compiler that may use NEON
      mapfile -t arguments < <(machine arm-linux-gnueabihf && flags '-mfpu=neon-vfpv4 -mfp16-format=ieee')
      arguments+=("${release[@]}") ;;
    riscv64) mapfile -t arguments < <(machine riscv64-linux-gnu) && arguments+=("${small[@]}") ;;
    i686) mapfile -t arguments < <(machine i686-linux-gnu) && arguments+=("${small[@]}") ;;
    cortex-m7) mapfile -t arguments < <(machine arm-none-eabi) && arguments+=("${small[@]}") ;;
    windows) mapfile -t arguments < <(machine x86_64-w64-mingw32) && arguments+=("${release[@]}") ;;
    *) echo "no variant \"$1\"; there are: $all" && return 1 ;;
  esac
}
all="scalar x86-64-v3 debug clang clang-debug aarch64 armhf riscv64 i686 cortex-m7"
# Not of all: memory is too slow, windows needs packages of its own.
# Compiled several files at once, in half of the time.  The others show that every file compiles alone, with the headers of
# glibc and of newlib, and what firmware links.
unity=" debug clang clang-debug memory aarch64 armhf riscv64 i686 windows "

# Those that size.csv has a row for.
sized() { cut -d, -f1 "$here/size.csv" | grep -x "$1"; }

variant() {
  local folder=build/portability/$1 arguments
  arguments "$1" || return
  case $unity in *" $1 "*) arguments+=(-DSPHC_UNITY_RUNTIME=ON) ;; esac
  cmake -S "$here" -B "$folder" -G Ninja -DSPHC_WERROR=ON -DSPHC_PRECOMPILE_RUNTIME=ON "-DSPHC_VARIANT=$(sized "$1")" "${arguments[@]}" &&
    cmake --build "$folder" --parallel $((($(nproc) + 1) / 2)) && ctest --test-dir "$folder" --output-on-failure --no-tests=error
}

attempt() { # NAME: leaves its verdict beside its log
  local begin=$SECONDS verdict=FAILED
  variant "$1" >"build/portability/$1.log" 2>&1 && verdict=equal
  printf '%s, %d s\n' $verdict $((SECONDS - begin)) >"build/portability/$1.verdict"
}

# shellcheck disable=SC2206 # words on purpose
names=(${*:-$all})
mkdir -p build/portability
rm -f build/portability/*.verdict
# Two at once: half of a variant's time is one process's, cmake's or a linker's.
for name in "${names[@]}"; do
  while [ "$(jobs -rp | wc -l)" -ge 2 ]; do wait -n; done
  attempt "$name" &
done
wait
passed=0 failed=0
for name in "${names[@]}"; do
  verdict=$(cat "build/portability/$name.verdict" 2>/dev/null || echo FAILED)
  case $verdict in
    equal*) passed=$((passed + 1)) ;;
    *) failed=$((failed + 1)) && tail -n 60 "build/portability/$name.log" ;;
  esac
  printf '%-12s %s\n' "$name" "$verdict"
done
printf '%d passed, %d failed\n' "$passed" "$failed"
[ "$failed" = 0 ]
