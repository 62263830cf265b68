#!/bin/sh
# Compiles the C routines below RESULTS/export/c to RESULTS/LAW.so, or the only one to
# RESULTS/routine.so. Usage: routines.sh RESULTS
set -eu
# The program calls a routine with the six states; one with other arguments (of a traced effect) must
# not be loaded: the added line does not compile then.
compile() {
  { cat "$1/frictab_tau_R.c" && echo 'double (*frictab_six_states)(double, double, double, double,
    double, double) = frictab_tau_R;'; } |
    cc -std=c99 -O2 -ffp-contract=off -Werror -shared -fPIC -I"$1" -x c - -o "$2" -lm
}
if [ -e "$1/export/c/frictab_tau_R.c" ]; then
  compile "$1/export/c" "$1/routine.so"
  exit
fi
for folder in "$1"/export/c/*/; do
  compile "$folder" "$1/$(basename "$folder").so"
done
