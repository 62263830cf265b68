// Converts calibrations and models to JSON and back.
#include "calibrate/calibration_file.h"

#include <cmath>

#include <fmt/format.h>

#include "calibrate/judgement_json.h"
#include "calibrate/recommended.h"
#include "core/error.h"
#include "core/text.h"
#include "io/json_fields.h"
#include "models/assembled_law.h"

namespace frictab::calibrate {

using io::Fields;
using models::Law;

static void describe(Fields& f, NetworkRecord& r) {
  f.only_written("architecture",
                 fmt::format("{} inputs, {} tanh units, 1 output, exp; ensemble of {}",
                             r.inputs.size(), r.hidden, r.members));
  f("inputs", r.inputs);
  f("hidden", r.hidden);
  f("members", r.members);
  f("dropped", r.dropped);
  f("weights_per_member", r.weights);
  f("bins", r.bins);
  f("folds_of_experiments", r.folds);
  f("repeats", r.repeats);
  f.known("decays", r.decays);
  f.known("cv_rmse_MPa", r.cv_rmse_MPa);
  f.known("decay", r.decay);
  f.known("noise_of_a_bin_MPa", r.noise_MPa);
  f.known("scatter_between_experiments", r.gain);
  f.known("spread_of_members_MPa", r.spread_MPa);
  f("nets_trained", r.nets);
  f("iterations", r.iterations);
}

static void describe(Fields& f, PolynomialNoise& n) {
  f.known("between_experiments", n.gain);
  f.known("slope_over_stroke", n.slope);
  f.known("slow", n.slow);
  f.known("slow_length_in_strokes", n.length);
  f.known("of_a_bin", n.white);
}

static void describe(Fields& f, PolynomialTerm& term) {
  f("term", term.text);
  f.known("coefficient", term.coefficient);
  f("std_error", term.std_error);
}

static void describe(Fields& f, PolynomialRecord& r) {
  f("inputs", r.inputs);
  f("coordinates", r.coordinates);
  f("order", r.order);
  f.known("cv_mae_MPa_by_order", r.cv_mae_MPa);
  f.known("shares_of_orders", r.shares);
  f("bins", r.bins);
  f("experiments", r.experiments);
  f("scatter_of_ln_mu", r.noise);
  f.known("spread_of_coefficients_by_order", r.spread);
  f("terms", r.terms);
}

static void describe(Fields& f, BandCheck& band) {
  f("factor_5", band.low);
  f("factor_95", band.high);
  f("validation_experiments_inside", band.inside);
  f("validation_experiments", band.experiments);
}

// Describes a skipped law as one text: "levanov: needs sigma_f_MPa".
static void describe(Fields& f, LeftOut& left) {
  std::string text = left.text();
  describe(f, text);
  if (!f.reads()) return;
  const std::string between = ": needs ";
  const std::size_t at = text.find(between);
  if (at == text.npos)
    throw InputError({f.file(), 0, 0}, "left_out has '" + text + "', not \"LAW: needs COLUMNS\"",
                     "calibrate again");
  left = {text.substr(0, at), text.substr(at + between.size())};
}

namespace {

constexpr const char* model_schema = "frictab/model/1";
constexpr const char* calibration_schema = "frictab/calibration/1";

int whole_seconds_above(double seconds) {
  for (const int bound : {10, 60, 600, 3600})
    if (seconds < bound) return bound;
  return static_cast<int>(std::ceil(seconds));
}

void describe_conventions(Fields& f, models::Conventions& c) {
  std::string shear_yield = models::shear_yield_name(c.shear_yield);
  f("shear_yield", shear_yield);
  f.known("k_over_sigma_f", c.k_over_sigma_f);
  f("shear_limit", c.shear_limit);
  if (!f.reads()) return;
  const auto known = models::find_shear_yield(shear_yield);
  if (!known)
    throw InputError({f.file(), 0, 0}, "unknown shear_yield '" + shear_yield + "'",
                     "one of mises, tresca, flow_stress");
  c.shear_yield = *known;
}

// Describes the formula as text that reads back to the same bits.
void describe_formula(Fields& f, Law& law, const models::Conventions& conventions) {
  models::Formula formula;
  if (!f.reads()) formula = law.build(conventions);
  std::string value = f.reads() ? "" : expr::to_text(formula.value);
  std::string combine = f.reads() ? "" : expr::to_text(formula.combine);
  f("value", value);
  f("combine", combine);
  if (!f.reads()) return;
  formula = {expr::parse_expr(value, f.file()), expr::parse_expr(combine, f.file())};
  law.build = [formula](const models::Conventions&) { return formula; };
}

void describe_table(Fields& f, Law& law) {
  using models::PieceQuantity, models::quantity_name, models::Calibrated;
  f.one_of("quantity", law.quantity,
           {{quantity_name(PieceQuantity::mu), PieceQuantity::mu},
            {quantity_name(PieceQuantity::tau_R), PieceQuantity::tau_R}});
  f("log_value", law.log_value);
  f.known("kinks", law.kinks);
  f("reference", law.reference);
  bool calibrated = law.calibrated != Calibrated::fixed;
  f("calibrated", calibrated);
  if (f.reads()) law.calibrated = calibrated ? Calibrated::fit : Calibrated::fixed;
}

// Describes a law whose formula is not the registry's; under a name outside the registry with all
// its members.
void describe_made_law(Fields& f, Law& law, const models::Conventions& conventions) {
  describe_formula(f, law, conventions);
  f.known("log_axes", law.log_axes);
  const bool own_name = !models::find_law(law.name);
  if (own_name) f("base", law.base);
  if (own_name && f.has("quantity", true)) // not in files of 0.1
    describe_table(f, law);
  else if (f.has("kinks", !law.kinks.empty()))
    f.known("kinks", law.kinks);
  if (f.has("clamped_inputs", !law.clamped_inputs.empty())) // not in files of 0.2
    f.known("clamped_inputs", law.clamped_inputs);
  if (!own_name) return;
  f.known("levels", law.levels);
  f.each("bounds", law.parameters.size(), [&](Fields& bounds, std::size_t p) {
    bounds.known("start", law.parameters[p].start);
    bounds.known("lower", law.parameters[p].lower);
    bounds.known("upper", law.parameters[p].upper);
  });
}

// Returns the registered law that a law extends, because files of 0.1 lack the table's properties.
Law law_of_base(Fields& fit, const std::string& base) {
  if (!models::find_law(base))
    throw InputError({fit.file(), 0, 0},
                     fmt::format("law '{}' extends '{}', which is not a friction law",
                                 fit.json().at("name").get<std::string>(), base),
                     suggest(base, models::law_names()));
  Law law = *models::find_law(base);
  law.calibrated = models::Calibrated::fit;
  return law;
}

// Reads a law whose name is not registered, except for the members that describe_made_law() reads.
Law law_with_name_of_its_own(Fields& fit) {
  const Fields::Json& made = fit.json().at("law");
  Law law = made.contains("quantity") ? Law() : law_of_base(fit, made.at("base"));
  fit("name", law.name);
  models::checked_model_name(law.name, fit.file());
  fit("title", law.title);
  fit("formula", law.formula);
  law.parameters.clear();
  fit.list("parameters", law.parameters, [](Fields& f, models::Parameter& parameter) {
    f("name", parameter.name);
    f("unit", parameter.unit);
    f("meaning", parameter.meaning);
  });
  return law;
}

std::shared_ptr<const Law> read_law(Fields& fit) {
  const std::string name = fit.json().at("name");
  const Law* known = models::find_law(name);
  const bool made = fit.json().contains("law");
  if (known && !made) return models::shared_law(*known);
  if (!known && !(made && fit.json().at("law").contains("base")))
    throw InputError({fit.file(), 0, 0}, "unknown friction law '" + name + "'",
                     suggest(name, models::law_names()));
  Law law = known ? *known : law_with_name_of_its_own(fit);
  fit.within("law", [&](Fields& f) { describe_made_law(f, law, {}); });
  return models::unregistered_law(std::move(law));
}

// Returns the number of the formula's revision, from 1; 0 if the file contains the formula or the
// formula never changed.
int revision_of(const models::Model& model) {
  if (!models::is_registered(*model.law)) return 0;
  const std::string convention = models::shear_yield_name(model.conventions.shear_yield);
  const std::vector<std::string>& revised = model.law->revisions;
  return static_cast<int>(std::ranges::count(revised, convention));
}

// Throws InputError if the law's formula has changed, because parameters are valid only with the
// formula that they were calibrated with.
void check_parameters(const models::Model& model, const Fields::Json& fit,
                      const std::string& file) {
  const Law& law = *model.law;
  const char* const mends = "calibrate again with this version";
  if (models::is_registered(law) && fit.value("revision", 0) != revision_of(model))
    throw InputError({file, 0, 0},
                     fmt::format("was made with another formula of {}: '{}', now '{}'", law.name,
                                 fit.at("formula").get<std::string>(), law.formula),
                     mends);
  const Fields::Json& list = fit.at("parameters");
  for (std::size_t p = 0; p < law.parameters.size(); ++p)
    if (p >= list.size() || list[p].at("name") != law.parameters[p].name)
      throw InputError(
          {file, 0, 0},
          fmt::format("law '{}' lacks its parameter '{}'", law.name, law.parameters[p].name),
          mends);
}

void describe_parameters(Fields& f, ModelFit& fit) {
  const Law& law = *fit.model.law;
  if (f.reads()) {
    check_parameters(fit.model, f.json(), f.file());
    fit.model.parameters.resize(law.parameters.size());
    fit.std_error.resize(law.parameters.size());
  }
  f.each("parameters", law.parameters.size(), [&](Fields& one, std::size_t p) {
    one.only_written("name", law.parameters[p].name);
    one.known("value", fit.model.parameters[p]);
    if (one.reads() && fit.model.parameters[p] < 0 && law.parameters[p].lower >= 0)
      throw InputError({one.file(), 0, 0},
                       fmt::format("the parameter '{}' of law '{}' is {}, and is never below 0",
                                   law.parameters[p].name, law.name, fit.model.parameters[p]),
                       "calibrate again");
    one("std_error", fit.std_error[p]);
    one.only_written("unit", law.parameters[p].unit);
    one.only_written("meaning", law.parameters[p].meaning);
  });
}

// Describes the time of the fit as an upper bound. Reading gives half a second less, which is
// written as the same bound again.
void describe_seconds(Fields& f, double& seconds) {
  f.only_written("wall_time_below_s", whole_seconds_above(seconds));
  if (!f.reads()) return;
  f.known("wall_time_below_s", seconds);
  seconds -= 0.5;
}

// Writes the law's formulas, in the names of its inputs and parameters, for readers without
// frictab. The key `law` of an unregistered law already contains the piece.
void write_expressions(Fields& f, const models::Model& model) {
  const models::AssembledLaw law(model);
  f.within("expressions", [&](Fields& texts) {
    if (models::is_registered(*model.law)) texts.only_written("value", expr::to_text(law.piece));
    texts.only_written("combine", expr::to_text(law.combine));
  });
}

void write_law(Fields& f, const models::Model& model) {
  Law law = *model.law;
  if (!models::is_registered(*model.law))
    f.within("law", [&](Fields& made) { describe_made_law(made, law, model.conventions); });
  write_expressions(f, model);
}

// Kinds of fits in files. No experiment is left to validate a delivered fit, so its errors are
// written as cross-validation.
enum class Part {
  model,      // models/NAME.json
  calibrated, // a law of calibration.json
  delivered   // that law fitted to all experiments
};

void describe_fit(Fields& f, ModelFit& fit, Part part,
                  const std::vector<std::string>& experiments = {});

void describe_delivered(Fields& f, ModelFit& fit) {
  if (!f.has("delivered", fit.on_all != nullptr)) return;
  ModelFit on_all = f.reads() ? ModelFit() : *fit.on_all;
  f.within("delivered", [&](Fields& one) { describe_fit(one, on_all, Part::delivered); });
  if (!f.reads()) return;
  if (on_all.model.law->name != fit.model.law->name)
    throw InputError({f.file(), 0, 0},
                     fmt::format("what is delivered of '{}' is a '{}'", fit.model.law->name,
                                 on_all.model.law->name),
                     "calibrate again");
  fit.on_all = std::make_shared<const ModelFit>(std::move(on_all));
}

void describe_fit(Fields& f, ModelFit& fit, Part part,
                  const std::vector<std::string>& experiments) {
  models::Model& model = fit.model;
  const bool whole = part != Part::model, calibrated = part == Part::calibrated;
  if (f.reads()) model.law = read_law(f);
  f.only_written("name", model.law->name);
  f.only_written("title", model.law->title);
  f.only_written("formula", model.law->formula);
  if (!f.reads()) f.only_written("inputs", models::inputs(*model.law, model.conventions));
  f.within("conventions", [&](Fields& c) { describe_conventions(c, model.conventions); });
  describe_parameters(f, fit);
  if (whole) {
    f("std_error_method", fit.std_error_method);
    f("training", fit.training);
    if (calibrated) f("validation", fit.validation);
    if (calibrated)
      f.within("by_experiment_left_out",
               [&](Fields& list) { describe_unseen(list, fit.unseen, experiments); });
    describe_seconds(f, fit.seconds);
    f("evaluations", fit.evaluations);
    f("termination", fit.termination);
    f("remarks", fit.remarks);
  }
  f.known("experiment_gains", model.experiment_gains);
  if (whole) f("band", fit.band);
  f.unless_default("covariance", model.covariance); // not in files of 0.2
  if (whole && f.has("determination", fit.determination.condition > 0))
    f("determination", fit.determination);
  if (f.has("data_range", !fit.data_range.empty())) f.known("data_range", fit.data_range);
  f.if_there("training_record", fit.network);
  if (!f.reads() && revision_of(model) > 0) f.only_written("revision", revision_of(model));
  f.if_there("polynomial", fit.polynomial);
  if (!f.reads()) write_law(f, model);
  bool candidate = !fit.reference;
  if (f.has("candidate", fit.reference)) f("candidate", candidate); // not in files of 0.1
  if (f.reads()) fit.reference = !candidate;
  if (f.has("fitted_to", fit.fitted_to_all)) // not in files of 0.1.0
    f.one_of("fitted_to", fit.fitted_to_all, {{"all", true}, {"training", false}}, {false});
  if (calibrated) describe_delivered(f, fit);
  if (part == Part::delivered) f("cross_validation", fit.validation);
}

} // namespace

static void describe(Fields& f, Calibration& c) {
  f("data_hash", c.data_hash);
  f("synthetic_data", c.synthetic);
  f.one_of("loss", c.loss, {{"L2", Loss::l2}, {"L1", Loss::l1}, {"huber", Loss::huber}},
           {Loss::l2});
  f("seed", c.seed);
  describe_judged_by(f, "judged_by", c.judged_by);
  if (f.has("deliver", true)) { // not in files of 0.1.0
    f.one_of("deliver", c.deliver, {{"all", Deliver::all}, {"training", Deliver::training}},
             {Deliver::training});
    f("delivery_folds", c.delivery_folds);
  }
  if (f.has("recordings", true)) f("recordings", c.recordings);
  f("validation_experiments", c.validation_experiments);
  f.unless_default("experiments_left_out_in_turn", c.all_experiments);
  if (f.has("mean_stress_MPa", true)) // not in files of 0.2
    f.known("mean_stress_MPa", c.mean_stress_MPa);
  f.within("noise_floor", [&](Fields& floors) { describe_noise_floors(floors, c.noise_floors); });
  f.list("models", c.fits, [&](Fields& one, ModelFit& fit) {
    describe_fit(one, fit, Part::calibrated, c.validation_experiments);
    if (one.has("by_experiment_left_out_in_turn", !fit.over_all.empty()))
      one.within("by_experiment_left_out_in_turn",
                 [&](Fields& list) { describe_unseen(list, fit.over_all, c.all_experiments); });
  });
  if (f.has("influence", true)) f("influence", c.influence);
  f("left_out", c.left_out);
  f("comparisons", c.comparisons);
  f("choice", c.choice);
  if (!f.reads()) {
    std::string best = c.fits.empty() ? "" : best_fit(c).model.law->name;
    f.null_if_empty("best", best);
    f.null_if_empty("recommended", c.recommended.law);
  }
  if (f.has("recommendation", true)) f("recommendation", c.recommended); // not in files of 0.1
  f("conditional", c.conditional);
}

std::string calibration_json(const Calibration& calibration) {
  return io::record_text(calibration_schema,
                         [&](Fields& f) { describe(f, io::to_write(calibration)); });
}

Calibration parse_calibration(std::string_view text, const std::string& file) {
  Calibration calibration;
  io::read_record(text, file, calibration_schema, "calibrate again",
                  [&](Fields& f) { describe(f, calibration); });
  return calibration;
}

std::string model_json(const ModelFit& fit, const Calibration& calibration) {
  return io::record_text(model_schema, [&](Fields& f) {
    f.only_written("data_hash", calibration.data_hash);
    f.only_written("synthetic_data", calibration.synthetic);
    Fields::Json body;
    Fields fields(body);
    describe_fit(fields, io::to_write(fit.delivered()), Part::model);
    for (const char* key :
         {"name", "title", "formula", "inputs", "conventions", "parameters", "experiment_gains",
          "data_range", "law", "expressions", "revision", "fitted_to", "covariance"})
      if (body.contains(key)) f.only_written(key, body.at(key));
  });
}

ModelFit parse_model_fit(std::string_view text, const std::string& file) {
  ModelFit fit;
  io::read_record(text, file, model_schema, "give models/NAME.json of a run, or calibrate again",
                  [&](Fields& f) { describe_fit(f, fit, Part::model); });
  return fit;
}

models::Model parse_model(std::string_view text, const std::string& file) {
  return parse_model_fit(text, file).model;
}

} // namespace frictab::calibrate
