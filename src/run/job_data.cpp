// Reads a job's data and splits them if the job does not.
#include "run/job_data.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <set>
#include <string>

#include <fmt/format.h>

#include "calibrate/calibration.h"
#include "calibrate/folds.h"
#include "codegen/flow_curve.h"
#include "core/error.h"
#include "core/text.h"
#include "data/append.h"
#include "data/derived.h"
#include "data/file_list.h"
#include "data/leave_out.h"
#include "data/load.h"
#include "data/load_condensed.h"
#include "data/oracle.h"
#include "data/plausibility.h"
#include "data/quantity.h"
#include "data/recordings.h"
#include "data/roles.h"
#include "data/signs.h"
#include "effects/extended_law.h"
#include "job/named_files.h"

namespace frictab::run {

namespace {

// Smallest number of experiments from which a share is held out. With fewer, that share would be
// too small to rank laws by and too large to leave out of the fit.
constexpr std::size_t few_experiments = 30;
constexpr double usual_share = 0.25;

void add_oracle(const data::DataOptions& options, JobData& data) {
  if (options.oracle.empty()) return;
  if (data.training.condensed) {
    data.training.notes.push_back(
        "data.oracle is not read: it is of rows, and these are condensed");
    return;
  }
  if (!calibrate::is_synthetic(data.training))
    throw InputError(options.oracle_place,
                     "data.oracle is for synthetic data: measured data have no known truth",
                     "synthetic data say so in a column `origin`; for measured data, repeated "
                     "tests give the noise floor");
  data::read_oracle(options, data.training, data.validation);
}

// Checks the names in [export.inputs]: besides states they may be a recorded column or history that
// only a traced effect adds to the law, and the strain of a hardening curve.
void check_export_inputs(const codegen::ExportOptions& exports, const data::Dataset& data) {
  std::vector<std::string> known = {codegen::strain_name};
  for (const data::Quantity& quantity : data::quantities())
    if (quantity.state) known.push_back(quantity.name);
  for (const data::DerivedQuantity& derived : data::derived_quantities())
    known.push_back(derived.name);
  for (const data::Column& column : data.columns)
    known.push_back(effects::symbol_of(column.name));
  FaultList faults;
  for (const auto& [key, place] : exports.input_places) {
    const std::size_t dot = key.rfind('.');
    const std::string name = key.substr(dot + 1);
    if (std::ranges::find(known, name) == known.end())
      faults.add(
          place,
          fmt::format("'{}' in [{}] is not a state, history or column", name, key.substr(0, dot)),
          suggest(name, known));
  }
  faults.throw_if_any();
}

// Test files found next to the data that neither of the two lists uses.
std::vector<std::string> unused_by_both(const data::Dataset& a, const data::Dataset& b) {
  std::vector<std::string> both;
  for (const std::string& name : a.unused)
    if (std::ranges::find(b.unused, name) != b.unused.end()) both.push_back(name);
  return both;
}

// Loads all rows, or `blocks` block means per experiment if `blocks` is not 0 (data.condense).
data::Dataset load(const std::vector<std::string>& files, const data::ReadRequest& options,
                   std::size_t blocks) {
  return blocks > 0 ? data::load_condensed(files, options, blocks)
                    : data::load_dataset(files, options);
}

void find_roles(std::span<data::Dataset* const> parts, const data::DataOptions& options) {
  FaultList faults;
  data::check_texts_to_drop(std::vector<const data::Dataset*>(parts.begin(), parts.end()), options,
                            faults);
  data::check_filled_columns(std::vector<const data::Dataset*>(parts.begin(), parts.end()), options,
                             faults);
  data::find_roles(parts, options, faults);
  faults.throw_if_any();
}

void add_leak(data::Dataset& training, const std::string& leak) {
  if (!leak.empty()) training.cautions.push_back(leak);
}

JobData with_validation_files(const data::ReadRequest& options, FaultList& implausible) {
  JobData data;
  const std::size_t blocks = data::blocks_to_condense(options);
  data.training = load(options.training, options, blocks);
  // Force zeros of validation tests are treated as the training tests require.
  data::ReadRequest alike = options;
  if (const auto differ = data::directions_differ(data.training);
      options.force_zero == data::ForceZero::automatic && differ != data::DirectionsDiffer::nowhere)
    alike.force_zero = differ == data::DirectionsDiffer::by_friction ? data::ForceZero::keep
                                                                     : data::ForceZero::remove;
  data.validation = load(options.validation, alike, blocks);
  data::settle_directions(std::array{&data.training, &data.validation});
  for (data::Dataset* part : {&data.training, &data.validation})
    data::check_plausibility(*part, options.allow_implausible, options.place, implausible);
  data::Dataset* const parts[] = {&data.training, &data.validation};
  find_roles(parts, options);
  data::check_units_between(data.training, data.validation, options.allow_implausible,
                            options.place, implausible);
  if (data.training.assumed == data.validation.assumed) data.validation.unit_questions.clear();
  data.training.unused = unused_by_both(data.training, data.validation);
  data.validation.unused.clear();
  add_leak(data.training, calibrate::leak_note(data.training, data.validation));
  add_leak(data.training, calibrate::leak_note(data.training, data.training));
  return data;
}

JobData without_others(data::Dataset all) {
  JobData data;
  const bool one = all.experiments.size() == 1;
  data.judged_by = one ? calibrate::JudgedBy::fit : calibrate::JudgedBy::leave_one_out;
  data.validation = all.subset({});
  data.validation.dropped.clear();
  data.validation.phases = {};
  data.validation.interventions.clear();
  data.validation.notes.clear();
  add_leak(all, calibrate::leak_note(all, all));
  data.training = std::move(all);
  return data;
}

JobData with_held_out_tests(data::Dataset all, double share, std::uint64_t seed) {
  data::Split split = data::hold_out(all, share, seed);
  JobData data;
  data.judged_by = calibrate::JudgedBy::held_out;
  data.training = std::move(split.training);
  data.validation = std::move(split.validation);
  data.training.implausible = all.implausible;
  data.training.unit_questions = all.unit_questions;
  data.training.unused = all.unused;
  add_leak(data.training, calibrate::leak_note(all, all));
  data.undivided = std::move(all);
  return data;
}

// Applies data.holdout below few_experiments as well: a user may want tests that no fit has seen.
JobData without_validation_files(const data::ReadRequest& options, std::uint64_t seed,
                                 FaultList& implausible) {
  data::Dataset all = load(options.training, options, data::blocks_to_condense(options));
  data::settle_directions(std::array{&all});
  data::check_plausibility(all, options.allow_implausible, options.place, implausible);
  data::Dataset* const parts[] = {&all};
  find_roles(parts, options);
  if (!options.holdout && data::units_of(all).count < few_experiments)
    return without_others(std::move(all));
  return with_held_out_tests(std::move(all), options.holdout.value_or(usual_share), seed);
}

// Columns other than quantities that the laws of the job take.
std::set<std::string> columns_of_laws(const calibrate::ModelOptions& options) {
  std::set<std::string> names;
  const auto& use = options.use;
  for (const auto& law : options.laws.own())
    if (law->build && (use.empty() || std::ranges::count(use, law->name) > 0))
      for (const std::string& name : models::inputs(*law, {.shear_limit = false}))
        if (!data::find_quantity(name) && !data::find_derived(name)) names.insert(name);
  return names;
}

// Checks the files that globs and rules of both lists select together.
void check_files(const data::DataOptions& options) {
  const auto training = data::find_files(options.training, options.base, options.place);
  std::vector<std::string> all = data::find_files(options.validation, options.base, options.place);
  for (const std::string& file : training)
    if (std::ranges::find(all, file) != all.end())
      throw InputError(options.place,
                       fmt::format("'{}' is in data.training and in data.validation", file),
                       "a test that validates is none of those to calibrate on");
  all.insert(all.end(), training.begin(), training.end());
  data::check_rules(all, options);
}

// The questions that frictab init left open in the job, as "job.toml (lines 6, 13)"; empty: none.
std::string open_questions(const std::string& job_file) {
  std::ifstream file(job_file);
  std::vector<std::size_t> numbers;
  std::string line;
  for (std::size_t number = 1; std::getline(file, line); ++number)
    if (line.starts_with("# ? ")) numbers.push_back(number);
  if (numbers.empty()) return "";
  return fmt::format("{} ({} {})", job_file, numbers.size() == 1 ? "line" : "lines",
                     fmt::join(numbers, ", "));
}

// Points from the faults that an answer would mend to the questions.
InputError with_open_questions(const InputError& error, const std::string& questions) {
  std::vector<Fault> faults = error.faults();
  for (Fault& fault : faults)
    if (fault.what.starts_with("there is no column sigma_n_MPa") ||
        fault.what.starts_with("there is neither tau_R_MPa"))
      fault.hint = fmt::format("answer the open questions in {}: {}", questions, fault.hint);
  return InputError(std::move(faults));
}

} // namespace

const data::Dataset& JobData::judged() const {
  return calibrate::on_other_experiments(judged_by) ? validation : training;
}

calibrate::CalibrationInput JobData::calibration_input(const job::Job& job) const {
  calibrate::CalibrationInput input = {
      training, judged(), job.models, job.calibration, judged_by, undivided ? &*undivided : nullptr,
      all()};
  if (shows_one_difference()) input.options.bootstrap = 0;
  return input;
}

bool JobData::shows_one_difference() const {
  return judged_by == calibrate::JudgedBy::leave_one_out && data::units_of(training).count == 2;
}

const data::Dataset* JobData::all() const {
  if (!delivers_all || !calibrate::on_other_experiments(judged_by)) return nullptr;
  return undivided ? &*undivided : &*together;
}

JobData load_job_data(const job::Job& job) {
  FaultList implausible;
  JobData data = load_job_data(job, implausible);
  implausible.throw_if_any();
  return data;
}

JobData load_job_data(const job::Job& job, FaultList& implausible) {
  job::check_data_files(job);
  check_files(job.data);
  data::ReadRequest options = job.data;
  options.needed = [names = columns_of_laws(job.models)](const std::string& column) {
    return names.count(column) > 0 || names.count(effects::symbol_of(column)) > 0;
  };
  JobData data;
  try {
    data = options.validation.empty()
               ? without_validation_files(options, job.calibration.seed, implausible)
               : with_validation_files(options, implausible);
  } catch (const InputError& error) {
    const std::string questions = open_questions(options.place.file);
    if (questions.empty()) throw;
    throw with_open_questions(error, questions);
  }
  add_oracle(options, data);
  data.delivers_all = job.calibration.deliver == calibrate::Deliver::all;
  if (data.delivers_all && data.judged_by == calibrate::JudgedBy::validation_files)
    data.together = data::together(data.training, data.validation);
  check_export_inputs(job.exports, data.training);
  return data;
}

} // namespace frictab::run
