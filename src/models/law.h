// A friction law as data: its name, inputs, parameters and formula. Calibration, tables, generated
// code and bounds all follow from the formula; no other code is specific to a law.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/registry.h"
#include "expr/expr.h"
#include "models/piece_quantity.h"
#include "models/shear_yield.h"

namespace frictab::models {

// The definitions of k and of the shear limit in a job.
struct Conventions {
  ShearYield shear_yield = ShearYield::mises;
  double k_over_sigma_f = shear_yield_ratio(ShearYield::mises);
  bool shear_limit = true; // 0 <= tau_R <= k; false if the data have no flow stress
};

struct Parameter {
  std::string name;
  std::string unit;
  std::string meaning;
  double start; // default start value, or the value of a fixed law
  double lower;
  double upper;
  // Experiments that would determine it: "experiments at several speeds".
  std::string settled_by = {};
};

// tau_R = combine(value, state, parameters), value = value(state, parameters).
// `value` is the smooth piece that is tabulated; kinks belong in `combine`, which is evaluated
// exactly after interpolation. Symbols: canonical state names (sigma_n_MPa, psi, v_rel_mm_s,
// T_contact_C, s_mm, sigma_f_MPa), parameter names and, in `combine`, "value".
struct Formula {
  expr::Expr value;
  expr::Expr combine;
};

enum class Calibrated {
  fixed,  // constants of the literature
  mean,   // means of mu_meas and m_meas over the training rows (the paper's method)
  fit,    // minimises the loss of the job
  train,  // the formula itself is found: an ensemble of networks
  regress // the formula itself is found: a polynomial, by generalised least squares
};

// Whether the law's formula contains numbers found from the data, scaled by its one parameter.
constexpr bool is_trained(Calibrated how) {
  return how == Calibrated::train || how == Calibrated::regress;
}

struct Law {
  std::string name;
  int order = 0; // place in listings
  std::string title;
  std::string formula;   // for people
  std::string reference; // source of formula and constants; "ours" for our own choices
  Calibrated calibrated = Calibrated::fit;
  std::vector<Parameter> parameters;
  PieceQuantity quantity = PieceQuantity::mu;
  bool log_value = false; // tabulate ln(value), which is linear for products of powers
  std::map<std::string, bool> log_axes; // axis coordinates that differ from the quantity's
  std::map<std::string, std::vector<double>> kinks; // inside `value`, by axis: a node each
  std::map<std::string, std::pair<double, double>> clamped_inputs; // to [low, high]
  std::vector<std::string> may_use; // trained laws: states used if the data vary in them
  std::string base; // of a law with traced effects: the registered law it extends; else empty
  // Levels of the inputs that are text columns, in the order of their numbers 0, 1, ...
  std::map<std::string, std::vector<std::string>> levels;
  std::function<Formula(const Conventions&)> build;
  // One convention of k per change of the formula that gave the same parameters another stress
  // under that convention. A file of a registered law has parameters without the formula, so it is
  // accepted only with the same number of changes.
  std::vector<std::string> revisions;
  std::map<std::string, Place> places = {}; // of a user's law: first mention of each column
};

// Returns the shear yield stress k as a formula of the flow stress.
expr::Expr shear_yield_stress(const Conventions& conventions);

// Returns the states that the law's tau_R depends on, in canonical order (with the shear limit's
// sigma_f_MPa), followed by the symbols of columns and derived quantities that traced effects use,
// sorted by name.
std::vector<std::string> inputs(const Law& law, const Conventions& conventions);
// Does the same for a tau_R that is already written out.
std::vector<std::string> inputs_of(const expr::Expr& tau_R, const Law& law);

// Returns the shear stress `combine` with the shear limit applied:
//   minimum(gain maximum(combine, 0), k).
expr::Expr limited(const expr::Expr& combine, const Conventions& conventions, double gain = 1);

// Returns tau_R in MPa as one formula of states and parameters. For a calibrated law see
// models/assembled_law.h.
expr::Expr tau_formula(const Law& law, const Conventions& conventions);

std::vector<std::string> parameter_names(const Law& law);
std::vector<double> start_values(std::span<const Parameter> parameters);

// One calibrated law, complete for predicting tau_R. Its law is registered, or found from data or
// written by a user and stored only here.
struct Model {
  std::shared_ptr<const Law> law;
  Conventions conventions;
  std::vector<double> parameters; // in the law's order
  // Covariance of the parameters, row-major, with the experiment as the unit: 0 for a parameter at
  // a bound, NaN for one that a single experiment determines. Empty if unknown, as for a trained
  // law.
  std::vector<double> covariance = {};
  // For one end of the band of experiments (calibrate/band.h): tau_R is the law's times `gain`.
  double quantile = 0.5; // of experiments; 0.5: the law as calibrated
  double gain = 1;
  // Factors between experiments and the law, ascending; the band is computed from them.
  std::vector<double> experiment_gains;

  const std::string& base() const;                   // name of the law, or of the law it extends
  bool traced() const { return !law->base.empty(); } // with effects found in the data
  std::string name() const; // the law's; log_coulomb_q05 for its 5 % quantile
};

// Returns the pointer by which a model keeps its law: to the registry's law, or to a copy of a law
// that was found from data or written by a user.
std::shared_ptr<const Law> shared_law(const Law& law);
std::shared_ptr<const Law> unregistered_law(Law law);

// Whether the law is the registry's own object, so that its name identifies it.
bool is_registered(const Law& law);

// Returns the name of a law with traced effects: log_coulomb_traced.
std::string traced_name(std::string_view base);
// Whether the name has the form of parameters that tracing adds for its effects: e1_a, e2_x0.
bool is_effect_parameter(std::string_view name);

// The laws available in a job: those of the registry, followed by the job's own.
class Laws {
public:
  void add(Law law) { own_.push_back(unregistered_law(std::move(law))); }
  std::vector<const Law*> all() const;
  std::vector<std::string> names() const;
  const Law* find(std::string_view name) const; // nullptr if not found
  const std::vector<std::shared_ptr<const Law>>& own() const { return own_; }

private:
  std::vector<std::shared_ptr<const Law>> own_;
};

// The parts of a model's name, for jobs and files of earlier runs, which have only the name.
struct ModelName {
  const Law* base = nullptr; // nullptr: not the name of a model
  bool traced = false;
  bool quantile = false;
};
// Parses a name; log_coulomb, log_coulomb_q05 and log_coulomb_traced_q05 have the base log_coulomb.
ModelName read_model_name(std::string_view name, const Laws& laws);
// Checks a name from a file, which becomes part of file names and of generated text. Throws
// InputError with `file` unless it has 1 to 100 letters, digits, '_', '.' and '-' and does not
// begin with '.'.
std::string checked_model_name(const std::string& name, const std::string& file);

const std::vector<Law>& all_laws();
const Law* find_law(std::string_view name);
std::vector<std::string> law_names(); // of all_laws()

} // namespace frictab::models
