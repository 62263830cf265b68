// The functions of each stage, called only through the table of stages (run.cpp).
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "run/run.h"

namespace frictab::run {

// Run a stage: compute its values from those of earlier stages, store them in `run`, write its
// files.
void calibrate_laws(Run& run);
void trace_laws(Run& run); // adds laws with effects to the calibration
void tabulate_laws(Run& run);
void export_sources(Run& run);
void verify_tables(Run& run);
void judge_process(Run& run);
void write_report(Run& run);
// Times each table against the law itself, for the summary only; writes no file.
void time_forms(Run& run);

// Load results of an earlier run for stage `wanted_by`.
void load_calibration(Run& run, std::string_view wanted_by);
void load_traces(Run& run, std::string_view wanted_by);
void load_tables(Run& run, std::string_view wanted_by);
void load_verification(Run& run, std::string_view wanted_by);

// Writes calibration.json, benchmark.md, errors_by_experiment.csv and models/.
void write_calibration(Run& run);

// Runs `work`. If memory runs out, the message gives the number of rows in memory.
void with_rows_in_memory(const JobData& data, const std::function<void()>& work);

// Makes the table of a law, without figures of its drift; with `grid` on its nodes, without a
// search for better ones (table/build.h).
table::Table sampled_table(const Run& run, const models::AssembledLaw& law,
                           const table::Table* grid = nullptr);

// Folder of a table's sources: "export/c", or "export/c/<model>" if there are several tables.
std::string export_directory(const Run& run, const std::string& target, const table::Table& table);
// Folder of sources that verify takes: of this command, otherwise of an earlier run, which may have
// had more tables.
std::string source_directory(const Run& run, const codegen::Exporter& exporter,
                             const table::Table& table);
// Whether a target's files are made from the law itself instead of its table.
bool is_of_law(const job::Job& job, const codegen::Exporter& exporter);
codegen::ExportRequest export_request(const job::Job& job, const std::string& target,
                                      const table::Table& form);

} // namespace frictab::run
