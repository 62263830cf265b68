// The stages of a job in a row. Each takes what it needs from memory, or from the files that the
// stage before it wrote.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/calibration.h"
#include "codegen/exporter.h"
#include "io/atomic_file.h"
#include "job/job.h"
#include "models/assembled_law.h"
#include "report/report.h"
#include "run/job_data.h"
#include "run/kept_work.h"
#include "run/result_directory.h"
#include "run/stages.h"
#include "table/table.h"
#include "trace/trace.h"
#include "verify/forms.h"
#include "verify/verify.h"

namespace frictab::run {

class Pipeline {
public:
  explicit Pipeline(job::Job job);

  // Goes on from what an earlier run of this job had finished, if it did not end, and keeps what
  // this one finishes. Of a run of all stages, before the first.
  void go_on();
  // What is kept, for who sees this run fail or stops it; empty where nothing is.
  std::string kept_text() const;

  // Stages; each stages its files in the output directory. Nothing appears there before commit().
  void calibrate();
  // Searches the residuals of trace.models; laws with effects join the calibration.
  void trace();
  void tabulate();
  void generate(); // sources
  void verify();
  void compare_forms(); // table or the law itself: measured, told by the summary, never written
  void report();
  void deliver(); // tabulate, generate, verify and report, in a row
  // Moves all files into place.
  void commit();

  // What the stages found, for summaries. Empty where the stage did not run.
  const job::Job& job() const { return job_; }
  const std::optional<JobData>& data() const { return data_; }
  const std::optional<calibrate::Calibration>& calibration() const { return calibration_; }
  const std::vector<trace::Trace>& traces() const { return traces_; }
  const std::vector<table::Table>& tables() const { return tables_; }
  const std::optional<verify::Verification>& verification() const { return verification_; }
  // Tables made in this run that drift further than allowed, in words.
  const std::vector<std::string>& missed() const { return missed_; }
  const std::vector<verify::FormComparison>& forms() const { return forms_; }
  const std::vector<std::string>& notes() const { return notes_; } // what a user should know
  std::vector<std::string> files() const { return output_.paths(); }

private:
  // Where no stage of this run has made them, from the job's files or an earlier run. What is not
  // there is made first; what was made from other data or another job is an InputError.
  void load_data();
  void with_rows(const std::function<void()>& work) const;
  void load_calibration();
  void load_tables();
  void load_sources();
  void check_fresh(const std::string& stage, const std::string& files) const;
  void check_as_written(const std::string& stage, const std::string& path) const;
  void remove_earlier(const std::vector<std::string>& called_like_results, std::string_view folder);
  void check_origin(table::Table& table); // of a table of an earlier run
  std::string data_key() const;           // empty where the data were not read

  void take_kept_calibration();
  bool take_kept_table(const std::string& model, table::Table& table);
  table::Table staged_table(const std::string& model) const; // as it was written
  // What is finished so far outlives the process.
  void keep_so_far();

  void write_calibration();
  void add_traced_laws();
  table::Table made_table(const models::AssembledLaw& law); // and its file
  table::Table sample_table(const models::AssembledLaw& law);
  void measure_drift(const models::AssembledLaw& law, table::Table& table);
  void write_table_file(const table::Table& table);
  const codegen::SourceBundle& sources_in(const std::string& directory);
  std::vector<verify::GeneratedSource> sources_of(const table::Table& table,
                                                  const table::Table& direct);

  const calibrate::ModelFit& fit_of(const models::Model& model) const;
  double mean_stress() const;                         // measured, MPa
  double law_error(const models::Model& model) const; // on unseen tests, MPa
  table::Tolerance tolerance_of(const models::Model& model) const;
  table::Tolerance drift_allowed(const models::Model& model) const;
  table::TableOptions table_options(const models::Model& model) const; // with that tolerance
  verify::VerifyInput verify_input(const models::AssembledLaw& law, const table::Table& table,
                                   const std::string& name) const;
  const data::Dataset& data_behind(const models::Model& model) const;
  const models::AssembledLaw& assembled(const models::Model& model);
  const models::AssembledLaw& law_of(const table::Table& table);
  table::Table direct_for_sources(const table::Table& table);
  codegen::ExportRequest request_for(const std::string& target, const table::Table& form) const;
  void generate_one(const codegen::Exporter& exporter, const codegen::ExportRequest& request,
                    const std::string& directory);
  // "export/c" where there is one table, "export/c/<model>" where there are several.
  std::string export_directory(const std::string& target, const table::Table& table) const;
  std::vector<report::Recipe> recipes() const;

  job::Job job_;
  io::OutputFiles output_; // first: it finishes what a process that died had begun
  ResultDirectory earlier_;
  Stages stages_;
  std::optional<KeptWork> kept_;    // of a run of all stages
  std::atomic<bool> keeps_ = false; // read when the run is interrupted
  std::optional<JobData> data_;
  std::optional<calibrate::Calibration> calibration_;
  bool new_calibration_ = false; // traces that lie in the directory belong to another one
  std::vector<trace::Trace> traces_;
  std::map<std::string, models::AssembledLaw> laws_; // those that have met a table, by model name
  std::vector<table::Table> tables_;
  std::map<std::string, verify::DriftRecord>
      compared_;           // each new table with its law, by model name
  bool verifying_ = false; // a changed table is what verification is there to measure
  std::vector<std::string> missed_;
  std::map<std::string, codegen::SourceBundle> sources_; // by export directory
  std::optional<verify::Verification> verification_;
  std::vector<verify::FormComparison> forms_;
  std::vector<std::string> notes_;
};

} // namespace frictab::run
