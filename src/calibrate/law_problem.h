// A law and the rows that it is fitted to: all rows and thinned copies of them.
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

// Coarse-to-fine fit: starts are tried on a few hundred rows, the survivors are refined on a few
// thousand, and only two or three evaluations use all rows.
class LawProblem {
public:
  // The data must have inputs(law) and tau_R_MPa, and outlive the problem. `own_tau_MPa`: the law's
  // own shear stress per row, for histories that follow it; may be empty otherwise.
  LawProblem(const models::Law& law, const models::Conventions& conventions,
             const data::Dataset& data, std::span<const double> own_tau_MPa = {});

  // Returns the best fit found. L1 is smoothed over a thousandth of the residuals; with one
  // parameter it is exact (weighted median).
  LawFit fit(Loss loss, double huber_delta_MPa) const;

  // Adds standard errors, with recordings as clusters (data/recordings.h), and remarks; moves the
  // parameters to Uncertainty::settled if that does not increase the loss.
  void add_uncertainty(LawFit& fit, Loss loss, double huber_delta_MPa,
                       const data::Dataset& data) const;

  const InputColumns& columns() const { return columns_; }

private:
  using Starts = std::vector<std::vector<double>>;
  struct Level {
    std::vector<std::vector<double>> kept; // a thinned copy: columns, tau_R and, if given, weights
    std::vector<const double*> columns;
    std::span<const double> measured;
    std::span<const double> weights; // empty: equal
    std::optional<expr::BoundProgram> formula;
  };
  FitProblem problem(const Level& level) const;
  void add_thinned(std::size_t rows);
  std::vector<FitResult> search(const Level& level, const Starts& offered,
                                LossFunction& loss) const;

  // Returns start values from an algorithm for this law; empty for laws that need a search.
  Starts law_starts() const;

  const models::Law& law_;
  models::Conventions conventions_;
  const data::Dataset& data_;
  InputColumns columns_;
  std::vector<double> weights_; // of all rows; empty: equal
  expr::Program program_;
  std::deque<Level> levels_; // coarse to fine; the last has all rows
};

} // namespace frictab::calibrate
