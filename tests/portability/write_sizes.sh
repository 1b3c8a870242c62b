#!/bin/sh
# write_sizes.sh - measures size.csv anew, from what variants.sh has built.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
built=$here/../../build/portability
tail -n +2 "$here/size.csv" | cut -d, -f1 | while read -r variant; do
  size=$(sed -n 's/^CMAKE_OBJDUMP:FILEPATH=\(.*\)objdump$/\1size/p' "$built/$variant/CMakeCache.txt")
  "$here/check_size.py" "$variant" "$size" "$built/$variant/portability_replay" --write
done
