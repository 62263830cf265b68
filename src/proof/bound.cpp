// Branch and bound over the cells of a table.
#include "proof/bound.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include <fmt/format.h>

#include "core/names.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "core/text.h"
#include "expr/coordinates.h"
#include "expr/sensitivity.h"
#include "proof/cell_polynomial.h"
#include "proof/taylor_model.h"
#include "table/drift.h"
#include "table/grid.h"

namespace frictab::proof {

using table::Probe;
using table::StateRange;
using table::Table;
using table::TableAxis;
using table::WorstCase;

using expr::Bounds;
using expr::Expr;

namespace {

constexpr std::size_t degree_linear = 4, degree_cubic = 5;

Expr combine_of(const Table& table) {
  std::map<std::string, Expr> constants;
  for (const auto& [name, value] : table.constants)
    constants.emplace(name, value);
  return substitute(table.combine, constants);
}

// Returns the law's piece as the table stores it, in the coordinates of its axes.
Expr piece_of(const models::AssembledLaw& law, const Table& table) {
  std::set<std::string> logarithmic;
  for (const TableAxis& axis : table.axes)
    if (axis.log) logarithmic.insert(axis.name);
  const Expr value = in_coordinates(law.in_numbers(law.piece), logarithmic);
  return table.log_value ? log_in_coordinates(value) : value;
}

struct Box {
  std::vector<CellPart> parts; // per axis
  std::vector<Bounds> state;   // per range; for an axis it follows from its part
  std::vector<double> law;     // coefficients of the polynomial over the parts
  double error = HUGE_VAL;     // error bound of the polynomial
  bool fresh = false;          // polynomial and error were computed for exactly this box
};

// The bound of one box, and the range by which to split it.
struct BoxBound {
  double bound = HUGE_VAL;
  double drift = 0;          // at the centre of the box
  std::vector<double> state; // the centre
  std::size_t split = 0;     // the range to halve
};

class CellBounder {
public:
  CellBounder(const models::AssembledLaw& law, const Table& table,
              const std::vector<StateRange>& ranges)
      : ranges_(ranges), table_(table), function_(table), law_(law, all_names(ranges)),
        monomials_(table.axes.size(), table.interpolation == table::Interpolation::cubic
                                          ? degree_cubic
                                          : degree_linear),
        piece_(piece_of(law, table), all_names(table.axes), monomials_), interpolant_(table),
        rewriting_(monomials_), deviation_(monomials_, interpolant_.support()),
        combine_(
            substitute(combine_of(table), {{"value", table.log_value ? exp(Expr::symbol("value"))
                                                                     : Expr::symbol("value")}}),
            table::with_value(ranges), "value") {
    for (const TableAxis& axis : table.axes) {
      coordinates_.push_back(axis.coordinates());
      const auto range = std::ranges::find(ranges, axis.name, &StateRange::name);
      range_of_axis_.push_back(static_cast<std::size_t>(range - ranges.begin()));
    }
  }

  struct Result {
    double bound = 0;
    double drift = 0;
    std::vector<double> state;
    std::size_t boxes = 0;
    bool out_of_boxes = false;
  };

  // Memory of one thread.
  struct Workspace {
    explicit Workspace(const CellBounder& cells) : taylor(cells.piece_) {}
    TaylorProgram::Work taylor;
    std::vector<double> tensor;
  };

  std::size_t count() const {
    std::size_t cells = 1;
    for (const TableAxis& axis : table_.axes)
      cells *= axis.nodes.size() - 1;
    return cells;
  }

  struct QueueEntry {
    Box box;
    BoxBound look;
  };

  // Splits the cell until every box is below the goal, or below the largest drift found in the
  // cell.
  Result run(std::size_t cell, double goal, std::size_t most, Workspace& work) const {
    Result result;
    std::vector<QueueEntry> open; // a heap: the largest bound first
    const auto smaller = [](const QueueEntry& a, const QueueEntry& b) {
      return a.look.bound < b.look.bound;
    };
    const auto add = [&](Box box) {
      ++result.boxes;
      BoxBound look = bound_box(box, goal, work);
      if (look.drift > result.drift) {
        result.drift = look.drift;
        result.state = look.state;
      }
      open.push_back({std::move(box), std::move(look)});
      std::push_heap(open.begin(), open.end(), smaller);
    };
    add(root_box(cell));
    while (true) {
      const QueueEntry& first = open.front();
      const double enough = std::max(goal, 1.005 * result.drift);
      if (first.look.bound <= enough || !can_split(first.box, first.look)) break;
      result.out_of_boxes = result.boxes + 2 > most;
      if (result.out_of_boxes) break;
      std::pop_heap(open.begin(), open.end(), smaller);
      const QueueEntry one = std::move(open.back());
      open.pop_back();
      add(child_box(one.box, one.look, false));
      add(child_box(one.box, one.look, true));
    }
    result.bound = open.front().look.bound;
    return result;
  }

private:
  std::size_t axis_of(std::size_t range) const {
    const auto found = std::ranges::find(range_of_axis_, range);
    return static_cast<std::size_t>(found - range_of_axis_.begin());
  }

  Bounds coordinate(std::size_t axis, const CellPart& part) const {
    const std::vector<double>& u = coordinates_[axis];
    const double width = u[part.cell + 1] - u[part.cell];
    return {u[part.cell] + part.low * width,
            part.high == 1 ? u[part.cell + 1] : u[part.cell] + part.high * width};
  }

  void set_part(Box& box, std::size_t axis, const CellPart& part) const {
    box.parts[axis] = part;
    const Bounds u = coordinate(axis, part);
    box.state[range_of_axis_[axis]] =
        table_.axes[axis].log ? expr::apply(expr::Op::exp, u, {}, {}, {}) : u;
  }

  Box root_box(std::size_t cell) const {
    Box box;
    box.parts.resize(table_.axes.size());
    for (const StateRange& range : ranges_)
      box.state.push_back({range.low, range.high});
    for (std::size_t a = table_.axes.size(); a-- > 0;) {
      const std::size_t cells = table_.axes[a].nodes.size() - 1;
      set_part(box, a, {cell % cells, 0, 1});
      cell /= cells;
    }
    box.law.resize(monomials_.size());
    return box;
  }

  void enclose(Box& box, Workspace& work) const {
    std::vector<Bounds> u;
    for (std::size_t a = 0; a < box.parts.size(); ++a)
      u.push_back(coordinate(a, box.parts[a]));
    box.error = piece_(u, work.taylor, box.law);
    box.fresh = true;
  }

  std::vector<double> middle(const Box& box) const {
    std::vector<double> state;
    for (const Bounds& x : box.state)
      state.push_back(0.5 * (x.low + x.high));
    for (std::size_t a = 0; a < box.parts.size(); ++a) {
      const Bounds u = coordinate(a, box.parts[a]);
      const double at = 0.5 * (u.low + u.high);
      state[range_of_axis_[a]] = table_.axes[a].log ? std::exp(at) : at;
    }
    return state;
  }

  BoxBound bound_box(Box& box, double goal, Workspace& work) const;
  double reach(const Box& box, const Bounds& value) const;
  std::vector<double> shares(const Box& box) const;
  void choose_split(BoxBound& look, const Box& box, const Bounds& value, double most, double slope,
                    const Deviation::Result& bounds) const;
  bool can_split(const Box& box, const BoxBound& look) const;
  Box child_box(const Box& box, const BoxBound& look, bool upper) const;

  const std::vector<StateRange>& ranges_;
  const Table& table_;
  const table::TableFunction function_;
  const table::LawFunction law_;
  const Monomials monomials_;
  const TaylorProgram piece_;
  const CellPolynomials interpolant_;
  const Rewriting rewriting_;
  const Deviation deviation_;
  const expr::Sensitivity combine_;              // derivative of tau_R by the tabulated number
  std::vector<std::vector<double>> coordinates_; // of the nodes, per axis
  std::vector<std::size_t> range_of_axis_;
};

// Bounds |d tau_R / d value| over the box.
double CellBounder::reach(const Box& box, const Bounds& value) const {
  std::vector<Bounds> columns{value};
  columns.insert(columns.end(), box.state.begin(), box.state.end());
  return combine_(columns).slope.magnitude();
}

BoxBound CellBounder::bound_box(Box& box, double goal, Workspace& work) const {
  BoxBound look;
  look.state = middle(box);
  look.drift = std::abs(law_(look.state) - function_(look.state));
  for (int pass = 0; pass < 2; ++pass) {
    if (!std::isfinite(box.error) && !box.fresh) enclose(box, work);
    std::vector<double> law = box.law;
    rewriting_.to_chebyshev(law);
    interpolant_.over(box.parts, work.tensor);
    const Deviation::Result bounds = deviation_(law, work.tensor);
    double spread = box.error;
    for (std::size_t i = 1; i < law.size(); ++i)
      spread += std::abs(law[i]);
    const Bounds error = bounds.range + Bounds{-box.error, box.error};
    const Bounds truth{law[0] - spread, law[0] + spread};
    const Bounds value = hull(truth, truth - error);
    const double slope = reach(box, value), most = error.magnitude();
    const double bound = most == 0 ? 0 : slope * most;
    if (!box.fresh && box.error * slope > 0.2 * (bound - goal) && bound > goal) {
      box.error = HUGE_VAL; // the polynomial of a larger box is too rough here
      continue;
    }
    look.bound = std::isnan(bound) ? HUGE_VAL : bound;
    choose_split(look, box, value, most, slope, bounds);
    break;
  }
  return look;
}

// Returns each axis' share in the polynomial's error, by its terms and by its width (a branch
// of the formula can hide the terms).
std::vector<double> CellBounder::shares(const Box& box) const {
  std::vector<double> terms(box.parts.size(), 0.0), share;
  double all_terms = 1e-300, width = 1e-300;
  for (std::size_t a = 0; a < box.parts.size(); ++a) {
    for (std::size_t i = 1; i < monomials_.size(); ++i)
      terms[a] += monomials_.exponents(i)[a] * std::abs(box.law[i]);
    all_terms += terms[a];
    width += box.parts[a].high - box.parts[a].low;
  }
  for (std::size_t a = 0; a < box.parts.size(); ++a)
    share.push_back(0.5 * terms[a] / all_terms +
                    1.5 * (box.parts[a].high - box.parts[a].low) / width);
  return share;
}

// Chooses the range whose halves promise the smallest bound.
void CellBounder::choose_split(BoxBound& look, const Box& box, const Bounds& value, double most,
                               double slope, const Deviation::Result& bounds) const {
  double best = -1;
  const std::vector<double> share = shares(box);
  for (std::size_t r = 0; r < ranges_.size(); ++r) {
    const std::size_t a = axis_of(r);
    double gain = 0;
    if (std::isfinite(slope) && std::isfinite(most)) {
      Box part = box;
      const Bounds x = box.state[r];
      const double cut = a < box.parts.size() ? look.state[r] : 0.5 * (x.low + x.high);
      part.state[r] = {x.low, cut};
      const double lower = reach(part, value);
      part.state[r] = {cut, x.high};
      const double upper = reach(part, value);
      // A half that needs no further work counts too, but less for a box that is already thin:
      // otherwise the search would split at a kink for ever.
      const double rest = a < box.parts.size()
                              ? box.parts[a].high - box.parts[a].low
                              : x.width() / (ranges_[r].high - ranges_[r].low + 1e-300);
      gain = most * (slope - std::max(lower, upper) +
                     rest * (std::max(lower, upper) - std::min(lower, upper)));
    }
    if (a < box.parts.size()) {
      const double rough = std::isfinite(box.error) ? box.error : 1.0;
      gain += (std::isfinite(slope) ? slope : 1.0) * (bounds.mixed[a] + rough * share[a]);
    }
    if (gain > best) {
      best = gain;
      look.split = r;
    }
  }
}

bool CellBounder::can_split(const Box& box, const BoxBound& look) const {
  const std::size_t a = axis_of(look.split);
  if (a < box.parts.size()) return box.parts[a].high - box.parts[a].low > 1e-6;
  const Bounds x = box.state[look.split];
  return x.width() > 1e-6 * (1e-9 + x.magnitude());
}

Box CellBounder::child_box(const Box& box, const BoxBound& look, bool upper) const {
  Box out = box;
  const std::size_t a = axis_of(look.split);
  if (a == box.parts.size()) {
    Bounds& x = out.state[look.split];
    (upper ? x.low : x.high) = 0.5 * (x.low + x.high);
    return out;
  }
  CellPart part = box.parts[a];
  (upper ? part.low : part.high) = 0.5 * (part.low + part.high);
  set_part(out, a, part);
  rewriting_.halve(a, upper, out.law);
  out.fresh = false;
  return out;
}

// Returns the reason why there cannot be a bound; empty if there can.
std::string obstacle(const models::AssembledLaw& law, const Table& table,
                     const BoundOptions& options) {
  const Expr of_law = law.in_numbers(law.combine);
  if (expr::to_text(shared(of_law)) != expr::to_text(shared(combine_of(table))))
    return "the table is combined to tau_R by a formula that is not the law's";
  const std::vector<std::string> axes = all_names(table.axes);
  for (const std::string& name : law.piece_inputs)
    if (std::ranges::find(axes, name) == axes.end())
      return "the law's piece depends on " + name + ", which is not an axis of the table";
  double cells = 1, nodes = 1;
  for (const TableAxis& axis : table.axes)
    nodes *= static_cast<double>(axis.nodes.size());
  if (static_cast<double>(table.value.size()) != nodes)
    return "the table's values are not in memory";
  for (const TableAxis& axis : table.axes)
    cells *= static_cast<double>(axis.nodes.size() - 1);
  if (cells > static_cast<double>(options.most_boxes))
    return fmt::format("the table has more cells than verify.proof_boxes = {}",
                       thousands(options.most_boxes));
  return "";
}

void run_cells(const CellBounder& cells, const std::vector<std::size_t>& chosen, double goal,
               std::size_t most, const Progress& progress,
               std::vector<CellBounder::Result>& results) {
  constexpr std::size_t per_task = 16;
  parallel_for((chosen.size() + per_task - 1) / per_task, [&](std::size_t task) {
    CellBounder::Workspace work(cells);
    for (std::size_t c = task * per_task; c < std::min(chosen.size(), (task + 1) * per_task); ++c) {
      results[chosen[c]] = cells.run(chosen[c], goal, most, work);
      progress.tick();
    }
  });
}

// Bounds every cell. Most cells need few boxes; the boxes they leave go to the other cells, which
// start again.
std::vector<CellBounder::Result> bounds_of(const CellBounder& cells, const BoundOptions& options,
                                           const std::string& model) {
  const std::size_t most_per_cell = std::max<std::size_t>(20, options.most_boxes / 500);
  std::vector<CellBounder::Result> results(cells.count());
  std::vector<std::size_t> chosen(results.size());
  std::iota(chosen.begin(), chosen.end(), 0);
  const std::size_t share =
      std::clamp<std::size_t>(options.most_boxes / 2 / results.size(), 1, most_per_cell);
  const Progress progress("proving the table of " + model, results.size());
  run_cells(cells, chosen, options.goal_MPa, share, progress, results);
  std::size_t used = 0;
  for (const CellBounder::Result& one : results)
    used += one.boxes;
  std::erase_if(chosen, [&](std::size_t c) { return !results[c].out_of_boxes; });
  if (chosen.empty() || used >= options.most_boxes) return results;
  const std::size_t larger = std::min((options.most_boxes - used) / chosen.size(), most_per_cell);
  if (larger > share)
    run_cells(cells, chosen, options.goal_MPa, larger,
              Progress("proving what is left of " + model, chosen.size()), results);
  return results;
}

} // namespace

DriftBound bound_drift(const models::AssembledLaw& law, const Table& table,
                       const std::vector<StateRange>& ranges, const BoundOptions& options) {
  DriftBound out;
  out.why_not = obstacle(law, table, options);
  if (!out.why_not.empty()) return out;
  const CellBounder cells(law, table, ranges);
  double bound = 0;
  for (const CellBounder::Result& one : bounds_of(cells, options, table.model)) {
    bound = std::max(bound, one.bound);
    out.boxes += one.boxes;
    out.out_of_boxes = out.out_of_boxes || one.out_of_boxes;
    if (one.drift > out.found_MPa) {
      out.found_MPa = one.drift;
      out.state = one.state;
    }
  }
  if (std::isfinite(bound))
    out.MPa = std::max(bound, out.found_MPa);
  else
    out.why_not = "the law's formula has no bounded derivatives somewhere in the range";
  return out;
}

namespace {

// Estimates the rounding of kernel and law, which the bound leaves out, as 2^-40 of the largest
// stress. No bound is shown below that.
double rounding_of(const models::AssembledLaw& law, const std::vector<StateRange>& ranges) {
  const Probe box =
      table::with_law(table::LawFunction(law, all_names(ranges)), table::box_points(ranges, 256));
  double largest = 0;
  for (const double tau : box.law)
    if (std::isfinite(tau)) largest = std::max(largest, std::abs(tau));
  return 0x1p-40 * largest;
}

} // namespace

ProvenDrift prove_drift(const models::AssembledLaw& law, const Table& table,
                        const std::vector<StateRange>& ranges, WorstCase found, double allowed_MPa,
                        std::size_t most_boxes) {
  // A bound within 2 % of the drift found is enough where that settles whether the drift is
  // allowed; elsewhere 10 % is.
  const double goal = std::max(
      1e-3 * allowed_MPa, std::clamp(allowed_MPa, 1.02 * found.drift_MPa, 1.1 * found.drift_MPa));
  ProvenDrift out{std::move(found), bound_drift(law, table, ranges, {goal, most_boxes})};
  if (out.bound.found_MPa > out.worst.drift_MPa) {
    const table::TableFunction function(table);
    table::States start;
    for (const double x : out.bound.state)
      start.push_back({x});
    const WorstCase more =
        table::worst_case(table::LawFunction(law, function.inputs()), function, ranges, start);
    if (more.drift_MPa > out.worst.drift_MPa) {
      out.worst.drift_MPa = more.drift_MPa;
      out.worst.state = more.state;
    }
    out.worst.points += more.points;
  }
  if (out.bound.MPa)
    out.bound.MPa = std::max({*out.bound.MPa, out.worst.drift_MPa, rounding_of(law, ranges)});
  return out;
}

} // namespace frictab::proof
