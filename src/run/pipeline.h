// The stages of a job in a row. Each takes what it needs from memory, or from the files that the
// stage before it wrote.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/calibration.h"
#include "codegen/exporter.h"
#include "io/atomic_file.h"
#include "job/job.h"
#include "table/table.h"
#include "trace/trace.h"
#include "verify/forms.h"
#include "verify/verification.h"

namespace frictab {

class Pipeline {
public:
  explicit Pipeline(Job job);

  // Stages; each stages its files in the output directory. Nothing appears there before commit().
  void calibrate();
  // Searches the residuals of trace.models; laws with effects join the calibration.
  void trace();
  // Throws InputError where a table that tabulate() would stream to disk is too large for the
  // sources that are asked for: before hours of sampling.
  void check_sizes();
  void tabulate();
  void generate(); // sources
  void verify();
  void compare_forms(); // table or the law itself: measured, told by the summary, never written
  void report();
  // Moves all files into place.
  void commit();

  // What the stages found, for summaries. Empty where the stage did not run.
  const Job& job() const { return job_; }
  const std::optional<Dataset>& training() const { return training_; }
  const std::optional<Dataset>& validation() const { return validation_; }
  const std::optional<Calibration>& calibration() const { return calibration_; }
  const std::vector<Trace>& traces() const { return traces_; }
  const std::vector<Table>& tables() const { return tables_; }
  const std::optional<Verification>& verification() const { return verification_; }
  // Tables made in this run that drift further than allowed, in words.
  const std::vector<std::string>& missed() const { return missed_; }
  const std::vector<FormComparison>& forms() const { return forms_; }
  const std::vector<std::string>& notes() const { return notes_; } // what a user should know
  std::vector<std::string> files() const { return output_.paths(); }

private:
  void need_data();
  void need_calibration();
  void write_calibration();
  std::vector<const ModelFit*> fits_to_trace() const;
  void add_traced_laws();
  std::vector<std::filesystem::path> table_files() const;
  void need_tables();
  std::vector<Model> chosen_models();
  Table sample_table(const Model& model); // and its place among the output files
  void remove_old_sources();
  ExportRequest request_for(const Table& form) const;
  double drift_allowed() const; // MPa
  Model model_of(const Table& table);
  std::vector<const ModelFit*> chosen_fits();
  // "export/c" where there is one table, "export/c/<model>" where there are several.
  std::string export_directory(const std::string& target, const Table& table) const;
  // Names that a model may have: laws, and what an earlier run left of laws with traced effects.
  std::vector<std::string> model_names() const;
  // Names that a table or its sources may have: laws, and what an earlier run left of
  // their bands and of laws with traced effects.
  std::vector<std::string> table_names() const;

  Job job_;
  OutputFiles output_;
  std::optional<Dataset> training_;
  std::optional<Dataset> validation_;
  // Training and validation together, where the tool itself held out a few of few tests: tracing
  // needs them all, and judges by leaving tests out itself.
  std::optional<Dataset> all_;
  std::optional<Calibration> calibration_;
  bool new_calibration_ = false; // what lies in the directory belongs to another one
  std::vector<Trace> traces_;
  std::vector<Table> tables_;
  std::map<std::string, DriftRecord> compared_; // each new table with its law, by name
  std::vector<std::string> missed_;
  bool have_tables_ = false;
  std::map<std::string, std::map<std::string, std::string>> sources_; // by export directory
  std::optional<Verification> verification_;
  std::vector<FormComparison> forms_;
  std::vector<std::string> notes_;
};

// The summary of what a pipeline holds, as text that is read in ten seconds, or as JSON.
std::string summary_text(const Pipeline& pipeline);
std::string drift_text(const Verification& verification); // the drift section alone
std::string summary_json(const Pipeline& pipeline);

} // namespace frictab
