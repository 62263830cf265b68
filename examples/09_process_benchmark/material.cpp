#include "material.h"

#include <cmath>
#include <stdexcept>

double Material::flow_stress(double plastic_strain, double temperature) const {
  return thermal_factor(temperature) * strength * std::pow(offset + plastic_strain, n);
}

double Material::hardening(double plastic_strain, double temperature) const {
  return flow_stress(plastic_strain, temperature) * n / (offset + plastic_strain);
}

double plastic_increment(const Material& material, const History& old, double q_trial) {
  const double stiffness = 3 * material.shear_modulus();
  double dep = 0;
  // The rest is convex and falls: from 0 on, Newton's method comes closer from one side only.
  for (int i = 0; i < 50; ++i) {
    const double strain = old.strain + dep;
    const double rest = q_trial - stiffness * dep - material.flow_stress(strain, old.temperature);
    if (rest <= 1e-13 * q_trial) return dep;
    dep += rest / (stiffness + material.hardening(strain, old.temperature));
  }
  if (!(dep < 10)) throw std::runtime_error("the return mapping did not converge");
  return dep;
}

namespace {

Symmetric<double> exponential(const Symmetric<double>& a) {
  const double m = 0.5 * (a.rr + a.zz), half = 0.5 * (a.rr - a.zz), d = std::hypot(half, a.rz);
  const double scale = std::exp(m), ratio = d > 1e-8 ? std::sinh(d) / d : 1;
  return {scale * (std::cosh(d) + ratio * half), scale * (std::cosh(d) - ratio * half),
          scale * ratio * a.rz, std::exp(a.tt)};
}

} // namespace

History advance(const Material& material, const History& old, const Gradient<double>& F) {
  const Returned<double> now = return_mapping(material, old, F);
  History next = old;
  next.strain += now.increment;
  const double det = F.rr * F.zz - F.rz * F.zr, mean = std::log(det * F.tt) / 3; // ln J / 3
  const Symmetric<double>& e = now.strain;
  const Symmetric<double> be =
      exponential({2 * (e.rr + mean), 2 * (e.zz + mean), 2 * e.rz, 2 * (e.tt + mean)});
  const Gradient<double> inverse{F.zz / det, -F.rz / det, -F.zr / det, F.rr / det, 1 / F.tt};
  next.plastic = elastic_trial(inverse, be); // Cp^-1 = F^-1 be F^-T
  return next;
}

double shear_energy(const Material& material, const History& now, const Gradient<double>& F) {
  const Symmetric<double> e = deviator_of_half_log(elastic_trial(F, now.plastic));
  const double square = e.rr * e.rr + e.zz * e.zz + e.tt * e.tt + 2 * e.rz * e.rz;
  return material.shear_modulus() * square;
}
