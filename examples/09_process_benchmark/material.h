// Finite plasticity of an isotropic metal in axisymmetry (coordinates r, z; hoop direction t).
//
// Kinematics: F = Fe Fp; elastic left Cauchy-Green tensor be = Fe Fe^T = F Cp^-1 F^T, where Cp^-1
// (plastic) is kept between steps. Elasticity: Hencky's, Kirchhoff stress
//   tau = 2 G dev(e) + pressure I,   e = ln(be)/2,
// with the pressure as a field of its own (mixed method) and ln J = pressure/K in the mean.
// Plasticity: von Mises with isotropic hardening sigma_f(ep) = C (e0 + ep)^n, integrated by the
// exponential map, for which return mapping in logarithmic strain is the radial return of small
// strains: with the trial strain e_tr from F Cp^-1_old F^T,
//   q_tr = sqrt(3/2) |2 G dev e_tr|,   q_tr - 3 G dep = sigma_f(ep_old + dep),
//   s = (1 - 3 G dep/q_tr) 2 G dev e_tr.
// (Simo, Hughes: Computational Inelasticity, 1998, chapter 9; de Souza Neto, Peric, Owen:
// Computational Methods for Plasticity, 2008, chapter 14.)
//
// The logarithm of be needs no eigenvectors here. For a symmetric 2x2 block b with mean m = tr b/2
// and d^2 = ((b_rr - b_zz)/2)^2 + b_rz^2:  ln b = ln(det b)/2 I + g(d^2/m^2)/m (b - m I),
// g(t) = artanh(sqrt t)/sqrt t, which is smooth at t = 0, where eigenvectors are undefined.
// Likewise exp(a) = exp(m) (cosh d I + sinh(d)/d (a - m I)).
//
// Everything is written for any type of number: Dual gives the consistent tangent (dual.h).
#pragma once

#include "dual.h"

// Symmetric tensor, and deformation gradient, of an axisymmetric state.
template <class S> struct Symmetric { S rr, zz, rz, tt; };
template <class S> struct Gradient { S rr, rz, zr, zz, tt; };

struct Material {
  double young = 210e3, poisson = 0.3;           // MPa, 1
  double strength = 700, offset = 0.01, n = 0.2; // sigma_f = strength (offset + ep)^n, MPa
  double softening = 0;                          // share of sigma_f lost per K above 20 degC

  double shear_modulus() const { return young / (2 * (1 + poisson)); }
  double bulk_modulus() const { return young / (3 * (1 - 2 * poisson)); }
  double thermal_factor(double temperature) const { return 1 - softening * (temperature - 20); }
  double flow_stress(double plastic_strain, double temperature) const;
  double hardening(double plastic_strain, double temperature) const; // d flow_stress/d strain
};

// What a material point remembers: Cp^-1, the accumulated plastic strain, the temperature.
struct History {
  Symmetric<double> plastic{1, 1, 0, 1};
  double strain = 0, temperature = 20;
};

// The increment of plastic strain that solves q_trial - 3 G dep = sigma_f(ep_old + dep); 0:
// elastic.
double plastic_increment(const Material& material, const History& old, double q_trial);

template <class S> struct Returned {
  Symmetric<S> strain; // elastic, logarithmic, deviator only
  S increment;         // of the plastic strain
};

template <class S> S artanh_ratio(const S& t) { // artanh(sqrt t)/sqrt t
  using std::log;
  using std::sqrt;
  if (value_of(t) > 1e-2) {
    const S x = sqrt(t);
    return log((1.0 + x) / (1.0 - x)) / (2.0 * x);
  }
  S sum = 1.0 / 19;
  for (int k = 8; k >= 0; --k) // 1 + t/3 + t^2/5 + ...: exact to rounding below 1e-2
    sum = 1.0 / (2 * k + 1) + t * sum;
  return sum;
}

template <class S> Symmetric<S> elastic_trial(const Gradient<S>& F, const Symmetric<double>& C) {
  const S ar = F.rr * C.rr + F.rz * C.rz, az = F.rr * C.rz + F.rz * C.zz;
  const S br = F.zr * C.rr + F.zz * C.rz, bz = F.zr * C.rz + F.zz * C.zz;
  return {ar * F.rr + az * F.rz, br * F.zr + bz * F.zz, ar * F.zr + az * F.zz, F.tt * F.tt * C.tt};
}

template <class S> Symmetric<S> deviator_of_half_log(const Symmetric<S>& b) {
  using std::log;
  const S m = 0.5 * (b.rr + b.zz), half = 0.5 * (b.rr - b.zz);
  const S t = (half * half + b.rz * b.rz) / (m * m);
  const S along = 0.25 * log(b.rr * b.zz - b.rz * b.rz), across = 0.5 * artanh_ratio(t) / m;
  const S rr = along + across * half, zz = along - across * half, tt = 0.5 * log(b.tt);
  const S mean = (rr + zz + tt) / 3.0;
  return {rr - mean, zz - mean, across * b.rz, tt - mean};
}

template <class S>
Returned<S> return_mapping(const Material& material, const History& old, const Gradient<S>& F) {
  using std::sqrt;
  const double G = material.shear_modulus();
  Symmetric<S> e = deviator_of_half_log(elastic_trial(F, old.plastic));
  const S square = e.rr * e.rr + e.zz * e.zz + e.tt * e.tt + 2.0 * e.rz * e.rz;
  const double q_trial = G * std::sqrt(6 * value_of(square)); // sqrt(3/2) 2 G |dev e|
  const double dep = plastic_increment(material, old, q_trial);
  if (dep == 0) return {e, S(0.0)};
  const S q = G * sqrt(6.0 * square);
  const double slope = material.hardening(old.strain + dep, old.temperature);
  const S increment = chain(q, dep, 1 / (3 * G + slope)); // of the equation solved, differentiated
  const S kept = 1.0 - 3.0 * G * increment / q;
  return {{e.rr * kept, e.zz * kept, e.rz * kept, e.tt * kept}, increment};
}

// First Piola-Kirchhoff stress (rr, rz, zr, zz, tt): P = tau F^-T.
template <class S>
Gradient<S> nominal_stress(const Material& material, const History& old, const Gradient<S>& F,
                           const S& pressure) {
  const Symmetric<S> e = return_mapping(material, old, F).strain;
  const double twice_G = 2 * material.shear_modulus();
  const S rr = twice_G * e.rr + pressure, zz = twice_G * e.zz + pressure;
  const S tt = twice_G * e.tt + pressure, rz = twice_G * e.rz;
  const S det = F.rr * F.zz - F.rz * F.zr;
  return {(rr * F.zz - rz * F.rz) / det, (rz * F.rr - rr * F.zr) / det,
          (rz * F.zz - zz * F.rz) / det, (zz * F.rr - rz * F.zr) / det, tt / F.tt};
}

// The history after a converged step.
History advance(const Material& material, const History& old, const Gradient<double>& F);

// Elastic energy per reference volume of the deviator, N/mm^2.
double shear_energy(const Material& material, const History& now, const Gradient<double>& F);
