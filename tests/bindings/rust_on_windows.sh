#!/bin/bash
# rust_on_windows.sh - the tests of the binding for Rust on Windows, in Wine, with the DLL that
# `tests/portability/variants.sh windows` has built.  By Debian's cargo, whose library for Windows is a package.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
built=$root/build/portability/windows
export WINEDEBUG=-all WINEPATH=$built/spherecloud/sdk/runtime
export SPHERECLOUD_LIB_DIR=$WINEPATH SPHERECLOUD_GOLDEN=$built/golden
export SPHERECLOUD_CONVENTIONS=$root/sdk/include/spherecloud/conventions.csv
cmake --build "$built" --target write_golden
mkdir -p "$SPHERECLOUD_GOLDEN"
wine "$built/write_golden.exe" "$SPHERECLOUD_GOLDEN"

export CARGO_TARGET_DIR=$built/rust RUSTC=/usr/bin/rustc
export CARGO_TARGET_X86_64_PC_WINDOWS_GNU_LINKER=x86_64-w64-mingw32-gcc CARGO_TARGET_X86_64_PC_WINDOWS_GNU_RUNNER=wine
export RUST_BACKTRACE=0 # Wine crashes where threads print one
/usr/bin/cargo test --offline --locked --quiet --workspace --tests --target x86_64-pc-windows-gnu \
  --manifest-path "$root/bindings/rust/Cargo.toml"
