// The base job with overrides, resolved once per list of overrides.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "study/study.h"

namespace frictab::study {

class ResolvedJobs {
public:
  // Reads the job file; `set` applies to every campaign, after its own overrides. Throws InputError
  // with all faults of the file.
  ResolvedJobs(std::string file, std::vector<std::string> set);

  // Returns the index in jobs() of the job with these overrides. Faults are added at `place`, once
  // for each list; the index is then meaningless.
  std::size_t find(const std::vector<std::string>& set, const Place& place, FaultList& faults);

  std::vector<ResolvedJob> take() { return std::move(jobs_); }
  // Folder of the job file; campaigns' files are relative to it.
  const std::string& folder() const { return folder_; }

private:
  ResolvedJob resolve(const std::vector<std::string>& set) const;

  std::string file_, text_, folder_;
  std::vector<std::string> set_;
  std::map<std::vector<std::string>, std::size_t> known_;
  std::vector<ResolvedJob> jobs_;
};

} // namespace frictab::study
