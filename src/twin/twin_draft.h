// One part of the campaign before effects are planted and noise is applied.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "twin/twin.h"

namespace frictab::twin {

struct TwinDraft {
  data::Dataset data;                  // tau_R_MPa is still 0
  TauPieces base;                      // without effects
  std::shared_ptr<const LawTruth> law; // empty: the twin's own physics
  std::vector<double> noise;           // measured = truth * noise
  std::span<const TwinExperiment> plan;
  unsigned part = 0;
};

// Drafts canonical columns, bystanders and noise of all experiments of one part (0 training, 1
// validation).
TwinDraft draft_part(const TwinOptions& options, const TwinParameters& set, const TwinPlan& plan,
                     unsigned part);

// Returns the noise-free tau per row, MPa.
std::vector<double> tau_of(const TwinDraft& draft, const TauPieces& pieces);
std::vector<double> base_tau(const TwinDraft& draft); // without effects

// Appends a column of zeros.
data::Column& add_column(data::Dataset& data, const char* name, std::size_t rows);

// Returns the values of tau_R_MPa.
std::vector<double>& measured_of(data::Dataset& data);

} // namespace frictab::twin
