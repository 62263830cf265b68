// Files that a job names, looked for before they are read, so that the job's line is reported.
#pragma once

#include "job/job.h"

namespace frictab::job {

// Throws InputError with each file of [data], or of [process], that is not there, and each glob or
// folder that holds none.
void check_data_files(const Job& job);
void check_process_files(const Job& job);

} // namespace frictab::job
