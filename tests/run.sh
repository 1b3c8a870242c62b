#!/bin/bash
# The one test command: installs what is missing, builds, runs every test.  Ends with "N passed, N failed".
# A step without test cases of its own, such as a build or the formatting check, counts as one.
set -uo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root" || exit 1
exec </dev/null
jobs=$(nproc)
passed=0 failed=0 begin=$SECONDS
mkdir -p build
# A compiler cache serves every checkout, precompiled headers too.
export CCACHE_BASEDIR=$root CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=pch_defines,time_macros

# OpenNI2 asks threads that have ended whether they live; as long as their stacks are kept it gets an answer.
export GLIBC_TUNABLES=glibc.pthread.stack_cache_size=1073741824

# check NAME COMMAND...: one step; its output is shown when it fails
check() {
  local name=$1 log
  shift
  log=$(mktemp build/step.XXXXXX)
  printf '\n== %s\n' "$name"
  if "$@" >"$log" 2>&1; then
    passed=$((passed + 1))
    tail -n 1 "$log"
  else
    failed=$((failed + 1))
    tail -n 200 "$log"
    printf 'FAILED: %s\n' "$name"
  fi
  rm -f "$log"
  printf '   %d s so far\n' $((SECONDS - begin))
}

# build FOLDER TARGETS CMAKE-ARGUMENTS...: TARGETS is a list of words, "all" for everything
build() {
  local folder=$1 targets=$2
  shift 2
  # shellcheck disable=SC2086 # words on purpose
  cmake -S . -B "$folder" -G Ninja "$@" && cmake --build "$folder" --parallel "$jobs" --target $targets
}

# tests NAME FOLDER CTEST-ARGUMENTS...: adds ctest's numbers up
tests() {
  local name=$1 folder=$2 numbers
  shift 2
  printf '\n== %s\n' "$name"
  ctest --test-dir "$folder" -j "$jobs" --output-on-failure --no-tests=error "$@" >"$folder/ctest.log" 2>&1
  grep -vE '^ *Start +[0-9]+:|[0-9]+/[0-9]+ Test +#[0-9]+: .* Passed +[0-9.]+ sec$' "$folder/ctest.log"
  numbers=$(sed -nE 's/^[0-9]+% tests passed, ([0-9]+) tests failed out of ([0-9]+)$/\1 \2/p' "$folder/ctest.log")
  if [ -n "$numbers" ]; then
    failed=$((failed + ${numbers% *}))
    passed=$((passed + ${numbers#* } - ${numbers% *}))
  else
    failed=$((failed + 1))
  fi
  printf '   %d s so far\n' $((SECONDS - begin))
}

# Sanitizers by clang, so that its warnings are seen too; with a little optimisation they are fast enough.  Keeps asserts.
sanitized=(-DCMAKE_BUILD_TYPE=None -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++
  "-DCMAKE_CXX_FLAGS=-O1 -g1" "-DCMAKE_C_FLAGS=-O1 -g1")

formatting() { git ls-files -z '*.h' '*.hpp' '*.c' '*.cpp' | xargs -0 clang-format --dry-run -Werror; }

check "packages" toolchains/install_packages.sh build test guest
check "python packages" toolchains/install_python_packages.sh build/python
check "formatting" formatting
check "release: build" build build/release all -DCMAKE_BUILD_TYPE=Release
tests "release: tests" build/release
check "the runtime alone, as firmware links it" build build/device all -DCMAKE_BUILD_TYPE=Release -DSPHC_HOST=OFF \
  -DSPHC_DRIVERS=OFF -DSPHC_EXAMPLES=OFF -DSPHC_TESTS=OFF
arm64=$root/build/guest/arm64
check "arm64: a kernel and libraries" tests/guest/fetch_arm64.sh "$arm64"
check "arm64: build" build build/arm64 'vhci_camera guest_capture' -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_TOOLCHAIN_FILE=toolchains/aarch64-linux-gnu.cmake -DSPHC_SYSROOT="$arm64/sysroot" -DSPHC_HOST=OFF \
  -DSPHC_EXAMPLES=OFF
tests "arm64: on a stock kernel in an emulator" build/arm64
# Without the command, its bench and its reports, which would take as long again; the presets asan and ubsan have them.
check "clang, sanitizers for addresses and undefined behaviour: build" build build/sanitized all "${sanitized[@]}" \
  -DSPHC_SANITIZE=address,undefined -DSPHC_COMMAND=OFF
# The simulated headset's contract renders a thousand images: too slow under sanitizers; its unit tests run there.
tests "sanitizers for addresses and undefined behaviour: tests" build/sanitized -LE 'pipeline|memory' \
  -E driver_contract_simulated
threaded='driver_contract_test driver_contract_openni2_test openni2_driver_test driver_simulated_test replay_driver_test'
check "thread sanitizer: build" build build/tsan "$threaded" "${sanitized[@]}" -DSPHC_SANITIZE=thread \
  -DSPHC_COMMAND=OFF
tests "thread sanitizer: the driver contract, the recorder, OpenNI2, rendering by threads" build/tsan \
  -R 'DriverContract|Recorder|^(Opening|Frames|Unplugging|OniRecording)\.|SameConfigSameBytesWhateverTheThreads'
printf '\n%d passed, %d failed\n' "$passed" "$failed"
[ "$failed" = 0 ]
