/* What hook.sh makes CalculiX call: the friction coefficient at a contact point, tau_R/p of the
 * routine that frictab has generated. CalculiX has no units; the deck is in N, mm, s, degC. */
#include <math.h>
#include <stdatomic.h>

#include "frictab_tau_R.h"

/* States that a contact spring of CalculiX does not know: -DUSRMU_PSI=... of the compiler. */
#ifndef USRMU_PSI
#define USRMU_PSI 2.0
#endif
#ifndef USRMU_SIGMA_F
#define USRMU_SIGMA_F 480.0
#endif
/* CalculiX gives 0 degC where a deck has no temperatures: this one then. */
#ifndef USRMU_T
#define USRMU_T 150.0
#endif

/* Every thread writes the same number; atomic, so that it is no race. */
static _Atomic double time_increment;

void usrmu_time_(const double* dtime) {
  atomic_store_explicit(&time_increment, *dtime, memory_order_relaxed);
}

/* al: relative displacement since the start of the increment; val: its part along the normal xn;
 * t: tangential displacement since first contact (the slip of a straight path, with the elastic
 * slip of the penalty); t1l: temperature of the first two nodes. um is left alone without contact,
 * where it multiplies a force of 0. */
void usrmu_(double* um, const double* pressure, const double al[3], const double xn[3],
            const double* val, const double t[3], const double* t1l) {
  const double dtime = atomic_load_explicit(&time_increment, memory_order_relaxed);
  const double x = al[0] - *val * xn[0], y = al[1] - *val * xn[1], z = al[2] - *val * xn[2];
  const double slip = sqrt(x * x + y * y + z * z);
  const double path = sqrt(t[0] * t[0] + t[1] * t[1] + t[2] * t[2]);
  if (*pressure <= 0) return;
  *um = frictab_tau_R(*pressure, USRMU_PSI, dtime > 0 ? slip / dtime : 0, *t1l != 0 ? *t1l : USRMU_T,
                      path, USRMU_SIGMA_F) /
        *pressure;
}
