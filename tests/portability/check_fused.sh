#!/bin/sh
# check_fused.sh OBJDUMP LIBRARY - no instruction of LIBRARY multiplies and adds with one rounding: machines without
# such an instruction would compute other numbers.  Of x86, ARM, AArch64 and RISC-V.
set -eu
fused='(vfn?m(add|sub)[0-9a-z]*|fn?m(add|sub|la|ls)(\.[sd])?|fcmla|vfn?m[as])'
listing=$(mktemp)
trap 'rm -f "$listing"' EXIT
"$1" -d -C --no-show-raw-insn "$2" >"$listing"
grep -qE '(mulsd|vmulsd|fmul|vmul)' "$listing" || {
  echo "$2 multiplies nothing: is $1 the disassembler of its machine?"
  exit 1
}
if awk '/>:$/ { name = $0 } { print name "\t" $0 }' "$listing" | grep -E "	 *[0-9a-f]+:	$fused(\.[a-z0-9]+)*[ 	]" >"$listing.found"; then
  sort -u "$listing.found" | head -20
  rm -f "$listing.found"
  exit 1
fi
rm -f "$listing.found"
