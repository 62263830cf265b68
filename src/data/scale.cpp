// Compares typical values of tests with usual ranges, and with each other.
#include "data/scale.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "core/no_value.h"
#include "core/text.h"
#include "core/units.h"
#include "data/condense.h"
#include "data/middle.h"
#include "data/quantity.h"
#include "data/tests_apart.h"

namespace frictab::data {

namespace {

// ---- the table ----

// Usual range of a test's typical value: from rock at plate rates to lead screws and traction
// machines, from shear cells to cold forging. Values outside raise doubt about the unit, not about
// the value.
struct Usual {
  const char* quantity;
  double low, high;
};
constexpr Usual usual_values[] = {{"sigma_n_MPa", 1e-3, 5000}, {"tau_R_MPa", 1e-5, 2000},
                                  {"sigma_f_MPa", 5, 4000},    {"v_rel_mm_s", 1e-6, 2e4},
                                  {"T_contact_C", 10, 1300},   {"T_tool_C", 10, 1300},
                                  {"s_mm", 1e-3, 1e8},         {"time_s", 0.05, 1e6}};
constexpr double usual_mu_low = 0.01, usual_mu_high = 0.8;
// Ranges of the normal stress over the flow stress: usual, and possible.
constexpr double usual_low_of_flow = 0.05, usual_high_of_flow = 10;
constexpr double least_of_flow = 0.01, most_of_flow = 20;

// Speed that only a bullet reaches (345 m/s); grinding wheels run at 150 m/s.
constexpr double fastest_mm_s = 2e5;
constexpr double coldest_C = -200, hottest_C = 1500;
constexpr double kelvin_low = 270, room_in_kelvin = 330, kelvin = 273.15;
// Limits of a test's duration: 116 days; shorter than any impact. Short tests, and rows at a rate
// at which friction is hardly ever recorded, are reported.
constexpr double longest_s = 1e7, shortest_s = 1e-6, short_s = 1e-3, fast_row_s = 2e-5;
constexpr double longest_mm = 1e10;

} // namespace

std::vector<const char*> other_units(const std::string& unit) {
  if (unit == "N") return {"kN", "kgf", "lbf", "mN"};
  if (unit == "MPa") return {"kPa", "GPa", "Pa", "kgf/mm2", "bar", "psi"};
  if (unit == "mm/s") return {"m/s", "m/min", "mm/min", "um/s"};
  if (unit == "mm") return {"m", "um", "in", "cm"};
  if (unit == "s") return {"ms", "min", "h", "days"};
  if (unit == "degC") return {"K", "degF"};
  return {};
}

std::string unit_in_name(const std::string& name, const std::string& wanted) {
  const auto cut = [&](std::size_t end) { return name.find_last_of("_ ", end); };
  const std::size_t last = cut(name.npos);
  if (last == name.npos || last == 0) return "";
  const std::string unit = name.substr(last + 1);
  if (convert(unit, wanted)) return unit == "N" && last == 1 ? "" : unit;
  const std::size_t before = cut(last - 1);
  if (before == name.npos || before == 0) return "";
  const std::string over = name.substr(before + 1, last - before - 1) + "/" + unit;
  return convert(over, wanted) ? over : "";
}

namespace {

// ---- typical values ----

// Duration of a clock or length of a path, start of a temperature, median of the positive values of
// any other quantity.
double typical(const Dataset& data, const std::string& name, std::size_t e) {
  if (!data.has(name)) return no_value;
  const auto all = data.values(name);
  const std::size_t begin = data.first_row[e], end = data.first_row[e + 1];
  if (name.starts_with("T_")) return all[begin];
  std::vector<double> values; // stops at enough values
  for (std::size_t i = begin; i < end; i += 1 + (end - begin) / 100)
    values.push_back(all[i]);
  values.push_back(all[end - 1]);
  if (name == "time_s" || name == "s_mm") {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return *high - *low;
  }
  std::vector<double> above;
  std::copy_if(values.begin(), values.end(), std::back_inserter(above),
               [](double x) { return x > 0; });
  return upper_median(std::move(above));
}

// Value of a quantity, or of a product of powers of several: "s_mm / v_rel_mm_s / time_s".
template <class Typical> double typical_of(const std::string& what, const Typical& typical) {
  double value = no_value;
  std::size_t at = 0;
  for (std::size_t end = 0; end != what.npos; at = end + 3) {
    end = what.find(" / ", at);
    const double one = typical(what.substr(at, end - at));
    value = at == 0 ? one : value / one;
  }
  return value;
}

struct Span {
  double low = no_value, high = no_value;
  bool known() const { return low <= high; }
};

Span span_of(const Dataset& data, const std::string& what) {
  Span span;
  for (std::size_t e = 0; e < data.experiments.size(); ++e)
    if (const double x =
            typical_of(what, [&](const std::string& name) { return typical(data, name, e); });
        std::isfinite(x)) {
      span.low = std::fmin(span.low, x);
      span.high = std::fmax(span.high, x);
    }
  return span;
}

// Three significant digits, without an exponent if it is readable without one.
std::string shown(double x) {
  const double size = std::abs(x);
  if (size < 1000 || size >= 1e7) return fmt::format("{:.3g}", x);
  const double step = std::pow(10, std::floor(std::log10(size)) - 2);
  return thousands(std::size_t(std::llround(std::round(size / step) * step)))
      .insert(0, x < 0 ? "-" : "");
}

std::string shown(const Span& span) {
  const std::string low = shown(span.low), high = shown(span.high);
  return low == high ? low : low + " to " + high;
}

// ---- missing units ----

const AssumedUnit* assumed(const Dataset& data, const std::string& quantity) {
  for (const AssumedUnit& one : data.assumed)
    if (one.quantity == quantity) return &one;
  return nullptr;
}

// Range of a quantity if it were read in another unit. (An area divides both alike.)
Span in_unit(const Span& read, const Conversion& how) {
  return {how(read.low), how(read.high)};
}

// The other measured part of a coefficient.
std::string partner(const std::string& quantity) {
  return quantity == "F_R_N" ? "F_N_N" : quantity == "F_N_N" ? "F_R_N" : "sigma_n_MPa";
}

// The quantity that a unit decides, and whether a range of it is usual.
class Judged {
public:
  Judged(const Dataset& data, const std::string& quantity) : what(quantity) {
    const auto row = std::find_if(std::begin(usual_values), std::end(usual_values),
                                  [&](const Usual& one) { return one.quantity == quantity; });
    if (row != std::end(usual_values)) usual_ = {row->low, row->high};
    const bool above = quantity == "F_R_N" || quantity == "tau_R_MPa";
    if (quantity.starts_with("F_") || quantity == "tau_R_MPa") {
      what = above ? quantity + " / " + partner(quantity) : partner(quantity) + " / " + quantity;
      divides_ = !above;
      usual_ = {usual_mu_low, usual_mu_high};
    }
    read = span_of(data, what);
    const Span flow = quantity == "sigma_n_MPa" ? span_of(data, "sigma_f_MPa") : Span();
    if (flow.known()) usual_ = {usual_low_of_flow * flow.low, usual_high_of_flow * flow.high};
  }

  Span in(const Conversion& how) const {
    return divides_ ? Span{read.low / how.factor, read.high / how.factor} : in_unit(read, how);
  }
  bool is_usual(const Span& span) const {
    return span.known() && span.low >= usual_.low && span.high <= usual_.high;
  }

  std::string what;
  Span read;

private:
  Span usual_{0, 0};
  bool divides_ = false;
};

// True if path, speed and time agree and the path was measured: then only all of their units
// together can differ.
bool path_agrees(const Dataset& data) {
  const Span ratio = span_of(data, "s_mm / v_rel_mm_s / time_s");
  const bool integrated = std::any_of(data.notes.begin(), data.notes.end(), [](const auto& note) {
    return note.starts_with("s_mm integrated");
  });
  constexpr double same = 1.5;
  return !integrated && ratio.known() && ratio.low > 1 / same && ratio.high < same;
}

struct Others {
  // Units that would be usual, with the resulting values: "kN 500 to 2,050".
  std::vector<std::string> units;
  bool usual_as_read = false;
  Judged judged;
};

Others others_of(const Dataset& data, const AssumedUnit& unit) {
  Others out{{}, false, Judged(data, unit.quantity)};
  out.usual_as_read = out.judged.is_usual(out.judged.read);
  constexpr std::size_t most = 3;
  std::vector<std::string> names;
  if (!unit.from_name.empty()) names.push_back(unit.from_name);
  for (const char* const other : other_units(unit.unit))
    if (other != unit.from_name) names.emplace_back(other);
  for (const std::string& name : names) {
    const auto how = convert(name, unit.unit);
    if (!how || out.units.size() == most) continue;
    const Span there = out.judged.in(*how);
    if (name == unit.from_name || out.judged.is_usual(there))
      out.units.push_back(name + " " + shown(there));
  }
  return out;
}

// True if the question about this unit is asked elsewhere, cancels, or is answered by a coefficient
// that is usual with the other force in its stated unit.
bool is_settled(const Dataset& data, const AssumedUnit& unit, const Others& others) {
  const std::string& quantity = unit.quantity;
  const AssumedUnit* const pressure = assumed(data, "sigma_n_MPa");
  const bool both_forces = assumed(data, "F_R_N") && assumed(data, "F_N_N");
  if (quantity == "F_R_N" || quantity == "F_N_N") return both_forces || others.usual_as_read;
  if (quantity == "tau_R_MPa") return pressure || others.usual_as_read;
  // For a force over an area together with a friction force of known unit, the coefficient decides.
  if (quantity == "sigma_n_MPa" && unit.unit == "N")
    return assumed(data, "F_N_N") && data.has("F_R_N") && !both_forces;
  if (!path_agrees(data)) return false;
  if (quantity == "v_rel_mm_s") return !assumed(data, "s_mm") && !assumed(data, "time_s");
  return (quantity == "s_mm" || quantity == "time_s") && data.has("v_rel_mm_s");
}

std::string question(const AssumedUnit& unit, const Others& others) {
  const std::string ending =
      unit.from_name.empty() ? "" : fmt::format(" (its name ends with {})", unit.from_name);
  return fmt::format(
      "no unit is given for '{}'{}, taken as {}: {} is {}{}; in {}. Say which one where it is "
      "mapped: {} = {{ column = \"{}\", unit = \"{}\", ... }}",
      unit.column, ending, unit.unit, others.judged.what, shown(others.judged.read),
      others.usual_as_read ? "" : ", which is hardly so", join(others.units, ", in "),
      unit.quantity, unit.column, unit.unit);
}

// ---- comparison of tests ----

// A quantity, or the ratio of the first to the others, with its limits: most_span, its largest
// variation between tests of one unit; margin, the allowed distance of converted tests from the
// others; least_factor, the smallest factor between units that is reported; may_be_certain, whether
// a factor can prove an error.
struct Series {
  std::vector<const char*> of;
  double most_span, margin, least_factor;
  bool may_be_certain;
  std::string what() const { return fmt::format("{}", fmt::join(of, " / ")); }
};
constexpr double cannot_be_design = 900; // 1,000, except for rounding
// Forces first: a measured quantity is reported before the stresses computed from it.
const Series all_series[] = {{{"F_N_N"}, 5, 2, cannot_be_design, true},
                             {{"F_R_N"}, 5, 2, cannot_be_design, true},
                             {{"sigma_n_MPa"}, 5, 2, cannot_be_design, true},
                             {{"tau_R_MPa"}, 5, 2, cannot_be_design, true},
                             {{"sigma_f_MPa"}, 1.5, 1.05, 4, true},
                             {{"F_N_N", "sigma_n_MPa"}, 1.3, 1.15, 4, true},
                             {{"F_R_N", "tau_R_MPa"}, 1.3, 1.15, 4, true},
                             {{"s_mm", "v_rel_mm_s", "time_s"}, 1.3, 1.15, 4, true},
                             {{"tau_R_MPa", "sigma_n_MPa"}, 2.5, 1.2, 4, true},
                             {{"F_R_N", "F_N_N"}, 2.5, 1.2, 4, true},
                             {{"v_rel_mm_s"}, 3, 1.3, cannot_be_design, false},
                             {{"s_mm"}, 3, 1.3, cannot_be_design, false},
                             {{"time_s"}, 3, 1.3, cannot_be_design, false}};
// No design of one rig has levels as far apart as MPa and Pa: at such a factor the others may span
// more.
constexpr double far_factor = 1e5, far_span = 100, far_margin = 10;

struct Odd {
  std::vector<std::size_t> tests; // indices in `places`
  std::string unit;
  bool certain = false;
  Span own, others;
};

class Compared {
public:
  explicit Compared(std::span<const Dataset* const> parts) {
    for (const Dataset* part : parts)
      for (std::size_t e = 0; e < part->experiments.size(); ++e)
        places.push_back({part, e});
  }

  std::optional<Odd> odd_by_factor(const Series& series) const {
    sort_by(series.what());
    const std::size_t cut = largest_gap();
    if (cut == 0) return std::nullopt;
    std::optional<Odd> best;
    std::size_t best_place = 99;
    for (const bool high : {true, false}) {
      const std::size_t count = high ? sorted_.size() - cut : cut;
      if (2 * count > sorted_.size() || sorted_.size() - count < 2) continue;
      const Span low_side{sorted_[0].first, sorted_[cut - 1].first},
          high_side{sorted_[cut].first, sorted_.back().first};
      const Span &own = high ? high_side : low_side, &others = high ? low_side : high_side;
      const auto [unit, place, factor] = unit_between(series, own, others);
      if (unit.empty() || place >= best_place) continue;
      Odd odd = side(cut, high, own, others, unit);
      odd.certain = series.may_be_certain && factor > cannot_be_design;
      const bool may_be = odd.certain || (3 * count <= sorted_.size() && !is_set_otherwise(odd));
      if (!are_whole_files(odd) || !may_be) continue;
      best = odd;
      best_place = place;
    }
    return best;
  }

  // Finds levels of a design that agree with those of the others to less than a percent each after
  // a factor that no design uses, far from the others and with small steps among them.
  std::optional<Odd> odd_by_levels(const char* quantity, const std::string& unit) const {
    constexpr double same = 0.007, far = 2.5, by_chance = 0.1;
    sort_by(quantity);
    const std::size_t cut = largest_gap();
    if (cut == 0 || sorted_.size() < 5) return std::nullopt;
    const double gap = sorted_[cut].first / sorted_[cut - 1].first;
    for (const bool high : {true, false}) {
      const std::size_t count = high ? sorted_.size() - cut : cut;
      if (3 * count > sorted_.size() ||
          gap < far * largest_step(high ? 0 : cut + 1, high ? cut : sorted_.size()))
        continue;
      const auto others = high ? std::span(sorted_).first(cut) : std::span(sorted_).subspan(cut);
      const auto own = high ? std::span(sorted_).subspan(cut) : std::span(sorted_).first(cut);
      for (const char* const other : other_units(unit)) {
        const double factor = convert(other, unit)->factor;
        const double decades = std::log10(factor);
        if (std::abs(decades - std::round(decades)) < 1e-6 || (factor < 1) != high) continue;
        std::set<long> levels; // of the others, in steps of `same`
        for (const auto& [value, place] : others)
          levels.insert(std::lround(std::log(value) / same));
        const bool all = std::all_of(own.begin(), own.end(), [&](const auto& one) {
          return std::any_of(others.begin(), others.end(), [&](const auto& level) {
            return std::abs(std::log(factor * one.first / level.first)) < same;
          });
        });
        const double range = std::log(others.back().first / others.front().first) + 2 * same;
        const double share = std::min(1.0, 2 * same * double(levels.size()) / range);
        if (!all || levels.size() < 2 || std::pow(share, double(own.size())) > by_chance) continue;
        Odd odd = side(cut, high, {own.front().first, own.back().first},
                       {others.front().first, others.back().first},
                       fmt::format("{} in {}", quantity, other));
        if (are_whole_files(odd) && !is_set_otherwise(odd)) return odd;
      }
    }
    return std::nullopt;
  }

  std::optional<Odd> in_kelvin(const char* quantity) const {
    sort_by(quantity);
    // Start of the kelvin values; the gap before them and the largest other gap, in K.
    std::size_t cut = 0;
    double gap = 0, largest = 0;
    for (std::size_t i = 1; i < sorted_.size(); ++i)
      if (const double here = sorted_[i].first - sorted_[i - 1].first; here > gap) {
        largest = gap;
        gap = here;
        cut = i;
      } else {
        largest = std::max(largest, here);
      }
    if (cut < 2 || 2 * cut < sorted_.size()) return std::nullopt;
    const Span own{sorted_[cut].first, sorted_.back().first},
        others{sorted_[0].first, sorted_[cut - 1].first};
    constexpr double near = 3, equal = 1, least_gap = 100, larger = 1.5, setting = 300, about = 1.6;
    double off = 0; // largest distance to the nearest of the others
    for (std::size_t i = cut; i < sorted_.size(); ++i) {
      double nearest = own.high;
      for (std::size_t k = 0; k < cut; ++k)
        nearest = std::min(nearest, std::abs(sorted_[i].first - kelvin - sorted_[k].first));
      off = std::max(off, nearest);
    }
    const bool is_room = own.low > kelvin_low && own.high < room_in_kelvin;
    if (off > near || !is_room || gap < least_gap || gap < larger * largest) return std::nullopt;
    Odd odd = side(cut, true, own, others, fmt::format("{} in K", quantity));
    if (!are_whole_files(odd)) return std::nullopt;
    // A furnace at 300 degC must not be read as a room at 26.85 degC (300 K).
    odd.certain = off < equal || own.high < setting - about || own.low > setting + about;
    return odd;
  }

  std::vector<TestOf> places;

private:
  void sort_by(const std::string& what) const {
    sorted_.clear();
    for (std::size_t i = 0; i < places.size(); ++i)
      if (const double x =
              typical_of(what, [&](const std::string& name) { return typical_at(name, i); });
          std::isfinite(x) && x > 0)
        sorted_.emplace_back(x, i);
    std::sort(sorted_.begin(), sorted_.end());
  }

  double typical_at(const std::string& name, std::size_t place) const {
    std::vector<double>& known = typical_[name];
    for (std::size_t i = known.size(); i < places.size(); ++i)
      known.push_back(typical(*places[i].data, name, places[i].test));
    return known[place];
  }

  // Index of the first value after the largest gap; 0: fewer than three tests.
  std::size_t largest_gap() const {
    std::size_t cut = 0;
    for (std::size_t i = 1; sorted_.size() >= 3 && i < sorted_.size(); ++i)
      if (cut == 0 ||
          sorted_[i].first / sorted_[i - 1].first > sorted_[cut].first / sorted_[cut - 1].first)
        cut = i;
    return cut;
  }

  double largest_step(std::size_t begin, std::size_t end) const {
    double step = 1;
    for (std::size_t i = std::max<std::size_t>(begin, 1); i < end; ++i)
      step = std::max(step, sorted_[i].first / sorted_[i - 1].first);
    return step;
  }

  // Units in which the odd tests would be among the others, the position of the first unit in its
  // list, and its factor.
  static std::tuple<std::string, std::size_t, double>
  unit_between(const Series& series, const Span& own, const Span& others) {
    std::string text;
    std::size_t place = 0;
    double least = 0;
    for (std::size_t q = 0; q < series.of.size(); ++q) {
      const std::string unit = find_quantity(series.of[q])->unit;
      const auto units = other_units(unit);
      for (std::size_t i = 0; i < units.size(); ++i) {
        const double of_unit = convert(units[i], unit)->factor,
                     factor = q == 0 ? of_unit : 1 / of_unit, size = std::max(factor, 1 / factor);
        const bool far = size >= far_factor && series.may_be_certain;
        const double span = far ? far_span : series.most_span,
                     margin = far ? far_margin : series.margin;
        if (size < series.least_factor || own.high / own.low > span ||
            others.high / others.low > span || factor * own.low < others.low / margin ||
            factor * own.high > others.high * margin)
          continue;
        if (text.empty()) std::tie(place, least) = std::pair(i, size);
        text += fmt::format("{}{} in {}", text.empty() ? "" : " or ", series.of[q], units[i]);
      }
    }
    return {text, place, least};
  }

  Odd side(std::size_t cut, bool high, const Span& own, const Span& others,
           const std::string& unit) const {
    Odd odd{{}, unit, false, own, others};
    for (std::size_t i = high ? cut : 0; i < (high ? sorted_.size() : cut); ++i)
      odd.tests.push_back(sorted_[i].second);
    std::sort(odd.tests.begin(), odd.tests.end());
    return odd;
  }

  bool is_odd(const Odd& odd, std::size_t place) const {
    return std::binary_search(odd.tests.begin(), odd.tests.end(), place);
  }

  // True if the odd tests are complete files, since a file has one unit. A single file may combine
  // tests of several sources.
  bool are_whole_files(const Odd& odd) const {
    std::set<std::string> own, others;
    for (std::size_t i = 0; i < places.size(); ++i)
      (is_odd(odd, i) ? own : others).insert(places[i].file());
    const bool one_file = own == others && own.size() == 1;
    return one_file || std::none_of(own.begin(), own.end(),
                                    [&](const auto& file) { return others.count(file) > 0; });
  }

  bool is_set_otherwise(const Odd& odd) const {
    return are_set_otherwise(places, [&](std::size_t place) { return is_odd(odd, place); });
  }

  mutable std::map<std::string, std::vector<double>> typical_; // of quantities, by place
  mutable std::vector<std::pair<double, std::size_t>> sorted_; // value, place
};

std::string names_of(const Compared& compared, const Odd& odd) {
  std::vector<std::string> tests;
  std::set<std::string> files;
  for (const std::size_t i : odd.tests) {
    const TestOf& place = compared.places[i];
    tests.push_back("'" + place.data->experiments[place.test] + "'");
    if (!place.file().empty()) files.insert(place.file());
  }
  constexpr std::size_t most = 3;
  const auto some = [&](std::vector<std::string> names, const char* what) {
    const std::size_t more = names.size() - std::min(most, names.size());
    names.resize(names.size() - more);
    return join(names, ", ") + and_more(more, what);
  };
  const std::string text =
      fmt::format("test{} {}", tests.size() == 1 ? "" : "s", some(tests, "test"));
  return files.empty() ? text
                       : fmt::format("{} ({})", text, some({files.begin(), files.end()}, "file"));
}

} // namespace

Implausible normal_to_flow(const Dataset& data) {
  const Span ratio = span_of(data, "sigma_n_MPa / sigma_f_MPa");
  if (!ratio.known() || (ratio.high >= least_of_flow && ratio.low <= most_of_flow)) return {};
  const bool far_below = ratio.high < least_of_flow;
  Implausible out = {"", data.source_rows(), data.source_rows(),
                     fmt::format("sigma_n_MPa is {} at a flow stress sigma_f_MPa of {}",
                                 shown(span_of(data, "sigma_n_MPa")),
                                 shown(span_of(data, "sigma_f_MPa"))),
                     far_below ? "a force in kN, a normal stress in GPa, or a flow stress in kPa? "
                                 "`unit` where it is mapped"
                               : "a normal stress in kPa or Pa, or a flow stress in GPa? `unit` "
                                 "where it is mapped"};
  if (!far_below) return out;
  out.certain = false;
  if (const AssumedUnit* const unit = assumed(data, "sigma_n_MPa"))
    if (const Others others = others_of(data, *unit);
        !others.units.empty() && !is_settled(data, *unit, others)) {
      out.certain = true;
      out.hint = question(*unit, others);
    }
  return out;
}

Implausible sliding_speed(const Dataset& data) {
  if (!data.has("v_rel_mm_s")) return {};
  const auto values = data.values("v_rel_mm_s");
  std::vector<double> fast;
  std::copy_if(values.begin(), values.end(), std::back_inserter(fast),
               [](double v) { return v > fastest_mm_s; });
  return {"", fast.size(), values.size(),
          fmt::format("v_rel_mm_s is {}, above {} mm/s, where no rig and no process slides",
                      shown(upper_median(fast)), thousands(std::size_t(fastest_mm_s))),
          "a speed in um/s, or over a clock in days, as spreadsheets hold it? `unit` where it is "
          "mapped"};
}

Implausible temperature(const Dataset& data) {
  Implausible worst;
  for (const char* name : {"T_contact_C", "T_tool_C"}) {
    if (!data.has(name)) continue;
    const auto values = data.values(name);
    const auto [low, high] = source_range(data, name, values);
    const auto rows = std::size_t(std::count_if(
        values.begin(), values.end(), [](double T) { return T < coldest_C || T > hottest_C; }));
    if (low > kelvin_low && low < room_in_kelvin)
      worst = {
          "", data.source_rows(), data.source_rows(),
          fmt::format("{} is {:.4g} to {:.4g}, and never below {}", name, low, high, kelvin_low),
          "a temperature in K? unit = \"K\" where it is mapped"};
    else if (rows > worst.rows)
      worst = {"", rows, values.size(),
               fmt::format("{} is {:.4g} to {:.4g}, outside {} to {} degC", name, low, high,
                           coldest_C, hottest_C),
               "a temperature in K or degF, or a sensor that is broken? `unit` where it is mapped"};
  }
  return worst;
}

Implausible elapsed_time(const Dataset& data) {
  if (!data.has("time_s")) return {};
  Implausible out;
  out.of = data.rows();
  Span wrong, all;
  std::vector<double> steps;
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    const double lasts = typical(data, "time_s", e);
    const std::size_t rows = data.first_row[e + 1] - data.first_row[e];
    if (!(lasts > 0) || rows < 2) continue;
    steps.push_back(lasts / double(rows - 1));
    all = {std::fmin(all.low, lasts), std::fmax(all.high, lasts)};
    if (lasts <= longest_s && lasts >= shortest_s) continue;
    wrong = {std::fmin(wrong.low, lasts), std::fmax(wrong.high, lasts)};
    out.rows += rows;
  }
  const double step = upper_median(steps);
  if (out.rows > 0) {
    out.what = fmt::format("a test lasts {} s by time_s", shown(wrong));
  } else if (all.high < short_s || step < fast_row_s) {
    out.rows = out.of;
    out.certain = false;
    out.what = fmt::format("a test lasts {} s by time_s, and rows follow each other in {} s",
                           shown(all), shown(step));
  }
  out.hint = wrong.high > longest_s
                 ? "a clock in ms or us, or one that was reset? `unit` where it is mapped"
                 : "a clock in days, as spreadsheets hold it, or in min? `unit` where it is mapped";
  return out;
}

Implausible sliding_path(const Dataset& data) {
  if (!data.has("s_mm")) return {};
  Implausible out;
  out.of = data.rows();
  double longest = 0;
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    const double slid = typical(data, "s_mm", e);
    if (slid > longest_mm) out.rows += data.first_row[e + 1] - data.first_row[e];
    longest = std::max(longest, slid);
  }
  out.what = fmt::format("a test slides {} mm by s_mm", shown(longest));
  out.hint = "a path in um or nm, or a marker among its values? `unit` where it is mapped";
  return out;
}

Implausible mixed_units(std::span<const Dataset* const> parts) {
  const Compared compared(parts);
  std::vector<std::pair<std::string, Odd>> found;
  const auto add = [&](const std::string& what, const std::optional<Odd>& odd) {
    if (odd) found.emplace_back(what, *odd);
  };
  for (const char* const name : {"T_contact_C", "T_tool_C"})
    add(name, compared.in_kelvin(name));
  for (const Series& series : all_series)
    add(series.what(), compared.odd_by_factor(series));
  for (const auto& [name, unit] : {std::pair("sigma_n_MPa", "MPa"),
                                   {"tau_R_MPa", "MPa"},
                                   {"F_N_N", "N"},
                                   {"v_rel_mm_s", "mm/s"}})
    add(name, compared.odd_by_levels(name, unit));
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return a.second.certain && !b.second.certain;
  });
  if (found.empty()) return {};
  const Odd& first = found.front().second;
  std::string what = names_of(compared, first);
  std::size_t said = 0;
  for (const auto& [name, odd] : found)
    if (odd.tests == first.tests && said++ < 3)
      what += fmt::format("{} {} {}, of the others {} ({}?)", said == 1 ? ":" : ",", name,
                          shown(odd.own), shown(odd.others), odd.unit);
  Implausible out{"",
                  0,
                  0,
                  what,
                  "other units than in the other files? `unit` in a [[data.files]] rule with their "
                  "match; or other settings, if they were",
                  first.certain};
  for (std::size_t i = 0; i < compared.places.size(); ++i) {
    const std::size_t rows = compared.places[i].data->source_rows(compared.places[i].test);
    out.of += rows;
    if (std::binary_search(first.tests.begin(), first.tests.end(), i)) out.rows += rows;
  }
  return out;
}

void ask_for_units(Dataset& data) {
  std::vector<std::string> asked;
  std::set<std::string> quiet; // a force and its stress may come from one column
  for (const AssumedUnit& unit : data.assumed) {
    const bool is_other = !unit.from_name.empty();
    const Others others = others_of(data, unit);
    std::string as = fmt::format("{} ({})", unit.column, unit.unit);
    if (!is_other && (others.units.empty() || is_settled(data, unit, others)))
      quiet.insert(std::move(as));
    else if (is_other || !others.usual_as_read)
      data.unit_questions.push_back(question(unit, others));
    else
      asked.push_back(question(unit, others));
  }
  data.unit_questions.insert(data.unit_questions.end(), asked.begin(), asked.end());
  if (!quiet.empty())
    data.notes.push_back(fmt::format("no unit is given for {}: taken so", fmt::join(quiet, ", ")));
}

} // namespace frictab::data
