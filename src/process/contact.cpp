// Reads contact states and the tool, and derives speeds, paths, expansions and flow stresses.
#include "process/contact.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include <fmt/format.h>

#include "core/text.h"
#include "data/derived.h"
#include "data/load.h"
#include "process/quantities.h"

namespace frictab::process {

using data::Column;
using data::Dataset;

namespace {

using Rows = std::vector<std::size_t>;

// ---- reading ----

data::ReadRequest request_of(const ProcessOptions& options,
                             const std::map<std::string, data::ColumnSource>& columns,
                             std::span<const data::Quantity> quantities) {
  data::ReadRequest request;
  request.base = options.base;
  request.place = options.place;
  request.quantities = quantities;
  request.columns = columns;
  return request;
}

std::string files_text(const std::vector<std::string>& files) {
  return files.size() == 1 ? files.front() : fmt::format("{} files", files.size());
}

Dataset read_states(const ProcessOptions& options) {
  data::ReadRequest request = request_of(options, options.columns, contact_quantities());
  data::ColumnSource facet;
  facet.names = {facet_column, "node", "element"};
  facet.place = options.place;
  if (const auto own = request.columns.extract(facet_column)) facet = own.mapped();
  request.columns["experiment"] = std::move(facet);
  request.experiment = std::string(data::file_and_column) + facet_column;
  for (const auto& [state, value] : options.constants)
    request.constants[state] = value;
  request.bystanders.emplace(); // other columns of a solver's file are none of these laws
  return data::load_rows(options.contact, request);
}

// The facets' rows. A facet that goes on in another file, at other times, is the same one; at the
// same times it is one of another surface.
std::vector<Rows> rows_of_facets(const Dataset& data) {
  const std::span<const double> time = data.values("time_s");
  std::map<std::string, Rows> at; // index of the facet's lists, by its own name
  std::vector<Rows> facets;
  std::vector<std::set<double>> times;
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    const std::string own = data.experiments[e].substr(data.filed[e].file.size() + 1);
    const auto own_time =
        time.subspan(data.first_row[e], data.first_row[e + 1] - data.first_row[e]);
    Rows& known = at[own];
    const auto goes_on = std::ranges::find_if(known, [&](std::size_t facet) {
      return std::ranges::none_of(own_time, [&](double t) { return times[facet].count(t) > 0; });
    });
    const std::size_t facet = goes_on == known.end() ? facets.size() : *goes_on;
    if (goes_on == known.end()) {
      known.push_back(facet);
      facets.emplace_back();
      times.emplace_back();
    }
    for (std::size_t row = data.first_row[e]; row < data.first_row[e + 1]; ++row)
      facets[facet].push_back(row);
    times[facet].insert(own_time.begin(), own_time.end());
  }
  return facets;
}

void check_needed(const Dataset& data) {
  FaultList faults;
  for (const char* name : {"time_s", "area_mm2", "sigma_n_MPa"})
    if (!data.has(name))
      faults.add(
          place_of(data), fmt::format("there is no column {}", name),
          fmt::format(
              "map it: [process.columns] {} = \"...\"; `frictab explain process` has all columns",
              name));
  if (!data.has("v_rel_mm_s") && !data.has("slip_1_mm"))
    faults.add(place_of(data), "there is neither a column v_rel_mm_s nor slip_1_mm",
               "the slip speed, or the slip so far along the surface's tangents");
  faults.throw_if_any();
}

// Rows with pressure and area, in time order.
std::vector<Rows> touching(const Dataset& data, std::vector<Rows> facets,
                           std::vector<std::string>& notes) {
  const auto pressure = data.values("sigma_n_MPa"), area = data.values("area_mm2"),
             time = data.values("time_s");
  std::size_t open = 0, negative = 0;
  std::string twice;
  for (Rows& rows : facets) {
    std::erase_if(rows, [&](std::size_t row) {
      const bool is_open = !(pressure[row] > 0 && area[row] > 0);
      open += is_open;
      negative += pressure[row] < 0;
      return is_open;
    });
    std::ranges::sort(rows, [&](std::size_t a, std::size_t b) {
      return std::pair(time[a], a) < std::pair(time[b], b);
    });
    for (std::size_t i = 1; i < rows.size(); ++i)
      if (time[rows[i]] == time[rows[i - 1]] && twice.empty())
        twice = fmt::format("a facet stands twice at time_s = {}", time[rows[i]]);
  }
  std::erase_if(facets, [](const Rows& rows) { return rows.empty(); });
  if (!twice.empty())
    throw InputError(place_of(data), twice,
                     "one row per facet and increment; facets of several surfaces or contact pairs "
                     "need names of their own, or a file each");
  if (facets.empty())
    throw InputError(place_of(data), "no row has a pressure and an area",
                     negative > 0 ? "sigma_n_MPa is negative: compression is positive here: "
                                    "[process.columns] sigma_n_MPa = { formula = \"-NAME\" }"
                                  : "rows of facets that touch are wanted");
  if (open > 0)
    notes.push_back(fmt::format("{} of {} rows without pressure or area are left out",
                                thousands(open), thousands(data.rows())));
  return facets;
}

// ---- the tool ----

double interpolated(std::span<const double> x, std::span<const double> y, double at) {
  const auto after = static_cast<std::size_t>(std::ranges::upper_bound(x, at) - x.begin());
  if (after == 0) return y.front();
  if (after == x.size()) return y.back();
  const double share = (at - x[after - 1]) / (x[after] - x[after - 1]);
  return y[after - 1] + share * (y[after] - y[after - 1]);
}

void check_tool(const Dataset& tool, const ContactHistory& h, const std::string& named) {
  FaultList faults;
  for (const char* name : {"time_s", "force_kN", "speed_mm_s"})
    if (!tool.has(name))
      faults.add({named, 0, 0}, fmt::format("there is no column {}", name),
                 fmt::format("map it: [process.tool_columns] {} = \"...\"", name));
  faults.throw_if_any();
  const auto time = tool.values("time_s");
  if (!std::ranges::is_sorted(time, std::less_equal<>()))
    throw InputError({named, 0, 0}, "time_s does not increase from row to row",
                     "one row per increment, one step after the other on one clock");
  const double slack = 1e-6 * (time.back() - time.front());
  if (h.time_s.front() < time.front() - slack || h.time_s.back() > time.back() + slack)
    throw InputError({named, 0, 0},
                     fmt::format("the tool is known from {} to {} s, contacts are from {} to {} s",
                                 time.front(), time.back(), h.time_s.front(), h.time_s.back()),
                     "both files on the same clock, in seconds");
}

void read_tool(ContactHistory& h, const ProcessOptions& options) {
  const Dataset file =
      data::load_rows(options.tool, request_of(options, options.tool_columns, tool_quantities()));
  const std::string named = files_text(options.tool);
  check_tool(file, h, named);
  const auto time = file.values("time_s");
  const auto at_increments = [&](const char* name) {
    std::vector<double> out;
    for (const double t : h.time_s)
      out.push_back(interpolated(time, file.values(name), t));
    return out;
  };
  Tool tool;
  tool.force_kN = at_increments("force_kN");
  tool.speed_mm_s = at_increments("speed_mm_s");
  if (file.has("stroke_mm")) tool.stroke_mm = at_increments("stroke_mm");
  // A force or speed against the axis has a sign; the work of the tool decides.
  for (std::size_t i = 0; i < tool.force_kN.size(); ++i) {
    tool.force_kN[i] = std::abs(tool.force_kN[i]);
    tool.speed_mm_s[i] = std::abs(tool.speed_mm_s[i]);
  }
  if (std::ranges::all_of(tool.force_kN, [](double f) { return f == 0; }) ||
      std::ranges::all_of(tool.speed_mm_s, [](double v) { return v == 0; }))
    throw InputError({named, 0, 0}, "the tool has no force or no speed at any increment",
                     "force and speed of the tool that the process is driven by");
  if (file.has("friction_J"))
    tool.friction_J = interpolated(time, file.values("friction_J"), h.time_s.back()) -
                      file.values("friction_J").front();
  for (const std::string& note : file.notes)
    h.notes.push_back(named + ": " + note);
  h.tool = std::move(tool);
  h.start_s = std::min(time.front(), h.time_s.front());
}

// ---- the history ----

class Reader {
public:
  Reader(const ProcessOptions& options, Dataset file) : options_(options), file_(std::move(file)) {}

  ContactHistory history() {
    check_needed(file_);
    notes_ = file_.notes;
    facets_ = touching(file_, rows_of_facets(file_), notes_);
    gather();
    set_increments();
    if (!options_.tool.empty()) read_tool(h_, options_);
    for (const std::size_t i : h_.increment)
      h_.dt_s.push_back(h_.step(i));
    take_speed();
    take_path();
    take_expansion();
    take_flow_stress();
    take_shear_stress();
    take_place();
    h_.facets = h_.states.experiments.size();
    h_.notes.insert(h_.notes.begin(), notes_.begin(), notes_.end());
    return std::move(h_);
  }

private:
  std::vector<double> taken(const char* name) const {
    const auto all = file_.values(name);
    std::vector<double> out;
    for (const std::size_t row : order_)
      out.push_back(all[row]);
    return out;
  }

  bool has(const char* name) const { return file_.has(name); }

  void add(const char* name, std::vector<double> values) {
    h_.states.columns.push_back(
        {name, data::find_quantity(name)->unit, std::move(values), {}, data::Role::state});
  }

  void gather() {
    for (const Rows& rows : facets_) {
      order_.insert(order_.end(), rows.begin(), rows.end());
      h_.states.first_row.push_back(order_.size());
      h_.states.experiments.push_back(std::to_string(h_.states.first_row.size() - 1));
    }
    h_.states.sources = file_.sources;
    add("time_s", taken("time_s"));
    add("sigma_n_MPa", taken("sigma_n_MPa"));
    if (has("T_contact_C")) add("T_contact_C", taken("T_contact_C"));
    h_.area_mm2 = taken("area_mm2");
    for (double& area : h_.area_mm2)
      area *= options_.symmetry;
  }

  // Times that differ by less than a hundred-thousandth of the last one are those of one increment.
  void set_increments() {
    const auto time = h_.states.values("time_s");
    std::vector<double> sorted(time.begin(), time.end());
    std::ranges::sort(sorted);
    const double same = 1e-5 * (sorted.back() - std::min(sorted.front(), 0.0));
    for (const double t : sorted)
      if (h_.time_s.empty() || t > h_.time_s.back() + same) h_.time_s.push_back(t);
    for (const double t : time) {
      const auto after = std::ranges::upper_bound(h_.time_s, t);
      h_.increment.push_back(static_cast<std::size_t>(after - h_.time_s.begin()) - 1);
    }
    // Without a tool: as long before the first increment as that before the second, but not before
    // 0.
    const double first = h_.time_s.front();
    h_.start_s = h_.time_s.size() > 1 ? first - (h_.time_s[1] - first) : 0;
    if (first >= 0) h_.start_s = std::max(h_.start_s, 0.0);
  }

  void take_speed() {
    std::vector<double> speed;
    if (has("v_rel_mm_s")) {
      speed = taken("v_rel_mm_s");
      for (double& v : speed)
        v = std::abs(v);
    } else {
      const std::vector<double> one = taken("slip_1_mm"),
                                two = has("slip_2_mm") ? taken("slip_2_mm")
                                                       : std::vector<double>(order_.size());
      const auto time = h_.states.values("time_s");
      speed.resize(order_.size());
      for_each_row([&](std::size_t row, bool first) {
        const double u = one[row] - (first ? 0 : one[row - 1]),
                     w = two[row] - (first ? 0 : two[row - 1]);
        const double dt = first ? step(row) : time[row] - time[row - 1];
        speed[row] = dt > 0 ? std::hypot(u, w) / dt : 0;
      });
      notes_.emplace_back("v_rel_mm_s from the slips of each facet, as a vector");
    }
    add("v_rel_mm_s", std::move(speed));
  }

  template <class Do> void for_each_row(const Do& act) const {
    for (std::size_t f = 0; f + 1 < h_.states.first_row.size(); ++f)
      for (std::size_t row = h_.states.first_row[f]; row < h_.states.first_row[f + 1]; ++row)
        act(row, row == h_.states.first_row[f]);
  }

  // Time since the increment before that of a row.
  double step(std::size_t row) const { return h_.step(h_.increment[row]); }

  void take_path() {
    if (has("s_mm")) {
      add("s_mm", taken("s_mm"));
      return;
    }
    const auto speed = h_.states.values("v_rel_mm_s");
    std::vector<double> path(order_.size());
    for_each_row([&](std::size_t row, bool first) {
      path[row] = (first ? 0 : path[row - 1]) + speed[row] * step(row);
    });
    add("s_mm", std::move(path));
    notes_.emplace_back("s_mm is the way that each facet has slid since its first row");
  }

  void take_expansion() {
    std::vector<double> psi;
    if (has("psi")) {
      psi = taken("psi");
    } else if (has("area_start_mm2")) {
      psi = taken("area_mm2");
      const std::vector<double> start = taken("area_start_mm2");
      for (std::size_t i = 0; i < psi.size(); ++i)
        psi[i] = start[i] > 0 ? psi[i] / start[i] : 1;
      notes_.emplace_back("psi is area_mm2/area_start_mm2");
    } else {
      return;
    }
    std::size_t below = 0;
    double least = 1;
    for (double& value : psi) {
      least = std::min(least, value);
      below += value < 1;
      value = std::max(value, 1.0);
    }
    if (below > 0)
      notes_.push_back(
          fmt::format("psi is below 1 in {} of {} rows (least {:.3g}): the laws take it as 1",
                      thousands(below), thousands(psi.size()), least));
    add("psi", std::move(psi));
  }

  void take_flow_stress() {
    if (has("sigma_f_MPa")) {
      add("sigma_f_MPa", taken("sigma_f_MPa"));
      return;
    }
    if (options_.flow_curve.empty()) {
      if (has("plastic_strain"))
        notes_.emplace_back("plastic_strain is not used: process.flow_curve, or a formula of "
                            "sigma_f_MPa, makes a flow stress of it");
      return;
    }
    if (!has("plastic_strain"))
      throw InputError(place_of(file_), "there is no column plastic_strain for process.flow_curve",
                       "map it: [process.columns] plastic_strain = \"PEEQ\"");
    add("sigma_f_MPa", on_curve(taken("plastic_strain")));
  }

  std::vector<double> on_curve(std::vector<double> strain) {
    const Dataset curve =
        data::load_rows({options_.flow_curve}, request_of(options_, {}, curve_quantities()));
    for (const char* name : {"plastic_strain", "sigma_f_MPa"})
      if (!curve.has(name))
        throw InputError({options_.flow_curve, 0, 0}, fmt::format("there is no column {}", name),
                         "a flow curve has the columns plastic_strain and sigma_f_MPa");
    const auto x = curve.values("plastic_strain"), y = curve.values("sigma_f_MPa");
    if (!std::ranges::is_sorted(x, std::less_equal<>()))
      throw InputError({options_.flow_curve, 0, 0}, "plastic_strain does not increase",
                       "one row per strain, in ascending order");
    std::size_t beyond = 0;
    for (double& e : strain) {
      beyond += e > x.back();
      e = interpolated(x, y, e);
    }
    notes_.push_back("sigma_f_MPa from " + options_.flow_curve +
                     (beyond == 0 ? ""
                                  : fmt::format(", held at its end in {} of {} rows",
                                                thousands(beyond), thousands(strain.size()))));
    return strain;
  }

  void take_shear_stress() {
    if (has("tau_R_MPa")) {
      h_.tau_MPa = taken("tau_R_MPa");
      for (double& tau : h_.tau_MPa)
        tau = std::abs(tau);
    } else if (has("tau_1_MPa")) {
      h_.tau_MPa = taken("tau_1_MPa");
      const std::vector<double> two =
          has("tau_2_MPa") ? taken("tau_2_MPa") : std::vector<double>(order_.size());
      for (std::size_t i = 0; i < two.size(); ++i)
        h_.tau_MPa[i] = std::hypot(h_.tau_MPa[i], two[i]);
    }
  }

  void take_place() {
    double most = 0;
    for (const char* name : {"r_mm", "x_mm", "y_mm", "z_mm"}) {
      if (!has(name)) continue;
      std::vector<double> place = taken(name);
      const auto [low, high] = std::ranges::minmax_element(place);
      if (!(*high - *low > most)) continue;
      most = *high - *low;
      h_.place_name = std::string(1, *name);
      h_.place_mm = std::move(place);
    }
  }

  const ProcessOptions& options_;
  Dataset file_;
  std::vector<Rows> facets_; // rows of the file
  Rows order_;               // the file's row of each row here
  ContactHistory h_;
  std::vector<std::string> notes_;
};

// ---- states that the files lack ----

// Quantiles of the finite values of a column of the tests.
std::vector<double> quantiles_of(std::span<const double> column, std::vector<double> shares) {
  std::vector<double> values;
  std::ranges::copy_if(column, std::back_inserter(values),
                       [](double x) { return std::isfinite(x); });
  if (values.empty()) return {};
  std::ranges::sort(values);
  for (double& share : shares)
    share = values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
  return shares;
}

// The level that most rows of the tests have.
double usual_level(std::span<const double> column) {
  std::map<double, std::size_t> rows;
  for (const double level : column)
    ++rows[level];
  return std::ranges::max_element(rows,
                                  [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

} // namespace

Place place_of(const Dataset& data) {
  return {data.sources.empty() ? "" : data.sources.front(), 0, 0};
}

double ContactHistory::step(std::size_t i) const {
  return time_s[i] - (i > 0 ? time_s[i - 1] : start_s);
}

std::vector<double> ContactHistory::per_increment(std::span<const double> values) const {
  std::vector<double> sums(time_s.size());
  for (std::size_t row = 0; row < values.size(); ++row)
    sums[increment[row]] += values[row];
  return sums;
}

std::vector<double> ContactHistory::work_J(std::span<const double> tau) const {
  constexpr double mJ_per_J = 1e3; // MPa mm^2 mm = N mm
  std::vector<double> work(rows());
  const auto v = speed();
  for (std::size_t row = 0; row < work.size(); ++row)
    work[row] = tau[row] * v[row] * area_mm2[row] * dt_s[row] / mJ_per_J;
  return work;
}

std::vector<double> ContactHistory::power_W(std::span<const double> tau) const {
  constexpr double mW_per_W = 1e3;
  std::vector<double> power(rows());
  const auto v = speed();
  for (std::size_t row = 0; row < power.size(); ++row)
    power[row] = tau[row] * v[row] * area_mm2[row] / mW_per_W;
  return per_increment(power);
}

std::vector<std::size_t> ContactHistory::late() const {
  constexpr double standing = 1e-6; // share of the highest speed
  const double half = 0.5 * (time_s.back() + start_s);
  const double fastest = tool ? *std::ranges::max_element(tool->speed_mm_s) : 0;
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < time_s.size(); ++i)
    if (time_s[i] >= half && (!tool || tool->speed_mm_s[i] > standing * fastest))
      found.push_back(i);
  return found;
}

ContactHistory read_contact(const ProcessOptions& options) {
  Reader reader(options, read_states(options));
  return reader.history();
}

void hold_missing(ContactHistory& history, std::span<const std::string> inputs,
                  const std::map<std::string, std::vector<std::string>>& levels,
                  const Dataset& tests) {
  for (const std::string& name : inputs) {
    if (history.states.has(name) || data::find_derived(name)) continue;
    Held held{name, "", 1, "psi of a surface that does not expand"};
    const data::Quantity* quantity = data::find_quantity(name);
    if (quantity) held.unit = quantity->unit;
    const Column* column = tests.find(name);
    if (!column)
      throw InputError(history.place(), "a law needs " + name + ", which is nowhere given",
                       "map it in [process.columns], or leave the law out of models.use");
    const auto level = levels.find(name);
    if (level != levels.end()) {
      held.value = usual_level(column->values);
      held.why = "as in most rows of the tests";
      history.states.columns.push_back({name, "", std::vector<double>(history.rows(), held.value),
                                        column->levels, data::Role::state});
      history.held.push_back(std::move(held));
      continue;
    }
    const std::vector<double> of_tests = quantiles_of(column->values, {0.1, 0.5, 0.9});
    if (of_tests.empty())
      throw InputError(history.place(), name + " has no value in the tests either",
                       "give it in [process.constants]");
    held.low = of_tests[0];
    held.high = of_tests[2];
    if (name != "psi") {
      held.value = of_tests[1];
      held.why = "the median of the tests";
    }
    history.states.columns.push_back(
        {name, held.unit, std::vector<double>(history.rows(), held.value), {}, data::Role::state});
    history.held.push_back(std::move(held));
  }
}

} // namespace frictab::process
