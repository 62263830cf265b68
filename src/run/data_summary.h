// Output of `frictab data`: the data of a job as they were read, before anything is fitted.
#pragma once

#include <string>

#include "run/job_data.h"

namespace frictab::run {

// Lists all tests, the other columns, then what was converted, computed, joined and left out.
std::string data_text(const JobData& data);
std::string data_json(const JobData& data);

// Returns training and validation as one campaign in canonical units. Adds the text column `use`
// (train or validate) unless the data already have it.
data::Dataset canonical(const JobData& data);

} // namespace frictab::run
