#!/bin/sh
# Called by conda-build in the unpacked source.
set -eu
cmake -S . -B build -G Ninja $CMAKE_ARGS -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON \
  -DCMAKE_UNITY_BUILD_BATCH_SIZE=16 -DFRICTAB_TESTS=OFF
cmake --build build
cmake --install build
