// process.html: the laws in a simulation of the user's own, as a page that opens offline.
#pragma once

#include <string>

#include "calibrate/calibration.h"
#include "data/dataset.h"
#include "process/process.h"

namespace frictab::report {

// `tests`: of the campaign; `calibration`: its laws. `job`: the job's file.
std::string process_html(const process::Process& process, const data::Dataset& tests,
                         const calibrate::Calibration& calibration, const std::string& job);

} // namespace frictab::report
