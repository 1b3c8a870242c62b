#!/bin/bash -eu
# Builds the fuzz targets of the runtime as OSS-Fuzz asks for: compilers, flags and folders come in the environment.
# docs/packages.md says how it was tried.
cmake -S "$SRC/spherecloud" -B "$WORK/build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DSPHC_HOST=OFF -DSPHC_DRIVERS=OFF \
  -DSPHC_EXAMPLES=OFF -DSPHC_SIMD=static -DSPHC_FUZZ=ON -DSPHC_FUZZ_ENGINE="$LIB_FUZZING_ENGINE"
ninja -C "$WORK/build" fuzz_programs fuzz_seeds
for program in "$WORK"/build/tests/fuzz/fuzz_*; do
  name=${program##*/}
  cp "$program" "$OUT/$name"
  (cd "$WORK/build/tests/fuzz/seeds/${name#fuzz_}" && zip -q "$OUT/${name}_seed_corpus.zip" ./*)
done
