// A friction law as data: what it is called, what it needs, its parameters and its formula. From
// the formula come calibration, tables, generated code and bounds; nothing else knows the law.
#pragma once

#include <functional>
#include <map>
#include <memory>
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

// What k and the shear limit mean in this job.
struct Conventions {
  ShearYield shear_yield = ShearYield::mises;
  double k_over_sigma_f = shear_yield_ratio(ShearYield::mises);
  bool shear_limit = true; // 0 <= tau_R <= k; off where the data have no flow stress
};

struct Parameter {
  std::string name;
  std::string unit;
  std::string meaning;
  double start; // default start value, or the value of a fixed law
  double lower;
  double upper;
  std::string settled_by = {}; // what experiments would settle it: "experiments at several speeds"
};

// tau_R = combine(value, state, parameters), value = value(state, parameters).
// `value` is the smooth piece that is tabulated; kinks belong into `combine`, which is evaluated
// exactly after interpolation. Symbols: canonical state names (sigma_n_MPa, psi, v_rel_mm_s,
// T_contact_C, s_mm, sigma_f_MPa), parameter names and, in `combine`, "value".
struct Formula {
  expr::Expr value;
  expr::Expr combine;
};

enum class Calibrated {
  fixed,  // constants of the literature
  mean,   // means of mu_meas and m_meas over the training rows (the paper's way)
  fit,    // by the loss of the job
  train,  // the formula itself is found: an ensemble of networks
  regress // the formula itself is found: a polynomial, by generalised least squares
};

// Whether the law's formula holds numbers from the data, behind one parameter that scales it.
constexpr bool is_trained(Calibrated how) {
  return how == Calibrated::train || how == Calibrated::regress;
}

struct Law {
  std::string name;
  int order = 0; // place in listings
  std::string title;
  std::string formula; // for people
  std::string
      reference; // where formula and constants come from; says "ours" where it is our choice
  Calibrated calibrated = Calibrated::fit;
  std::vector<Parameter> parameters;
  PieceQuantity quantity = PieceQuantity::mu;
  bool log_value = false;               // tabulate ln(value): straight for products of powers
  std::map<std::string, bool> log_axes; // axis coordinate where it differs from the quantity's
  std::map<std::string, std::vector<double>> kinks; // on an axis, inside `value`: get a node each
  std::map<std::string, std::pair<double, double>> held; // inputs held at these ends
  std::vector<std::string> may_use; // trained laws: states used where the data vary in them
  std::string base; // of a law with traced effects: the registered one it extends; else empty
  // Inputs that are text columns: the levels that their numbers 0, 1, ... stand for.
  std::map<std::string, std::vector<std::string>> levels;
  std::function<Formula(const Conventions&)> build;
  // Conventions of k by which the same parameters came to mean another stress, once per time. A
  // file of a registered law holds parameters and not the formula, and must be of the same count.
  std::vector<std::string> revisions;
  std::map<std::string, Place> places = {}; // of a user's law: where its columns are first named
};

// Shear yield stress k as a formula of the flow stress.
expr::Expr shear_yield_stress(const Conventions& conventions);

// State names the law's tau_R depends on, in canonical order (with the shear limit's sigma_f_MPa);
// behind them, by name, symbols of columns and derived quantities that a traced effect brought in.
std::vector<std::string> inputs(const Law& law, const Conventions& conventions);
// The same where the law's tau_R is written out already.
std::vector<std::string> inputs_of(const expr::Expr& tau_R, const Law& law);

// The shear stress `combine` under the shear limit: minimum(gain maximum(combine, 0), k).
expr::Expr limited(const expr::Expr& combine, const Conventions& conventions, double gain = 1);

// tau_R in MPa as one formula of state and parameters. For a calibrated law see
// models/assembled_law.h.
expr::Expr tau_formula(const Law& law, const Conventions& conventions);

std::vector<std::string> parameter_names(const Law& law);

// One calibrated law: with this, and nothing else, tau_R can be predicted. Its law is a registered
// one, or one that was found from data and is nowhere else.
struct Model {
  std::shared_ptr<const Law> law;
  Conventions conventions;
  std::vector<double> parameters; // in the law's order
  // Of the parameters, row by row, with the experiment as the unit: 0 for one that is held, NaN for
  // one that a single experiment determines. Empty: not known, as of a law that was trained.
  std::vector<double> covariance = {};
  // One end of the band in which experiments lie (calibrate/band.h): tau_R of the law times `gain`.
  double quantile = 0.5; // of experiments; 0.5: the law itself
  double gain = 1;
  // Factors between experiments and the law, ascending: what the band is made of.
  std::vector<double> experiment_gains;

  const std::string& base() const; // the registered law: its own, or the one it extends
  bool traced() const { return !law->base.empty(); } // with effects found in the data
  std::string name() const; // the law's; log_coulomb_q05 for its 5 % quantile
};

// How a model holds its law: one of the registry, or one that is nowhere else - found from data, or
// written by a user - of which it keeps a copy.
std::shared_ptr<const Law> held_law(const Law& law);
std::shared_ptr<const Law> unregistered_law(Law law);

// Whether the law is the registry's: then its name says all about it.
bool is_registered(const Law& law);

// What a law with traced effects is called: log_coulomb_traced.
std::string traced_name(std::string_view base);
// Whether a parameter has the name of one that tracing adds for its effects: e1_a, e2_x0.
bool is_effect_parameter(std::string_view name);

// The laws that a job knows: those of the registry, and behind them its own.
class Laws {
public:
  void add(Law law) { own_.push_back(unregistered_law(std::move(law))); }
  std::vector<const Law*> all() const;
  std::vector<std::string> names() const;
  const Law* find(std::string_view name) const; // nullptr where there is none
  const std::vector<std::shared_ptr<const Law>>& own() const { return own_; }

private:
  std::vector<std::shared_ptr<const Law>> own_;
};

// Where a name is all there is, in a job and on files of earlier runs; a Model says it itself.
struct ModelName {
  const Law* base = nullptr; // nullptr: it names no model
  bool traced = false;
  bool quantile = false;
};
// Of log_coulomb, log_coulomb_q05 and log_coulomb_traced_q05 the base is log_coulomb.
ModelName read_model_name(std::string_view name, const Laws& laws);
// A name from a file; it becomes part of file names and of generated text. Throws InputError that
// names `file` unless it is 1 to 100 letters, digits, '_', '.' and '-', the first no '.'.
std::string checked_model_name(const std::string& name, const std::string& file);

const std::vector<Law>& all_laws();
const Law* find_law(std::string_view name);
std::vector<std::string> law_names(); // of all_laws()

} // namespace frictab::models
