// Contact with a rigid die, with friction.
//
// Normal direction: penalty, p = c * depth where the point is inside the die (c in MPa/mm).
// Friction opposes the slip of the step. With the slip speed v = du.e/dt along the die's tangent e,
//   tau = tau_R(p, psi, |v|, T, s, sigma_f) v/sqrt(v^2 + v0^2) p/sqrt(p^2 + p0^2):
// the law times two factors. The first is 1 but for (v0/v)^2/2 where v is well above v0, and
// carries tau smoothly through 0 where the material sticks (Chen, Kobayashi 1978 use an arc
// tangent). The second is 1 but for (p0/p)^2/2, and lets tau begin at 0 where a surface meets the
// die: shear friction would jump there, and Newton's method with it. What the law is asked:
//   psi      da/dA by Nanson's formula: n da = J F^-T N dA, so psi = |cof(F) N|,
//   s        sum of the slip since the point first touched the die,
//   sigma_f  flow stress at the point's own plastic strain, of the return mapping at the surface,
//   T        temperature of the workpiece's surface at the beginning of the step.
// All but s and T depend on the displacement; their derivatives reach Newton's method.
//
// The traction on the area of the billet is t = (-p n - tau e) psi.
#pragma once

#include "die.h"
#include "friction.h"
#include "material.h"

struct ContactSetting {
  const Material* material = nullptr;
  const FrictionLaw* law = nullptr;
  const Die* die = nullptr;
  double penalty = 0;        // MPa/mm
  double sticking_speed = 0; // v0, mm/s
  double soft_pressure = 0;  // p0, MPa
  double time_step = 0;      // s
};

// A surface point: where it is, how it has moved, what it remembers.
template <class S> struct SurfacePoint {
  S r, z, slip_r, slip_z; // position; displacement of this step relative to the die, mm
  Gradient<S> F;
  double normal_r, normal_z; // of the billet, outwards
  double slid;               // mm, before this step
  History history;           // before this step
};

template <class S> struct Traction {
  S r, z; // on the area of the billet, MPa
  bool touches = false;
  ContactState state{};
  double tau = 0, velocity = 0; // along the tangent (n_z, -n_r) of the die
};

// tau_R with its derivatives, for double or Dual states.
inline double evaluate(const FrictionLaw& law, double p, double psi, double v, double T, double s,
                       double flow_stress) {
  return law.stress({p, psi, v, T, s, flow_stress});
}
template <int N>
Dual<N> evaluate(const FrictionLaw& law, const Dual<N>& p, const Dual<N>& psi, const Dual<N>& v,
                 double T, double s, const Dual<N>& flow_stress) {
  std::array<double, 6> by{};
  Dual<N> tau(law.gradient({p.value, psi.value, v.value, T, s, flow_stress.value}, by));
  for (unsigned i = 0; i < N; ++i)
    tau.d[i] = by[0] * p.d[i] + by[1] * psi.d[i] + by[2] * v.d[i] + by[5] * flow_stress.d[i];
  return tau;
}

template <class S> S area_ratio(const Gradient<S>& F, double normal_r, double normal_z) {
  using std::sqrt;
  const S r = F.tt * (F.zz * normal_r - F.zr * normal_z);
  const S z = F.tt * (F.rr * normal_z - F.rz * normal_r);
  return sqrt(r * r + z * z);
}

template <class S> Traction<S> traction(const ContactSetting& set, const SurfacePoint<S>& point) {
  using std::sqrt;
  const DieContact<S> die = set.die->at(point.r, point.z);
  if (value_of(die.depth) <= 0) return {S(0.0), S(0.0)};
  const S p = set.penalty * die.depth, psi = area_ratio(point.F, point.normal_r, point.normal_z);
  const S e_r = die.normal_z, e_z = -die.normal_r; // tangent
  const S v = (point.slip_r * e_r + point.slip_z * e_z) / set.time_step;
  const S speed = value_of(v) < 0 ? -v : v;
  const S dep = return_mapping(*set.material, point.history, point.F).increment;
  const double T = point.history.temperature, strain = point.history.strain + value_of(dep);
  const S sigma_f =
      chain(dep, set.material->flow_stress(strain, T), set.material->hardening(strain, T));
  const S limit = evaluate(*set.law, p, psi, speed, T, point.slid, sigma_f);
  const S tau = limit * v / sqrt(v * v + set.sticking_speed * set.sticking_speed) * p /
                sqrt(p * p + set.soft_pressure * set.soft_pressure);
  return {-(p * die.normal_r + tau * e_r) * psi,
          -(p * die.normal_z + tau * e_z) * psi,
          true,
          {value_of(p), value_of(psi), value_of(speed), T, point.slid, value_of(sigma_f)},
          value_of(tau),
          value_of(v)};
}
