// Determines the phases of load, then of speed, then strokes.
#include "data/phases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "data/middle.h"

namespace frictab::data {

namespace {

using Values = std::span<const double>;

// Shares of the typical load, speed or path of a test.
constexpr double unloaded_share = 0.05, full_share = 0.9, steady_share = 0.3, ramp_share = 0.15;
constexpr double moving_share = 0.1, slow = 0.02, nearly_zero = 1e-3, turning_speed = 0.2,
                 turning_path = 0.05;
// A force that builds up after a reversal: the largest share of the stroke's path for it, and the
// shares of the later force at which it begins and ends.
constexpr double longest_turn = 0.2, half_turned = 0.5, turned = 0.9;
// Step of a reading, and its scatter from row to row, relative to the typical speed.
constexpr double coarse_step = 1.0 / 3, noisy_speed = 0.3;
constexpr std::size_t ramp_rows = 20, stroke_rows = 3, mean_rows = 5, few_values = 60;
constexpr double rare_pauses = 50; // steps of a path for each pause, if it is regular
// A test has both directions if this share of the rows goes either way at this share of the speed.
constexpr double either_way = 0.1, goes = 0.2;
// Largest ratio of friction over load to that of the whole test at which it counts as the same
// friction at a lower load.
constexpr double same_friction = 2;
// Rows at an end of a test without its friction that are rest and not physics: fewest rows of such
// a test, largest share of them, and largest number; smallest share of the load.
constexpr std::size_t rows_with_ends = 20, most_still_rows = 10;
constexpr double still_rows_share = 0.05, pressed_share = 0.5;
// Quantile of the coefficients of such a test that is well above none.
constexpr double still_quantile = 0.15;

std::vector<double> finite_values(Values values) {
  std::vector<double> out;
  std::copy_if(values.begin(), values.end(), std::back_inserter(out),
               [](double x) { return std::isfinite(x); });
  return out;
}

std::vector<double> sizes(Values values) {
  std::vector<double> out = finite_values(values);
  for (double& x : out)
    x = std::abs(x);
  return out;
}

// Median of the values above `share` of nearly the largest.
double typical_of(std::vector<double> values, double share) {
  const double least = share * quantile_of(values, 0.95);
  std::erase_if(values, [&](double x) { return !(x > least); });
  return median_of(std::move(values));
}

// Running median of five; short tests stay unchanged.
std::vector<double> median_of_five(Values values) {
  std::vector<double> out(values.begin(), values.end());
  constexpr std::size_t width = 5, half = width / 2;
  if (values.size() < 2 * width) return out;
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::array<double, width> near;
    const std::size_t begin = std::min(i - std::min(i, half), values.size() - width);
    std::copy_n(values.begin() + static_cast<long>(begin), width, near.begin());
    std::nth_element(near.begin(), near.begin() + half, near.end());
    out[i] = near[half];
  }
  return out;
}

// Replaces a non-finite value by the one before it; `held` stores the result if it differs.
Values filled(Values values, std::vector<double>& held) {
  if (std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); }))
    return values;
  double last = 0;
  for (const double x : values)
    held.push_back(last = std::isfinite(x) ? x : last);
  return held;
}

struct Piece {
  std::size_t begin, end;
  std::size_t rows() const { return end - begin; }
};

template <class Is> std::vector<Piece> pieces_where(std::size_t rows, const Is& is) {
  std::vector<Piece> pieces;
  for (std::size_t i = 0, from = 0; i <= rows; ++i)
    if (i == rows || !is(i)) {
      if (i > from) pieces.push_back({from, i});
      from = i + 1;
    }
  return pieces;
}

struct Mean {
  double value = 0, error = 0;
  // A single row has no known error. Of runs about zero, 0.3 % lie beyond three errors.
  bool is_zero() const { return value == 0 || std::abs(value) < 3 * error; }
};

Mean mean_with_error(Values values) {
  const double n = static_cast<double>(values.size());
  Mean mean;
  for (const double x : values)
    mean.value += x / n;
  for (const double x : values)
    mean.error += (x - mean.value) * (x - mean.value) / n;
  mean.error = values.size() < mean_rows ? 0 : std::sqrt(mean.error / n);
  return mean;
}

// ---- load ----

class LoadPhases {
public:
  LoadPhases(const TestSignals& test, TestPhases& out) : test_(test), load_(test.load), out_(out) {
    typical_ = typical_of(finite_values(load_), 0.5);
    if (!(typical_ > 0) || load_.size() < 2 * mean_rows) return; // a few rows are levels
    out.has_load = true;
    if (load_.size() >= ramp_rows) mark_ramps();
    mark_unloaded();
  }

private:
  void mark_ramps() {
    const auto is_full = [&](double x) { return x >= full_share * typical_; };
    const auto first = std::find_if(load_.begin(), load_.end(), is_full);
    const auto last = std::find_if(load_.rbegin(), load_.rend(), is_full).base();
    if (first >= last) return;
    const std::vector<double> between(first, last);
    if (quantile_of(between, 0.9) - quantile_of(between, 0.1) > steady_share * typical_) return;
    const auto longest = static_cast<std::ptrdiff_t>(ramp_share * double(load_.size()));
    const auto front = first - load_.begin(), back = load_.end() - last;
    if (front <= longest && (front == 0 || *first > load_.front()))
      std::fill_n(out_.rows.begin(), front, Phase::closing);
    if (back <= longest) std::fill_n(out_.rows.end() - back, back, Phase::opening);
  }

  // Marks unloaded rows, except a low level with the usual coefficient. If friction there is more
  // than half of that under load, the load reading is wrong.
  void mark_unloaded() {
    std::vector<double> ratios, frictions;
    for (std::size_t i = 0; i < test_.friction.size(); ++i)
      if (load_[i] > 0.5 * typical_ && std::isfinite(test_.friction[i])) {
        ratios.push_back(std::abs(test_.friction[i]) / load_[i]);
        frictions.push_back(std::abs(test_.friction[i]));
      }
    const double mu = median_of(std::move(ratios)), rubbing = median_of(std::move(frictions));
    for (const Piece& run : pieces_where(load_.size(), [&](std::size_t i) {
           return std::abs(load_[i]) < unloaded_share * typical_;
         })) {
      const Values load = load_.subspan(run.begin, run.rows());
      double friction = 0;
      if (!test_.friction.empty())
        friction = median_of(sizes(test_.friction.subspan(run.begin, run.rows())));
      const Mean mean = mean_with_error(load);
      const double ratio = mean.value > 0 ? friction / mean.value : 0;
      const bool is_level = run.rows() >= mean_rows && !mean.is_zero() && mu > 0 &&
                            ratio > mu / same_friction && ratio < mu * same_friction;
      if (is_level || (rubbing > 0 && friction > 0.5 * rubbing)) continue;
      std::fill_n(out_.rows.begin() + static_cast<long>(run.begin), run.rows(), Phase::unloaded);
    }
  }

  const TestSignals& test_;
  Values load_;
  TestPhases& out_;
  double typical_ = 0;
};

// ---- speed ----

// True for a set speed, which stays the same for many rows, unlike a measured one.
bool is_held(Values speed) {
  constexpr double rounding = 1e-9;
  std::size_t held = 0, moving = 0;
  for (std::size_t from = 0, i = 1; i <= speed.size(); ++i) {
    if (i < speed.size() && std::abs(speed[i] - speed[from]) <= rounding * std::abs(speed[from]))
      continue;
    if (speed[from] != 0) {
      moving += i - from;
      held += i - from >= mean_rows ? i - from : 0;
    }
    from = i;
  }
  return 2 * held > moving;
}

// Step between neighbouring readings if they take few values; else 0.
double reading_step(Values speed) {
  std::vector<double> values = sizes(speed.first(std::min<std::size_t>(speed.size(), 5000)));
  std::sort(values.begin(), values.end());
  values.erase(
      std::unique(values.begin(), values.end(), [](double a, double b) { return b - a < 1e-9; }),
      values.end());
  if (values.size() >= few_values || values.size() < 2) return 0;
  std::vector<double> steps;
  for (std::size_t i = 1; i < values.size(); ++i)
    steps.push_back(values[i] - values[i - 1]);
  return median_of(std::move(steps));
}

// Standard deviation of a reading about its neighbours' mean; for Gaussian noise the difference has
// 1.22 times the standard deviation of a reading.
double row_scatter(Values speed) {
  std::vector<double> off;
  for (std::size_t i = 1; i + 1 < speed.size(); ++i)
    off.push_back(std::abs(speed[i] - (speed[i - 1] + speed[i + 1]) / 2));
  return off.size() < 6 ? 0 : 1.4826 * median_of(std::move(off)) / 1.22;
}

// Speed in motion: most rows of a test may be at rest.
double speed_in_motion(Values speed) {
  return typical_of(sizes(speed), moving_share);
}

SpeedReading reading_of(Values speed) {
  const double typical = speed_in_motion(speed);
  if (!(typical > 0)) return SpeedReading::still;
  if (is_held(speed)) return SpeedReading::usable;
  if (reading_step(speed) > coarse_step * typical) return SpeedReading::coarse;
  // Uses magnitudes for a speed that changes sign from row to row.
  const double scatter = std::min(row_scatter(speed), row_scatter(sizes(speed)));
  return scatter > noisy_speed * typical ? SpeedReading::noisy : SpeedReading::usable;
}

bool goes_both_ways(Values values, double reference) {
  double forward = 0, backward = 0;
  const double n = static_cast<double>(values.size());
  for (const double x : values) {
    forward += x > goes * reference;
    backward += x < -goes * reference;
  }
  return forward > either_way * n && backward > either_way * n;
}

// Rows between changes of sign; rows near zero belong to the stroke before.
std::vector<TestPhases::Stroke> strokes_of(Values values, double near_zero) {
  std::vector<TestPhases::Stroke> strokes;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const int sign = std::abs(values[i]) < near_zero ? 0 : values[i] > 0 ? 1 : -1;
    if (strokes.empty())
      strokes.push_back({0, 1, sign});
    else if (sign == 0 || strokes.back().direction == sign || strokes.back().direction == 0) {
      strokes.back().end = i + 1;
      if (strokes.back().direction == 0) strokes.back().direction = sign;
    } else
      strokes.push_back({i, i + 1, sign});
  }
  return strokes;
}

// Rows over which a path stands still: it stays within its resolution and noise for so long that
// its mean speed is below the share `slow` of the test's. A path that does not resolve the way of a
// row shows that only over many rows, or at its ends; over fewer where it advances regularly.
class Standing {
public:
  Standing(Values path, Values time) : path_(path) {
    const std::vector<double> ways = ways_per_row(path, time);
    const double way = typical_of(ways, moving_share), noise = row_scatter(without_repeats(path));
    const std::vector<double> gaps = rows_between_steps(ways, moving_share * way);
    if (!(way > 0) || gaps.empty()) return;
    const double held = median_of(gaps); // above 1 where a slow recorder repeats its last reading
    const auto pauses = std::count_if(gaps.begin(), gaps.end(), [&](double x) { return x > held; });
    is_regular_ = rare_pauses * static_cast<double>(pauses) <= static_cast<double>(gaps.size());
    double step = finest(ways, 1e-9 * way);
    is_coarse_ = 1.5 * step > coarse_step * way;
    if (is_coarse_) step = 0;
    const double still = std::max({slow * way, 1.5 * step, 5 * noise});
    if (still > coarse_step * way) return;
    reach_ = std::max(2 * step, 6 * noise);
    least_ = std::max(reach_ / (slow * way / held), held > 1 ? 3 * held : 2.0);
    for (const Piece& run :
         pieces_where(ways.size(), [&](std::size_t i) { return ways[i] <= still; }))
      take(run.begin, run.end);
  }

  const std::vector<Piece>& pieces() const { return pieces_; } // of rows

private:
  // Magnitudes, those over longer times scaled to a usual one.
  static std::vector<double> ways_per_row(Values path, Values time) {
    std::vector<double> ways, times;
    for (std::size_t i = 1; i < path.size(); ++i) {
      ways.push_back(std::abs(path[i] - path[i - 1]));
      if (!time.empty()) times.push_back(time[i] - time[i - 1]);
    }
    const double usual = times.empty() ? 0 : median_of(times);
    for (std::size_t i = 0; i < times.size(); ++i)
      if (usual > 0 && times[i] > usual) ways[i] *= usual / times[i];
    return ways;
  }

  static std::vector<double> without_repeats(Values path) {
    std::vector<double> out;
    std::unique_copy(path.begin(), path.end(), std::back_inserter(out));
    return out;
  }

  // Smallest difference between two ways, or between one and none.
  static double finest(std::vector<double> ways, double rounding) {
    ways.push_back(0);
    std::sort(ways.begin(), ways.end());
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < ways.size(); ++i)
      if (const double apart = ways[i] - ways[i - 1]; apart > rounding)
        least = std::min(least, apart);
    return least;
  }

  static std::vector<double> rows_between_steps(const std::vector<double>& ways, double least) {
    std::vector<double> rows;
    for (std::size_t i = 0, last = 0; i < ways.size(); ++i) {
      if (!(ways[i] > least)) continue;
      if (last > 0) rows.push_back(static_cast<double>(i + 1 - last));
      last = i + 1;
    }
    return rows;
  }

  // A path that advances evenly, however little, slides; so does one that only turns.
  bool moves(std::size_t first, std::size_t last) const {
    const double all = path_[last] - path_[first], half = path_[(first + last) / 2] - path_[first];
    if (std::abs(all) > reach_ && half / all > 0.25 && half / all < 0.75) return true;
    return last - first < mean_rows && first > 0 && last + 1 < path_.size() &&
           (path_[first] - path_[first - 1]) * (path_[last + 1] - path_[last]) < 0;
  }

  // Takes the parts of rows first .. last, between which the path hardly advances, that are long
  // enough.
  void take(std::size_t first, std::size_t last) {
    if (moves(first, last)) return;
    const bool at_end = first == 0 || last + 1 == path_.size();
    double least = least_;
    if (is_coarse_ && is_regular_) least = at_end ? least_ : mean_rows;
    if (is_coarse_ && !is_regular_) least = at_end ? mean_rows : 1 / slow;
    for (std::size_t from = first; from < last;) {
      double low = path_[from], high = low;
      std::size_t to = from;
      for (; to < last; ++to) {
        low = std::min(low, path_[to + 1]);
        high = std::max(high, path_[to + 1]);
        if (high - low > reach_) break;
      }
      const bool is_long = static_cast<double>(to - from) >= least;
      const bool arrives = from == first && first > 0; // its way was made before
      if (is_long) pieces_.push_back({arrives ? from + 1 : from, to + 1});
      from = is_long ? to + 1 : from + 1;
    }
  }

  Values path_;
  bool is_coarse_ = false, is_regular_ = false;
  double reach_ = 0, least_ = 0; // way; rows
  std::vector<Piece> pieces_;
};

// Speed of a path, over as many rows as its noise requires.
std::vector<double> speed_of_path(Values path, Values time) {
  std::vector<double> speed(path.size());
  const std::size_t last = path.size() - 1;
  for (std::size_t half = 2;; half *= 2) {
    for (std::size_t i = 0; i <= last; ++i) {
      const std::size_t a = i - std::min(i, half), b = std::min(i + half, last);
      speed[i] = time[b] > time[a] ? (path[b] - path[a]) / (time[b] - time[a]) : 0;
    }
    if (half >= std::max<std::size_t>(2, path.size() / 20) ||
        row_scatter(speed) < 0.2 * speed_in_motion(speed))
      return speed;
  }
}

// Whether a speed neither rises nor falls by as much as it is off zero: it is not starting.
bool is_level(Values speed) {
  const std::size_t half = speed.size() / 2;
  const Mean first = mean_with_error(speed.first(half)),
             second = mean_with_error(speed.subspan(half));
  return std::abs(second.value - first.value) <
         std::max(0.25 * std::abs(second.value + first.value),
                  3 * std::hypot(first.error, second.error));
}

class SpeedPhases {
public:
  // `of_path`: the speed is that of the path.
  SpeedPhases(const TestSignals& test, bool of_path, TestPhases& out) : test_(test), out_(out) {
    const std::size_t rows = out.rows.size();
    if (!test.speed.empty()) out.speed = reading_of(test.speed);
    if (out.speed == SpeedReading::still) mark(0, rows, Phase::rest);
    if (out.speed == SpeedReading::usable) {
      // A speed that changes sign from row to row is not smoothed.
      const bool turns = row_scatter(test.speed) > noisy_speed * speed_in_motion(test.speed);
      speed_ = turns ? std::vector<double>(test.speed.begin(), test.speed.end())
                     : median_of_five(test.speed);
      size_ = speed_;
      for (double& v : size_)
        v = std::abs(v);
      typical_ = typical_of(size_, moving_share);
      if (goes_both_ways(speed_, typical_)) out.strokes = strokes_of(speed_, slow * typical_);
    }
    if (!out.both_directions()) take_strokes_of_friction();
    if (out.speed == SpeedReading::usable) mark_rest();
    if (!out.both_directions() && !shows_motion()) {
      mark_rest_by_other_speed();
      mark_ends_without_friction();
    }
    if ((of_path || !test.speed.empty()) && test.path.size() > 2) take_standing(of_path);
    if (!out.both_directions()) {
      double sum = 0;
      for (const double v : test.speed)
        sum += std::isfinite(v) ? v : 0;
      out.strokes = {{0, rows, sum < 0 ? -1 : 1}};
      return;
    }
    if (rows < mean_rows * out.strokes.size()) return; // a row may be the mean of a stroke
    for (std::size_t s = 0; s < out.strokes.size(); ++s)
      mark_turning(out.strokes[s], s > 0, s + 1 < out.strokes.size());
  }

private:
  // Takes the direction of an unsigned speed from the force, unless that only scatters.
  void take_strokes_of_friction() {
    const std::vector<double> friction = median_of_five(test_.friction);
    const double reference = typical_of(sizes(friction), moving_share);
    if (!(reference > 0) || row_scatter(friction) > noisy_speed * reference ||
        !goes_both_ways(friction, reference))
      return;
    auto strokes = strokes_of(friction, goes * reference);
    if (friction.size() < mean_rows * strokes.size()) return; // too short for strokes
    out_.strokes = std::move(strokes);
    by_friction_ = true;
    std::vector<double> rows;
    for (const TestPhases::Stroke& stroke : out_.strokes)
      rows.push_back(static_cast<double>(stroke.end - stroke.begin));
    usual_rows_ = median_of(std::move(rows));
    for (const int direction : {-1, 1})
      full_[direction > 0] = median_of(friction_of(direction));
  }

  std::vector<double> friction_of(int direction) const {
    std::vector<double> out;
    for (const TestPhases::Stroke& stroke : out_.strokes)
      for (std::size_t i = stroke.begin; stroke.direction == direction && i < stroke.end; ++i)
        if (std::isfinite(test_.friction[i])) out.push_back(test_.friction[i]);
    return out;
  }

  // A set speed does not show rest, nor does one that cannot be used.
  bool shows_motion() const {
    return out_.speed == SpeedReading::still ||
           (out_.speed == SpeedReading::usable && (test_.speed.empty() || !is_held(test_.speed)));
  }

  // Friction over load; NaN for a row without load.
  double coefficient(std::size_t i) const {
    const double load = test_.load.empty() ? 1 : test_.load[i];
    return load > 0 ? std::abs(test_.friction[i]) / load : std::numeric_limits<double>::quiet_NaN();
  }

  std::vector<double> coefficients_where(std::size_t begin, std::size_t end,
                                         const std::vector<char>& is) const {
    std::vector<double> out;
    for (std::size_t i = begin; i < end; ++i)
      if (const double mu = coefficient(i);
          (is.empty() || is[i]) && std::isfinite(mu) && out_.rows[i] != Phase::unloaded)
        out.push_back(mu);
    return out;
  }

  // Marks rows in which another reading of the speed is next to zero, without half of the friction.
  void mark_rest_by_other_speed() {
    const Values other = test_.other_speed;
    const double typical = speed_in_motion(other);
    if (other.empty() || test_.friction.empty() || !(typical > 0)) return;
    std::vector<char> moves(other.size());
    for (std::size_t i = 0; i < other.size(); ++i)
      moves[i] = !(std::abs(other[i]) <= slow * typical);
    const double rubbing = median_of(coefficients_where(0, other.size(), moves));
    for (const Piece& run : pieces_where(other.size(), [&](std::size_t i) { return !moves[i]; })) {
      const std::vector<double> mu = coefficients_where(run.begin, run.end, {});
      if (mu.empty() || !(median_of(mu) < half_turned * rubbing)) continue;
      out_.still_by_other_speed += mark(run.begin, run.end, Phase::rest);
    }
  }

  // Marks few rows at either end, next to rows at rest or without load, if the friction is there a
  // few rows on, at the same set speed: more of them, or a slow rise, may be a film of lubricant
  // that breaks down, or a surface that runs in.
  void mark_ends_without_friction() {
    const std::size_t rows = test_.friction.size();
    if (rows < rows_with_ends) return;
    const std::vector<double> all = coefficients_where(0, rows, {});
    const double usual = median_of(all),
                 load = test_.load.empty() ? 1 : typical_of(finite_values(test_.load), 0.5);
    const auto most = std::min(
        most_still_rows,
        std::max<std::size_t>(1, static_cast<std::size_t>(still_rows_share * double(rows))));
    const auto is_still = [&](std::size_t i) {
      return coefficient(i) < no_friction_share * usual &&
             (test_.load.empty() || test_.load[i] > pressed_share * load);
    };
    if (all.empty() || !(quantile_of(all, still_quantile) > half_turned * usual)) return;
    for (const bool front : {true, false}) {
      const auto at = [&](std::size_t i) { return front ? i : rows - 1 - i; };
      std::size_t begin = 0;
      while (begin < rows && !is_fitted(out_.rows[at(begin)]))
        ++begin;
      std::size_t end = begin;
      while (end < rows && is_still(at(end)))
        ++end;
      if (end == begin || end - begin > most) continue;
      bool rubs = false, same_speed = true;
      for (std::size_t i = begin; i < std::min(end + most, rows); ++i) {
        rubs = rubs || (i >= end && coefficient(at(i)) > half_turned * usual);
        same_speed = same_speed && (out_.speed != SpeedReading::usable || i > end ||
                                    test_.speed[at(i)] == test_.speed[at(begin)]);
      }
      if (!rubs || !same_speed) continue;
      for (std::size_t i = begin; i < end; ++i)
        out_.still_by_friction += mark(at(i), at(i) + 1, Phase::rest);
    }
  }

  // Whether many rows are slow, but not slower than this.
  bool wide_range(double slowest) const {
    const auto between = std::count_if(size_.begin(), size_.end(), [&](double v) {
      return v >= slowest * typical_ && v < moving_share * typical_;
    });
    return static_cast<double>(between) > either_way * static_cast<double>(size_.size());
  }

  // Friction over load; without a load, friction.
  std::vector<double> coefficients(std::size_t begin, std::size_t end, double least_speed) const {
    std::vector<double> out;
    for (std::size_t i = begin; i < std::min(end, test_.friction.size()); ++i) {
      const double load = test_.load.empty() ? 1 : test_.load[i];
      if (size_[i] >= least_speed && load > 0 && out_.rows[i] != Phase::unloaded)
        out.push_back(std::abs(test_.friction[i]) / load);
    }
    return out;
  }

  // Marks rest. A slow constant level is sliding; a speed within its error of zero is rest, and so
  // is an offset of the speed sensor: a small one, or one without the friction of motion.
  void mark_rest() {
    const bool wide = wide_range(nearly_zero), runs_up = wide_range(slow);
    const double rubbing = median_of(coefficients(0, size_.size(), moving_share * typical_));
    for (const Piece& run : pieces_where(size_.size(), [&](std::size_t i) {
           return size_[i] < slow * typical_ || test_.speed[i] == 0;
         })) {
      if (run.rows() < mean_rows && turns_in(run)) continue; // the end of a stroke, not a rest
      const Values speed = test_.speed.subspan(run.begin, run.rows());
      const Mean mean = mean_with_error(speed);
      const bool constant =
          std::all_of(speed.begin(), speed.end(), [&](double v) { return v == speed.front(); });
      const bool is_offset = !wide && std::abs(mean.value) < nearly_zero * typical_,
                 rubs_less = !runs_up && rubbing > 0 && run.rows() >= mean_rows &&
                             is_level(speed) &&
                             median_of(coefficients(run.begin, run.end, 0)) < half_turned * rubbing;
      if (mean.is_zero() ? mean.value == 0 || run.rows() >= mean_rows
                         : !constant && (is_offset || rubs_less))
        mark(run.begin, run.end, Phase::rest);
    }
  }

  // A set speed, as one that is too coarse, does not show where the path stands.
  void take_standing(bool of_path) {
    if (!of_path && out_.speed == SpeedReading::usable && !is_held(test_.speed)) return;
    const Standing standing(test_.path, test_.time);
    for (const Piece& piece : standing.pieces())
      mark(piece.begin, piece.end, Phase::rest);
  }

  bool turns_in(const Piece& piece) const {
    return std::any_of(out_.strokes.begin(), out_.strokes.end(), [&](const auto& stroke) {
      return stroke.begin > 0 && stroke.begin >= piece.begin && stroke.begin <= piece.end;
    });
  }

  std::size_t mark(std::size_t begin, std::size_t end, Phase phase) {
    std::size_t marked = 0;
    for (std::size_t i = begin; i < end; ++i)
      if (out_.rows[i] != Phase::unloaded && out_.rows[i] != phase) {
        out_.rows[i] = phase;
        ++marked;
      }
    return marked;
  }

  // Progress along the stroke from 0 to 1, by the path, else by the summed speed, else by rows.
  std::vector<double> along(const TestPhases::Stroke& stroke) const {
    std::vector<double> way{0};
    for (std::size_t i = stroke.begin + 1; i < stroke.end; ++i)
      way.push_back(way.back() + (!test_.path.empty() ? std::abs(test_.path[i] - test_.path[i - 1])
                                  : !size_.empty()    ? size_[i]
                                                      : 1));
    const double all = way.back() > 0 ? way.back() : 1;
    for (double& at : way)
      at /= all;
    return way;
  }

  void mark_turning(const TestPhases::Stroke& stroke, bool has_before, bool has_behind) {
    const std::size_t rows = stroke.end - stroke.begin;
    if (rows < stroke_rows) return mark_turned(stroke.begin, stroke.end);
    const std::vector<double> way = along(stroke);
    const double top = size_.empty() ? 0
                                     : quantile_of({size_.begin() + static_cast<long>(stroke.begin),
                                                    size_.begin() + static_cast<long>(stroke.end)},
                                                   0.9);
    for (std::size_t i = 0; i < rows; ++i) {
      const bool is_slow = !size_.empty() && size_[stroke.begin + i] < turning_speed * top;
      if (is_slow || (has_before && way[i] < turning_path) ||
          (has_behind && way[i] > 1 - turning_path))
        mark_turned(stroke.begin + i, stroke.begin + i + 1);
    }
    if (by_friction_) return mark_turned_by_force(stroke);
    mark_turned(stroke.begin, stroke.begin + rows_that_build_up(stroke, way));
  }

  // Marks rows at both ends of a stroke whose force differs from that in full motion: where the
  // force alone shows the reversal, its sign changes between the two. The test may begin and end
  // within a stroke.
  void mark_turned_by_force(const TestPhases::Stroke& stroke) {
    const std::size_t rows = stroke.end - stroke.begin;
    const Values friction = test_.friction.subspan(stroke.begin, rows);
    const double later = static_cast<double>(rows) < 0.5 * usual_rows_
                             ? full_[stroke.direction > 0]
                             : median_of(finite_values(friction));
    const auto is_full = [&](double x) { return x / later >= turned; };
    const auto first = std::find_if(friction.begin(), friction.end(), is_full) - friction.begin(),
               last = std::find_if(friction.rbegin(), friction.rend(), is_full) - friction.rbegin();
    for (const auto& [count, front] : {std::pair(first, true), std::pair(last, false)}) {
      const double edge = front ? friction.front() : friction.back();
      if (!(edge / later < half_turned) || double(count) > longest_turn * usual_rows_) continue;
      const auto marked = std::min(static_cast<std::size_t>(count), rows);
      mark_turned(front ? stroke.begin : stroke.end - marked,
                  front ? stroke.begin + marked : stroke.end);
    }
  }

  void mark_turned(std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (out_.rows[i] != Phase::unloaded && out_.rows[i] != Phase::rest)
        out_.rows[i] = Phase::turning;
  }

  // Rows at the start of a stroke in which the force changes from its value before the reversal to
  // that of the stroke.
  std::size_t rows_that_build_up(const TestPhases::Stroke& stroke,
                                 const std::vector<double>& way) const {
    if (test_.friction.empty()) return 0;
    const Values friction = test_.friction.subspan(stroke.begin, stroke.end - stroke.begin);
    const double later = median_of(finite_values(friction));
    const auto built_up = std::find_if(friction.begin(), friction.end(),
                                       [&](double x) { return x / later >= turned; });
    const auto rows = static_cast<std::size_t>(built_up - friction.begin());
    const bool builds_up = friction.front() / later < half_turned;
    return builds_up && rows < friction.size() && way[rows] < longest_turn ? rows : 0;
  }

  const TestSignals& test_;
  TestPhases& out_;
  std::vector<double> speed_, size_; // smoothed
  double typical_ = 0;
  // Strokes by the force alone: their usual number of rows, and medians of the force by direction.
  bool by_friction_ = false;
  double usual_rows_ = 0;
  std::array<double, 2> full_{};
};

} // namespace

const char* phase_name(Phase phase) {
  static constexpr const char* names[phase_count] = {"sliding", "rest",    "closing",
                                                     "opening", "turning", "unloaded"};
  return names[static_cast<std::size_t>(phase)];
}

bool is_fitted(Phase phase) {
  return phase == Phase::sliding || phase == Phase::closing || phase == Phase::opening;
}

TestPhases phases_of(const TestSignals& test) {
  TestPhases out;
  const std::size_t rows =
      std::max({test.speed.size(), test.load.size(), test.path.size(), test.friction.size()});
  out.rows.assign(rows, Phase::sliding);
  std::vector<double> speed, time, load, path, friction;
  TestSignals whole = {filled(test.speed, speed),       filled(test.time, time),
                       filled(test.load, load),         filled(test.path, path),
                       filled(test.friction, friction), test.other_speed};
  const bool of_path = whole.speed.empty() && whole.path.size() > 2 && !whole.time.empty();
  if (of_path) {
    speed = speed_of_path(whole.path, whole.time);
    whole.speed = speed;
  }
  const LoadPhases of_load(whole, out);
  const SpeedPhases of_speed(whole, of_path, out);
  return out;
}

} // namespace frictab::data
