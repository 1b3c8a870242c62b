#!/bin/bash
# All tests of a build as other processors of x86-64 would run them.
#
#   tests/portability/processors.sh [BUILD]
#
# First the whole suite with other picks of the C library (GLIBC_TUNABLES) and of OpenCV, then the programs of the unit
# tests under qemu-user's processors.  It takes forty minutes and more; tests/run.sh has the quickest part (processors.*).
# The last line counts; the status is 0 if all pass.
set -uo pipefail
build=$(cd "${1:-build/release}" && pwd) || exit 1
failed=0 passed=0

# Without those that are about threads and devices, or start the command.
mapfile -t programs < <(cd "$build/tests/unit" && find . -type f -executable '(' -name '*unit_*' -o -name '*_test' ')' |
  grep -vE 'simulated|v4l2|openni2|live|cli' | sort)
[ ${#programs[@]} -gt 0 ] || { echo "$build has no unit tests; build it first" >&2; exit 1; }

# step NAME COMMAND...
step() {
  local name=$1 log
  shift
  log=$(mktemp)
  if "$@" >"$log" 2>&1; then
    passed=$((passed + 1))
    printf 'passed: %s\n' "$name"
  else
    failed=$((failed + 1))
    tail -n 60 "$log"
    printf 'FAILED: %s\n' "$name"
  fi
  rm -f "$log"
}

# Without multiply-add, as processors before 2013; and as the first of x86-64.
for without in -AVX2,-FMA,-FMA4,-AVX512F -AVX2,-FMA,-FMA4,-AVX512F,-AVX,-SSE4_2,-SSE4_1,-SSSE3; do
  step "the whole suite, hwcaps=$without" env GLIBC_TUNABLES="glibc.cpu.hwcaps=$without" \
    OPENCV_CPU_DISABLE=AVX512-SKX,AVX2,FP16,AVX ctest --test-dir "$build" -j "$(nproc)" -LE guest --output-on-failure --no-tests=error
done

# A spawned program that is not there is not told to its parent by qemu-user.
filter=-Coprocess.AProgramThatIsNotThereIsToldByName
for processor in Nehalem Haswell max; do
  for program in "${programs[@]}"; do
    step "$(basename "$program") on $processor" qemu-x86_64 -cpu "$processor" "$build/tests/unit/$program" --gtest_brief=1 --gtest_filter="$filter"
  done
done

printf '%d passed, %d failed\n' "$passed" "$failed"
[ "$failed" = 0 ]
