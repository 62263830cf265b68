// What `frictab data` shows: the data of a job as they were read, before anything is fitted.
#pragma once

#include <string>

#include "run/job_data.h"

namespace frictab::run {

// A table of all tests, then what was converted, computed, joined and left out.
std::string data_text(const JobData& data);
std::string data_json(const JobData& data);

// Training and validation as one campaign in canonical units, with the text column `use` (train or
// validate), unless they have one.
data::Dataset canonical(const JobData& data);

} // namespace frictab::run
