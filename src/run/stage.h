// The stages of a job, in the order of a run: what each goes on from, which sections of the job its
// results depend on, what it writes, and how it is loaded or run. Commands, --dry-run, status,
// resuming and stages.json all read this one table.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace frictab::run {

class ResultDirectory;
class StageRecord;
struct Run;

struct Stage {
  std::string name; // also that of its command
  std::vector<std::string> needs =
      {}; // stages whose results it goes on from: made first if missing
  std::vector<std::string> sections = {}; // of the job; none: its results are not recorded
  // Files that later stages read, then those for people alone; "models/" is a whole folder.
  std::vector<std::string> results = {}, pages = {};
  bool optional = false;       // no gap where it has not run
  std::string made_first = {}; // the note where another stage had to run it

  // Whether an earlier run has left its results.
  bool (*is_there)(const ResultDirectory&, const StageRecord&) = nullptr;
  // Takes its results from an earlier run; `wanted_by` is the stage that goes on from them.
  void (*load)(Run&, std::string_view wanted_by) = nullptr;
  void (*run)(Run&) = nullptr;

  bool is_recorded() const { return !sections.empty(); }
  std::vector<std::string> writes() const; // results, then pages
};

const std::vector<Stage>& all_stages();
const Stage& stage_named(std::string_view name);

} // namespace frictab::run
