// What an effect of the synthetic campaign may follow: columns, histories, hidden causes.
#pragma once

#include <string>
#include <vector>

#include "core/error.h"
#include "twin/twin_draft.h"

namespace frictab::twin {

// Adds a fault where `name` is unknown or does not go with the form (text and numbers), or where
// the truth has no limit that an effect on it could change.
void check_column(const EffectSpec& spec, const std::string& name, const TwinDraft& draft,
                  FaultList& faults);

// Column, derived quantity or "latent", one value per row; `effect` = index in options.effects,
// `tests` = experiments of both parts. Histories follow the law without effects.
std::vector<double> quantity_rows(const TwinOptions& options, std::size_t effect,
                                  const std::string& name, std::size_t tests,
                                  const TwinDraft& draft);

} // namespace frictab::twin
