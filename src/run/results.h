// Protects files from being replaced by results: those that the job reads, and those that frictab
// did not write.
#pragma once

#include "io/atomic_file.h"
#include "run/stage_record.h"

namespace frictab::run {

// Runs before long computations. Throws InputError if the output directory has files that are named
// like results but were not written by frictab. Checks nothing if the job may replace files of
// others.
void check_directory(const job::Job& job, const StageRecord& stages);

// Records fingerprints of the staged files, except reports, which list the files of their own
// command.
void record_files(StageRecord& stages, const io::OutputFiles& files);

// Moves the files into place, together with stages.json, which records their origin. Throws
// InputError and changes nothing if a file would replace one that the job reads or, unless the job
// may replace files of others, one that frictab did not write.
void commit_results(const job::Job& job, StageRecord& stages, io::OutputFiles& files);

// Writes verify.xml alone, of a verification that could not be carried out: all other results stay
// as they were. Throws InputError if another process writes in the directory, or, unless
// `replaces_others`, if frictab did not write the verify.xml there.
void write_verify_xml(const std::filesystem::path& directory, const std::string& xml,
                      bool replaces_others);

} // namespace frictab::run
