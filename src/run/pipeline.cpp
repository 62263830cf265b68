// The stages of a job, each a screen of named steps.
#include "run/pipeline.h"

#include <algorithm>
#include <iterator>
#include <set>

#include <fmt/format.h>

#include "calibrate/band.h"
#include "calibrate/calibration_file.h"
#include "calibrate/comparison.h"
#include "calibrate/experiment_errors.h"
#include "calibrate/recommended.h"
#include "calibrate/row_errors.h"
#include "codegen/recipe.h"
#include "codegen/values_file.h"
#include "core/error.h"
#include "core/large_work.h"
#include "core/progress.h"
#include "core/text.h"
#include "core/version.h"
#include "report/numbers.h"
#include "report/report.h"
#include "run/chosen.h"
#include "run/results.h"
#include "table/build.h"
#include "table/direct.h"
#include "table/distance.h"
#include "table/table_file.h"
#include "trace/trace_file.h"

namespace frictab::run {

using calibrate::ModelFit;
using table::Table;

namespace fs = std::filesystem;

Pipeline::Pipeline(job::Job job)
    : job_(std::move(job)), output_(job_.directory), earlier_(job_), stages_(job_, job_.directory) {
  check_directory(job_, stages_);
  if (!output_.keeps_others_off())
    notes_.push_back(job_.directory + " is on a file system without locks: run one frictab at a "
                                      "time there");
}

// ---- what the stages are made of ----

std::string Pipeline::data_key() const {
  return data_ ? data::fingerprint(data_->training, data_->validation) : "";
}

void Pipeline::check_fresh(const std::string& stage, const std::string& files) const {
  const std::string why = stages_.stale(stage, data_key());
  if (why.empty()) return;
  throw InputError({(fs::path(job_.directory) / files).string(), 0, 0}, "is stale: " + why,
                   fmt::format("`frictab {} {}` makes it anew, `frictab run` everything; `frictab "
                               "status` shows all stages",
                               stage, job_.arguments()));
}

// Hints say what makes a file anew.
void Pipeline::check_as_written(const std::string& stage, const std::string& path) const {
  if (stages_.is_as_written(path).value_or(true)) return;
  throw InputError(
      {(fs::path(job_.directory) / path).string(), 0, 0},
      fmt::format("was changed since `frictab {}` wrote it", stage),
      fmt::format("`frictab {} {}` makes it anew; for a law with constants of your own "
                  "or a table from elsewhere: `frictab export --law` or `--table`",
                  stage, job_.arguments()));
}

void Pipeline::load_data() {
  if (data_) return;
  const Progress progress("reading data", 0);
  data_ = large_work("putting the files of [data] together", 0, fewer_rows,
                     [&] { return load_job_data(job_); });
}

// Files of an earlier run: by their names, which is all there is of those of 0.1, and as
// stages.json has them, of laws that the job no longer knows.
void Pipeline::remove_earlier(const std::vector<std::string>& called_like_results,
                              std::string_view folder) {
  for (const std::string& file : called_like_results)
    output_.remove_old(file);
  for (const std::string& file : stages_.recorded_in(folder))
    output_.remove_old(file);
}

void Pipeline::load_calibration() {
  if (calibration_) return;
  if (!earlier_.has_calibration()) {
    notes_.push_back("there was no calibration: the laws were calibrated first");
    calibrate();
    return;
  }
  check_fresh("calibrate", "calibration.json");
  check_as_written("calibrate", "calibration.json");
  calibration_ = earlier_.calibration();
  // What stages.json says, where there is none.
  if (data_ && calibration_->data_hash != data::fingerprint(data_->training, data_->judged()))
    throw InputError({(fs::path(job_.directory) / "calibration.json").string(), 0, 0},
                     "was made from other data: their fingerprint is " + calibration_->data_hash,
                     "`frictab calibrate " + job_.arguments() + "` makes it anew");
}

namespace {

// Of the tables in the directory those that table.model names; all of them where it says best or
// all, which is what the earlier run has resolved.
void keep_named(std::vector<Table>& tables, const table::TableOptions& options,
                const models::Laws& laws) {
  const std::vector<std::string>& names = options.model;
  if (!options.names_laws()) return;
  std::string there;
  for (const Table& table : tables)
    there += (there.empty() ? "" : ", ") + table.model;
  const auto is_named = [&](const Table& table) {
    const models::ModelName name = models::read_model_name(table.model, laws);
    std::string law = table.model; // without its quantile
    if (name.base) law = name.base->name + (name.traced ? "_traced" : "");
    return std::find(names.begin(), names.end(), law) != names.end() ||
           std::find(names.begin(), names.end(), table.model) != names.end();
  };
  std::erase_if(tables, [&](const Table& table) { return !is_named(table); });
  if (tables.empty())
    throw InputError(options.place, "there is no table of " + join(names, ", "),
                     "there are tables of " + there + "; frictab tabulate makes others");
}

} // namespace

void Pipeline::load_tables() {
  if (!tables_.empty()) return;
  if (!earlier_.has_tables()) {
    notes_.push_back("there were no tables: they were made first");
    tabulate();
    return;
  }
  check_fresh("tabulate", "tables");
  tables_ = earlier_.tables();
  keep_named(tables_, job_.table, job_.models.laws);
  load_calibration();
  for (Table& table : tables_)
    check_origin(table);
}

// Verification measures a changed table; what goes on from it does not take it for the law.
void Pipeline::check_origin(Table& table) {
  const std::string path = "tables/" + table.model + ".h5";
  const fs::path file = fs::path(job_.directory) / path;
  const std::string hash = table.record.data_hash.value_or(calibration_->data_hash);
  if (hash != calibration_->data_hash)
    throw InputError({file.string(), 0, 0},
                     fmt::format("was made from other data: their fingerprint is {}, that of "
                                 "calibration.json is {}",
                                 hash, calibration_->data_hash),
                     "`frictab tabulate " + job_.arguments() + "` makes it anew");
  const std::optional<bool> as_written = stages_.is_as_written(path);
  table.drift_is_claimed = !as_written.value_or(false);
  if (as_written.value_or(true)) return;
  if (!verifying_) check_as_written("tabulate", path);
  notes_.push_back(file.string() + " was changed since `frictab tabulate` wrote it");
}

// ---- what outlives a run that does not end ----

void Pipeline::go_on() {
  kept_.emplace(job_);
}

std::string Pipeline::kept_text() const {
  if (!keeps_) return "";
  return fmt::format("what was finished is kept in {}; `frictab run {}` goes on from there",
                     (fs::path(job_.directory) / io::kept_name).string(), job_.arguments());
}

void Pipeline::keep_so_far() {
  if (!kept_) return;
  record_files(stages_, output_);
  output_.keep("stages.json", stages_.json());
  keeps_ = true;
}

void Pipeline::take_kept_calibration() {
  for (const std::string& path : kept_->calibration_files())
    output_.take_kept(path);
  calibration_ = kept_->files().calibration();
  notes_.push_back("the calibration is that of a run that did not end");
}

Table Pipeline::staged_table(const std::string& model) const {
  Table table = table::read_table(output_.staged("tables/" + model + ".h5"));
  table.drift_is_claimed = false;
  return table;
}

bool Pipeline::take_kept_table(const std::string& model, Table& table) {
  const std::string path = "tables/" + model + ".h5";
  if (!kept_ || !kept_->has_file("tabulate", path, data_key())) return false;
  output_.take_kept(path);
  table = staged_table(model);
  notes_.push_back("the table of " + table.model + " is that of a run that did not end");
  return true;
}

// ---- calibrate ----

// What rows need memory for; the message says how many there are.
void Pipeline::with_rows(const std::function<void()>& work) const {
  const std::size_t rows = data_->training.rows() + data_->validation.rows();
  large_work(fmt::format("with {} rows in memory", thousands(rows)), rows, fewer_rows, work);
}

void Pipeline::calibrate() {
  load_data();
  const bool is_kept = kept_ && kept_->has_calibration(data_key());
  if (!is_kept)
    with_rows([&] { calibration_ = calibrate::calibrate(data_->calibration_input(job_)); });
  new_calibration_ = true;
  laws_.clear();
  remove_earlier(earlier_.model_files(), "models/");
  output_.remove_old("trace.json"); // of another calibration
  if (is_kept)
    take_kept_calibration();
  else
    write_calibration();
  stages_.record("calibrate", data_key());
  if (!is_kept) keep_so_far();
}

void Pipeline::write_calibration() {
  output_.write("calibration.json", calibrate::calibration_json(*calibration_));
  output_.write("benchmark.md", report::benchmark_md(*calibration_));
  output_.write("errors_by_experiment.csv", calibrate::errors_csv(calibrate::errors_by_experiment(
                                                *calibration_, data_->training, data_->judged())));
  for (const ModelFit& fit : calibration_->fits)
    output_.write("models/" + fit.model.law->name + ".json",
                  calibrate::model_json(fit, *calibration_));
}

// ---- trace ----

void Pipeline::trace() {
  load_data();
  load_calibration();
  if (kept_ && kept_->has_calibration(data_key()) && kept_->has("trace", data_key())) {
    traces_ = kept_->files().traces();
    stages_.record("trace", data_key());
    keep_so_far();
    return;
  }
  std::erase_if(calibration_->fits, // of an earlier trace
                [](const ModelFit& fit) { return fit.model.traced(); });
  remove_earlier(earlier_.model_files(), "models/");
  const auto fits = fits_to_trace(*calibration_, job_.trace);
  if (fits.empty())
    throw InputError({job_.file, 0, 0}, "trace.models names no law that was calibrated",
                     "\"best\", or a name from the ranking");
  const Progress progress("tracing", fits.size());
  for (const ModelFit* fit : fits) {
    with_rows([&] {
      traces_.push_back(
          trace::trace({data_->training, data_->validation, *fit, job_.trace,
                        job_.calibration.bootstrap, job_.calibration.seed, data_->all()}));
    });
    progress.tick();
  }
  add_traced_laws();
  laws_.clear();
  output_.write("trace.json", trace::trace_json(traces_, calibration_->synthetic));
  stages_.record("trace", data_key());
  keep_so_far();
}

namespace {

// A trace sorts experiments by name.
std::vector<calibrate::ExperimentError>
in_order_of(const std::vector<std::string>& names,
            const std::vector<calibrate::ExperimentError>& errors) {
  std::vector<calibrate::ExperimentError> sorted;
  for (const std::string& name : names)
    for (const calibrate::ExperimentError& one : errors)
      if (one.experiment == name) sorted.push_back(one);
  return sorted;
}

// Of few validation tests, which laws are ranked by, a traced law may come out behind the law that
// its effects were added to; the left-out tests of the trace, by which they were, are more. True
// where it was.
bool put_before_its_law(std::vector<ModelFit>& fits, const trace::Trace& trace) {
  const auto with_name = [&](const std::string& name) {
    return std::find_if(fits.begin(), fits.end(),
                        [&](const ModelFit& fit) { return fit.model.name() == name; });
  };
  const auto traced = with_name(trace.extended_model), own = with_name(trace.model);
  if (trace.unseen == "validation" || traced == fits.end() || traced < own) return false;
  traced->remarks.push_back(fmt::format(
      "stands before {} by the {} left-out tests of its trace, {:.4g} MPa there against {:.4g}: "
      "the validation tests are {}",
      trace.model, trace.after.validation.n_experiments, trace.after.validation.mae_MPa,
      trace.before.validation.mae_MPa, traced->validation.n_experiments));
  std::rotate(own, traced, traced + 1);
  return true;
}

} // namespace

void Pipeline::add_traced_laws() {
  std::vector<ModelFit*> by_validation;
  for (trace::Trace& trace : traces_)
    if (trace.extended.model.law && trace.extended.unseen.empty())
      by_validation.push_back(&trace.extended);
  calibrate::judge_on_rows(by_validation, data_->calibration_input(job_));
  for (const trace::Trace& trace : traces_) {
    if (!trace.extended.model.law) continue;
    ModelFit fit = trace.extended;
    fit.unseen = in_order_of(calibration_->validation_experiments, fit.unseen);
    calibration_->fits.push_back(std::move(fit));
  }
  std::stable_sort(calibration_->fits.begin(), calibration_->fits.end(),
                   [](const ModelFit& a, const ModelFit& b) {
                     return a.validation.mae_MPa < b.validation.mae_MPa;
                   });
  calibrate::add_comparisons(*calibration_, data_->calibration_input(job_));
  std::vector<std::string> overruled; // by more tests than rank the laws
  for (const trace::Trace& trace : traces_)
    if (put_before_its_law(calibration_->fits, trace)) overruled.push_back(trace.model);
  calibrate::add_recommended(*calibration_, data_->calibration_input(job_), overruled);
  write_calibration();
}

// ---- tabulate ----

const ModelFit& Pipeline::fit_of(const models::Model& model) const {
  return *std::find_if(calibration_->fits.begin(), calibration_->fits.end(),
                       [&](const ModelFit& fit) { return fit.model.law->name == model.law->name; });
}

double Pipeline::mean_stress() const {
  double sum = 0;
  const auto tau = data_->training.values("tau_R_MPa");
  for (const double one : tau)
    sum += std::abs(one);
  return sum / static_cast<double>(tau.size());
}

double Pipeline::law_error(const models::Model& model) const {
  return table::least_error(fit_of(model).delivered().validation.mae_MPa, mean_stress());
}

table::Tolerance Pipeline::tolerance_of(const models::Model& model) const {
  if (job_.table.tolerance_MPa) return {*job_.table.tolerance_MPa, ""};
  const bool judged = calibration_->judged_by != calibrate::JudgedBy::fit;
  return table::auto_tolerance(fit_of(model).delivered().validation.mae_MPa, mean_stress(),
                               judged ? "unseen tests" : "the test that it is fitted to");
}

table::Tolerance Pipeline::drift_allowed(const models::Model& model) const {
  if (job_.verify.max_drift_MPa) return {*job_.verify.max_drift_MPa, ""};
  return tolerance_of(model);
}

table::TableOptions Pipeline::table_options(const models::Model& model) const {
  const table::Tolerance tolerance = tolerance_of(model);
  table::TableOptions options = job_.table;
  options.tolerance_MPa = tolerance.MPa;
  options.tolerance_from = tolerance.from;
  return options;
}

verify::VerifyInput Pipeline::verify_input(const models::AssembledLaw& law, const Table& table,
                                           const std::string& name) const {
  const table::Tolerance allowed = drift_allowed(law.model);
  verify::VerifyInput input{law, table, name, &data_->judged(), allowed.MPa, job_.verify.samples};
  input.proof_boxes = job_.verify.proof_boxes;
  input.allowed_from = allowed.from;
  input.law_error_MPa = law_error(law.model);
  return input;
}

const models::AssembledLaw& Pipeline::assembled(const models::Model& model) {
  return laws_.try_emplace(model.name(), model).first->second;
}

// The tests that the delivered law was fitted to: its tables reach what they reach.
const data::Dataset& Pipeline::data_behind(const models::Model& model) const {
  const data::Dataset* all = data_->all();
  const bool on_all =
      std::any_of(calibration_->fits.begin(), calibration_->fits.end(), [&](const ModelFit& fit) {
        return fit.on_all && fit.model.law->name == model.law->name;
      });
  return all && on_all ? *all : data_->training;
}

Table Pipeline::sample_table(const models::AssembledLaw& law) {
  const table::TableOptions options = table_options(law.model);
  const auto ranges = table::state_ranges(law, data_behind(law.model), options);
  return large_work("making the table of " + law.model.name(), 0,
                    "fewer nodes in [table.axes], or a larger table.tolerance_MPa",
                    [&] { return table::build_table(law, ranges, options); });
}

// The drift a user can rely on, measured before the file is written.
void Pipeline::measure_drift(const models::AssembledLaw& law, Table& table) {
  const verify::VerifyInput input = verify_input(law, table, "the new table");
  const verify::DriftRecord& drift = compared_[table.model] = verify::verify(input, {}).front();
  const bool to_tolerance = !job_.table.nodes && !job_.table.max_bytes;
  if (!drift.passed && to_tolerance)
    missed_.push_back(
        fmt::format("the table of {} drifts by up to {:.3g} MPa, more than the {:.3g} MPa "
                    "allowed{}: more nodes "
                    "in [table.axes], or a larger table.tolerance_MPa",
                    table.model, verify::largest_drift_MPa(drift), drift.allowed_MPa,
                    drift.allowed_from.empty() ? "" : " (" + drift.allowed_from + ")"));
  verify::set_drift(table.record, drift);
}

void Pipeline::write_table_file(const Table& table) {
  table::write_table(table, output_.stage("tables/" + table.model + ".h5"), job_.table.hdf5);
}

Table Pipeline::made_table(const models::AssembledLaw& law) {
  Table table;
  if (take_kept_table(law.model.name(), table)) {
    measure_drift(law, table);
    return table;
  }
  table = sample_table(law);
  if (job_.table.distance) table::add_distance(table, law, data_behind(law.model));
  table.record.tool_version = tool_version();
  table.record.data_hash = calibration_->data_hash;
  table.record.data_origin = calibration_->synthetic ? "synthetic" : "measured";
  measure_drift(law, table);
  write_table_file(table);
  return staged_table(table.model); // what is verified is what users get
}

void Pipeline::tabulate() {
  load_data();
  load_calibration();
  remove_earlier(earlier_.table_files(), "tables/");
  tables_.clear();
  const std::vector<models::Model> models = models_to_tabulate(*calibration_, job_.table);
  stages_.begin("tabulate", data_key());
  Progress progress("tabulating", models.size());
  for (const models::Model& model : models) {
    tables_.push_back(made_table(assembled(model)));
    keep_so_far();
    progress.tick();
  }
  // As a later stage reads them: by name.
  std::sort(tables_.begin(), tables_.end(),
            [](const Table& a, const Table& b) { return a.model < b.model; });
  stages_.record("tabulate", data_key());
}

// ---- generate ----

const models::AssembledLaw& Pipeline::law_of(const Table& table) {
  if (const auto known = laws_.find(table.model); known != laws_.end()) return known->second;
  load_calibration();
  for (const ModelFit& fit : calibration_->fits) {
    models::Model model = fit.delivered().model;
    model.quantile = table.quantile();
    if (model.name() == table.model)
      return assembled(
          calibrate::at_quantile(fit.delivered().model, table.quantile(), job_.table.place));
  }
  throw InputError({job_.file, 0, 0}, "law '" + table.model + "' is not in calibration.json",
                   "calibrate it, or tabulate again");
}

// Solvers' own tables are made from the law itself: made from a table they would add its drift to
// their own. They keep its tolerance.
Table Pipeline::direct_for_sources(const Table& table) {
  Table direct = table::direct_form(law_of(table), table);
  direct.record.tolerance_MPa = table.record.tolerance_MPa;
  direct.record.tolerance_from = table.record.tolerance_from;
  return direct;
}

codegen::ExportRequest Pipeline::request_for(const std::string& target, const Table& form) const {
  return {form, job_.exports.units, job_.exports.inputs_for(target), job_.exports.options};
}

std::string Pipeline::export_directory(const std::string& target, const Table& table) const {
  return "export/" + target + (tables_.size() > 1 ? "/" + table.model : "");
}

namespace {

// A target names the key at fault; the job knows where it stands, and that there may be others.
Fault said_in_job(Fault fault, const std::string& target, const codegen::ExportOptions& exports) {
  fault.what = target + ": " + fault.what;
  const std::string all = "export.inputs.";
  if (!fault.place.file.starts_with(all)) return fault;
  const std::string own = "export." + target + ".inputs";
  for (const std::string& key : {own + "." + fault.place.file.substr(all.size()), fault.place.file})
    if (const auto known = exports.input_places.find(key); known != exports.input_places.end()) {
      fault.place = known->second;
      if (key.starts_with(all))
        fault.hint +=
            (fault.hint.empty() ? "for" : "; for") + (" this target alone: [" + own + "]");
      break;
    }
  return fault;
}

} // namespace

void Pipeline::generate() {
  load_data();
  load_calibration();
  const auto targets = codegen::exporters_named(job_.exports.targets);
  for (const auto& [target, inputs] : job_.exports.inputs_of_target)
    if (std::find(targets.begin(), targets.end(), codegen::find_exporter(target)) == targets.end())
      notes_.push_back(fmt::format("[export.{0}.inputs] is not used: {0} is not among "
                                   "export.targets",
                                   target));
  if (tables_.empty() && !targets.empty() && earlier_.has_tables()) {
    check_fresh("tabulate", "tables");
    std::vector<Table> described = earlier_.table_descriptions(); // before anything large is read
    keep_named(described, job_.table, job_.models.laws);
    for (const Table& table : described)
      codegen::check_request_size(table, targets, job_.exports.options);
  }
  load_tables();
  remove_earlier(earlier_.source_files(), "export/");
  FaultList faults; // of all targets: what one cannot take, another can
  std::set<const codegen::Exporter*> refused;
  for (const Table& table : tables_)
    for (const codegen::Exporter* exporter : targets) {
      if (refused.count(exporter)) continue; // for the same reason
      const std::string directory = export_directory(exporter->name, table);
      const bool direct = job_.exports.form == codegen::ExportForm::direct || !exporter->whole();
      const Table form = direct ? direct_for_sources(table) : table;
      try {
        generate_one(*exporter, request_for(exporter->name, form), directory);
      } catch (const InputError& error) {
        refused.insert(exporter);
        for (const Fault& fault : error.faults()) {
          const Fault said = said_in_job(fault, exporter->name, job_.exports);
          faults.add(said.place, said.what, said.hint);
        }
      }
    }
  faults.throw_if_any();
  stages_.record("export", data_key());
}

void Pipeline::generate_one(const codegen::Exporter& exporter,
                            const codegen::ExportRequest& request, const std::string& directory) {
  sources_[directory] = exporter.generate(request);
  const std::string caution = exporter.caution ? exporter.caution(request) : "";
  if (!caution.empty() && std::find(notes_.begin(), notes_.end(), caution) == notes_.end())
    notes_.push_back(caution);
  for (const auto& [path, text] : sources_[directory])
    output_.write(directory + "/" + path, text);
}

// ---- verify ----

const codegen::SourceBundle& Pipeline::sources_in(const std::string& directory) {
  if (!sources_.count(directory)) sources_[directory] = earlier_.sources(directory);
  return sources_[directory];
}

// As the recipes say: of the table, or of the law itself.
std::vector<verify::GeneratedSource> Pipeline::sources_of(const Table& table, const Table& direct) {
  std::vector<verify::GeneratedSource> sources;
  for (const codegen::Exporter* exporter : codegen::exporters_named(job_.exports.targets)) {
    std::string directory = export_directory(exporter->name, table);
    if (!sources_.count(directory)) // of a run that may have had more tables
      directory = earlier_.source_directory(exporter->name, table.model);
    const codegen::SourceBundle& bundle = sources_in(directory);
    const bool of_law =
        codegen::is_direct_recipe(bundle.at("recipe.json"), directory + "/recipe.json");
    sources.push_back({exporter, request_for(exporter->name, of_law ? direct : table), bundle});
  }
  return sources;
}

void Pipeline::load_sources() {
  if (!sources_.empty() || job_.exports.targets.empty()) return;
  if (stages_.has("export"))
    check_fresh("export", "export");
  else if (earlier_.source_files().empty()) {
    notes_.push_back("there were no routines: they were written first");
    generate();
  }
}

void Pipeline::verify() {
  verifying_ = true;
  load_data();
  load_calibration();
  load_tables();
  load_sources();
  verification_ = verify::Verification{0, {}, job_.verify.require_proof, job_.verify.require_run};
  for (const Table& table : tables_)
    verification_->max_drift_MPa =
        std::max(verification_->max_drift_MPa, drift_allowed(law_of(table).model).MPa);
  stages_.begin("verify", data_key());
  std::vector<verify::DriftRecord> kept; // of whole tables
  if (kept_ && kept_->has_file("verify", "verify.json", data_key()))
    kept = kept_->files().verification()->records;
  Progress progress("verifying", tables_.size());
  for (const Table& table : tables_) {
    const auto of_table = [&](const verify::DriftRecord& r) { return r.model == table.model; };
    if (std::any_of(kept.begin(), kept.end(), of_table)) {
      std::copy_if(kept.begin(), kept.end(), std::back_inserter(verification_->records), of_table);
      progress.tick();
      continue;
    }
    const Table direct = direct_for_sources(table);
    const auto known = compared_.find(table.model);
    verify::VerifyInput input =
        verify_input(law_of(table), table, job_.directory + "/tables/" + table.model + ".h5");
    if (known != compared_.end()) input.known = &known->second;
    const auto records = verify::verify(input, sources_of(table, direct));
    verification_->records.insert(verification_->records.end(), records.begin(), records.end());
    output_.write("verify.json", verify::verification_json(*verification_));
    keep_so_far();
    progress.tick();
  }
  output_.write("verify.json", verify::verification_json(*verification_));
  output_.write("verify.xml", verify::verification_junit(*verification_));
  stages_.record("verify", data_key());
}

void Pipeline::compare_forms() {
  load_tables();
  Progress progress("timing", tables_.size());
  for (const Table& table : tables_) {
    forms_.push_back(verify::compare_forms(law_of(table), table));
    progress.tick();
  }
}

// ---- report ----

namespace {

// A job called job.toml says nothing: its folder is the campaign's name then.
std::string campaign_name(const std::string& job_file) {
  const fs::path file(job_file);
  const std::string folder = fs::absolute(file).parent_path().filename().string();
  return file.filename() == "job.toml" && !folder.empty() ? folder : file.filename().string();
}

} // namespace

// Of the sources that this run made, else of those that lie in the directory.
std::vector<report::Recipe> Pipeline::recipes() const {
  const std::vector<std::string> staged = output_.paths();
  std::vector<report::Recipe> found;
  for (const codegen::Exporter* exporter : codegen::exporters_named(job_.exports.targets))
    for (const Table& table : tables_) {
      const std::string path = export_directory(exporter->name, table) + "/recipe.json";
      const fs::path file = std::find(staged.begin(), staged.end(), path) != staged.end()
                                ? output_.staged(path)
                                : fs::path(job_.directory) / path;
      if (fs::exists(file)) found.push_back({path, io::read_file(file)});
    }
  return found;
}

void Pipeline::report() {
  load_data();
  load_calibration();
  load_tables();
  if (!verification_) {
    const std::string why = stages_.stale("verify", data_key());
    check_as_written("verify", "verify.json");
    if (why.empty())
      verification_ = earlier_.verification().value_or(verify::Verification{});
    else {
      notes_.push_back("verify.json is not in the report: " + why);
      verification_ = verify::Verification{};
    }
  }
  if (traces_.empty() && !new_calibration_) {
    check_as_written("trace", "trace.json");
    traces_ = earlier_.traces();
  }
  std::vector<std::vector<double>> predicted;
  for (const ModelFit& fit : calibration_->fits)
    predicted.push_back(calibrate::predict(fit.model, data_->judged()));
  std::vector<verify::FormComparison> sizes;
  for (const Table& table : tables_)
    sizes.push_back(verify::form_sizes(law_of(table), table));
  std::vector<std::string> written = output_.paths();
  written.insert(written.end(), {"report.html", "report.md"});
  const report::ReportInput input{
      campaign_name(job_.file),
      *calibration_,
      data_->training,
      data_->judged(),
      std::move(predicted),
      tables_,
      *verification_,
      std::move(written),
      std::move(sizes),
      traces_,
      calibrate::errors_by_experiment(*calibration_, data_->training, data_->judged()),
      recipes()};
  output_.write("report.html", report::report_html(input));
  output_.write("report.md", report::report_md(input));
}

void Pipeline::deliver() {
  tabulate();
  generate();
  verify();
  report();
}

void Pipeline::commit() {
  commit_results(job_, stages_, output_);
}

} // namespace frictab::run
