// Is the friction in the solved step that of the routine? Asked again from outside: the traction is
// what GetFEM has assembled, split into p and tau by the die's normal; psi is det(F) |F^-T N| by
// GetFEM's own determinant and inverse; the slip speed comes from the displacements; sigma_f from
// the plastic strain that is kept after the step. The routine is called once more with these, its
// value times the factors of contact.h is compared with tau. To be called before Billet::keep.
#include "billet.h"

#include <cmath>

double Billet::friction_error() const {
  const std::string F = "(Id(2)+Grad_u)", H = "[Grad_u(1,1),Grad_u(1,2),Grad_u(2,1),Grad_u(2,2),"
                                              "u(1)/X(1)]";
  const Vector t = at_contact("Die_traction(" + H + ",u,X,u_before,Normal,memory)", 2),
               psi = at_contact("(1+u(1)/X(1))*Det(" + F + ")*Norm(Inv(" + F + "')*Normal)", 1),
               x = at_contact("X+u", 2), slip = at_contact("u-u_before", 2),
               strain = at_contact(H, 5);
  const Vector& memory = model_.real_variable("memory");
  double worst = 0;
  for (std::size_t i = 0; i < psi.size(); ++i) {
    const DieContact<double> die = set_.die->at(x[2 * i], x[2 * i + 1]);
    if (die.depth <= 0) continue;
    const double* h = &strain[5 * i];
    const std::size_t m = memory_size * i;
    const History now = advance(*set_.material, unpack_history(memory, m),
                                {1 + h[0], h[1], h[2], 1 + h[3], 1 + h[4]});
    const double p = -(t[2 * i] * die.normal_r + t[2 * i + 1] * die.normal_z) / psi[i];
    const double tau = -(t[2 * i] * die.normal_z - t[2 * i + 1] * die.normal_r) / psi[i];
    const double v = (slip[2 * i] * die.normal_z - slip[2 * i + 1] * die.normal_r) / set_.time_step;
    const double limit =
        set_.law->stress({p, psi[i], std::abs(v), now.temperature, memory[m + history_size],
                          set_.material->flow_stress(now.strain, now.temperature)});
    const double factor =
        v / std::hypot(v, set_.sticking_speed) * p / std::hypot(p, set_.soft_pressure);
    worst = std::max(worst, std::abs(tau - limit * factor));
  }
  return worst;
}
