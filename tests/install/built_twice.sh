#!/bin/bash
# built_twice.sh - the Debian packages of the runtime, built in two folders without a compiler cache: the same bytes.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
place=$root/build/twice
rm -rf "$place"
export CCACHE_DISABLE=1 SOURCE_DATE_EPOCH=1700000000
for folder in once again_in_a_longer_folder; do
  mkdir -p "$place/$folder/src"
  git -C "$root" archive HEAD | tar -C "$place/$folder/src" -x
  cmake -S "$place/$folder/src" -B "$place/$folder/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DSPHC_HOST=OFF -DSPHC_DRIVERS=OFF \
    -DSPHC_EXAMPLES=OFF -DSPHC_TESTS=OFF
  cmake --build "$place/$folder/build"
  cpack --config "$place/$folder/build/CPackConfig.cmake" -B "$place/$folder/debs"
  rm -rf "$place/$folder/debs/_CPack_Packages"
done
diff -r "$place/once/debs" "$place/again_in_a_longer_folder/debs"
packages=("$place"/once/debs/*.deb)
[ ${#packages[@]} -ge 2 ]
rm -rf "$place"
printf '%d packages have the same bytes\n' ${#packages[@]}
