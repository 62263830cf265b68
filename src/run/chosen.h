// Selects the calibrated laws that a job names.
#pragma once

#include <string>
#include <vector>

#include "calibrate/calibration.h"
#include "table/options.h"
#include "trace/options.h"

namespace frictab::run {

// Returns the fits of trace.models, each once: "best" is the first candidate of the ranking, "all"
// every law that was fitted to the data, thus without constants. Ignores names that were not
// calibrated.
std::vector<const calibrate::ModelFit*> fits_to_trace(const calibrate::Calibration& calibration,
                                                      const trace::TraceOptions& options);

// Returns laws of a closed form besides the best law, in which effects may show more clearly: the
// one with the fewest numbers among those as good as the recommended law, and the first in the
// ranking. A law found from data takes up much of what differs between tests.
std::vector<const calibrate::ModelFit*> simpler_laws(const calibrate::Calibration& calibration);

// Returns the fit of this name ("best": the first candidate of the ranking; "recommended": see
// calibrate/recommended.h). An empty name stands for the first name in table.model. Throws
// InputError if the law was not calibrated.
const calibrate::ModelFit& fit_named(const calibrate::Calibration& calibration,
                                     const std::string& name, const table::TableOptions& options);

// Returns the models of table.model at the quantiles of table.quantile. Throws InputError for a law
// that was not calibrated, or for a quantile that it does not have.
std::vector<models::Model> models_to_tabulate(const calibrate::Calibration& calibration,
                                              const table::TableOptions& options);

} // namespace frictab::run
