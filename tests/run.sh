#!/bin/bash
# The one test command: installs what is missing, builds, runs tests.  Ends with "N passed, N failed".
#
#   tests/run.sh [STAGE...]     without a stage: all
#
# Stages:
#   all          the six behind quick, in this order
#   quick        formatting, unit tests, layers, the golden session: what to run while working
#   release      formatting; the release with gcc and all its tests, guests included
#   device       the runtime alone, as firmware links it
#   portability  the runtime by other compilers and flags and for other machines: the same bytes
#   arm64        the drivers of cameras on a stock arm64 kernel in an emulator
#   sanitized    clang with AddressSanitizer and UndefinedBehaviorSanitizer
#   tsan         ThreadSanitizer on what has threads
#   tsan_commands  the same on the commands that have threads
#   coverage     lines and branches of the device's libraries and of the parsers that tests reach, against floors
#   emulated     the runtime's unit tests on other machines, in emulators
#   windows      the runtime for Windows, in Wine: the same bytes, its unit tests, the binding for Rust
#   first_pose   the first pose in each language, in a Debian that has nothing else; needs root and Debian's mirror
#   bare_packages  the Debian packages, installed and used in such a Debian
#
# A test case counts as one; so does a step without test cases of its own, such as a build.  What was skipped is listed
# and counts as neither.
set -uo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root" || exit 1
exec </dev/null
jobs=$(nproc)
passed=0 failed=0 skipped=0 begin=$SECONDS
stages=(release device portability arm64 sanitized tsan)
apart=(quick tsan_commands coverage emulated windows first_pose bare_packages) # not of all
# A compiler cache serves every checkout, precompiled headers too.
export CCACHE_BASEDIR=$root CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=pch_defines,time_macros

usage() { sed -n '2,/^set /{/^set /d;s/^# \{0,1\}//p}' "$0"; }

finished() { printf '   %d s so far\n' $((SECONDS - begin)); }

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
  finished
}

# build FOLDER TARGETS CMAKE-ARGUMENTS...: TARGETS is a list of words, "all" for everything
build() {
  local folder=$1 targets=$2
  shift 2
  # shellcheck disable=SC2086 # words on purpose
  cmake -S . -B "$folder" -G Ninja -DSPHC_WERROR=ON "$@" &&
    cmake --build "$folder" --parallel "$jobs" --target $targets
}

# tests NAME FOLDER CTEST-ARGUMENTS...: adds up the test cases that ctest's log tells of
tests() {
  local name=$1 folder=$2 numbers good bad left_out
  shift 2
  printf '\n== %s\n' "$name"
  if ! [ -d "$folder" ]; then
    printf 'FAILED: %s was not built\n' "$folder"
    failed=$((failed + 1))
    return
  fi
  rm -f "$folder/ctest.xml"
  ctest --test-dir "$folder" -j "$jobs" --output-on-failure --no-tests=error --output-junit "$root/$folder/ctest.xml" \
    --test-output-size-passed 1000000 --test-output-size-failed 1000000 "$@" >"$folder/ctest.log" 2>&1
  grep -vE '^ *Start +[0-9]+:|[0-9]+/[0-9]+ Test +#[0-9]+: .* Passed +[0-9.]+ sec *$' "$folder/ctest.log"
  numbers=$(python3 tests/count_cases.py "$folder/ctest.xml") || numbers="0 1 0"
  read -r good bad left_out <<<"$numbers"
  printf '%d passed, %d failed, %d skipped\n' "$good" "$bad" "$left_out"
  passed=$((passed + good)) failed=$((failed + bad)) skipped=$((skipped + left_out))
  finished
}

formatting() { git ls-files -z '*.h' '*.hpp' '*.c' '*.cpp' | xargs -0 clang-format --dry-run -Werror; }

prepare() { check "packages" toolchains/install_packages.sh "$@"; }
python_packages() { check "python packages" toolchains/install_python_packages.sh build/python; }

stage_quick() {
  prepare runtime build test
  check "formatting" formatting
  check "quick: build" build build/release 'tests_unit tests_golden' -DCMAKE_BUILD_TYPE=Release
  tests "quick: unit tests, layers, the golden session" build/release -L '^(unit|layers|golden|quick)$'
}

# Where nobody edits between two builds, several files are compiled as one.  The folder build/release is the developer's.
# The runtime's only where nothing of it ships.
unity=-DSPHC_UNITY=ON
# Links programs in a third of the time.
linker=-DCMAKE_EXE_LINKER_FLAGS=-fuse-ld=gold

# Whose bindings are tested with Debian's tools; Python's is tested with that of build/python.
languages="rust java csharp"

stage_release() {
  prepare runtime build openni2 test guest $languages
  python_packages
  check "formatting" formatting
  check "release: build" build build/unity all -DCMAKE_BUILD_TYPE=Release $unity $linker
  tests "release: tests" build/unity
}

stage_device() {
  prepare runtime
  check "device: the runtime alone, as firmware links it" build build/device all -DCMAKE_BUILD_TYPE=Release -DSPHC_HOST=OFF \
    -DSPHC_DRIVERS=OFF -DSPHC_EXAMPLES=OFF -DSPHC_TESTS=OFF
}

stage_portability() {
  prepare runtime portability
  check "portability: the same bytes from other compilers, flags and machines" tests/portability/variants.sh
}

stage_arm64() {
  local arm64=$root/build/guest/arm64
  prepare runtime build test guest
  # The guest plays what the release's guests have recorded.
  if ! [ -d build/unity/tests/guest/recorded ]; then
    check "arm64: the release, to record with" build build/unity 'make_recording replay_poses spherecloud_cli' \
      -DCMAKE_BUILD_TYPE=Release $unity $linker
    tests "arm64: what the cameras play" build/unity -R '^guest\.recording$'
  fi
  check "arm64: a kernel and libraries" tests/guest/fetch_arm64.sh "$arm64"
  check "arm64: build" build build/arm64 'vhci_camera guest_capture' -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_TOOLCHAIN_FILE=toolchains/aarch64-linux-gnu.cmake -DSPHC_SYSROOT="$arm64/sysroot" -DSPHC_HOST=OFF \
    -DSPHC_EXAMPLES=OFF -DSPHC_GUEST_RECORDED="$root/build/unity/tests/guest/recorded" $unity -DSPHC_UNITY_RUNTIME=ON
  tests "arm64: on a stock kernel in an emulator" build/arm64 -L guest
}

# Sanitizers by clang, so that its warnings are seen too; with a little optimisation they are fast enough.  Keeps asserts.
# Without the command and the laboratory, which would take as long again; the presets asan and ubsan have them.
sanitized=(-DCMAKE_BUILD_TYPE=None -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++
  "-DCMAKE_CXX_FLAGS=-O1 -g1" "-DCMAKE_C_FLAGS=-O1 -g1" -DSPHC_COMMAND=OFF -DSPHC_LAB=OFF
  -DSPHC_UNITY_RUNTIME=ON)

stage_sanitized() {
  prepare runtime build openni2 test
  python_packages
  check "sanitized: build" build build/sanitized all "${sanitized[@]}" $unity $linker -DSPHC_SANITIZE=address,undefined
  # The simulated headset's contract renders a thousand images, and some of its unit tests many: too slow here.
  GTEST_FILTER='-SimulatedAmplitude.*:SimulatedHeadset.*:SimulatedLight.NoiseRisesAsLightFalls' \
    tests "sanitized: tests" build/sanitized -LE 'pipeline|memory' -E driver_contract_simulated
}

stage_tsan() {
  local programs='halves_test parallel_test shared_map_test driver_contract_test driver_contract_openni2_test openni2_driver_test driver_simulated_test replay_driver_test'
  prepare runtime build openni2 test
  check "tsan: build" build build/tsan "$programs" "${sanitized[@]}" $unity $linker -DSPHC_SANITIZE=thread
  # The two halves of a frame, frames on several cores, one map under several localizers, the driver contract, the recorder, OpenNI2 on a virtual camera, rendering by threads.
  GTEST_FILTER='Halves.*:ParallelFrames.*:SharedMap.*:*DriverContract*:*Recorder*:Opening.*:Frames.*:Unplugging.*:OniRecording.*:OneReader.*:*SameConfigSameBytesWhateverTheThreads*' \
    tests "tsan: tests" build/tsan -R "^(${programs// /|})\$"
}

stage_tsan_commands() {
  prepare runtime build openni2 test
  check "tsan_commands: build" build build/tsan_commands 'host_live_test host_guide_test spherecloud_cli' "${sanitized[@]}" $unity $linker \
    -DSPHC_COMMAND=ON -DSPHC_SANITIZE=thread
  tests "tsan_commands: tests" build/tsan_commands -R '^(host_live_test|host_guide_test|threads.of_commands)$'
}

stage_coverage() {
  # One instruction set: of those that Highway dispatches to, clang maps the lines of the last alone.
  local counted='-O1 -g1 -march=x86-64-v3 -fprofile-instr-generate -fcoverage-mapping'
  local programs='unit_runtime unit_signature unit_encryption capi_test halves_test mutation_test replay_driver_test foreign_recordings_test raw_driver_test host_calibration_test unit_host host_images_test pixels_test'
  local -x CCACHE_BASEDIR= # a header that is known by two paths would be counted as two
  prepare runtime build test coverage
  check "coverage: build" build build/coverage "$programs" "${sanitized[@]}" $unity $linker \
    -DSPHC_SIMD=static "-DCMAKE_CXX_FLAGS=$counted" "-DCMAKE_C_FLAGS=$counted"
  check "coverage: lines and branches" tests/coverage/coverage.py --build build/coverage --results tests/pipeline/coverage.csv
}

stage_emulated() {
  local machine folder
  prepare runtime portability
  for machine in aarch64 armhf riscv64 i686; do
    folder=build/emulated/$machine
    check "emulated: build for $machine" build "$folder" tests_unit --preset "$machine" -DSPHC_TESTS=ON $unity \
      -DSPHC_UNITY_RUNTIME=ON -DSPHC_PRECOMPILE_RUNTIME=ON
    tests "emulated: the runtime's unit tests on $machine" "$folder"
  done
}

stage_windows() {
  prepare runtime windows
  check "windows: the same bytes" tests/portability/variants.sh windows
  check "windows: the binding for Rust" tests/bindings/rust_on_windows.sh
  check "windows: build" build build/windows all --preset windows -DSPHC_TESTS=ON $unity -DSPHC_UNITY_RUNTIME=ON \
    -DSPHC_PRECOMPILE_RUNTIME=ON
  tests "windows: the runtime's unit tests" build/windows
}

stage_first_pose() {
  local language
  prepare bare_root
  for language in c python $languages; do
    check "first pose: $language, in a Debian that has nothing else" tests/bindings/first_pose_in_bare_root.sh "$language"
  done
}

stage_bare_packages() {
  prepare runtime build openni2 test bare_root
  python_packages
  check "packages: build" build build/unity all -DCMAKE_BUILD_TYPE=Release $unity $linker
  check "packages: installed in a Debian that has nothing else" tests/install/packages_in_bare_root.sh build/unity
  check "packages: the runtime's, built twice" tests/install/built_twice.sh
}

wanted=()
for stage in "${@:-all}"; do
  case " all ${apart[*]} ${stages[*]} " in
    *" $stage "*) ;;
    *)
      case $stage in -h | --help) usage && exit 0 ;; esac
      printf 'run.sh: there is no stage "%s"\n\n%s\n' "$stage" "$(usage)" >&2
      exit 2
      ;;
  esac
  if [ "$stage" = all ]; then wanted+=("${stages[@]}"); else wanted+=("$stage"); fi
done

mkdir -p build
# All at once is quicker than stage by stage.
if [ ${#wanted[@]} -ge ${#stages[@]} ]; then prepare runtime build openni2 test guest portability $languages; fi
for stage in "${wanted[@]}"; do
  "stage_$stage"
done
if [ $skipped != 0 ]; then
  printf '\n%d skipped' $skipped
  case ${SPHC_REQUIRE_DATA:-0} in
    0) printf '; SPHC_REQUIRE_DATA=1 makes it a failure where recordings are missing\n' ;;
    *) printf '\n' ;;
  esac
fi
printf '\n%d passed, %d failed\n' "$passed" "$failed"
[ "$failed" = 0 ]
