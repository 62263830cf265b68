#!/bin/sh
# Builds the program in OUT/build. Usage: build.sh OUT. Exit code 77: no GetFEM here.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
if ! printf '#include <getfem/getfem_models.h>\n' | c++ -E -x c++ - >/dev/null 2>&1; then
  echo "skipped: GetFEM is not installed (apt-get install libgetfem-dev)"
  exit 77
fi
mkdir -p "$1"
cmake -S "$here" -B "$1/build" >"$1/build.log"
cmake --build "$1/build" >>"$1/build.log" 2>&1 || {
  cat "$1/build.log"
  exit 1
}
