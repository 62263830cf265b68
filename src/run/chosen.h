// Which of the calibrated laws a job names.
#pragma once

#include <string>
#include <vector>

#include "calibrate/calibration.h"
#include "table/options.h"
#include "trace/options.h"

namespace frictab::run {

// The fits of trace.models, each once: "best" is the first candidate of the ranking, "all" every
// law that was fitted to the data, so none of the constants. Names that were not calibrated are
// passed over.
std::vector<const calibrate::ModelFit*> fits_to_trace(const calibrate::Calibration& calibration,
                                                      const trace::TraceOptions& options);

// The fit of this name ("best": the first candidate of the ranking; "recommended": see
// calibrate/recommended.h); where it is empty, of the first name in
// table.model. Throws InputError for a law that was not calibrated.
const calibrate::ModelFit& fit_named(const calibrate::Calibration& calibration,
                                     const std::string& name, const table::TableOptions& options);

// The models of table.model at the quantiles of table.quantile. Throws InputError for a law that
// was not calibrated, or for a quantile that it does not have.
std::vector<models::Model> models_to_tabulate(const calibrate::Calibration& calibration,
                                              const table::TableOptions& options);

} // namespace frictab::run
