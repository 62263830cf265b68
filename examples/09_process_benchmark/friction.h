// Friction laws as the process sees them: tau_R of six states and its gradient. A law is either the
// C routine that `frictab` has generated, compiled to a shared library and loaded here while the
// program runs, so that one program serves every law; or one of two formulas of the textbooks,
//   shear friction  tau_R = m k, k = sigma_f/sqrt(3),   Coulomb friction  tau_R = min(mu p, k),
// that the checks need without frictab.
#pragma once

#include <array>
#include <memory>
#include <string>

// The state of a contact point, in the order of the routine's arguments and gradient.
struct ContactState {
  double pressure;    // sigma_n_MPa
  double expansion;   // psi, area now over area of the billet
  double speed;       // v_rel_mm_s
  double temperature; // T_contact_C
  double slid;        // s_mm
  double flow_stress; // sigma_f_MPa
};

class FrictionLaw {
public:
  virtual ~FrictionLaw() = default;
  virtual double stress(const ContactState& state) const = 0;
  virtual double gradient(const ContactState& state, std::array<double, 6>& by) const = 0;
  // Bits of the states beyond the campaign's range; 0 for a formula.
  virtual unsigned outside(const ContactState& state) const = 0;
};

// `none`, `shear:M`, `coulomb:MU`, or the path of a compiled routine (LIBRARY.so).
std::unique_ptr<FrictionLaw> friction_law(const std::string& text);
