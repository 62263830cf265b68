// The base job with overrides, each list of them once.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "study/study.h"

namespace frictab::study {

class ResolvedJobs {
public:
  // Reads the job file; `set` holds for every campaign, behind its own. Throws InputError with all
  // faults of the file.
  ResolvedJobs(std::string file, std::vector<std::string> set);

  // The number among jobs() of the job with these overrides. Faults are added at `place`, once for
  // each list; then the number means nothing.
  std::size_t find(const std::vector<std::string>& set, const Place& place, FaultList& faults);

  std::vector<ResolvedJob> take() { return std::move(jobs_); }
  // Of the job file; what campaigns name lies relative to it.
  const std::string& folder() const { return folder_; }

private:
  ResolvedJob resolve(const std::vector<std::string>& set) const;

  std::string file_, text_, folder_;
  std::vector<std::string> set_;
  std::map<std::vector<std::string>, std::size_t> known_;
  std::vector<ResolvedJob> jobs_;
};

} // namespace frictab::study
