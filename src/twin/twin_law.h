// A friction law as the truth of a synthetic campaign, instead of its own physics.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "data/dataset.h"
#include "expr/program.h"
#include "models/law.h"

namespace frictab::twin {

// The points at which effects act, one value per row. For the twin's physics: stresses in MPa; for
// a law: factors on mu and on the limit.
struct TauPieces {
  std::vector<double> tau0, limit;
  std::vector<double> shift; // MPa, added at the end
};

// The law in the form of extended_law, with one factor per row on mu, on the limit and on the added
// term.
class LawTruth {
public:
  // Fits the parameters by least squares on tau_R_MPa.
  LawTruth(const models::Law& law, const data::Dataset& physics);

  const models::Law& law() const { return law_; }
  const std::vector<double>& parameters() const { return parameters_; }
  bool has_limit() const; // whether an effect on the limit differs from one on mu

  // Returns tau in MPa, one per row. The data must have the law's inputs.
  std::vector<double> tau(const data::Dataset& data, const TauPieces& pieces,
                          std::span<const double> parameters) const;

  // Fits the parameters by least squares on `measured`, from the true ones, by at most `steps`
  // steps.
  std::vector<double> recalibrated(const data::Dataset& data, const TauPieces& pieces,
                                   std::span<const double> measured, std::size_t steps = 200) const;

private:
  const models::Law& law_;
  models::Conventions conventions_;
  std::vector<double> parameters_;
  expr::Program program_;
};

// Names of laws that can be a truth: those calibrated by a fit, of states alone.
std::vector<std::string> truth_names();

} // namespace frictab::twin
