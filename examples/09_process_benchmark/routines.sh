#!/bin/sh
# Compiles the C routines below RESULTS/export/c to RESULTS/LAW.so, or the only one to
# RESULTS/routine.so. Usage: routines.sh RESULTS
set -eu
compile() { cc -std=c99 -O2 -ffp-contract=off -shared -fPIC "$1/frictab_tau_R.c" -o "$2" -lm; }
if [ -e "$1/export/c/frictab_tau_R.c" ]; then
  compile "$1/export/c" "$1/routine.so"
  exit
fi
for folder in "$1"/export/c/*/; do
  compile "$folder" "$1/$(basename "$folder").so"
done
