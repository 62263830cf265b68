// The closed form of /FRICTION that is nearest to a law, as a card and the loss it costs.
//
// Each form is fitted to tau_R (MPa, not mu, so that a coefficient counts by the stress it makes)
// at the nodes of both states' ranges and between them, by least squares. Of the fitted forms the
// one with the smallest largest error is chosen, because a table or a routine is judged by its
// largest drift as well; a simpler one whose largest error is as good as the smallest precedes it.
#pragma once

#include "card.h"
#include "codegen/native_grid.h"
#include "codegen/native_table.h"

namespace frictab::openradioss::friction {

// Differences in tau_R from the law at the fixed states, MPa.
struct Loss {
  double rms_MPa = 0;                      // over states that fill the tested range
  double worst_MPa = 0;                    // largest found there
  double pressure_MPa = 0, speed_mm_s = 0; // its state
  double below_MPa = 0;                    // largest found in the decade below the tested pressures
};

struct FittedCard {
  Card card; // solver's units, numbers as the text has them
  Loss loss;
};

// `problem`: axes sigma_n_MPa and v_rel_mm_s; takes_speed: whether tau_R depends on the second.
FittedCard fit_card(const codegen::NativeProblem& problem, bool takes_speed);

} // namespace frictab::openradioss::friction
