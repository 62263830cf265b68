// Heat in the billet, between the mechanical steps (staggered): after each step of time dt
//   c (T - T_before)/dt - div(k grad T) = share * plastic work/dt,
//   at the die:  flux out = film (T - T_tool) - half the friction work/dt,
// with linear elements, backward Euler, conduction on the deformed body (grad = F^-T Grad) and the
// heat capacity c per volume of the billet. The tool keeps its temperature, and takes the other
// half of the friction heat. (Taylor, Quinney 1934: share 0.9.)
#pragma once

#include "billet.h"

class Heat {
public:
  Heat(Billet& billet, const HeatData& data, double temperature);
  void step(double time_step); // after Billet::keep; gives the billet its temperatures

private:
  Billet& billet_;
  HeatData data_;
  getfem::mesh_fem mf_;
  getfem::model model_;
};
