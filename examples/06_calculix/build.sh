#!/bin/sh
# Fetches CalculiX 2.20 as Debian's source package, inserts the calls of USRMU and builds it with
# the generated routine of ROUTINE (a folder of target calculix_usrmu) into WORK/ccx_NAME.
# Usage: build.sh WORK ROUTINE NAME        NAME: the law, only part of the file's name
# Needs dpkg-dev, gcc, gfortran, libarpack2-dev libspooles-dev liblapack-dev; no root, and no change
# of the machine's list of package sources.
set -eu
mkdir -p "$1"
work=$(cd "$1" && pwd)
routine=$(cd "$2" && pwd)
name=$3
source=$work/calculix-ccx-2.20/ccx_2.20/src
if [ ! -e "$source/ccx_2.20.c" ]; then
  mkdir -p "$work/apt/lists/partial" "$work/apt/cache/archives/partial"
  key=/usr/share/keyrings/debian-archive-keyring.gpg
  echo "deb-src [signed-by=$key] http://deb.debian.org/debian bookworm main" >"$work/apt/sources.list"
  own="-o Dir::Etc::sourcelist=$work/apt/sources.list -o Dir::Etc::sourceparts=/dev/null
       -o Dir::State::lists=$work/apt/lists -o Dir::Cache=$work/apt/cache"
  cd "$work"
  # shellcheck disable=SC2086 # a list of options
  apt-get $own update -q
  # shellcheck disable=SC2086
  apt-get $own source -q calculix-ccx=2.20-1
fi
sh "$routine/frictab_hook.sh" "$source"
cd "$source"
c_flags="-w -O1 -I/usr/include/spooles -DARCH=Linux -DSPOOLES -DARPACK -DMATRIXSTORAGE -DUSE_MT=1"
make -s -j"$(nproc)" CFLAGS="$c_flags" FFLAGS="-w -O1 -fallow-argument-mismatch -fopenmp" \
  ccx_2.20.a ccx_2.20.o >"$work/make.log" 2>&1 || {
  tail "$work/make.log"
  exit 1
}
gfortran -O2 -frecursive -std=legacy -ffixed-line-length-72 -ffp-contract=off -c "$routine/frictab_usrmu.f" \
  -o "$work/usrmu_$name.o"
gfortran -fopenmp ccx_2.20.o "$work/usrmu_$name.o" ccx_2.20.a \
  -lspooles -lpthread -larpack -llapack -lblas -lm -o "$work/ccx_$name"
echo "$work/ccx_$name"
