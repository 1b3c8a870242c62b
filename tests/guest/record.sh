#!/bin/bash
# record.sh FOLDER MAKE_RECORDING SPHERECLOUD REPLAY_POSES - what the cameras play, a map of the place, and the poses that
# the replay driver gets from it.
set -euo pipefail
folder=$1 make_recording=$2 spherecloud=$3 replay_poses=$4
rm -rf "$folder"
mkdir -p "$folder"
"$make_recording" "$folder"
"$spherecloud" build --recording "$folder/walk" --step 2 --map "$folder/room.sphc"
"$replay_poses" "$folder"
