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

// What effects act on, one value per row. Of the twin's physics: stresses in MPa; of a law: factors
// on mu and on the limit.
struct TauPieces {
  std::vector<double> tau0, limit;
  std::vector<double> shift; // MPa, added in the end
};

// The law as extended_law has it, with one factor per row on mu, on the limit and on what is added.
class LawTruth {
public:
  // Parameters by least squares on tau_R_MPa.
  LawTruth(const models::Law& law, const data::Dataset& physics);

  const models::Law& law() const { return law_; }
  const std::vector<double>& parameters() const { return parameters_; }
  bool has_limit() const; // whether an effect on it is another than on mu

  // MPa, one per row. The data must have the law's inputs.
  std::vector<double> tau(const data::Dataset& data, const TauPieces& pieces,
                          std::span<const double> parameters) const;

  // Parameters by least squares on `measured`, from the true ones, after at most so many steps.
  std::vector<double> recalibrated(const data::Dataset& data, const TauPieces& pieces,
                                   std::span<const double> measured, std::size_t steps = 200) const;

private:
  const models::Law& law_;
  models::Conventions conventions_;
  std::vector<double> parameters_;
  expr::Program program_;
};

// Law names that can be a truth: those calibrated by a fit, of states alone.
std::vector<std::string> truth_names();

} // namespace frictab::twin
