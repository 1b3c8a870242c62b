#!/bin/sh
# check_dll.sh OBJDUMP DLL EXPORTS - the DLL needs Windows and its C library alone, and exports what the script of ELF's
# linker names, and nothing else.
set -eu
listing=$(mktemp)
trap 'rm -f "$listing" "$listing".*' EXIT
"$1" -p "$2" >"$listing"
if sed -n 's/^[[:space:]]*DLL Name: //p' "$listing" | grep -viE '^(kernel32|msvcrt)\.dll$'; then
  echo "$2 needs these beside Windows: is it linked with -static?"
  exit 1
fi
sed -n '/Name Pointer\] Table$/,/^$/s/^[[:space:]]*\[ *[0-9]*\] \(.*[[:space:]]\)\?\([A-Za-z_][A-Za-z0-9_]*\)$/\2/p' "$listing" | sort >"$listing.exported"
grep -oE '\bsphc_[a-z0-9_]+' "$3" | sort >"$listing.declared"
[ -s "$listing.exported" ] || {
  echo "$2 exports nothing"
  exit 1
}
diff "$listing.declared" "$listing.exported" || {
  echo "$3 has those marked <, and $2 those marked >"
  exit 1
}
