// Greedy V-optimal tests within a rig's reach.
#include "process/design.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "core/no_value.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/text.h"
#include "data/middle.h"
#include "data/quantity.h"
#include "io/csv.h"
#include "process/coverage.h"
#include "process/smooth.h"

namespace frictab::process {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

constexpr std::size_t rows_of_a_course = 40;
constexpr std::size_t target_states = 600; // of a process, drawn by friction work
constexpr std::array<std::size_t, 4> level_counts = {15, 6, 5, 6};

using Range = std::pair<double, double>;

// ---- the tests of the campaign ----

struct Campaign {
  const data::Dataset& data;
  std::vector<Setting> at; // settings of each test
  std::array<bool, 4> varies{};
  std::array<Range, 4> range;

  explicit Campaign(const data::Dataset& tests) : data(tests) {
    for (std::size_t e = 0; e < data.experiments.size(); ++e)
      at.push_back({median("sigma_n_MPa", e), largest("psi", e), median("v_rel_mm_s", e), tool(e)});
    for (std::size_t s = 0; s < at.front().size(); ++s) {
      Range& r = range[s] = {HUGE_VAL, -HUGE_VAL};
      for (const Setting& one : at)
        if (std::isfinite(one[s])) r = {std::min(r.first, one[s]), std::max(r.second, one[s])};
      varies[s] = r.second > r.first * (1 + 1e-6) || r.second > r.first + 1e-6 * std::abs(r.second);
    }
  }

private:
  std::span<const double> of(const char* name, std::size_t e) const {
    if (!data.has(name)) return {};
    return data.values(name).subspan(data.first_row[e], data.first_row[e + 1] - data.first_row[e]);
  }
  double median(const char* name, std::size_t e) const {
    const auto values = of(name, e);
    return data::upper_median({values.begin(), values.end()});
  }
  double largest(const char* name, std::size_t e) const {
    const auto values = of(name, e);
    return values.empty() ? no_value : *std::ranges::max_element(values);
  }
  double tool(std::size_t e) const {
    for (const char* name : {"T_tool_C", "T_contact_C"})
      if (const auto values = of(name, e); !values.empty()) return values.front();
    return no_value;
  }
};

// Table 1 where the campaign lies within it, else what the campaign reaches.
Range usual_reach(const char* name, const Range& tested) {
  const data::Quantity& quantity = *data::find_quantity(name);
  const Range table1 = *quantity.paper_range;
  const bool within = tested.first >= 0.99 * table1.first && tested.second <= 1.01 * table1.second;
  return within ? table1 : tested;
}

std::array<Range, 4> reach_of(const Campaign& campaign, const ProcessOptions& options) {
  std::array<Range, 4> reach;
  for (std::size_t s = 0; s < setting_names.size(); ++s) {
    const auto own = options.rig.find(setting_names[s]);
    reach[s] =
        own != options.rig.end() ? own->second : usual_reach(setting_names[s], campaign.range[s]);
    if (!campaign.varies[s]) reach[s] = campaign.range[s]; // not a setting
  }
  return reach;
}

bool is_log(std::size_t setting) {
  return setting_names[setting] != std::string_view("T_tool_C");
}
double coordinate(std::size_t setting, double x) {
  return is_log(setting) ? std::log(std::max(x, 1e-3)) : x;
}

// ---- candidates ----

// Rounded as people set rigs: two digits.
double rounded(double x) {
  if (x == 0) return 0;
  const double unit = std::pow(10, std::floor(std::log10(std::abs(x))) - 1);
  return std::round(x / unit) * unit;
}

std::vector<double> levels_of(std::size_t setting, const Range& reach, bool varies) {
  if (!varies) return {reach.first};
  std::set<double> found;
  const double low = coordinate(setting, reach.first), high = coordinate(setting, reach.second);
  const std::size_t count = level_counts[setting];
  for (std::size_t i = 0; i < count; ++i) {
    const double u = low + (high - low) * static_cast<double>(i) / static_cast<double>(count - 1);
    const bool is_end = i == 0 || i + 1 == count;
    const double x = is_log(setting) ? std::exp(u) : u;
    found.insert(is_end ? (i == 0 ? reach.first : reach.second)
                        : std::clamp(rounded(x), reach.first, reach.second));
  }
  return {found.begin(), found.end()};
}

std::vector<Setting> all_settings(const Campaign& campaign, const std::array<Range, 4>& reach) {
  std::array<std::vector<double>, 4> at;
  for (std::size_t s = 0; s < setting_names.size(); ++s)
    at[s] = levels_of(s, reach[s], campaign.varies[s]);
  std::vector<Setting> found;
  for (const double p : at[0])
    for (const double psi : at[1])
      for (const double v : at[2])
        for (const double T : at[3])
          found.push_back({p, psi, v, T});
  return found;
}

// Tests at new settings: each is the nearest test of the campaign, brought there.
class Courses {
public:
  Courses(const Campaign& campaign, const std::array<Range, 4>& reach) : campaign_(campaign) {
    for (std::size_t s = 0; s < setting_names.size(); ++s)
      span_[s] = coordinate(s, reach[s].second) - coordinate(s, reach[s].first);
    for (std::size_t e = 0; e < campaign.at.size(); ++e)
      rows_.push_back(
          some_rows(campaign.data.first_row[e], campaign.data.first_row[e + 1], rows_of_a_course));
  }

  // Between settings, each divided by the rig's reach.
  double distance(const Setting& a, const Setting& b) const {
    double square = 0;
    for (std::size_t s = 0; s < setting_names.size(); ++s) {
      if (!campaign_.varies[s] || !(span_[s] > 0)) continue;
      const double d = (coordinate(s, a[s]) - coordinate(s, b[s])) / span_[s];
      square += d * d;
    }
    return std::sqrt(square);
  }

  // The campaign's own tests, by some of their rows.
  data::Dataset own() const {
    std::vector<std::size_t> all(rows_.size());
    std::iota(all.begin(), all.end(), 0);
    return gathered(all);
  }

  data::Dataset at(const std::vector<Setting>& settings) const {
    std::vector<std::size_t> bases(settings.size());
    parallel_for(settings.size(), [&](std::size_t i) { bases[i] = nearest(settings[i]); });
    data::Dataset tests = gathered(bases);
    for (data::Column& column : tests.columns)
      for (std::size_t e = 0; e < settings.size(); ++e)
        for (std::size_t row = tests.first_row[e]; row < tests.first_row[e + 1]; ++row)
          column.values[row] =
              moved(column.name, column.values[row], campaign_.at[bases[e]], settings[e]);
    return tests;
  }

private:
  static constexpr double no_expansion = 1.02; // psi of a test whose surface hardly expands

  data::Dataset gathered(const std::vector<std::size_t>& tests) const {
    data::Dataset out;
    std::vector<std::size_t> rows;
    for (const std::size_t e : tests) {
      rows.insert(rows.end(), rows_[e].begin(), rows_[e].end());
      out.first_row.push_back(rows.size());
      out.experiments.push_back(std::to_string(out.first_row.size() - 1));
    }
    for (const data::Column& column : campaign_.data.columns) {
      data::Column taken{column.name, column.unit, {}, column.levels, column.role};
      for (const std::size_t row : rows)
        taken.values.push_back(column.values[row]);
      out.columns.push_back(std::move(taken));
    }
    return out;
  }

  double moved(const std::string& state, double x, const Setting& from, const Setting& to) const {
    if (state == "sigma_n_MPa" && campaign_.varies[0]) return x * to[0] / from[0];
    if (state == "psi" && campaign_.varies[1])
      return from[1] > no_expansion ? 1 + (x - 1) * (to[1] - 1) / (from[1] - 1) : to[1];
    if (state == "v_rel_mm_s" && campaign_.varies[2]) return x * to[2] / from[2];
    if ((state == "T_contact_C" || state == "T_tool_C") && campaign_.varies[3])
      return x + to[3] - from[3];
    return x;
  }

  std::size_t nearest(const Setting& setting) const {
    std::size_t best = 0;
    double least = HUGE_VAL;
    for (std::size_t e = 0; e < campaign_.at.size(); ++e) {
      const Setting& own = campaign_.at[e];
      double far = distance(own, setting);
      // A course without expansion cannot be scaled to one with it.
      const bool scalable =
          !campaign_.varies[1] || own[1] > no_expansion || setting[1] <= no_expansion;
      if (!scalable) far += 100;
      if (far < least) {
        least = far;
        best = e;
      }
    }
    return best;
  }

  const Campaign& campaign_;
  Setting span_{};
  std::vector<std::vector<std::size_t>> rows_; // of each test
};

// ---- the design ----

// Covariance after a test with these bins.
MatrixXd with_test(const MatrixXd& S, const MatrixXd& g, const MatrixXd& V) {
  const MatrixXd sg = S * g.transpose();
  const MatrixXd m = V + g * sg;
  return S - sg * m.llt().solve(sg.transpose());
}

class Design {
public:
  // `target`: terms of the process's states.
  Design(const Smooth& smooth, const std::vector<MatrixXd>& known, const MatrixXd& target)
      : V_(smooth.weight().llt().solve(
            MatrixXd::Identity(smooth.weight().rows(), smooth.weight().cols()))),
        moments_(target.transpose() * target / static_cast<double>(target.rows())) {
    MatrixXd precision = smooth.prior().cwiseInverse().asDiagonal();
    for (const MatrixXd& g : known)
      precision += g.transpose() * smooth.weight() * g;
    S_ = precision.llt().solve(MatrixXd::Identity(precision.rows(), precision.cols()));
  }

  double open() const { return open(S_); }
  double open_with(const std::vector<MatrixXd>& tests) const {
    MatrixXd S = S_;
    for (const MatrixXd& g : tests)
      S = with_test(S, g, V_);
    return open(S);
  }

  std::vector<std::size_t> greedy(const std::vector<MatrixXd>& candidates,
                                  std::size_t count) const {
    std::vector<std::size_t> chosen;
    MatrixXd S = S_;
    std::vector<double> gain(candidates.size());
    for (std::size_t n = 0; n < count; ++n) {
      const MatrixXd smt = S * moments_ * S;
      parallel_for(candidates.size(), [&](std::size_t i) {
        const MatrixXd& g = candidates[i];
        const MatrixXd m = V_ + g * S * g.transpose();
        gain[i] = m.llt().solve(g * smt * g.transpose()).trace();
      });
      chosen.push_back(static_cast<std::size_t>(std::ranges::max_element(gain) - gain.begin()));
      S = with_test(S, candidates[chosen.back()], V_);
    }
    return chosen;
  }

private:
  double open(const MatrixXd& S) const { return std::sqrt(S.cwiseProduct(moments_).sum()); }

  MatrixXd V_, moments_, S_;
};

// ---- centres of friction work ----

// Settings whose course is in the middle of friction work: k-means of its states, clipped to the
// rig.
std::vector<Setting> centres_of(const ContactHistory& history, std::span<const double> work_J,
                                const Campaign& campaign, const std::array<Range, 4>& reach,
                                double heating, std::size_t count) {
  const std::array<const char*, 4> state = {"sigma_n_MPa", "psi", "v_rel_mm_s", "T_contact_C"};
  const std::vector<std::string> names(state.begin(), state.end());
  const States at = states_at(history.states, names, drawn_by_work(work_J, target_states));
  const std::size_t rows = at.front().size();
  std::vector<Setting> points(rows);
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t s = 0; s < state.size(); ++s) {
      const double span = coordinate(s, reach[s].second) - coordinate(s, reach[s].first);
      points[i][s] = span > 0 ? coordinate(s, at[s][i]) / span : 0;
    }
  const auto distance = [](const Setting& a, const Setting& b) {
    double sum = 0;
    for (std::size_t s = 0; s < a.size(); ++s)
      sum += (a[s] - b[s]) * (a[s] - b[s]);
    return sum;
  };
  // Each further start is the point farthest from those before.
  std::vector<Setting> centres{points[rows / 2]};
  while (centres.size() < std::min(count, rows)) {
    std::size_t farthest = 0;
    double most = -1;
    for (std::size_t i = 0; i < rows; ++i) {
      double least = HUGE_VAL;
      for (const Setting& centre : centres)
        least = std::min(least, distance(points[i], centre));
      if (least > most) {
        most = least;
        farthest = i;
      }
    }
    centres.push_back(points[farthest]);
  }
  for (int round = 0; round < 30; ++round) {
    std::vector<Setting> sums(centres.size(), Setting{});
    std::vector<double> members(centres.size());
    for (const Setting& point : points) {
      std::size_t best = 0;
      for (std::size_t c = 1; c < centres.size(); ++c)
        if (distance(point, centres[c]) < distance(point, centres[best])) best = c;
      for (std::size_t s = 0; s < point.size(); ++s)
        sums[best][s] += point[s];
      ++members[best];
    }
    for (std::size_t c = 0; c < centres.size(); ++c)
      for (std::size_t s = 0; members[c] > 0 && s < sums[c].size(); ++s)
        centres[c][s] = sums[c][s] / members[c];
  }
  std::vector<Setting> settings;
  for (const Setting& centre : centres) {
    Setting setting;
    for (std::size_t s = 0; s < setting.size(); ++s) {
      const double span = coordinate(s, reach[s].second) - coordinate(s, reach[s].first);
      const double u = centre[s] * span;
      const double x = is_log(s) ? std::exp(u) : u - heating;
      setting[s] = campaign.varies[s] ? rounded(std::clamp(x, reach[s].first, reach[s].second))
                                      : reach[s].first;
      if (campaign.varies[s]) setting[s] = std::clamp(setting[s], reach[s].first, reach[s].second);
    }
    settings.push_back(setting);
  }
  return settings;
}

// By how much contacts of the campaign are warmer than their tools, in the middle.
double heating_of(const Campaign& campaign) {
  if (!campaign.data.has("T_contact_C") || !campaign.data.has("T_tool_C")) return 0;
  const auto contact = campaign.data.values("T_contact_C"), tool = campaign.data.values("T_tool_C");
  std::vector<double> rise;
  for (std::size_t i = 0; i < contact.size(); ++i)
    if (std::isfinite(contact[i] - tool[i])) rise.push_back(contact[i] - tool[i]);
  return rise.empty() ? 0 : data::upper_median(std::move(rise));
}

std::vector<OutOfReach> out_of_reach(const ContactHistory& history, std::span<const double> work_J,
                                     const Campaign& campaign, const std::array<Range, 4>& reach) {
  std::vector<OutOfReach> found;
  const double all = std::accumulate(work_J.begin(), work_J.end(), 0.0);
  for (std::size_t s = 0; s < 3; ++s) { // the temperature of a contact is not set
    if (!campaign.varies[s] || !history.states.has(setting_names[s])) continue;
    const auto x = history.states.values(setting_names[s]);
    for (const bool below : {true, false}) {
      OutOfReach one{setting_names[s], data::find_quantity(setting_names[s])->unit,
                     below ? reach[s].first : reach[s].second, below};
      std::vector<double> work(x.size());
      for (std::size_t row = 0; row < x.size(); ++row)
        if (below ? x[row] < one.limit : x[row] > one.limit) work[row] = work_J[row];
      one.share = std::accumulate(work.begin(), work.end(), 0.0) / all;
      if (one.share < 0.005) continue;
      one.median = weighted_quantile(x, work, 0.5);
      found.push_back(one);
    }
  }
  return found;
}

// The range of each state that the tests and the rig reach together.
StateRanges wide_ranges(const Campaign& campaign, const std::array<Range, 4>& reach,
                        const std::vector<std::string>& states, double heating) {
  StateRanges ranges = ranges_of(campaign.data, states);
  for (std::size_t i = 0; i < states.size(); ++i)
    for (std::size_t s = 0; s < setting_names.size(); ++s) {
      const bool is_temperature = setting_names[s] == std::string_view("T_tool_C");
      if (!campaign.varies[s] || states[i] != (is_temperature ? "T_contact_C" : setting_names[s]))
        continue;
      ranges[i].first = std::min(ranges[i].first, reach[s].first);
      ranges[i].second =
          std::max(ranges[i].second, reach[s].second + (is_temperature ? heating : 0));
    }
  return ranges;
}

std::vector<std::size_t> evenly(std::size_t all, std::size_t count) {
  std::vector<std::size_t> at;
  for (std::size_t i = 0; i < std::min(all, count); ++i)
    at.push_back(count < 2 ? all / 2 : i * (all - 1) / (count - 1));
  return at;
}

// Returns an empty text where tests can be designed.
std::string why_no_design(const Campaign& campaign) {
  if (smooth_states(campaign.data).empty() || campaign.at.size() < 3)
    return "fewer than three tests, or no state that varies in them";
  if (std::ranges::find(campaign.varies, true) == campaign.varies.end())
    return "the tests vary in no setting of a rig";
  return "";
}

// The rig's reach, and the linear model of the campaign's tests and of the process.
struct Basis {
  const Campaign& campaign;
  std::vector<std::string> states;
  std::array<Range, 4> reach;
  double heating;
  Smooth smooth;
  Courses courses;
  std::vector<MatrixXd> known; // bins of the campaign's tests
  std::optional<Design> design;

  Basis(const Campaign& of, const Tests& tests, const ContactHistory& history,
        std::span<const double> work_J, const ProcessOptions& options)
      : campaign(of), states(smooth_states(of.data)), reach(reach_of(of, options)),
        heating(heating_of(of)),
        smooth(tests.calibration, of.data, states, wide_ranges(of, reach, states, heating)),
        courses(of, reach) {
    const States target = states_at(history.states, states, drawn_by_work(work_J, target_states));
    smooth.add_bumps(target);
    known = bins_of(courses.own());
    design.emplace(smooth, known, smooth.design(target));
  }

  std::vector<MatrixXd> bins_of(const data::Dataset& some) const {
    std::vector<MatrixXd> bins;
    std::vector<std::size_t> rows(some.rows());
    std::iota(rows.begin(), rows.end(), 0);
    const MatrixXd terms = smooth.design(states_at(some, states, rows));
    for (std::size_t e = 0; e < some.experiments.size(); ++e)
      bins.push_back(smooth.bins(
          terms.middleRows(static_cast<Index>(some.first_row[e]),
                           static_cast<Index>(some.first_row[e + 1] - some.first_row[e]))));
    return bins;
  }

  // Without the settings in which the tests do not vary.
  Setting shown(Setting setting) const {
    for (std::size_t s = 0; s < setting_names.size(); ++s)
      if (!campaign.varies[s]) setting[s] = no_value;
    return setting;
  }
};

} // namespace

double open_ln_tau(const Tests& tests, const ContactHistory& history,
                   std::span<const double> work_J, const ProcessOptions& options) {
  const Campaign campaign(tests.all);
  if (!why_no_design(campaign).empty()) return 0;
  return Basis(campaign, tests, history, work_J, options).design->open();
}

ProposedTests propose_tests(const Tests& tests, const ContactHistory& history,
                            std::span<const double> work_J, const ProcessOptions& options) {
  ProposedTests out;
  const Campaign campaign(tests.all);
  out.why_none = why_no_design(campaign);
  if (!out.why_none.empty()) return out;
  const Basis basis(campaign, tests, history, work_J, options);
  for (std::size_t s = 0; s < setting_names.size(); ++s)
    if (campaign.varies[s]) out.rig.emplace_back(setting_names[s], basis.reach[s]);
  const std::vector<Setting> settings = all_settings(campaign, basis.reach);
  const std::vector<MatrixXd> candidates = basis.bins_of(basis.courses.at(settings));
  std::vector<MatrixXd> chosen, again;
  for (const std::size_t i : basis.design->greedy(candidates, options.tests)) {
    out.tests.push_back(basis.shown(settings[i]));
    chosen.push_back(candidates[i]);
  }
  const std::vector<Setting> centres =
      centres_of(history, work_J, campaign, basis.reach, basis.heating, options.tests);
  for (const Setting& setting : centres)
    out.centres.push_back(basis.shown(setting));
  for (const std::size_t e : evenly(campaign.at.size(), options.tests))
    again.push_back(basis.known[e]);
  for (std::size_t i = 0; i < std::min(options.repeats, out.tests.size()); ++i)
    out.repeated.push_back(i);
  out.open = basis.design->open();
  out.with_tests = basis.design->open_with(chosen);
  out.with_centres = basis.design->open_with(basis.bins_of(basis.courses.at(centres)));
  out.with_repeats = basis.design->open_with(again);
  out.out_of_reach = out_of_reach(history, work_J, campaign, basis.reach);
  return out;
}

std::string plan_csv(const ProposedTests& proposed, const std::vector<std::string>& known,
                     std::uint64_t seed) {
  constexpr std::uint64_t stream = 0x706c616e; // "plan"
  std::vector<std::size_t> runs(proposed.tests.size());
  std::iota(runs.begin(), runs.end(), 0);
  runs.insert(runs.end(), proposed.repeated.begin(), proposed.repeated.end());
  std::vector<std::size_t> order(runs.size());
  std::iota(order.begin(), order.end(), 0);
  Random random(seed, stream);
  random.shuffle(std::span<std::size_t>(order));
  // Names that differ from those of the campaign.
  std::string prefix = "P";
  while (
      std::ranges::any_of(known, [&](const std::string& name) { return name.starts_with(prefix); }))
    prefix += "P";
  std::string text = "experiment,plan_order,plan_repeats,plan_sigma_n_MPa,plan_psi,plan_v_rel_mm_s,"
                     "plan_T_tool_C\n";
  const auto number = [](double x) { return std::isfinite(x) ? fmt::format("{:.6g}", x) : ""; };
  for (std::size_t place = 0; place < order.size(); ++place) {
    const std::size_t run = order[place], test = runs[run];
    const bool repeats = run >= proposed.tests.size();
    text += fmt::format("{}{:02},{},{}", prefix, run + 1, place + 1,
                        repeats ? fmt::format("{}{:02}", prefix, test + 1) : "-");
    for (const double value : proposed.tests[test])
      text += "," + number(value);
    text += "\n";
  }
  for (const std::string& name : known)
    text += io::csv_cell(name) + ",,-,,,,\n";
  return text;
}

} // namespace frictab::process
