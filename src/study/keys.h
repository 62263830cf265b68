// Keys of campaigns: a hash of everything on which a result depends, by which results are found and
// shards assigned.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "study/study.h"

namespace frictab::study {

// XXH64 of the version of frictab, the last stage, the resolved job, and the bytes of the
// campaign's files with their names (an experiment may be called after its file) but not their
// folders; for a twin, of its block and seed. Throws InputError where files cannot be read or do
// not fit the job's rules. Adds the campaign's files to `files`.
std::uint64_t key_of(const Study& study, const Campaign& campaign, WatchedFiles& files);

// The error that key_of throws for a file that cannot be read.
InputError no_such_file(const std::string& file);

// Converts a key to 16 hex digits, the name of the result's folder, and back.
std::string key_text(std::uint64_t key);
std::optional<std::uint64_t> read_key(std::string_view text);

// Returns the campaign's job with its files; a twin has none.
job::Job job_of(const Study& study, const Campaign& campaign);

} // namespace frictab::study
