// The job file (TOML) as plain values, with the place of every key for later messages.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "calibrate/options.h"
#include "codegen/options.h"
#include "core/text.h"
#include "data/options.h"
#include "process/options.h"
#include "table/options.h"
#include "trace/options.h"
#include "verify/options.h"

namespace frictab::job {

struct Job {
  std::string file; // as given by the user
  std::string
      command_line_options; // further command-line options: " -o loose --set data.holdout=0.2"
  data::DataOptions data;
  calibrate::ModelOptions models;
  calibrate::CalibrationOptions calibration;
  table::TableOptions table;
  codegen::ExportOptions exports;
  verify::VerifyOptions verify;
  trace::TraceOptions trace;
  process::ProcessOptions process;
  std::string directory = "out"; // relative to the job file, already joined with its directory
  bool replaces_others = false;  // --force: also files in it that frictab did not write
  // Values of file and overrides by section head, as text without places and order; by it a stage
  // recognizes results of a different job. Without table.model, which also selects among tables
  // that exist already.
  std::map<std::string, std::string> sections;
  // Places of the files that keys name, by key and name.
  std::map<std::pair<std::string, std::string>, Place> file_places;

  // Arguments for another command, as advice repeats them: "job.toml -o loose".
  std::string arguments() const { return shell_word(file) + command_line_options; }
};

// Reads and checks a job file; `set` lists "key=value" overrides (TOML values, dotted keys). Throws
// InputError with every fault of the file: syntax, unknown keys (naming the nearest known one),
// wrong types, values out of bounds, unknown laws, targets and quantities.
Job read_job(const std::string& file, const std::vector<std::string>& set = {});
Job parse_job(std::string_view text, const std::string& file,
              const std::vector<std::string>& set = {});

} // namespace frictab::job
