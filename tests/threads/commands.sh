#!/bin/bash
# The commands that have threads, under ThreadSanitizer, whose status is 66 where it reports.
#
#   commands.sh SPHERECLOUD
set -euo pipefail
spherecloud=$(realpath "$1")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

run() {
  printf '== %s\n' "$*"
  "$spherecloud" "$@" >said 2>&1 || { status=$?; cat said; exit $status; }
}

few=(--max-keypoints 300)
run simulate --out walk.mcap --frames 12 --rate 6.25 --threads 2
run build --recording walk.mcap --map room.sphc "${few[@]}"
run live --device replay:walk.mcap --map room.sphc --every --json
run record --device replay:walk.mcap --out again.mcap
run record --device replay:walk.mcap --out guided.mcap --guide
run doctor --device replay:walk.mcap --frames 8
run map --recording walk.mcap --model walk.model --threads 2 "${few[@]}"
