// The form of an effect that a law may lack: a factor of one quantity, neutral parameters give 1.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/registry.h"
#include "expr/expr.h"
#include "models/law.h"

namespace frictab {

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

// How one shape parameter (a parameter behind the amplitude) is started from the data.
struct Shape {
  double (*start)(const Spread&) = nullptr;
  bool fitted = true; // false: a reference point or scale, set once from the data and kept
  int column = 0;     // 0: from the spread of x, 1: of x2
};

// One file per form in src/effects/. The factor is a formula of "x" (and "x2" for a product of two
// quantities) and of the parameters; the amplitude scales the whole effect: 0 is neutral, bit for
// bit. A form may have several amplitudes (spline): it is linear in them, all 0 is neutral.
struct EffectForm {
  std::string name;
  int order = 0;
  std::string title;
  std::string formula;               // for people
  std::vector<Parameter> parameters; // amplitudes first; the others have units of x
  std::vector<Shape> shapes;         // one per parameter behind the amplitude
  // For a text column: one factor per level instead of a formula of x (form "category").
  bool categorical = false;
  bool two_columns = false;
  std::size_t amplitudes = 1;
  Expr (*factor)() = nullptr; // nullptr where categorical
  // Shape parameters (behind the amplitude) that a search over a column should try: near enough to
  // each other that one of them finds what a fit would; nullptr: the start values alone.
  std::vector<std::vector<double>> (*grid)(const Spread&) = nullptr;
};

// Start values of all parameters but the amplitude, which is 0. `x2` is used by forms of two
// columns only.
std::vector<double> start_values(const EffectForm& form, const Spread& x, const Spread& x2 = {});

// Evenly spaced inside the 5 % .. 95 % part of a column's range: places that a grid tries.
std::vector<double> places_to_try(const Spread& spread, int count);

// In listing order.
const std::vector<EffectForm>& all_effects();
const EffectForm* find_effect(std::string_view name); // nullptr where there is none
std::vector<std::string> effect_names();

} // namespace frictab
