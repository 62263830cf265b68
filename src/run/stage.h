// A stage of a job: the stages it needs, the sections of the job that its results depend on, the
// files it writes, and the functions that load or run it. The table of all stages (run.cpp) is in
// the order of a run; commands, --dry-run, status, resuming and stages.json all read it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "job/job.h"

namespace frictab::run {

class ResultDirectory;
class StageRecord;
struct Run;

struct Stage {
  std::string name; // also the name of its command
  // Stages whose results it needs; run first if their results are missing.
  std::vector<std::string> needs = {};
  bool makes_missing = true; // false: a gate, which names missing results instead of making them
  std::vector<std::string> sections = {}; // sections of the job; empty: results are not recorded
  // Files that later stages read, and pages that only people read; "models/" is a whole folder.
  std::vector<std::string> results = {}, pages = {};
  bool optional = false; // not running it leaves no gap
  // False if the job leaves nothing to do for it, so that no stage needs it. Null: always true.
  bool (*applies)(const job::Job&) = nullptr;
  std::string made_first = {}; // note to the user, if another stage had to run it first

  // True if an earlier run has left its results. Null for stages that no other stage needs.
  bool (*is_there)(const ResultDirectory&, const StageRecord&) = nullptr;
  // Loads its results of an earlier run into the Run; `wanted_by` is the stage that needs them.
  // Null for the last stage.
  void (*load)(Run&, std::string_view wanted_by) = nullptr;
  // Computes its values from those of earlier stages, stores them in the Run and writes its files.
  void (*run)(Run&) = nullptr;

  bool applies_to(const job::Job& job) const { return !applies || applies(job); }
  bool is_recorded() const { return !sections.empty(); }
  std::vector<std::string> writes() const; // results, then pages
  std::string folder_or_file() const;      // its first result: "calibration.json", "tables"
};

const std::vector<Stage>& all_stages();
const Stage& stage_named(std::string_view name);

} // namespace frictab::run
