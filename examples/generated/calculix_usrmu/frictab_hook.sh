#!/bin/sh
# Inserts calls of USRMU (frictab_usrmu.f) into the sources of CalculiX 2.20, in the folder `src`
# given. Nothing else of CalculiX is changed, and none of its text is kept here.
set -eu
cd "$1"
if grep -q usrmu springforc_f2f.f; then
  echo "already inserted"
  exit 0
fi
# Where the shear force is limited: mu from the pressure, the slip of this increment and the slip
# since first contact, at every contact point.
for file in springforc_f2f.f springstiff_f2f.f springforc_n2f.f springstiff_n2f.f; do
  sed -i '/^ *dfshear=um\*dfnl/i\      call usrmu(um,dfnl/springarea(1),al,xn,val,t,t1l)' "$file"
done
# What is dissipated is the shear stress that was reached, not a constant times the pressure.
sed -i '/^ *shear=dsqrt(stx(5,1,i)/a\      if(pressure.gt.0.d0) um=shear/pressure' frictionheating.f
# The time increment, which the four routines are not given.
sed -i '/^ *call springforc_[fn]2f(/i\      call usrmu_time(dtime)' resultsmech.f
sed -i '/^ *call springstiff_[fn]2f(/i\      call usrmu_time(dtime)' e_c3d.f
grep -c usrmu springforc_f2f.f springstiff_f2f.f springforc_n2f.f springstiff_n2f.f \
  resultsmech.f e_c3d.f
