#!/bin/bash
# The one test command: installs what is missing, builds, runs every test.  Ends with "N passed, N failed".
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root"
step() { printf '\n== %s\n' "$1"; }
jobs=$(nproc)

step "packages"
toolchains/install_packages.sh build test

step "release: build and test"
cmake --preset release -DSPHC_TESTS=ON -DSPHC_EXAMPLES=ON >/dev/null
cmake --build --preset release
status=0
ctest --test-dir build/release -j "$jobs" --output-on-failure | tee build/release/ctest.log || status=1

step "address and undefined-behaviour sanitizers"
cmake -S . -B build/sanitized -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DSPHC_SANITIZE=address,undefined >/dev/null
cmake --build build/sanitized
ctest --test-dir build/sanitized -j "$jobs" --output-on-failure -LE 'pipeline|slow|memory' |
  tee build/sanitized/ctest.log || status=1

step "thread sanitizer: the driver contract"
cmake --preset tsan >/dev/null
cmake --build --preset tsan --target driver_contract_test
ctest --test-dir build/tsan -j "$jobs" --output-on-failure -R '^(Sample|Replay)' | tee build/tsan/ctest.log || status=1

step "clang: no warnings"
cmake --preset clang >/dev/null
cmake --build --preset clang

step "the runtime alone, as firmware links it"
cmake --preset device >/dev/null
cmake --build --preset device

step "formatting"
git ls-files -z '*.h' '*.hpp' '*.c' '*.cpp' | xargs -0 clang-format --dry-run -Werror || status=1

# ctest counts per run; the sum of all runs closes the log
awk '/tests passed, .* tests failed out of/ { failed += $4; passed += $NF - $4 }
     END { printf "\n%d passed, %d failed\n", passed, failed; exit failed > 0 || passed == 0 }' build/*/ctest.log || status=1
exit $status
