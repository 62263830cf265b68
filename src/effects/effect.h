// Forms of effects that a law may lack: factors of one to three quantities; neutral parameters
// give 1.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/registry.h"
#include "expr/expr.h"
#include "models/law.h"

namespace frictab::effects {

// Distribution of a column's values, from which start values of shape parameters are computed.
struct Spread {
  double minimum = 0;
  double low = 0; // 10 % quantile
  double median = 0;
  double high = 1; // 90 % quantile
  double maximum = 1;

  double span() const;     // high - low, or a positive substitute
  double positive() const; // the median if positive, else span()
};

// Computes the spread of the finite values; returns the default Spread if there are none.
Spread spread_of(std::span<const double> values);

// Rule that computes a shape parameter (any parameter after the amplitude) from its input's spread.
using Measure = double (*)(const Spread&);
struct Shape {
  Measure measure = nullptr;
  double share = 1;   // start value of a fit, as a multiple of the measure
  bool fitted = true; // false: a reference or scale, set once from the data
  // Values that a search over columns tries instead of the start, close enough to each other that
  // one of them detects the effect that a fit would find: `positions` places within the range, or
  // `tried_shares` times `tried_measure`.
  std::size_t positions = 0;
  Measure tried_measure = nullptr;
  std::vector<double> tried_shares = {};
  std::size_t input = 0; // input whose spread is measured: x (0), x2 (1) or x3 (2)

  double start(const Spread& spread) const { return share * measure(spread); }
};

struct EffectForm;

struct EffectInput {
  std::string column;              // recorded column or derived quantity (data/derived.h)
  std::vector<std::string> levels; // of a text column; the first is the reference
  // Range of the data that the effect was fitted to; values beyond it are clamped to its ends.
  double low = 0, high = 1;
  std::vector<double> knots = {}; // of smooth forms: nodes of their curves, ascending
};

// The part of a law that an effect acts on.
enum class ActsOn {
  mu,   // the tabulated piece, before any limit
  m,    // the limit
  tau,  // added, in units of tau_scale_MPa
  mu_m, // both mu and m, if the law has its own limit
};
const char* acts_on_name(ActsOn acts_on); // in jobs and files: "mu", "m", "tau", "mu+m"
std::optional<ActsOn> find_acts_on(std::string_view name);

// One effect form with the columns it follows and the part of the law it acts on. The factor goes
// into `combine`, which is evaluated exactly after interpolation: a table needs no axis for it, and
// its drift does not grow.
struct PlacedEffect {
  const EffectForm* form = nullptr;
  std::vector<EffectInput> inputs; // as many as the form takes: x, x2, x3
  ActsOn acts_on = ActsOn::mu;
  std::vector<double> parameters; // in the order of parameters_of
  double tau_scale_MPa = 1;
  // Contact pressure below which an added effect fades, because friction vanishes without pressure;
  // 0: never.
  double pressure_MPa = 0;
  double stiffness = 0; // of a penalised fit: weight of the form's roughness; 0: none
};

// An effect form. Closed forms are rows of forms.cpp, those of several amplitudes of
// amplitude_forms.cpp. The factor is a
// formula of "x" (and "x2", "x3" for forms of several quantities) and of the parameters; the
// amplitude scales the whole effect; an amplitude of 0 is neutral, bit for bit. A form with several
// amplitudes is linear in them and neutral if all are 0.
struct EffectForm {
  std::string name;
  int order = 0;
  std::string title;
  std::string formula; // for people
  std::vector<models::Parameter>
      parameters;                 // the amplitude first; the others have units of x, x2 or x3
  std::vector<Shape> shapes = {}; // one per parameter after the amplitude
  std::size_t columns = 1;
  std::size_t texts = 0; // the first so many inputs are text columns, given by level numbers
  std::optional<expr::Expr> factor = {}; // absent if `build` is set
  // For forms whose parameters depend on levels or knots: all are amplitudes, and `parameters`
  // above has one entry that represents them.
  std::vector<models::Parameter> (*parameters_of)(const PlacedEffect&) = nullptr;
  // Builds the formula of x, x2, x3 and the parameters' names.
  expr::Expr (*build)(const PlacedEffect&) = nullptr;
  // Amplitudes that a synthetic campaign plants for an effect of size 1.
  std::vector<double> (*pattern)(const PlacedEffect&) = nullptr;
  // For smooth forms: the number of knots per input (0: none), and the roughness matrix of the
  // amplitudes, row-major, symmetric and positive semidefinite; nullptr for closed forms.
  std::vector<int> knots = {};
  std::vector<double> (*penalty)(const PlacedEffect&) = nullptr;
  // Readable text with numbers; nullptr: the formula and its parameters.
  std::string (*text)(const PlacedEffect&) = nullptr;
  // Values that a search tries if shape parameters depend on each other; nullptr: all combinations
  // of the values from `shapes`.
  std::vector<std::vector<double>> (*grid)(const Spread&) = nullptr;
};

// Sets the knots of every input that its form requires; `values`: one column per input.
void set_knots(PlacedEffect& effect, const std::vector<std::span<const double>>& values);

// Returns all parameters of an effect, amplitudes first, and the number of its amplitudes.
std::vector<models::Parameter> parameters_of(const PlacedEffect& effect);
std::size_t amplitudes_of(const PlacedEffect& effect);
// Returns the input whose unit a parameter has, by its unit x, x2 or x3; nullptr for other units.
const EffectInput* input_of(const models::Parameter& parameter, const PlacedEffect& effect);
// Returns the unit of a parameter: the unit of its input (empty if unknown, for a recorded column
// that is not a canonical quantity), or else its own.
std::string unit_of(const models::Parameter& parameter, const PlacedEffect& effect);
// Returns the factor, 1 + ..., as a formula of x, x2, x3 and the names of the parameters.
expr::Expr formula_of(const PlacedEffect& effect);
// Returns the levels of a text input or, of two, the pairs of levels: "oil A, coated"; those of the
// first level of the first come first.
std::vector<std::string> level_names(const PlacedEffect& effect);
// Returns x, x2, x3, as many as the form takes.
std::vector<std::string> input_symbols(const EffectForm& form);

// Returns start values of all parameters except the amplitude, which is 0; one spread per column.
std::vector<double> start_values(const EffectForm& form, const std::vector<Spread>& spreads);

// Returns values of the shape parameters for a search over columns with these spreads.
std::vector<std::vector<double>> shapes_to_try(const EffectForm& form,
                                               const std::vector<Spread>& spreads);

// Returns all forms in listing order.
const std::vector<EffectForm>& all_effects();
const EffectForm* find_effect(std::string_view name); // nullptr if not found
std::vector<std::string> effect_names();

} // namespace frictab::effects
