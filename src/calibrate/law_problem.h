// A law and the rows it is fitted to, on all rows and on thinned copies of them.
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "calibrate/fit.h"
#include "calibrate/input_columns.h"
#include "calibrate/options.h"
#include "calibrate/sandwich.h"
#include "data/dataset.h"

namespace frictab::calibrate {

struct LawFit {
  FitResult result;
  Uncertainty uncertainty; // after add_uncertainty
};

// Coarse to fine: starts are tried on a few hundred rows, the survivors are refined on a few
// thousand, and all rows are seen two or three times only.
class LawProblem {
public:
  // The data must have inputs(law) and tau_R_MPa, and outlive the problem. `own_tau_MPa`, per row:
  // what histories of the law's own shear stress follow; nothing where there are none.
  LawProblem(const models::Law& law, const models::Conventions& conventions,
             const data::Dataset& data, std::span<const double> own_tau_MPa = {});

  // The best fit found. L1 is rounded off over a thousandth of the residuals; with one parameter it
  // is exact (weighted median).
  LawFit fit(Loss loss, double huber_delta_MPa) const;

  // Standard errors, with recordings as clusters (data/recordings.h), and remarks; moves the
  // parameters to Uncertainty::settled where that costs nothing.
  void add_uncertainty(LawFit& fit, Loss loss, double huber_delta_MPa,
                       const data::Dataset& data) const;

  const InputColumns& columns() const { return columns_; }

private:
  using Starts = std::vector<std::vector<double>>;
  struct Level {
    std::vector<std::vector<double>> kept; // of a thinned copy: columns, tau_R, weights if any
    std::vector<const double*> columns;
    std::span<const double> measured;
    std::span<const double> weights; // empty: all alike
    std::optional<expr::BoundProgram> formula;
  };
  FitProblem problem(const Level& level) const;
  void add_thinned(std::size_t rows);
  std::vector<FitResult> search(const Level& level, const Starts& offered,
                                LossFunction& loss) const;

  Starts law_starts() const; // the law's own

  const models::Law& law_;
  models::Conventions conventions_;
  const data::Dataset& data_;
  InputColumns columns_;
  std::vector<double> weights_; // of all rows; empty: all alike
  expr::Program program_;
  std::deque<Level> levels_; // coarse to fine; the last has all rows
};

} // namespace frictab::calibrate
