// Chooses the nodes of each axis from the measured error along it, then checks the whole table.
#include "table/build.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "core/text.h"
#include "data/meaning.h"
#include "table/direct.h"
#include "table/drift.h"
#include "table/grid.h"
#include "table/outside.h"
#include "table/sampling.h"
#include "table/tolerance.h"

namespace frictab::table {

namespace {

using Counts = std::vector<std::size_t>; // per axis

AxisPlan plan_axis(const models::Law& law, const StateRange& range, const TableOptions& options) {
  const data::Meaning quantity = data::meaning_of(range.name);
  const AxisOptions asked = options.axis(range.name);
  AxisPlan plan;
  plan.axis.name = range.name;
  plan.axis.unit = quantity.unit;
  plan.axis.long_name = quantity.text;
  plan.axis.data = range.data;
  const auto own = law.log_axes.find(range.name);
  const bool plain = options.coordinates == "plain";
  plan.axis.log =
      !plain && (own == law.log_axes.end() ? quantity.log_axis : own->second) && range.low > 0;
  if (asked.spacing) {
    plan.axis.log = *asked.spacing == "log";
    plan.even = true;
    if (plan.axis.log && plain)
      throw InputError(asked.place,
                       "table.coordinates is \"plain\", and the axis " + range.name +
                           " is asked to be logarithmic",
                       "spacing = \"linear\", or table.coordinates = \"law\"");
    if (plan.axis.log && range.low <= 0)
      throw InputError(asked.place,
                       fmt::format("the axis {} cannot be logarithmic: its range starts at {}",
                                   range.name, range.low),
                       "spacing = \"linear\", or a range that starts above 0");
  }
  plan.axis.below = range.below.value_or(usual_below(range.name));
  if (!asked.outside.empty()) {
    plan.axis.below = *find_outside(asked.outside.front());
    plan.axis.above = *find_outside(asked.outside.back());
  }
  plan.fixed = {range.low, range.high};
  if (const auto kinks = law.kinks.find(range.name); kinks != law.kinks.end())
    for (const double kink : kinks->second)
      if (kink > range.low && kink < range.high) plan.axis.kinks.push_back(kink);
  plan.fixed.insert(plan.fixed.end(), plan.axis.kinks.begin(), plan.axis.kinks.end());
  std::ranges::sort(plan.fixed);
  if (asked.nodes) {
    plan.cells = *asked.nodes - 1;
    plan.by_user = true;
  }
  return plan;
}

// One plan per axis; other inputs are not axes.
std::vector<AxisPlan> plan_axes(const models::AssembledLaw& law,
                                const std::vector<StateRange>& ranges,
                                const TableOptions& options) {
  std::vector<AxisPlan> plans;
  for (std::size_t r = 0; r < ranges.size(); ++r)
    if (law.piece_inputs.count(ranges[r].name)) {
      plans.push_back(plan_axis(*law.model.law, ranges[r], options));
      plans.back().input = r;
    }
  return plans;
}

void check_memory(const std::vector<TableAxis>& axes, const TableOptions& options) {
  if (fits_into_memory(count_nodes(axes))) return;
  std::vector<std::string> counts;
  for (const TableAxis& axis : axes)
    counts.push_back(fmt::format("{} {}", axis.name, axis.nodes.size()));
  throw InputError(
      options.place,
      fmt::format("the table needs {} ({} nodes: {}), more than half of this machine's "
                  "memory",
                  human_bytes(8.0 * static_cast<double>(count_nodes(axes))),
                  thousands(count_nodes(axes)), join(counts, ", ")),
      fmt::format("fewer nodes in [table.axes], a larger table.tolerance_MPa than {:.3g}{}, or "
                  "narrower ranges",
                  options.tolerance_MPa.value_or(usual_tolerance_MPa),
                  options.tolerance_from.empty() ? "" : " (" + options.tolerance_from + ")"));
}

// Samples the piece at all nodes.
std::vector<double> sample(const Pieces& pieces, const std::vector<StateRange>& ranges,
                           const std::vector<TableAxis>& axes) {
  std::vector<double> values(count_nodes(axes));
  parallel_for((values.size() + sample_block - 1) / sample_block, [&](std::size_t c) {
    const std::size_t first = c * sample_block;
    sample_nodes(pieces, ranges, axes, first,
                 std::span(values).subspan(first, std::min(sample_block, values.size() - first)));
  });
  return values;
}

Table sampled_table(const models::AssembledLaw& law, const Pieces& pieces,
                    const std::vector<StateRange>& ranges, std::vector<TableAxis> axes,
                    Interpolation interpolation, bool log_value) {
  std::vector<double> values = sample(pieces, ranges, axes);
  Table table = describe_table(law, ranges, std::move(axes), interpolation, log_value);
  table.value = std::move(values);
  return table;
}

// Whether the table interpolates in ln value, which is above 0 on these axes then.
bool has_log_value(const models::AssembledLaw& law, const Pieces& pieces,
                   const std::vector<StateRange>& ranges, const std::vector<TableAxis>& axes,
                   const TableOptions& options) {
  if (!law.model.law->log_value || options.coordinates != "law") return false;
  const std::vector<double> values = sample(pieces, ranges, axes);
  return *std::ranges::min_element(values) > 0;
}

// Says in the record to what the table was made.
void set_aim(TableRecord& record, const TableOptions& options) {
  record.tolerance_MPa = options.tolerance_MPa.value_or(usual_tolerance_MPa);
  if (!options.tolerance_from.empty()) record.tolerance_from = options.tolerance_from;
  if (options.nodes) record.asked_nodes = static_cast<double>(*options.nodes);
  if (options.max_bytes) record.asked_bytes = static_cast<double>(*options.max_bytes);
}

// Searches for the fewest nodes; build.h describes how.
class Builder {
public:
  Builder(const models::AssembledLaw& law, const std::vector<StateRange>& ranges,
          const TableOptions& options)
      : law_(law), ranges_(ranges), options_(options),
        progress_("grids for " + law.model.name(), 0),
        tolerance_(options.tolerance_MPa.value_or(usual_tolerance_MPa)),
        limit_(share_of_tolerance * tolerance_), pieces_(law, ranges), tau_R_(law, pieces_.names) {
    plans_ = plan_axes(law, ranges, options);
    Counts least;
    for (const AxisPlan& plan : plans_)
      least.push_back(plan.cells);
    check_memory(axes_with(least), options);
    log_value_ = has_log_value(law, pieces_, ranges, axes_with(least), options);
    box_ = with_law(tau_R_, box_points(ranges, box_samples));
  }

  Table build() {
    if (options_.nodes || options_.max_bytes) return closest();
    interpolation_ = options_.interpolation.value_or(linear_is_small() ? Interpolation::linear
                                                                       : Interpolation::cubic);
    AxisErrors errors(pieces_, ranges_, log_value_, interpolation_ == Interpolation::cubic);
    const double target = first_target(errors);
    for (AxisPlan& plan : plans_)
      errors.distribute_nodes(plan, target);
    for (int round = 0; round < 4; ++round) {
      refine(errors, target * limit_ / (share_of_tolerance * tolerance_));
      if (best_.drift > limit_) break;
      trim();
      const double worst = worst_anywhere();
      if (worst <= tolerance_) break;
      limit_ *= share_of_tolerance * tolerance_ / worst;
      if (round < 3) best_ = {};
    }
    return finished();
  }

private:
  static constexpr double share_of_tolerance = 0.96;
  static constexpr std::size_t box_samples = 20000, last_samples = 200000;
  static constexpr std::size_t most_trim_nodes = 4'000'000; // nodes sampled while trimming
  // cubic above it, if the job leaves the choice
  static constexpr double most_linear_nodes = 20'000;

  Table finished() {
    set_aim(best_.table.record, options_);
    best_.table.record.refinement = trail_;
    return std::move(best_.table);
  }

  struct Trial {
    Counts cells;
    Table table;
    double drift = HUGE_VAL;
  };

  // Shares the limit equally among the axes that err at all.
  double first_target(AxisErrors& errors) const {
    std::size_t active = 0;
    for (const AxisPlan& plan : plans_)
      active += errors.largest(plan, plan.cells) > 1e-3 * tolerance_;
    return limit_ / static_cast<double>(std::max<std::size_t>(active, 1));
  }

  bool linear_is_small() const {
    AxisErrors errors(pieces_, ranges_, log_value_, false);
    const double target = first_target(errors);
    double nodes = 1;
    for (AxisPlan plan : plans_) {
      errors.distribute_nodes(plan, target);
      nodes *=
          1.0 + static_cast<double>(plan.by_user ? plan.cells : errors.cells_for(plan, target));
    }
    return nodes <= most_linear_nodes;
  }

  std::vector<TableAxis> axes_with(const Counts& cells) const {
    std::vector<TableAxis> axes;
    for (std::size_t a = 0; a < plans_.size(); ++a)
      axes.push_back(axis_with(plans_[a], cells[a]));
    return axes;
  }

  // Samples the whole table and searches for the worst state. Stops early where a state that is
  // already known is worse than `enough`.
  Trial attempt(const Counts& cells, double enough) {
    progress_.tick();
    Trial trial;
    trial.cells = cells;
    std::vector<TableAxis> axes = axes_with(cells);
    check_memory(axes, options_);
    trial.table =
        sampled_table(law_, pieces_, ranges_, std::move(axes), interpolation_, log_value_);
    check_finite(trial.table, 0, trial.table.value, options_.place);
    const TableFunction function(trial.table);
    trial.drift = compare(peaks_, function);
    if (trial.drift > enough) return trial;
    Probe all = with_law(tau_R_, cell_points(ranges_, trial.table.axes, box_samples));
    append(all, box_);
    compare(all, function);
    const WorstCase worst = worst_case(tau_R_, function, ranges_, all);
    append(peaks_, with_law(tau_R_, worst.peaks));
    trial.drift = std::max(trial.drift, worst.drift_MPa);
    return trial;
  }

  // Searches again among as many states as a verification takes.
  double worst_anywhere() {
    const WorstCase worst = worst_case(tau_R_, TableFunction(best_.table), ranges_,
                                       probe_points(ranges_, best_.table.axes, last_samples));
    append(peaks_, with_law(tau_R_, worst.peaks));
    return worst.drift_MPa;
  }

  void remember(const Trial& trial) {
    trail_ += fmt::format("{}{} nodes: {:.3g} MPa", trail_.empty() ? "" : "; ",
                          thousands(trial.table.nodes()), trial.drift);
  }

  void refine(AxisErrors& errors, double target) {
    double passed = 0, failed = HUGE_VAL; // targets
    Counts cells;
    for (int round = 0; round < 12; ++round) {
      const Counts next = cells_at(errors, target);
      if (round > 0 && next == cells) return;
      cells = next;
      const std::size_t known = peaks_.law.size();
      Trial trial = attempt(cells, HUGE_VAL);
      remember(trial);
      const double ratio = trial.drift / limit_;
      const bool fewer = trial.table.nodes() < best_.table.nodes();
      if (best_.cells.empty() || (ratio <= 1 ? best_.drift > limit_ || fewer
                                             : best_.drift > limit_ && trial.drift < best_.drift))
        best_ = std::move(trial);
      if (ratio <= 1 && ratio > 0.85) return;
      for (std::size_t i = known; i < std::min(known + 8, peaks_.law.size()); ++i)
        errors.add(state_of(peaks_, i));
      (ratio <= 1 ? passed : failed) = target;
      target *= std::clamp(0.95 / ratio, 0.2, 5.0);
      if (passed > 0 && target <= passed) target = 0.5 * (passed + std::min(failed, 2 * passed));
      if (target >= failed) target = passed > 0 ? 0.5 * (passed + failed) : 0.5 * failed;
      if (failed < 1.05 * passed) return;
    }
  }

  // Gives up cells, first on the axis with the fewest: one cell less saves most there.
  void trim() {
    Counts step;
    for (std::size_t a = 0; a < plans_.size(); ++a)
      step.push_back(plans_[a].by_user ? 0 : std::max<std::size_t>(1, best_.cells[a] / 8));
    const std::size_t before = best_.table.nodes();
    for (std::size_t sampled = 0; sampled < most_trim_nodes;) {
      std::size_t at = plans_.size();
      for (std::size_t a = 0; a < plans_.size(); ++a)
        if (step[a] > 0 && best_.cells[a] > plans_[a].cells &&
            (at == plans_.size() || best_.cells[a] * step[at] < best_.cells[at] * step[a]))
          at = a;
      if (at == plans_.size()) break;
      Counts cells = best_.cells;
      cells[at] -= std::min(step[at], cells[at] - plans_[at].cells);
      Trial trial = attempt(cells, limit_);
      sampled += trial.table.nodes();
      if (trial.drift <= limit_)
        best_ = std::move(trial);
      else
        step[at] /= 2;
    }
    if (best_.table.nodes() < before) remember(best_);
  }

  // Returns the closest table within the budget; tries both interpolations if the job leaves the
  // choice.
  Table closest() {
    Trial closest;
    const std::vector<AxisPlan> plans = plans_;
    for (const Interpolation interpolation : grid_interpolations) {
      if (options_.interpolation.value_or(interpolation) != interpolation) continue;
      interpolation_ = interpolation;
      plans_ = plans;
      best_ = {};
      fill_budget();
      if (closest.cells.empty() || best_.drift < closest.drift) closest = std::move(best_);
    }
    best_ = std::move(closest);
    return finished();
  }

  bool within_budget(const Counts& cells) const {
    double nodes = 1, numbers = static_cast<double>(law_.parameters.size());
    for (const std::size_t count : cells) {
      nodes *= static_cast<double>(count + 1);
      numbers += static_cast<double>(count + 1);
    }
    return (!options_.nodes || nodes <= static_cast<double>(*options_.nodes)) &&
           (!options_.max_bytes ||
            8 * (nodes + numbers) <= static_cast<double>(*options_.max_bytes));
  }

  // Works like refine(), but with the smallest target whose cells are within the budget; then adds
  // single cells for as long as they help and fit.
  void fill_budget() {
    AxisErrors errors(pieces_, ranges_, log_value_, interpolation_ == Interpolation::cubic);
    Counts least;
    for (const AxisPlan& plan : plans_)
      least.push_back(plan.cells);
    if (!within_budget(least))
      throw InputError(options_.place,
                       fmt::format("the smallest table of {} has {} nodes, which is more than "
                                   "table.nodes or table.max_bytes allows",
                                   law_.model.name(), thousands(count_nodes(axes_with(least)))),
                       "a larger budget, or fewer nodes in [table.axes]");
    double target = budget_target(errors, least);
    for (AxisPlan& plan : plans_)
      errors.distribute_nodes(plan, target);
    for (int round = 0; round < 5; ++round) {
      target = budget_target(errors, least);
      const Counts cells = cells_at(errors, target);
      if (cells == best_.cells) break;
      const std::size_t known = peaks_.law.size();
      consider(attempt(cells, HUGE_VAL));
      for (std::size_t i = known; i < std::min(known + 8, peaks_.law.size()); ++i)
        errors.add(state_of(peaks_, i));
    }
    while (best_.drift > 1e-9 && add_cell()) {
    }
    remember(best_);
  }

  void consider(Trial trial) {
    if (best_.cells.empty() || trial.drift < best_.drift) best_ = std::move(trial);
  }

  Counts cells_at(AxisErrors& errors, double target) const {
    Counts cells;
    for (const AxisPlan& plan : plans_)
      cells.push_back(plan.by_user ? plan.cells : errors.cells_for(plan, target));
    return cells;
  }

  double budget_target(AxisErrors& errors, const Counts& least) const {
    double fits = 1e-9, fails = 0;
    for (const AxisPlan& plan : plans_)
      fits = std::max(fits, errors.largest(plan, plan.cells));
    for (double next = fits; next > 1e-9; next /= 2) {
      const Counts cells = cells_at(errors, next);
      if (cells != least && !within_budget(cells)) {
        fails = next;
        break;
      }
      fits = next;
    }
    for (int step = 0; step < 6 && fails > 0; ++step) {
      const double middle = std::sqrt(fits * fails);
      (within_budget(cells_at(errors, middle)) ? fits : fails) = middle;
    }
    return fits;
  }

  // Adds one cell to the axis where it helps most; false where none fits or helps.
  bool add_cell() {
    const double before = best_.drift;
    Trial next;
    for (std::size_t a = 0; a < plans_.size(); ++a) {
      Counts cells = best_.cells;
      ++cells[a];
      if (plans_[a].by_user || !within_budget(cells)) continue;
      Trial trial = attempt(cells, before);
      if (trial.drift < before && (next.cells.empty() || trial.drift < next.drift))
        next = std::move(trial);
    }
    if (next.cells.empty()) return false;
    best_ = std::move(next);
    return true;
  }

  const models::AssembledLaw& law_;
  const std::vector<StateRange>& ranges_;
  const TableOptions& options_;
  const Progress progress_; // counts the grids tried; their number is not known beforehand
  const double tolerance_;
  double limit_; // below the tolerance: the search may miss the very worst state
  Pieces pieces_;
  LawFunction tau_R_;
  std::vector<AxisPlan> plans_;
  bool log_value_ = false;
  Interpolation interpolation_ = Interpolation::linear;
  Probe box_;   // the same states for every trial
  Probe peaks_; // worst states of all trials
  Trial best_;
  std::string trail_;
};

} // namespace

Table build_table(const models::AssembledLaw& law, const std::vector<StateRange>& ranges,
                  const TableOptions& options) {
  return Builder(law, ranges, options).build();
}

Table table_on_nodes(const models::AssembledLaw& law, const std::vector<StateRange>& ranges,
                     const TableOptions& options, const Table& grid) {
  const Pieces pieces(law, ranges);
  std::vector<TableAxis> least, axes;
  for (const AxisPlan& plan : plan_axes(law, ranges, options)) {
    least.push_back(axis_with(plan, plan.cells));
    axes.push_back(least.back());
    const auto own = std::ranges::find(grid.axes, plan.axis.name, &TableAxis::name);
    if (own == grid.axes.end()) continue;
    axes.back().nodes = own->nodes;
    axes.back().nodes.front() = plan.fixed.front();
    axes.back().nodes.back() = plan.fixed.back();
  }
  check_memory(axes, options);
  const bool log_value = has_log_value(law, pieces, ranges, least, options);
  Table table = sampled_table(law, pieces, ranges, std::move(axes),
                              options.interpolation.value_or(grid.interpolation), log_value);
  set_aim(table.record, options);
  table.record.refinement = grid.record.refinement;
  return table;
}

} // namespace frictab::table
