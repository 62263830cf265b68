// The stages of a job, each a screen of named steps.
#include "run/pipeline.h"

#include <algorithm>

#include <fmt/format.h>

#include "calibrate/calibration_file.h"
#include "calibrate/comparison.h"
#include "calibrate/folds.h"
#include "codegen/exporter.h"
#include "codegen/recipe.h"
#include "codegen/values_file.h"
#include "core/error.h"
#include "core/progress.h"
#include "core/text.h"
#include "data/derived.h"
#include "data/load.h"
#include "data/oracle.h"
#include "data/quantity.h"
#include "effects/extended_law.h"
#include "report/report.h"
#include "table/build.h"
#include "table/direct.h"
#include "table/stream.h"
#include "table/table_file.h"
#include "trace/trace_file.h"
#include "verify/verify.h"

namespace frictab {

namespace fs = std::filesystem;

namespace {
// Below so many, the tests that the tool holds out itself are needed for tracing as well.
constexpr std::size_t few_experiments = 30;
} // namespace

Pipeline::Pipeline(Job job) : job_(std::move(job)), output_(job_.directory) {}

namespace {

void add_oracle(const DataOptions& options, Dataset& training, Dataset& validation) {
  if (options.oracle.empty()) return;
  if (!is_synthetic(training))
    throw InputError(options.oracle_place,
                     "data.oracle is for synthetic data: measured data have no known truth",
                     "synthetic data say so in a column `origin`; for measured data, repeated "
                     "tests give the noise floor");
  read_oracle(options, training, validation);
}

// [export.inputs] may name what only a traced effect brings in: a recorded column, or a history.
void check_export_inputs(const ExportOptions& exports, const Dataset& data) {
  std::vector<std::string> known;
  for (const Quantity& quantity : quantities())
    if (quantity.state) known.push_back(quantity.name);
  for (const DerivedQuantity& derived : derived_quantities())
    known.push_back(derived.name);
  for (const Column& column : data.columns)
    known.push_back(symbol_of(column.name));
  FaultList faults;
  for (const auto& [name, place] : exports.input_places)
    if (std::find(known.begin(), known.end(), name) == known.end())
      faults.add(place, "'" + name + "' in [export.inputs] is no state, history or column",
                 suggest(name, known));
  faults.throw_if_any();
}

} // namespace

void Pipeline::need_data() {
  if (training_) return;
  training_ = load_dataset(job_.data.training, job_.data);
  if (!job_.data.validation.empty()) {
    validation_ = load_dataset(job_.data.validation, job_.data);
    if (const std::string leak = leak_note(*training_, *validation_); !leak.empty())
      validation_->notes.push_back(leak);
  } else {
    if (training_->experiments.size() < few_experiments) all_ = training_;
    Split split = hold_out(*training_, job_.data.holdout, job_.calibration.seed);
    training_ = std::move(split.training);
    validation_ = std::move(split.validation);
  }
  add_oracle(job_.data, *training_, *validation_);
  check_export_inputs(job_.exports, *training_);
}

void Pipeline::need_calibration() {
  if (calibration_) return;
  const fs::path file = fs::path(job_.directory) / "calibration.json";
  if (!fs::exists(file))
    throw InputError({file.string(), 0, 0}, "there is no calibration yet",
                     "run `frictab calibrate " + job_.file + "` first");
  calibration_ = parse_calibration(read_file(file), file.string());
}

std::vector<fs::path> Pipeline::table_files() const {
  const fs::path directory = fs::path(job_.directory) / "tables";
  std::vector<fs::path> files;
  if (fs::is_directory(directory))
    for (const auto& entry : fs::directory_iterator(directory))
      if (entry.path().extension() == ".h5") files.push_back(entry.path());
  if (files.empty())
    throw InputError({directory.string(), 0, 0}, "there are no tables yet",
                     "run `frictab tabulate " + job_.file + "` first");
  std::sort(files.begin(), files.end());
  return files;
}

void Pipeline::need_tables() {
  if (have_tables_) return;
  const auto in_memory = static_cast<std::size_t>(job_.table.memory_limit_MiB * (1 << 20));
  for (const fs::path& file : table_files())
    tables_.push_back(read_table(file, in_memory));
  have_tables_ = true;
}

double Pipeline::drift_allowed() const {
  return job_.verify.max_drift_MPa.value_or(job_.table.tolerance_MPa);
}

Model Pipeline::model_of(const Table& table) {
  need_calibration();
  for (const ModelFit& fit : calibration_->fits) {
    Model model = fit.model;
    model.quantile = table.quantile();
    if (model.name() == table.model)
      return at_quantile(fit.model, table.quantile(), job_.table.place);
  }
  throw InputError({job_.file, 0, 0}, "law '" + table.model + "' is not in calibration.json",
                   "calibrate it, or tabulate again");
}

std::vector<std::string> Pipeline::model_names() const {
  std::vector<std::string> names;
  for (const Law& law : all_laws())
    names.push_back(law.name);
  const fs::path models = fs::path(job_.directory) / "models";
  if (!fs::is_directory(models)) return names;
  for (const auto& entry : fs::directory_iterator(models))
    if (const std::string name = entry.path().stem().string();
        read_model_name(name).base && !find_law(name) && entry.path().extension() == ".json")
      names.push_back(name);
  return names;
}

std::vector<std::string> Pipeline::table_names() const {
  std::vector<std::string> names;
  for (const Law& law : all_laws())
    names.push_back(law.name);
  std::vector<fs::path> places{fs::path(job_.directory) / "tables"};
  for (const Exporter& exporter : all_exporters())
    places.push_back(fs::path(job_.directory) / "export" / exporter.name);
  for (const fs::path& place : places) {
    if (!fs::is_directory(place)) continue;
    for (const auto& entry : fs::directory_iterator(place))
      if (const std::string name = entry.path().stem().string();
          read_model_name(name).base && std::find(names.begin(), names.end(), name) == names.end())
        names.push_back(name);
  }
  return names;
}

std::vector<const ModelFit*> Pipeline::chosen_fits() {
  std::vector<const ModelFit*> chosen;
  const auto choose = [&](const ModelFit& fit) {
    if (std::find(chosen.begin(), chosen.end(), &fit) == chosen.end()) chosen.push_back(&fit);
  };
  for (const std::string& name : job_.table.model) {
    if (name == "best") choose(calibration_->fits.front());
    bool found = name == "best" || name == "all";
    for (const ModelFit& fit : calibration_->fits)
      if (name == "all" || fit.model.law->name == name) {
        choose(fit);
        found = true;
      }
    if (!found)
      throw InputError(job_.table.place, "table.model: law '" + name + "' was not calibrated",
                       read_model_name(name).traced
                           ? "it is there where trace finds an effect that its law lacks"
                           : "add it to models.use, or map the columns it needs");
  }
  return chosen;
}

std::string Pipeline::export_directory(const std::string& target, const Table& table) const {
  return "export/" + target + (tables_.size() > 1 ? "/" + table.model : "");
}

void Pipeline::write_calibration() {
  output_.write("calibration.json", calibration_json(*calibration_));
  output_.write("benchmark.md", benchmark_md(*calibration_));
  for (const ModelFit& fit : calibration_->fits)
    output_.write("models/" + fit.model.law->name + ".json", model_json(fit, *calibration_));
}

void Pipeline::calibrate() {
  need_data();
  calibration_ = frictab::calibrate({*training_, *validation_, job_.models, job_.calibration});
  for (const std::string& name : model_names())
    output_.remove_old("models/" + name + ".json");
  output_.remove_old("trace.json"); // of another calibration
  new_calibration_ = true;
  write_calibration();
}

std::vector<const ModelFit*> Pipeline::fits_to_trace() const {
  std::vector<const ModelFit*> chosen;
  for (const std::string& name : job_.trace.models)
    for (const ModelFit& fit : calibration_->fits) {
      const bool fixed = fit.model.law->calibrated == Calibrated::fixed ||
                         fit.model.law->calibrated == Calibrated::mean;
      if (name == "all" ? fixed : name != "best" && name != fit.model.law->name) continue;
      if (std::find(chosen.begin(), chosen.end(), &fit) == chosen.end()) chosen.push_back(&fit);
      if (name == "best") break;
    }
  return chosen;
}

void Pipeline::trace() {
  need_data();
  need_calibration();
  std::erase_if(calibration_->fits, // of an earlier trace
                [](const ModelFit& fit) { return fit.model.traced(); });
  for (const std::string& name : model_names())
    output_.remove_old("models/" + name + ".json");
  const auto chosen = fits_to_trace();
  if (chosen.empty())
    throw InputError({job_.file, 0, 0}, "trace.models names no law that was calibrated",
                     "\"best\", or a name from the ranking");
  for (const ModelFit* fit : chosen)
    traces_.push_back(frictab::trace({all_ ? *all_ : *training_, *validation_, *fit, job_.trace,
                                      job_.calibration.bootstrap, job_.calibration.seed}));
  add_traced_laws();
  output_.write("trace.json", trace_json(traces_, calibration_->synthetic));
}

void Pipeline::add_traced_laws() {
  std::vector<ModelFit> nested; // judged on other tests than the laws they came from
  for (const Trace& trace : traces_) {
    if (!trace.extended.model.law) continue;
    (trace.unseen == "validation" ? calibration_->fits : nested).push_back(trace.extended);
  }
  std::stable_sort(calibration_->fits.begin(), calibration_->fits.end(),
                   [](const ModelFit& a, const ModelFit& b) {
                     return a.validation.mae_MPa < b.validation.mae_MPa;
                   });
  add_comparisons(*calibration_, {*training_, *validation_, job_.models, job_.calibration});
  for (ModelFit& fit : nested) { // in front of their law, which they are better than
    const auto base = std::find_if(
        calibration_->fits.begin(), calibration_->fits.end(),
        [&](const ModelFit& other) { return other.model.law->name == fit.model.base(); });
    calibration_->fits.insert(base, std::move(fit));
  }
  write_calibration();
}

std::vector<Model> Pipeline::chosen_models() {
  std::vector<Model> models;
  for (const ModelFit* fit : chosen_fits())
    for (const double quantile : job_.table.quantile)
      models.push_back(at_quantile(fit->model, quantile, job_.table.place));
  return models;
}

void Pipeline::check_sizes() {
  need_data();
  need_calibration();
  if (job_.exports.targets.empty()) return;
  for (const Model& model : chosen_models()) {
    const auto ranges = state_ranges(model, *training_, job_.table);
    if (!is_streamed(model, ranges, job_.table)) continue;
    Table table;
    table.model = model.name();
    table.axes = *fixed_axes(model, ranges, job_.table);
    check_request_size(table, exporters_named(job_.exports.targets), job_.exports.options);
  }
}

Table Pipeline::sample_table(const Model& model) {
  const auto ranges = state_ranges(model, *training_, job_.table);
  if (!is_streamed(model, ranges, job_.table)) return build_table(model, ranges, job_.table);
  const fs::path file = fs::path(job_.directory) / "tables" / (model.name() + ".h5");
  StreamedTable streamed = stream_table(model, ranges, job_.table, file);
  if (streamed.kept > 0)
    notes_.push_back(fmt::format("{}: {} of {} chunks kept from an interrupted run", model.name(),
                                 thousands(streamed.kept), thousands(streamed.chunks)));
  return std::move(streamed.table);
}

void Pipeline::tabulate() {
  need_data();
  need_calibration();
  for (const std::string& name : table_names()) {
    output_.remove_old("tables/" + name + ".h5");
    for (const std::string& file : work_files(name + ".h5"))
      output_.remove_old("tables/" + file);
  }
  tables_.clear();
  const std::vector<Model> models = chosen_models();
  Progress progress("tabulating", models.size());
  for (const Model& model : models) {
    Table table = sample_table(model);
    table.record.tool_version = FRICTAB_VERSION;
    table.record.data_hash = calibration_->data_hash;
    table.record.data_origin = calibration_->synthetic ? "synthetic" : "measured";
    // The drift a user can rely on is measured before the file is written.
    const VerifyInput input{model,         table,           "the new table",
                            &*validation_, drift_allowed(), job_.verify.samples};
    const DriftRecord& drift = compared_[table.model] = frictab::verify(input, {}).front();
    table.record.worst_case_MPa = drift.worst_case_MPa;
    if (!drift.passed && !job_.table.nodes && !job_.table.max_bytes)
      missed_.push_back(fmt::format(
          "the table of {} drifts by up to {:.3g} MPa, more than the {:g} "
          "MPa allowed: more nodes in [table.axes], or a larger "
          "table.tolerance_MPa",
          table.model, std::max(drift.worst_case_MPa, drift.rows.max_abs), drift_allowed()));
    table.record.proven_drift_MPa = drift.proven_MPa;
    for (const auto& [name, value] : drift.worst_state)
      table.record.inputs[name].worst_case_at = value;
    const std::string name = "tables/" + table.model + ".h5";
    if (table.stored)
      output_.adopt(name, finish_stream(table, job_.table.hdf5, fs::path(job_.directory) / name));
    else
      write_table(table, output_.stage(name), job_.table.hdf5);
    tables_.push_back(std::move(table));
    progress.tick();
  }
  // As a later stage reads them: by name.
  std::sort(tables_.begin(), tables_.end(),
            [](const Table& a, const Table& b) { return a.model < b.model; });
  have_tables_ = true;
}

// The files of an earlier run: those that its recipes list, and nothing else.
void Pipeline::remove_old_sources() {
  std::vector<std::string> directories;
  for (const Exporter& exporter : all_exporters()) {
    directories.push_back("export/" + exporter.name);
    for (const std::string& name : table_names())
      directories.push_back("export/" + exporter.name + "/" + name);
  }
  for (const std::string& directory : directories) {
    const fs::path recipe = fs::path(job_.directory) / directory / "recipe.json";
    if (!fs::exists(recipe)) continue;
    for (const std::string& file : files_of_recipe(read_file(recipe), recipe.string()))
      output_.remove_old(directory + "/" + file);
  }
}

ExportRequest Pipeline::request_for(const Table& form) const {
  return {form, job_.exports.units, job_.exports.inputs, job_.exports.options};
}

namespace {

// Solvers' own tables are made from the law itself: made from a table they would add its drift to
// their own. They keep its tolerance.
Table direct_for_sources(const Model& model, const Table& table) {
  Table direct = direct_form(model, table);
  direct.record.tolerance_MPa = table.record.tolerance_MPa;
  return direct;
}

} // namespace

void Pipeline::generate() {
  if (!have_tables_ && !job_.exports.targets.empty())
    for (const fs::path& file : table_files()) // before anything large is read
      check_request_size(read_description(file).table, exporters_named(job_.exports.targets),
                         job_.exports.options);
  need_tables();
  remove_old_sources();
  for (const Table& table : tables_)
    for (const Exporter* exporter : exporters_named(job_.exports.targets)) {
      const std::string directory = export_directory(exporter->name, table);
      const Table form = job_.exports.form == "direct" || !exporter->whole()
                             ? direct_for_sources(model_of(table), table)
                             : table;
      sources_[directory] = exporter->generate(request_for(form));
      for (const auto& [path, text] : sources_[directory])
        output_.write(directory + "/" + path, text);
    }
}

namespace {

SourceBundle read_bundle(const fs::path& directory) {
  const std::string recipe = (directory / "recipe.json").string();
  SourceBundle bundle;
  for (const std::string& file : files_of_recipe(read_file(recipe), recipe))
    bundle[file] = read_file(directory / file);
  return bundle;
}

} // namespace

void Pipeline::verify() {
  need_data();
  need_calibration();
  need_tables();
  const double allowed = drift_allowed();
  verification_ = Verification{allowed, {}};
  Progress progress("verifying", tables_.size());
  for (const Table& table : tables_) {
    std::vector<GeneratedSource> sources;
    const Model model = model_of(table);
    const Table direct = direct_for_sources(model, table);
    for (const Exporter* exporter : exporters_named(job_.exports.targets)) {
      const std::string directory = export_directory(exporter->name, table);
      const fs::path written = fs::path(job_.directory) / directory;
      if (!sources_.count(directory)) {
        if (!fs::is_directory(written))
          throw InputError({written.string(), 0, 0}, "there are no generated sources",
                           "run `frictab export " + job_.file + "` first");
        sources_[directory] = read_bundle(written);
      }
      const SourceBundle& bundle = sources_[directory];
      const Table& form =
          is_direct_recipe(bundle.at("recipe.json"), directory + "/recipe.json") ? direct : table;
      sources.push_back({exporter, request_for(form), bundle});
    }
    const std::string name = job_.directory + "/tables/" + table.model + ".h5";
    const auto known = compared_.find(table.model);
    const auto records =
        frictab::verify({model, table, name, &*validation_, allowed, job_.verify.samples,
                         known == compared_.end() ? nullptr : &known->second},
                        sources);
    verification_->records.insert(verification_->records.end(), records.begin(), records.end());
    progress.tick();
  }
  output_.write("verify.json", verification_json(*verification_));
  output_.write("verify.xml", verification_junit(*verification_));
}

void Pipeline::compare_forms() {
  need_tables();
  Progress progress("timing", tables_.size());
  for (const Table& table : tables_) {
    forms_.push_back(frictab::compare_forms(model_of(table), table));
    progress.tick();
  }
}

void Pipeline::report() {
  need_data();
  need_calibration();
  need_tables();
  if (!verification_) {
    const fs::path file = fs::path(job_.directory) / "verify.json";
    verification_ =
        fs::exists(file) ? parse_verification(read_file(file), file.string()) : Verification{};
  }
  if (const fs::path file = fs::path(job_.directory) / "trace.json";
      traces_.empty() && !new_calibration_ && fs::exists(file))
    traces_ = parse_traces(read_file(file), file.string());
  std::vector<std::vector<double>> predicted;
  for (const ModelFit& fit : calibration_->fits)
    predicted.push_back(predict(fit.model, *validation_));
  std::vector<FormComparison> sizes;
  for (const Table& table : tables_)
    sizes.push_back(form_sizes(model_of(table), table));
  std::vector<std::string> written = output_.paths();
  written.push_back("report.html");
  const ReportInput input{fs::path(job_.file).filename().string(),
                          *calibration_,
                          *training_,
                          *validation_,
                          std::move(predicted),
                          tables_,
                          *verification_,
                          std::move(written),
                          std::move(sizes),
                          traces_};
  output_.write("report.html", report_html(input));
}

void Pipeline::commit() {
  output_.commit();
}

} // namespace frictab
