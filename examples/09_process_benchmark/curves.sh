#!/bin/sh
# The classical calibration curves of the ring test: inner radius for friction factors m.
# Usage: curves.sh OUT
set -eu
here=$(cd "$(dirname "$0")" && pwd)
python=$(command -v /usr/bin/python3 || echo python3) # with numpy and h5py of the packages
mkdir -p "$1/curves"
for m in 0 0.05 0.1 0.2 0.3 0.5 1; do
  "$1/build/process_benchmark" ring --law shear:$m --output "$1/curves/$m" >"$1/curves/$m.log"
done
for truth in "$1"/*/truth; do
  "$python" "$here/plot.py" "$(dirname "$truth")" "$1/curves"
done
