// Finds a model's fit in the calibration and derives the tolerances of its tables.
#include "run/law_accuracy.h"

#include <algorithm>

#include "calibrate/band.h"
#include "calibrate/metrics.h"
#include "core/error.h"
#include "table/direct.h"

namespace frictab::run {

using calibrate::ModelFit;
using table::Table;

namespace {

const ModelFit& fit_of(const Run& run, const models::Model& model) {
  return *calibrate::find_fit(*run.calibration, model.law->name);
}

table::Tolerance tolerance_of(const Run& run, const models::Model& model) {
  if (run.job.table.tolerance_MPa) return {*run.job.table.tolerance_MPa, ""};
  const bool judged = run.calibration->judged_by != calibrate::JudgedBy::fit;
  return table::auto_tolerance(fit_of(run, model).delivered().validation.mae_MPa,
                               calibrate::mean_stress_MPa(run.data->training),
                               judged ? "unseen tests" : "the test that it is fitted to");
}

} // namespace

models::Model model_of(const Run& run, const Table& table) {
  for (const ModelFit& fit : run.calibration->fits) {
    models::Model model = fit.delivered().model;
    model.quantile = table.quantile();
    if (model.name() == table.model)
      return calibrate::at_quantile(fit.delivered().model, table.quantile(), run.job.table.place);
  }
  throw InputError({run.job.file, 0, 0}, "law '" + table.model + "' is not in calibration.json",
                   "calibrate it, or tabulate again");
}

models::AssembledLaw law_of(const Run& run, const Table& table) {
  return models::AssembledLaw(model_of(run, table));
}

const data::Dataset& fitted_tests(const Run& run, const models::Model& model) {
  const data::Dataset* all = run.data->all();
  const ModelFit* const fit = calibrate::find_fit(*run.calibration, model.law->name);
  return all && fit && fit->on_all ? *all : run.data->training;
}

table::Tolerance drift_allowed(const Run& run, const models::Model& model) {
  if (run.job.verify.max_drift_MPa) return {*run.job.verify.max_drift_MPa, ""};
  return tolerance_of(run, model);
}

table::TableOptions table_options(const Run& run, const models::Model& model) {
  const table::Tolerance tolerance = tolerance_of(run, model);
  table::TableOptions options = run.job.table;
  options.tolerance_MPa = tolerance.MPa;
  options.tolerance_from = tolerance.from;
  return options;
}

verify::VerifyInput verify_input(const Run& run, const models::AssembledLaw& law,
                                 const Table& table, const std::string& name) {
  const table::Tolerance allowed = drift_allowed(run, law.model);
  verify::VerifyInput input{
      law, table, name, &run.data->judged(), allowed.MPa, run.job.verify.samples};
  input.proof_boxes = run.job.verify.proof_boxes;
  input.allowed_from = allowed.from;
  input.law_error_MPa = table::least_error(fit_of(run, law.model).delivered().validation.mae_MPa,
                                           calibrate::mean_stress_MPa(run.data->training));
  return input;
}

Table direct_with_tolerance(const models::AssembledLaw& law, const Table& table) {
  Table direct = table::direct_form(law, table);
  direct.record.tolerance_MPa = table.record.tolerance_MPa;
  direct.record.tolerance_from = table.record.tolerance_from;
  return direct;
}

} // namespace frictab::run
