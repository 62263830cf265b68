// Handles signs test by test, and decides campaign-wide questions when the campaign is complete.
#include "data/signs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

#include <fmt/format.h>

#include "core/no_value.h"
#include "core/text.h"
#include "data/computed.h"
#include "data/leave_out.h"
#include "data/middle.h"
#include "data/name_words.h"
#include "data/quantity.h"
#include "io/csv.h"

namespace frictab::data {

namespace {

using Values = std::span<const double>;

// Smallest number of rows per direction for an offset of a cycle, and of the test; of cycles that
// show a drift.
constexpr std::size_t cycle_rows = 10, test_rows = 3, drift_cycles = 3;
// Load of the opposite sign that still counts as none, relative to the typical load.
constexpr double still_unloaded = 0.05;
// Smallest number of rows without load, and at rest, that determine a zero.
constexpr std::size_t unloaded_rows = 10, rest_rows = 5;
// Smallest numbers of rows of a pause and of a test between pauses. long_pause_rows, other_setting:
// pauses, and differences of load or speed between such tests, that lead to a question.
constexpr std::size_t pause_rows = 5, long_pause_rows = 20;
constexpr double other_setting = 0.1;
// other_load: smallest ratio of loads that distinguishes a zero from friction; clearly: ratio of
// scatters over the tests that decides between the two; matters: smallest relevant offset as a
// share of the friction; share_of_zero: smallest friction of some test as a share of a zero above
// it.
constexpr double other_load = 1.2, clearly = 0.5, matters = 0.02, share_of_zero = 0.2;

// "\1v_rel_mm_s": a character that no header contains.
std::string signed_name(const std::string& canonical) {
  return '\1' + canonical;
}

double finite_median(std::vector<double> values) { // NaN for no values
  std::erase_if(values, [](double x) { return !std::isfinite(x); });
  return values.empty() ? no_value : median_of(std::move(values));
}

struct Middle {
  double value = no_value, error = 0;
  std::size_t rows = 0;
};

// The median and its standard error, assuming Gaussian and independent rows.
Middle middle_with_error(const std::vector<double>& values) {
  Middle out{finite_median(values), 0, values.size()};
  std::vector<double> off;
  for (const double x : values)
    off.push_back(std::abs(x - out.value));
  if (out.rows > 0)
    out.error =
        1.2533 * 1.4826 * finite_median(std::move(off)) / std::sqrt(static_cast<double>(out.rows));
  return out;
}

template <class Takes>
std::vector<double> rows_where(Values values, std::size_t begin, std::size_t end,
                               const Takes& takes) {
  std::vector<double> out;
  for (std::size_t i = begin; i < end; ++i)
    if (takes(i) && std::isfinite(values[i])) out.push_back(values[i]);
  return out;
}

Column direction_of(std::vector<double> values) {
  return {direction_column, "", std::move(values), {}, Role::setting, direction_why};
}

bool is_direction(const Column& column) { // our own column, not a file's
  return column.name == direction_column && column.why == direction_why;
}

// ---- one test ----

// Friction of one test, over its fitted rows.
class TestFriction {
public:
  TestFriction(std::span<double> friction, Values load, const TestPhases& test)
      : friction_(friction), load_(load), test_(test) {}

  // Replaces friction by its magnitude; `found` receives its sign, zero and value without load.
  // Returns the range of the zeros of its cycles if each has its own, else 0.
  double take_magnitude(ForceZero zero, SignedTest& found) {
    const auto unloaded = rows_where(friction_, 0, friction_.size(), [&](std::size_t i) {
      return test_.rows[i] == Phase::unloaded;
    });
    if (unloaded.size() >= unloaded_rows) found.unloaded = finite_median(unloaded);
    if (test_.both_directions() && take_both_directions(zero, found)) return drift_;
    const Middle all = middle_with_error(fitted(0));
    if (!(all.value < -2 * all.error)) return 0;
    for (double& x : friction_)
      x = -x;
    found.friction = -1;
    return 0;
  }

private:
  // Rows of one direction; 0: of both.
  std::vector<double> fitted(int direction) const {
    std::vector<double> out;
    for (const TestPhases::Stroke& stroke : test_.strokes) {
      if (direction != 0 && stroke.direction != direction) continue;
      const auto rows = rows_where(friction_, stroke.begin, stroke.end,
                                   [&](std::size_t i) { return is_fitted(test_.rows[i]); });
      out.insert(out.end(), rows.begin(), rows.end());
    }
    return out;
  }

  // Half of the difference between the magnitudes of both directions; nullopt for too few rows.
  std::optional<Middle> offset() const {
    const Middle forward = middle_with_error(fitted(1)), backward = middle_with_error(fitted(-1));
    if (forward.rows < test_rows || backward.rows < test_rows) return {};
    return Middle{(forward.value + backward.value) / 2,
                  std::hypot(forward.error, backward.error) / 2, forward.rows + backward.rows};
  }

  // False for a magnitude.
  bool take_both_directions(ForceZero zero, SignedTest& found) {
    const double forward = finite_median(fitted(1)), backward = finite_median(fitted(-1));
    const std::optional<Middle> of_test = offset();
    if (!of_test) return false;
    const double sign = forward > backward ? 1 : -1;
    const ForceOffset half{sign * of_test->value, of_test->error, std::abs(forward - backward) / 2,
                           std::abs(finite_median({load_.begin(), load_.end()}))};
    if (!(forward * backward < 0)) {
      if (half.friction > std::max(5 * half.error, matters * std::abs(half.offset)))
        found.above_friction = half;
      if (!found.above_friction || zero != ForceZero::remove) return false;
    }
    found.zero = half;
    std::vector<double> offsets(friction_.size(), 0.0);
    if (zero != ForceZero::keep) {
      std::fill(offsets.begin(), offsets.end(), of_test->value);
      drift_ = take_drift(half.friction, offsets);
    }
    for (const TestPhases::Stroke& stroke : test_.strokes)
      for (std::size_t i = stroke.begin; i < stroke.end; ++i)
        friction_[i] = sign * stroke.direction * (friction_[i] - offsets[i]);
    return true;
  }

  // Middles of the strokes of usual length; one at an end of the test may be cut off, in it the
  // force may only build up.
  std::vector<std::optional<Middle>> middles_of_strokes() const {
    std::vector<std::optional<Middle>> middles;
    std::vector<double> counts;
    for (const TestPhases::Stroke& stroke : test_.strokes) {
      middles.push_back(
          middle_with_error(rows_where(friction_, stroke.begin, stroke.end,
                                       [&](std::size_t i) { return is_fitted(test_.rows[i]); })));
      counts.push_back(static_cast<double>(middles.back()->rows));
    }
    const double least = std::max(double(cycle_rows), 0.5 * finite_median(std::move(counts)));
    for (auto& middle : middles)
      if (static_cast<double>(middle->rows) < least) middle.reset();
    return middles;
  }

  // Replaces the offset of the test by the cycles' own if these drift: by more than their errors,
  // and from cycle to cycle by less than in all. Returns their range; 0: one for the test. A cycle
  // counts together with the pairs of strokes half a cycle earlier and later: friction that runs in
  // adds to one what it takes from the other.
  double take_drift(double friction, std::vector<double>& offsets) const {
    const std::vector<std::optional<Middle>> middles = middles_of_strokes();
    std::vector<double> errors;
    const auto pair_at = [&](std::size_t s) {
      return s + 1 < middles.size() && middles[s] && middles[s + 1]
                 ? std::optional((middles[s]->value + middles[s + 1]->value) / 2)
                 : std::nullopt;
    };
    std::vector<double> of_cycles, known; // one per two strokes, NaN if unknown
    for (std::size_t s = 0; s < middles.size(); s += 2) {
      const auto own = pair_at(s), behind = pair_at(s + 1),
                 before = s > 0 ? pair_at(s - 1) : std::nullopt;
      of_cycles.push_back(no_value);
      if (!own) continue;
      const double beside = before && behind ? (*before + *behind) / 2
                            : before         ? *before
                                             : behind.value_or(*own);
      known.push_back(of_cycles.back() = (*own + beside) / 2);
      errors.push_back(std::hypot(middles[s]->error, middles[s + 1]->error) / 2);
    }
    if (known.size() < drift_cycles) return 0;
    std::vector<double> steps;
    for (std::size_t c = 1; c < known.size(); ++c)
      steps.push_back(std::abs(known[c] - known[c - 1]));
    const auto [low, high] = std::minmax_element(known.begin(), known.end());
    const double range = *high - *low;
    if (!(range > std::max(6 * finite_median(std::move(errors)), matters * friction)) ||
        2 * finite_median(std::move(steps)) > range)
      return 0;
    double last = known.front(); // a cycle that is not known takes that of the cycle before
    for (std::size_t c = 0; c < of_cycles.size(); ++c) {
      if (std::isfinite(of_cycles[c])) last = of_cycles[c];
      const std::size_t behind = std::min(2 * c + 1, test_.strokes.size() - 1);
      std::fill(offsets.begin() + static_cast<long>(test_.strokes[2 * c].begin),
                offsets.begin() + static_cast<long>(test_.strokes[behind].end), last);
    }
    return range;
  }

  std::span<double> friction_;
  Values load_;
  const TestPhases& test_;
  double drift_ = 0;
};

// ---- the tests of a file ----

// True for a recorded column that is named like a speed and varies.
bool is_reading_of_speed(const Column& column) {
  if (find_quantity(column.name) || !column.levels.empty() || column.values.empty()) return false;
  const std::string words = words_of_name(column.name),
                    unit = lower_case(io::split_header_name(column.name).unit);
  const bool turns = unit == "rpm" || unit == "1/min" || unit == "u/min" || unit == "min-1";
  const bool named = has_word(words, {"speed", "velocity", "rpm", "geschwindigkeit", "drehzahl",
                                      "gleitgeschwindigkeit", "umdrehungen"}) &&
                     !has_word(words, {"set", "soll", "nominal", "target", "sound"});
  return (named || turns) && std::any_of(column.values.begin(), column.values.end(),
                                         [&](double v) { return v != column.values[0]; });
}

class FileSigns {
public:
  FileSigns(Part& part, const ReadRequest& options)
      : part_(part), options_(options), direction_(part.row.size(), 1.0) {
    for (const char* name : {"v_rel_mm_s", "tau_R_MPa", "F_R_N"})
      if (const Column* with_sign = part.find(signed_name(name)))
        if (Column* own = part.find(name)) own->values = with_sign->values; // a file may lack it
    forget_signed(part);
    const Column* const force = part.find("F_N_N");
    const bool by_force = force && std::any_of(force->values.begin(), force->values.end(),
                                               [&](double x) { return x != force->values[0]; });
    load_ = by_force ? "F_N_N" : "sigma_n_MPa";
    if (part.find("F_R_N")) friction_.emplace_back("F_R_N");
    if (part.find("tau_R_MPa") && part.measured_tau) friction_.emplace_back("tau_R_MPa");
    for (const Column& column : part.data.columns)
      if (other_speed_.empty() && is_reading_of_speed(column)) other_speed_ = column.name;
  }

  std::vector<Phase> take() {
    if (options_.experiment == by_pauses) cut_at_pauses();
    std::vector<Phase> phases;
    std::map<SpeedReading, std::size_t> readings;
    for (std::size_t e = 0; e < part_.data.experiments.size(); ++e) {
      const TestPhases test = phases_of_test(e);
      ++readings[test.speed];
      by_other_speed_ += test.still_by_other_speed;
      by_friction_ += test.still_by_friction;
      phases.insert(phases.end(), test.rows.begin(), test.rows.end());
      take_test(e, test);
    }
    if (Column* speed = part_.find("v_rel_mm_s"))
      for (double& v : speed->values)
        v = std::abs(v);
    if (!part_.measured_tau) fill_shear_stress(part_);
    if (std::any_of(direction_.begin(), direction_.end(), [](double d) { return d < 0; }) &&
        !part_.find(direction_column))
      part_.data.columns.push_back(direction_of(std::move(direction_)));
    report_speed_readings(readings);
    if (drifting_ > 0)
      add_counted(part_, "the zero of the force cell drifts in ",
                  " of the tests, beyond its errors and a fiftieth of the friction: there it is "
                  "taken off cycle by cycle",
                  drifting_);
    if (by_other_speed_ > 0)
      add_counted(part_, "at rest, though v_rel_mm_s does not show it: ",
                  fmt::format(" of the rows have {} next to 0 and less than half of the friction",
                              other_speed_),
                  by_other_speed_);
    if (by_friction_ > 0)
      add_counted(part_, "at rest, though v_rel_mm_s does not show it: ",
                  " of the rows, at the ends of tests, have less than an eighth of their friction "
                  "under load",
                  by_friction_);
    return phases;
  }

private:
  std::span<double> values(const std::string& name, std::size_t e) {
    Column* const column = part_.find(name);
    if (!column) return {};
    return std::span(column->values)
        .subspan(part_.data.first_row[e], part_.data.first_row[e + 1] - part_.data.first_row[e]);
  }

  TestPhases phases_of_test(std::size_t e) {
    return phases_of({values("v_rel_mm_s", e), values("time_s", e), values(load_, e),
                      values("s_mm", e), friction_.empty() ? Values() : values(friction_[0], e),
                      other_speed_.empty() ? Values() : values(other_speed_, e)});
  }

  struct Piece {
    std::size_t begin, end; // rows of the test
  };
  // Pieces that slide, between pauses of at least so many rows.
  static std::vector<Piece> pieces_between(const std::vector<Phase>& phases, std::size_t pause) {
    std::vector<Piece> pieces;
    std::size_t still = pause;
    for (std::size_t i = 0; i < phases.size(); ++i) {
      const bool is_still = phases[i] == Phase::rest || phases[i] == Phase::unloaded;
      still = is_still ? still + 1 : still;
      if (is_still) continue;
      if (still >= pause)
        pieces.push_back({i, i + 1});
      else
        pieces.back().end = i + 1;
      still = 0;
    }
    std::erase_if(pieces, [](const Piece& piece) { return piece.end - piece.begin < pause_rows; });
    return pieces;
  }

  // Each piece is a test, with the pause before it.
  void cut_at_pauses() {
    Dataset& data = part_.data;
    std::vector<std::string> experiments;
    std::vector<Dataset::Filed> filed;
    std::vector<std::size_t> first_row{0};
    for (std::size_t e = 0; e < data.experiments.size(); ++e) {
      const std::vector<Piece> pieces = pieces_between(phases_of_test(e).rows, pause_rows);
      const std::size_t count = std::max<std::size_t>(pieces.size(), 1);
      for (std::size_t p = 0; p < count; ++p) {
        experiments.push_back(pieces.size() < 2 ? data.experiments[e]
                                                : fmt::format("{} {}", data.experiments[e], p + 1));
        filed.push_back(data.filed[e]);
        first_row.push_back(p + 1 < count ? data.first_row[e] + pieces[p].end
                                          : data.first_row[e + 1]);
      }
    }
    data.experiments = std::move(experiments);
    data.filed = std::move(filed);
    data.first_row = std::move(first_row);
    direction_.assign(part_.row.size(), 1.0);
  }

  // Magnitudes of the fitted rows: a piece may go both ways.
  static std::vector<double> sizes_where(Values all, std::size_t begin, std::size_t end,
                                         const TestPhases& test) {
    auto sizes =
        rows_where(all, begin, end, [&](std::size_t i) { return is_fitted(test.rows[i]); });
    for (double& x : sizes)
      x = std::abs(x);
    return sizes;
  }

  // Pieces with long pauses between that differ in load or speed by much; 1: they do not.
  std::size_t other_pieces(std::size_t e, const TestPhases& test) {
    if (options_.experiment != "file" && !options_.experiment.empty()) return 1;
    const std::vector<Piece> pieces = pieces_between(test.rows, long_pause_rows);
    const auto differ = [&](Values all) {
      std::vector<double> middles;
      for (const Piece& piece : pieces)
        middles.push_back(finite_median(sizes_where(all, piece.begin, piece.end, test)));
      const auto [low, high] = std::minmax_element(middles.begin(), middles.end());
      return *high - *low > other_setting * *high;
    };
    if (pieces.size() < 2) return 1;
    for (const std::string& name : {load_, std::string("v_rel_mm_s")})
      if (const Values all = values(name, e); !all.empty() && differ(all)) return pieces.size();
    return 1;
  }

  void take_test(std::size_t e, const TestPhases& test) {
    SignedTest found{part_.data.experiments[e], friction_.empty() ? "" : friction_[0]};
    found.both = test.both_directions();
    found.pieces = other_pieces(e, test);
    found.speed = found.both ? 1 : test.strokes.front().direction;
    for (const TestPhases::Stroke& stroke : test.strokes)
      std::fill(direction_.begin() + static_cast<long>(part_.data.first_row[e] + stroke.begin),
                direction_.begin() + static_cast<long>(part_.data.first_row[e] + stroke.end),
                static_cast<double>(stroke.direction));
    for (std::size_t f = friction_.size(); f-- > 0;) { // `found` describes the first
      found.zero.reset();
      found.above_friction.reset();
      const double drift = TestFriction(values(friction_[f], e), values(load_, e), test)
                               .take_magnitude(options_.force_zero, found);
      drifting_ += f == 0 && drift > 0;
    }
    if (!friction_.empty()) found.rest = at_rest(values(friction_[0], e), values(load_, e), test);
    if (found.both || found.speed < 0 || found.friction < 0 || found.unloaded || found.rest ||
        found.pieces > 1)
      part_.data.signs.push_back(std::move(found));
  }

  // nullopt unless the reading at rest is one value, before as after sliding, that matters.
  static std::optional<SignedTest::Rest> at_rest(Values friction, Values load,
                                                 const TestPhases& test) {
    const auto of = [&](Values values, bool rest) {
      return rows_where(values, 0, test.rows.size(), [&](std::size_t i) {
        return rest ? test.rows[i] == Phase::rest : is_fitted(test.rows[i]);
      });
    };
    const std::vector<double> still = of(friction, true), sliding = of(friction, false);
    if (still.size() < rest_rows || sliding.size() < rest_rows || test.both_directions()) return {};
    const SignedTest::Rest rest{finite_median(still), finite_median(sliding),
                                finite_median(of(load, true))};
    std::vector<double> off;
    for (const double x : still)
      off.push_back(std::abs(x - rest.friction));
    const double size = std::abs(rest.friction);
    const bool is_one_value = finite_median(off) < 0.1 * size;
    return is_one_value && size > matters * std::abs(rest.sliding) ? std::optional(rest)
                                                                   : std::nullopt;
  }

  void report_speed_readings(const std::map<SpeedReading, std::size_t>& readings) {
    if (!options_.measured || part_.data.rows() == part_.data.experiments.size()) return;
    const auto count = [&](SpeedReading reading) {
      const auto found = readings.find(reading);
      return found == readings.end() ? 0 : found->second;
    };
    if (!part_.find("v_rel_mm_s") && count(SpeedReading::none) > 0)
      part_.data.notes.emplace_back(
          "rows have no phases of motion (rest, turning): there is neither "
          "v_rel_mm_s nor s_mm with time_s");
    if (options_.constants.count("sigma_n_MPa") > 0 && !part_.find("F_N_N"))
      part_.data.notes.emplace_back("rows have no phases of load (closing, opening, unloaded): "
                                    "sigma_n_MPa is a constant of the job");
    for (const auto& [reading, how] :
         {std::pair(SpeedReading::coarse, "coarse"), std::pair(SpeedReading::noisy, "noisy")})
      if (const std::size_t tests = count(reading); tests > 0)
        add_counted(part_, fmt::format("v_rel_mm_s is read too {} in ", how),
                    " of the tests to say by it what is at rest or turning", tests);
  }

  Part& part_;
  const ReadRequest& options_;
  std::string load_;
  std::vector<std::string> friction_; // columns that were measured
  std::string other_speed_;           // a recorded column, by its name; empty: none
  std::vector<double> direction_;
  std::size_t drifting_ = 0;                         // tests
  std::size_t by_other_speed_ = 0, by_friction_ = 0; // rows at rest that v_rel_mm_s does not show
};

} // namespace

void keep_signed(Part& part, const std::string& canonical, std::vector<double> values) {
  if (std::any_of(values.begin(), values.end(), [](double x) { return x < 0; }))
    part.data.columns.push_back({signed_name(canonical), "", std::move(values), {}});
}

void forget_signed(Part& part) {
  std::erase_if(part.data.columns,
                [](const Column& column) { return column.name.starts_with('\1'); });
}

void turn_loads(Part& part) {
  for (const char* name : {"F_N_N", "sigma_n_MPa"}) {
    Column* const column = part.find(name);
    if (!column) continue;
    std::size_t turned = 0;
    for (std::size_t e = 0; e < part.data.experiments.size(); ++e) {
      const auto rows =
          std::span(column->values)
              .subspan(part.data.first_row[e], part.data.first_row[e + 1] - part.data.first_row[e]);
      const double least = *std::min_element(rows.begin(), rows.end());
      const bool one_sign = std::none_of(rows.begin(), rows.end(),
                                         [&](double x) { return x > -still_unloaded * least; });
      if (!(least < 0) || !one_sign || !(finite_median({rows.begin(), rows.end()}) < 0)) continue;
      ++turned;
      for (double& x : rows)
        x = -x;
    }
    if (turned > 0)
      add_counted(part, fmt::format("{} is negative all along in ", name),
                  " of the tests: a convention, taken as compression", turned);
  }
}

std::vector<Phase> take_signs(Part& part, const ReadRequest& options) {
  return FileSigns(part, options).take();
}

// ---- a campaign ----

namespace {

std::vector<const ForceOffset*> offsets_of(const Dataset& data) {
  std::vector<const ForceOffset*> out;
  for (const SignedTest& test : data.signs)
    if (test.zero) out.push_back(&*test.zero);
  return out;
}

std::vector<const ForceOffset*> above_friction(const Dataset& data) {
  std::vector<const ForceOffset*> out;
  for (const SignedTest& test : data.signs)
    if (test.above_friction) out.push_back(&*test.above_friction);
  return out;
}

// Standard deviation over the magnitude of the mean.
double relative_scatter(const std::vector<double>& values) {
  double mean = 0, squares = 0;
  for (const double x : values)
    mean += x / static_cast<double>(values.size());
  for (const double x : values)
    squares += (x - mean) * (x - mean) / static_cast<double>(values.size());
  return std::sqrt(squares) / std::abs(mean);
}

// "1.9 to 2.1"; for a single value "2".
std::string range_text(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const std::string first = fmt::format("{:.3g}", *low), last = fmt::format("{:.3g}", *high);
  return first == last ? first : first + " to " + last;
}

std::string sizes_text(const std::vector<double>& values, const std::string& unit) {
  return range_text(values) + " " + unit;
}

// "test 'a'"; "3 tests ('a', 'b', ...)".
std::string tests_text(const std::vector<std::string>& names) {
  constexpr std::size_t shown = 3;
  if (names.size() == 1) return "test '" + names[0] + "'";
  std::vector<std::string> some;
  for (std::size_t i = 0; i < std::min(names.size(), shown); ++i)
    some.push_back("'" + names[i] + "'");
  if (names.size() > shown) some.emplace_back("...");
  return fmt::format("{} tests ({})", thousands(names.size()), join(some, ", "));
}

std::string canonical_unit(const std::string& column) {
  const Quantity* quantity = find_quantity(column);
  return quantity ? quantity->unit : "";
}

struct Signed { // tests of a kind
  std::vector<std::string> names;
  std::vector<double> sizes, frictions;
  std::string column;
};

Signed collected(const Dataset& data,
                 const std::function<std::optional<double>(const SignedTest&)>& size_of) {
  Signed out;
  for (const SignedTest& test : data.signs)
    if (const auto size = size_of(test)) {
      out.names.push_back(test.experiment);
      out.sizes.push_back(*size);
      out.frictions.push_back(test.zero ? test.zero->friction : 0);
      out.column = test.friction_column;
    }
  return out;
}

void report_zero_errors(Dataset& data, ForceZero said) {
  const Signed both = collected(data, [](const SignedTest& test) {
    return test.zero ? std::optional(test.zero->offset) : std::nullopt;
  });
  if (both.names.empty()) return;
  const std::string unit = canonical_unit(both.column);
  const DirectionsDiffer why = directions_differ(data);
  const bool kept = said == ForceZero::keep ||
                    (said == ForceZero::automatic && why == DirectionsDiffer::by_friction);
  const std::size_t one_sign = above_friction(data).size();
  std::string text = fmt::format(
      "{} {} in {}: {}; magnitudes are fitted, `{}` is recorded", both.column,
      one_sign > 0 ? "goes up and down about a zero" : "has both signs", tests_text(both.names),
      fmt::format("the two directions differ by twice {} at a friction of {} (half the sum and "
                  "half the difference of their medians)",
                  sizes_text(both.sizes, unit), sizes_text(both.frictions, unit)),
      direction_column);
  text += kept ? "; that difference is kept" : "; it is taken off as the zero of the force cell";
  if (one_sign > 0)
    text += fmt::format(", which is above the friction in {} of them", thousands(one_sign));
  if (said == ForceZero::automatic) {
    if (why == DirectionsDiffer::by_zero) text += ": it is the same at every load";
    if (why == DirectionsDiffer::by_friction)
      text += ": it is in proportion to the load, so friction";
    if (why == DirectionsDiffer::cannot_tell)
      text += ". Is it? These loads cannot distinguish a zero error from friction that depends on "
              "the direction "
              "(data.force_zero = \"remove\" or \"keep\" says which)";
  }
  tell(data, std::move(text));
}

// "{ formula = "COLUMN - 3.2" } does for a column in N".
std::string without_zero(double zero, const std::string& unit) {
  return fmt::format("{{ formula = \"COLUMN {} {:.3g}\" }} does for a column in {}",
                     zero < 0 ? '+' : '-', std::abs(zero), unit);
}

// Friction at rest that is the same in all tests, while their loads differ, is an offset.
void report_rest(Dataset& data) {
  std::vector<double> readings, coefficients, loads, shares; // readings with the column's own sign
  std::string column;
  for (const SignedTest& test : data.signs)
    if (test.rest) {
      readings.push_back(test.friction * test.rest->friction);
      coefficients.push_back(readings.back() / test.rest->load);
      loads.push_back(test.rest->load);
      shares.push_back(std::abs(test.rest->friction / test.rest->sliding));
      column = test.friction_column;
    }
  if (readings.size() < 3) return;
  const auto [low, high] = std::minmax_element(loads.begin(), loads.end());
  if (!(*high > other_load * *low) || relative_scatter(readings) > 0.1 ||
      !(relative_scatter(readings) < clearly * relative_scatter(coefficients)))
    return;
  const std::string unit = canonical_unit(column);
  const double zero = finite_median(readings);
  data.implausible.push_back(fmt::format(
      "{} shows {} at rest in {} tests of all loads, up to {:.0f} % of what it shows in "
      "sliding: a zero point that was not set? It is not taken off; where the friction is mapped, "
      "{}",
      column, sizes_text(readings, unit), thousands(readings.size()),
      100 * *std::max_element(shares.begin(), shares.end()), without_zero(zero, unit)));
}

DirectionsDiffer why_differ(const std::vector<const ForceOffset*>& all) {
  if (all.empty()) return DirectionsDiffer::nowhere;
  std::vector<double> offsets, coefficients, loads;
  bool any = false;
  for (const ForceOffset* one : all) {
    offsets.push_back(one->offset);
    coefficients.push_back(one->offset / one->load);
    loads.push_back(one->load);
    any = any || std::abs(one->offset) > std::max(2 * one->error, matters * one->friction);
  }
  if (!any) return DirectionsDiffer::nowhere;
  const auto [low, high] = std::minmax_element(loads.begin(), loads.end());
  if (all.size() < 3 || !(*high > other_load * *low)) return DirectionsDiffer::cannot_tell;
  const double as_zero = relative_scatter(offsets), as_friction = relative_scatter(coefficients);
  if (as_zero < clearly * as_friction) return DirectionsDiffer::by_zero;
  if (as_friction < clearly * as_zero) return DirectionsDiffer::by_friction;
  return DirectionsDiffer::cannot_tell;
}

} // namespace

DirectionsDiffer directions_differ(const Dataset& data) {
  return why_differ(offsets_of(data));
}

bool hides_zero(const Dataset& data) {
  std::vector<const ForceOffset*> all = above_friction(data);
  if (all.empty()) return false;
  const auto others = offsets_of(data);
  all.insert(all.end(), others.begin(), others.end());
  // A magnitude that hardly depends on the load has constant halves, or halves that hardly differ.
  std::vector<double> offsets, frictions;
  double largest = 0;
  for (const ForceOffset* one : all) {
    offsets.push_back(one->offset);
    frictions.push_back(one->friction);
    largest = std::max(largest, one->friction / std::abs(one->offset));
  }
  return why_differ(all) == DirectionsDiffer::by_zero && largest > share_of_zero &&
         relative_scatter(offsets) < clearly * relative_scatter(frictions);
}

void report_signs(Dataset& data, ForceZero said) {
  report_zero_errors(data, said);
  const Signed negative = collected(data, [](const SignedTest& test) {
    return test.friction < 0 ? std::optional(0.0) : std::nullopt;
  });
  const auto is_positive = [](const SignedTest& test) { return test.friction > 0; };
  const bool all = negative.names.size() + data.at_rest.size() >= data.experiments.size() &&
                   std::none_of(data.signs.begin(), data.signs.end(), is_positive);
  if (!negative.names.empty() && !all)
    tell(data,
         fmt::format("{} is negative in {} and positive in others: magnitudes are fitted, `{}` "
                     "says which way a test goes",
                     negative.column, tests_text(negative.names), direction_column));
  if (!negative.names.empty() && all)
    tell(data, fmt::format("{} is negative all along in {}: a convention, its magnitude "
                           "is fitted",
                           negative.column, tests_text(negative.names)));
  report_rest(data);
  const Signed parted = collected(data, [](const SignedTest& test) {
    return test.pieces > 1 ? std::optional(static_cast<double>(test.pieces)) : std::nullopt;
  });
  if (!parted.names.empty())
    tell(data, fmt::format("{} slide{} {} times at other loads or speeds, with pauses between: if "
                           "each is a test of its own, data.experiment = \"pause\" says so",
                           tests_text(parted.names), parted.names.size() == 1 ? "s" : "",
                           range_text(parted.sizes)));
  const Signed zeros = collected(data, [](const SignedTest& test) { return test.unloaded; });
  if (!zeros.names.empty() && relative_scatter(zeros.sizes) < 1) // else it scatters about zero
    tell(data, fmt::format("without load {} shows {} in {} (the zero of the force cell; it is not "
                           "taken off: where it is mapped, {})",
                           zeros.column, sizes_text(zeros.sizes, canonical_unit(zeros.column)),
                           tests_text(zeros.names),
                           without_zero(finite_median(zeros.sizes), canonical_unit(zeros.column))));
}

namespace {

// Tests with one direction each by their speed may still differ in the sign of their friction.
void take_signs_of_friction(Dataset& data) {
  Column direction = direction_of(std::vector<double>(data.rows(), 1.0));
  std::map<std::string, int> sign;
  for (const SignedTest& test : data.signs)
    sign[test.experiment] = test.friction;
  for (std::size_t e = 0; e < data.experiments.size(); ++e)
    if (const auto found = sign.find(data.experiments[e]); found != sign.end())
      std::fill(direction.values.begin() + static_cast<long>(data.first_row[e]),
                direction.values.begin() + static_cast<long>(data.first_row[e + 1]),
                static_cast<double>(found->second));
  std::erase_if(data.columns, is_direction);
  data.columns.push_back(std::move(direction));
}

} // namespace

void add_direction(std::span<Dataset* const> all) {
  const auto has_one = [](const Dataset* data) { return data->has(direction_column); };
  const bool is_own = std::all_of(all.begin(), all.end(), [](const Dataset* data) {
    const Column* const column = data->find(direction_column);
    return !column || is_direction(*column);
  });
  for (Dataset* data : all)
    if (is_own && !has_one(data))
      data->columns.push_back(direction_of(std::vector<double>(data->rows(), 1.0)));
}

void settle_directions(std::span<Dataset* const> all) {
  const auto plain = [](const Dataset* data) { return data->signs.empty(); };
  const auto has_own = [](const Dataset* data) {
    const Column* const column = data->find(direction_column);
    return column && !is_direction(*column);
  };
  if (std::all_of(all.begin(), all.end(), plain) || std::any_of(all.begin(), all.end(), has_own))
    return;
  const auto differ = [&](const auto& value_of) {
    std::optional<double> first;
    bool differs = false;
    for (const Dataset* data : all)
      value_of(*data, [&](double value) {
        differs = differs || (first && *first != value);
        first = value;
      });
    return differs;
  };
  const bool by_speed = differ([](const Dataset& data, const auto& take) {
    const Column* const column = data.find(direction_column);
    if (!column && data.rows() > 0) take(1.0);
    if (column) std::for_each(column->values.begin(), column->values.end(), take);
  });
  const bool by_friction = differ([](const Dataset& data, const auto& take) {
    for (const SignedTest& test : data.signs)
      take(test.friction);
    if (data.signs.size() < data.experiments.size()) take(1.0);
  });
  if (by_speed) add_direction(all);
  for (Dataset* data : all) {
    if (!by_speed && by_friction)
      take_signs_of_friction(*data);
    else if (!by_speed)
      std::erase_if(data->columns, is_direction);
    fingerprint(*data);
  }
}

} // namespace frictab::data
