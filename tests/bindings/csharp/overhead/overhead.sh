#!/bin/sh
# How much longer a frame takes through the C# binding than through C, on the golden session.  Needs mono and a C compiler.
#
#     overhead.sh LIBRARY GOLDEN [ROUNDS]    the path of libspherecloud.so; the folder that write_golden filled
set -eu
library=$(realpath "$1")
SPHERECLOUD_GOLDEN=$(realpath "$2")
export SPHERECLOUD_GOLDEN
here=$(dirname "$(realpath "$0")")
root=$here/../../../..
built=$(mktemp -d)
trap 'rm -rf "$built"' EXIT
ln -s "$library" "$built/libspherecloud.so"
cc -O2 -shared -fPIC -I "$root/sdk/include" "$here/timed.c" -o "$built/libtimed.so" "$library"
mcs -langversion:7.2 -optimize -unsafe -out:"$built/overhead.exe" "$root"/bindings/csharp/Runtime/*.cs \
  "$root"/bindings/csharp/Runtime/Generated/*.cs "$here/Overhead.cs" "$here/../Session.cs" "$here/../Expect.cs"
LD_LIBRARY_PATH=$built:$(dirname "$library") mono "$built/overhead.exe" "${3:-100}"
