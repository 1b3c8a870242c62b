#!/bin/bash
# first_pose.sh LANGUAGE - from nothing to the first pose in c, python, rust, java or csharp: installs what is missing,
# builds the runtime, makes a small session, and runs the language's first example on it.  Debian 12.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$here/..
built=$root/build/first_pose
language=${1:-}
usage() { sed -n '2,3s/^# //p' "$0"; }
fail() { printf 'first_pose.sh: %s\n\n%s\n' "$1" "$(usage)" >&2 && exit 2; }
[ $# = 1 ] || fail "one language is wanted, and there are $# words"
case $language in
  c) "$root/toolchains/install_packages.sh" runtime ;;
  python | rust | java | csharp) "$root/toolchains/install_packages.sh" runtime "$language" ;;
  -h | --help) usage && exit 0 ;;
  *) fail "there is no language \"$language\"" ;;
esac
cmake -S "$root/tests/portability" -B "$built" -G Ninja -DCMAKE_BUILD_TYPE=Release >/dev/null
cmake --build "$built" --target write_golden firmware_c spherecloud_shared | tail -n 1
session=$built/session
mkdir -p "$session"
"$built/write_golden" "$session"

libraries=$built/spherecloud/sdk/runtime
export LD_LIBRARY_PATH=$libraries SPHERECLOUD_LIB_DIR=$libraries SPHERECLOUD_LIBRARY=$libraries/libspherecloud.so
case $language in
  c) "$built/firmware_c" ;;
  python) PYTHONPATH=$here/python /usr/bin/python3 "$here/python/examples/first_pose.py" "$session/room.sphc" "$session" ;;
  rust)
    CARGO_TARGET_DIR=$built/rust cargo run --quiet --release --offline --locked --manifest-path "$here/rust/Cargo.toml" \
      --package spherecloud --example first_pose -- "$session"
    ;;
  java)
    cmake -S "$here/java" -B "$built/java" -G Ninja -DCMAKE_BUILD_TYPE=Release >/dev/null
    cmake --build "$built/java" --target spherecloud_java | tail -n 1
    java -cp "$built/java/spherecloud.jar" "-Dspherecloud.jni=$built/java/libspherecloud_jni.so" "$here/java/examples/FirstPose.java" "$session"
    ;;
  csharp)
    mcs -langversion:7.2 -unsafe -optimize "-out:$built/FirstPose.exe" "$here"/csharp/Runtime/*.cs "$here"/csharp/Runtime/Generated/*.cs \
      "$here/csharp/Samples~/FirstPose/FirstPose.cs"
    mono "$built/FirstPose.exe" "$session/room.sphc" "$session/color_00.gray8" "$session/depth_00.depth16"
    ;;
esac
