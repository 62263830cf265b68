// Evaluates the factor along its first quantity, at the ends of the second.
#include "effects/change_text.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "core/columns.h"
#include "core/text.h"
#include "effects/extended_law.h"

namespace frictab::effects {

namespace {

constexpr std::size_t points = 101; // along a quantity
// Smallest extreme between the ends that is reported, as a fraction of the whole change.
constexpr double worth_telling = 0.1;
constexpr std::size_t levels_shown = 6; // of more, only those of lowest and highest friction
// Smallest start value of a percentage, as a fraction of the end value or of 1 if that is larger.
constexpr double no_base = 0.05;

class ChangeText {
public:
  ChangeText(const PlacedEffect& effect, std::span<const PlacedEffect> law)
      : e_(effect), program_(factor_program(effect)), law_(law) {}

  std::string run() const {
    if (e_.inputs.size() == 1) {
      if (is_text(0)) return levels();
      const Curve curve = along(0, {middle(0)});
      return what() + " " + change(curve.front(), curve.back()) + range(0) + extreme(curve);
    }
    if (e_.form->texts == 2) return of_pairs();
    return of_two(is_text(0) ? 1 : 0, is_text(0) ? 0 : 1);
  }

private:
  using Curve = std::vector<double>;

  bool is_text(std::size_t input) const { return !e_.inputs[input].levels.empty(); }
  double middle(std::size_t input) const {
    return 0.5 * (e_.inputs[input].low + e_.inputs[input].high);
  }
  static std::vector<double> places_along(const EffectInput& x) {
    std::vector<double> places;
    for (std::size_t i = 0; i < points; ++i)
      places.push_back(x.low +
                       (x.high - x.low) * static_cast<double>(i) / static_cast<double>(points - 1));
    return places;
  }

  Curve factors(const std::vector<std::vector<double>>& columns) const {
    Curve factor(columns[0].size());
    program_.evaluate(factor.size(), pointers(columns), fitted_values(e_), factor.data());
    return factor;
  }

  // Evaluates along one input, with the others fixed at these values.
  Curve along(std::size_t input, const std::vector<double>& at) const {
    std::vector<std::vector<double>> columns;
    for (const double value : at)
      columns.emplace_back(points, value);
    columns[input] = places_along(e_.inputs[input]);
    return factors(columns);
  }

  std::string what() const {
    if (e_.acts_on == ActsOn::m) return "limit";
    return e_.acts_on == ActsOn::tau ? "tau_R" : "friction";
  }

  std::string change(double from, double to) const {
    if (e_.acts_on == ActsOn::tau) return signed_text(e_.tau_scale_MPa * (to - from)) + " MPa";
    if (!(std::abs(from) > no_base * std::max(std::abs(to), 1.0)))
      return fmt::format("{:.2g} to {:.2g} of the law's", from, to);
    return signed_text(100 * (to / from - 1)) + " %";
  }

  // Prints at least two digits; rounding errors become +0.
  static std::string signed_text(double value) {
    constexpr double rounding = 1e-9;
    if (std::abs(value) < rounding) return "+0";
    return std::abs(value) < 10 ? fmt::format("{:+.2g}", value) : fmt::format("{:+.0f}", value);
  }

  std::string range(std::size_t input) const {
    const EffectInput& x = e_.inputs[input];
    return fmt::format(" from {:.4g} to {:.4g}", x.low, x.high);
  }

  // Describes an extreme between the ends if it is clearly above or below both.
  std::string extreme(const Curve& curve) const {
    const auto [low, high] = std::ranges::minmax_element(curve);
    const double enough = worth_telling * (*high - *low);
    const auto [small, large] = std::minmax(curve.front(), curve.back());
    std::string text;
    const auto tell = [&](const char* word, Curve::const_iterator at) {
      text += fmt::format(", {} ({}) at {:.4g}", word, change(curve.front(), *at),
                          places_along(e_.inputs[0])[static_cast<std::size_t>(at - curve.begin())]);
    };
    if (small - *low > enough) tell("lowest", low);
    if (*high - large > enough) tell("highest", high);
    return text;
  }

  static std::vector<double> level_numbers(const EffectInput& text) {
    std::vector<double> numbers(text.levels.size());
    std::iota(numbers.begin(), numbers.end(), 0.0);
    return numbers;
  }

  std::string levels() const {
    const auto& names = e_.inputs[0].levels;
    const Curve factor = factors({level_numbers(e_.inputs[0])});
    std::vector<std::string> changes;
    for (std::size_t level = 1; level < names.size(); ++level)
      changes.push_back(names[level] + " " + change(factor[0], factor[level]));
    std::string more;
    if (names.size() > levels_shown) {
      const auto [low, high] = std::ranges::minmax_element(factor);
      changes.clear();
      for (const auto at : {low, high})
        changes.push_back(names[static_cast<std::size_t>(at - factor.begin())] + " " +
                          change(factor[0], *at));
      more = fmt::format(", the other {} between them", names.size() - 2);
    }
    return what() + " against " + names[0] + ": " + join(changes, ", ") + more;
  }

  // Describes the changes between the levels of the first text at each level of the second.
  std::string of_pairs() const {
    const EffectInput &x = e_.inputs[0], &y = e_.inputs[1];
    const bool two = x.levels.size() == 2; // then the other level is named once
    std::vector<std::string> changes;
    for (const double level : level_numbers(y)) {
      Curve factor = factors({level_numbers(x), Curve(x.levels.size(), level)});
      add_own_effects(0, factor, level_numbers(x));
      std::vector<std::string> here;
      for (std::size_t i = 1; i < x.levels.size(); ++i)
        here.push_back((two ? "" : x.levels[i] + " ") + change(factor[0], factor[i]));
      changes.push_back(join(here, " and ") + " with " + y.levels[static_cast<std::size_t>(level)]);
    }
    if (changes.size() > levels_shown) {
      changes.resize(levels_shown);
      changes.push_back(fmt::format("{} more", y.levels.size() - levels_shown));
    }
    return what() + (two ? " with " + x.levels[1] : "") + " against " + x.levels[0] + ": " +
           join(changes, ", ");
  }

  // Adds what the same law's effects of this input alone do at the same site: a product changes
  // them.
  void add_own_effects(std::size_t input, Curve& curve, const std::vector<double>& places) const {
    for (const PlacedEffect& other : law_) {
      if (other.inputs.size() != 1 || other.acts_on != e_.acts_on ||
          other.inputs[0].column != e_.inputs[input].column)
        continue;
      const Curve own = ChangeText(other, {}).factors({places});
      for (std::size_t i = 0; i < curve.size(); ++i)
        curve[i] = e_.acts_on == ActsOn::tau ? curve[i] + own[i] : curve[i] * own[i];
    }
  }

  // Describes the change along `input` at each level or at both ends of `other`.
  std::string of_two(std::size_t input, std::size_t other) const {
    const auto from_to = [&](double value) {
      std::vector<double> at;
      for (std::size_t i = 0; i < e_.inputs.size(); ++i)
        at.push_back(i == other ? value : middle(i));
      Curve curve = along(input, at);
      add_own_effects(input, curve, places_along(e_.inputs[input]));
      return change(curve.front(), curve.back());
    };
    std::vector<std::string> changes;
    const EffectInput& y = e_.inputs[other];
    for (std::size_t level = 0; level < std::min(y.levels.size(), levels_shown); ++level)
      changes.push_back(y.levels[level] + " " + from_to(static_cast<double>(level)));
    if (y.levels.size() > levels_shown)
      changes.push_back(fmt::format("{} more", y.levels.size() - levels_shown));
    if (y.levels.empty())
      changes = {fmt::format("{} at {} = {:.4g}", from_to(y.low), y.column, y.low),
                 fmt::format("{} at {:.4g}", from_to(y.high), y.high)};
    return what() + " with " + e_.inputs[input].column + range(input) + ": " + join(changes, ", ");
  }

  const PlacedEffect& e_;
  const expr::Program program_;
  const std::span<const PlacedEffect> law_;
};

} // namespace

std::string change_text(const PlacedEffect& effect, std::span<const PlacedEffect> law) {
  return ChangeText(effect, law).run();
}

} // namespace frictab::effects
