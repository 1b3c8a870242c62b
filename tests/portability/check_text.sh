#!/bin/sh
# check_text.sh PROGRAM MOST - at most MOST bytes of code and constants, and nothing that would have to run before main.
set -eu
size "$1"
text=$(size "$1" | awk 'NR == 2 { print $1 }')
if size -A "$1" | grep -E '^\.(init|preinit|ctors)'; then
  echo "$1 has constructors, which nobody runs"
  exit 1
fi
[ "$text" -le "$2" ] || {
  echo "$1 has $text bytes of text, $2 are allowed"
  exit 1
}
