#!/bin/sh
# check_map.sh MAKE_MAP FILE - the committed map is the one that MAKE_MAP writes.
set -eu
made=$(mktemp)
trap 'rm -f "$made"' EXIT
"$1" "$made"
cmp "$made" "$2"
