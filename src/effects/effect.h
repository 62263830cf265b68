// The form of an effect that a law may lack: a factor of one to three quantities, neutral
// parameters give 1.
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

// How a column's values are spread: what start values of shape parameters come from.
struct Spread {
  double minimum = 0;
  double low = 0; // 10 % quantile
  double median = 0;
  double high = 1; // 90 % quantile
  double maximum = 1;

  double span() const;     // high - low, or the nearest thing to it that is positive
  double positive() const; // the median where it is positive, else span()
};

// Of the finite values; the default Spread where there are none.
Spread spread_of(std::span<const double> values);

// How one shape parameter (a parameter behind the amplitude) is found from the spread of its input.
using Measure = double (*)(const Spread&);
struct Shape {
  Measure measure = nullptr;
  double share = 1;   // of the measure: where a fit starts
  bool fitted = true; // false: a reference point or scale, set once from the data and kept
  // What a search over columns tries, instead of the start alone: near enough to each other that
  // one of them finds what a fit would.
  std::size_t positions = 0;             // so many places within the range
  Measure tried_measure = nullptr;       // or
  std::vector<double> tried_shares = {}; // of it
  std::size_t input = 0;                 // whose spread it is: x (0), x2 (1) or x3 (2)

  double start(const Spread& spread) const { return share * measure(spread); }
};

struct EffectForm;

struct EffectInput {
  std::string column;              // recorded column or derived quantity (data/derived.h)
  std::vector<std::string> levels; // of a text column; the first is the reference
  // Where it was learned; beyond, the factor is held at its value at the end.
  double low = 0, high = 1;
  std::vector<double> knots = {}; // of smooth forms: where their curves are given, ascending
};

// Where an effect acts.
enum class ActsOn {
  mu,   // the tabulated piece, before any limit
  m,    // the limit
  tau,  // added, in units of tau_scale_MPa
  mu_m, // both mu and m, where a law has a limit of its own
};
const char* acts_on_name(ActsOn acts_on); // "mu", "m", "tau", "mu+m", as jobs and files have it
std::optional<ActsOn> find_acts_on(std::string_view name);

// One effect form with the columns it follows and the part of the law it acts on. The factor goes
// into `combine`, which is evaluated exactly after interpolation: a table needs no axis for it, and
// its drift does not grow.
struct PlacedEffect {
  const EffectForm* form = nullptr;
  std::vector<EffectInput> inputs; // as many as the form takes: x, x2, x3
  ActsOn acts_on = ActsOn::mu;
  std::vector<double> parameters; // as parameters_of lists them
  double tau_scale_MPa = 1;
  // What is added fades below this contact pressure: without pressure there is no friction. 0: not.
  double pressure_MPa = 0;
  double stiffness = 0; // of a penalised fit: weight of the form's roughness; 0: none
};

// Closed forms are rows of src/effects/forms.cpp, others have a file each. The factor is a formula
// of "x" (and "x2", "x3" for forms of several quantities) and of the parameters; the amplitude
// scales the whole effect: 0 is neutral, bit for bit. A form may have several amplitudes: it is
// linear in them, all 0 is neutral.
struct EffectForm {
  std::string name;
  int order = 0;
  std::string title;
  std::string formula; // for people
  std::vector<models::Parameter>
      parameters;            // the amplitude first; the others have units of x, x2 or x3
  std::vector<Shape> shapes; // one per parameter behind the amplitude
  std::size_t columns = 1;
  bool categorical = false;         // the first input is a text column: numbers of its levels
  std::optional<expr::Expr> factor; // absent where `build` stands for it
  // Forms whose parameters depend on levels or knots: all of them are amplitudes, `parameters`
  // above holds one that stands for them.
  std::vector<models::Parameter> (*parameters_of)(const PlacedEffect&) = nullptr;
  expr::Expr (*build)(const PlacedEffect&) = nullptr; // of x, x2, x3 and their names
  // Their values at an amplitude of 1: what a synthetic campaign plants.
  std::vector<double> (*pattern)(const PlacedEffect&) = nullptr;
  // Smooth forms: knots per input (0: none), and the roughness of the amplitudes, symmetric, row by
  // row, without negative eigenvalues; nullptr for closed forms.
  std::vector<int> knots;
  std::vector<double> (*penalty)(const PlacedEffect&) = nullptr;
  // For people, with numbers; nullptr: the formula and its parameters.
  std::string (*text)(const PlacedEffect&) = nullptr;
  // What a search tries where shape parameters depend on each other; nullptr: all that `shapes`
  // say.
  std::vector<std::vector<double>> (*grid)(const Spread&) = nullptr;
};

// Gives every input the knots that its form asks for; `values` of one column each.
void set_knots(PlacedEffect& effect, const std::vector<std::span<const double>>& values);

// The value of a text column's level, whose number is x.
expr::Expr value_by_level(const expr::Expr& x, std::span<const expr::Expr> values);
// Amplitudes of a planted effect of levels: they grow in equal steps up to 1.
std::vector<double> growing_pattern(const PlacedEffect& effect);

// All parameters of a form that is placed, and how many of them, in front, it is linear in.
std::vector<models::Parameter> parameters_of(const PlacedEffect& effect);
std::size_t amplitudes_of(const PlacedEffect& effect);
// The input that a parameter of a form is a value of, as its unit x, x2 or x3 says; nullptr: none.
const EffectInput* input_of(const models::Parameter& parameter, const PlacedEffect& effect);
// Its unit: that input's, empty where nobody has said it (a recorded column that is no canonical
// quantity); of a parameter that is no value of an input, its own.
std::string unit_of(const models::Parameter& parameter, const PlacedEffect& effect);
// 1 + ..., of x, x2, x3 and the names of the parameters.
expr::Expr formula_of(const PlacedEffect& effect);
// x, x2, x3: as many as the form takes.
std::vector<std::string> input_symbols(const EffectForm& form);

// Start values of all parameters but the amplitude, which is 0; one spread per column.
std::vector<double> start_values(const EffectForm& form, const std::vector<Spread>& spreads);

// Values of the shape parameters that a search over columns with these spreads should try.
std::vector<std::vector<double>> shapes_to_try(const EffectForm& form,
                                               const std::vector<Spread>& spreads);

// In listing order.
const std::vector<EffectForm>& all_effects();
const EffectForm* find_effect(std::string_view name); // nullptr where there is none
std::vector<std::string> effect_names();

} // namespace frictab::effects
