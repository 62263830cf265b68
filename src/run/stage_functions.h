// What each stage does: its values from those of the stages before it, then its files. Only the
// table of stages (run.cpp) calls these.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "run/run.h"

namespace frictab::run {

void calibrate_laws(Run& run);
void trace_laws(Run& run); // laws with effects join the calibration
void tabulate_laws(Run& run);
void export_sources(Run& run);
void verify_tables(Run& run);
void write_report(Run& run);
void time_forms(Run& run); // table or the law itself: for the summary alone, never written

// From an earlier run, for the stage `wanted_by`.
void load_calibration(Run& run, std::string_view wanted_by);
void load_traces(Run& run, std::string_view wanted_by);
void load_tables(Run& run, std::string_view wanted_by);
void load_verification(Run& run, std::string_view wanted_by);

// calibration.json, benchmark.md, errors_by_experiment.csv and models/ of a run.
void write_calibration(Run& run);

// Does `work`; where memory runs out in it, the message says how many rows are in memory.
void with_rows_in_memory(const JobData& data, const std::function<void()>& work);

// Where the sources of a table lie: "export/c" where there is one table, "export/c/<model>" where
// there are several.
std::string export_directory(const Run& run, const std::string& target, const table::Table& table);
codegen::ExportRequest export_request(const job::Job& job, const std::string& target,
                                      const table::Table& form);

} // namespace frictab::run
