// Results go neither over what the job reads, nor over files that frictab did not write.
#pragma once

#include "io/atomic_file.h"
#include "run/stage_record.h"

namespace frictab::run {

// Before a long run: throws InputError where the output directory holds files that are called like
// results and that frictab did not write. Not where the job replaces files of others.
void check_directory(const job::Job& job, const StageRecord& stages);

// Fingerprints of the files that are staged; not of reports, which list what their command wrote.
void record_files(StageRecord& stages, const io::OutputFiles& files);

// Puts the files in place, stages.json among them, which says what they are. Throws InputError, and
// leaves everything as it was, where one of them would stand in place of a file that the job reads
// or, unless the job replaces files of others, of one that frictab did not write.
void commit_results(const job::Job& job, StageRecord& stages, io::OutputFiles& files);

} // namespace frictab::run
