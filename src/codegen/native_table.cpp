// Computes the numbers of a solver's own table from a request.
#include "codegen/native_table.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "codegen/coefficient.h"
#include "codegen/entry_arguments.h"
#include "codegen/read_me.h"
#include "codegen/table_checks.h"
#include "core/columns.h"
#include "core/error.h"
#include "data/quantity.h"
#include "expr/program.h"
#include "io/file_streams.h"
#include "io/number.h"
#include "table/drift.h"
#include "table/outside.h"

namespace frictab::codegen {

using expr::Expr;

namespace {

constexpr double usual_tolerance_MPa = 0.5;
// Share of the tolerance for the grid; the rest allows for errors that the grid's own check misses,
// because it has fewer states than verification.
constexpr double share_of_tolerance = 0.93;
constexpr double least_share = 0.05;

bool is_pressure(const NativeColumn& column) {
  return column.state == "sigma_n_MPa";
}

// Returns the argument of a state that the table may not take, so that solver_inputs does not have
// it.
InputArgument argument_of(const ExportRequest& request, const std::string& name) {
  return argument_named(entry_arguments(request.table, request.units), name);
}

std::optional<std::pair<double, double>> range_of(const table::Table& table,
                                                  const std::string& name) {
  if (const auto known = table.range(name)) return known;
  const data::Quantity* quantity = data::find_quantity(name);
  return quantity && quantity->paper_range ? quantity->paper_range : std::nullopt;
}

// True if the coefficient is m, which needs a flow stress even if the law does not.
bool asks_flow_stress(const ExportRequest& request, const NativeForm& form) {
  return form.factor == NativeFactor::shear_yield && !input_index(request.table, "sigma_f_MPa");
}

double flow_stress_of(const std::string& choice) {
  const std::string number = choice.starts_with("constant:") ? choice.substr(9) : "";
  double value = 0;
  if (!io::read_number(number, '.', value) || !(value > 0))
    throw InputError(input_place("sigma_f_MPa"), "'" + choice + "' is not a flow stress to hold",
                     "constant:480");
  return value;
}

[[noreturn]] void no_value(const std::string& name) {
  throw InputError(input_place(name),
                   "this table has no column for " + name + ", and no value to hold it at is known",
                   fmt::format("{} = \"constant:{}\"", name, name == "sigma_f_MPa" ? 480 : 1));
}

void check_fields(const std::vector<NativeColumn>& columns, const NativeForm& form) {
  std::vector<std::size_t> used;
  for (const NativeColumn& column : columns) {
    if (column.field == 0) continue;
    if (column.field > form.most_fields)
      throw InputError(input_place(column.argument.name),
                       fmt::format("field {}: this table has columns for {} fields", column.field,
                                   form.most_fields),
                       "field:1");
    if (std::find(used.begin(), used.end(), column.field) != used.end())
      throw InputError(input_place(column.argument.name),
                       fmt::format("two states are field {}", column.field));
    used.push_back(column.field);
  }
}

} // namespace

std::vector<NativeColumn> native_columns(const ExportRequest& request, const NativeForm& form) {
  const std::vector<SolverInput> inputs = solver_inputs(request, form.gives);
  std::vector<NativeColumn> columns;
  for (const GivenState& row : form.gives.states) {
    const auto found = std::find_if(inputs.begin(), inputs.end(), [&](const SolverInput& input) {
      return input.source == Source::given && input.given == row.state;
    });
    const bool factor = form.factor == NativeFactor::pressure && row.state == "sigma_n_MPa";
    if (found != inputs.end())
      columns.push_back({found->argument, row.state, 0, row.text});
    else if (factor || form.every_column)
      columns.push_back({argument_of(request, row.state), row.state, 0, row.text});
  }
  std::vector<NativeColumn> fields;
  for (const SolverInput& input : inputs)
    if (input.source == Source::field)
      fields.push_back({input.argument, "", input.field, input.text});
  std::sort(fields.begin(), fields.end(),
            [](const auto& a, const auto& b) { return a.field < b.field; });
  columns.insert(columns.end(), fields.begin(), fields.end());
  check_fields(columns, form);
  return columns;
}

table::FixedStates native_fixed_states(const ExportRequest& request, const NativeForm& form) {
  table::FixedStates held;
  for (const SolverInput& input : solver_inputs(request, form.gives)) {
    if (input.source != Source::constant) continue;
    if (!input.fallback) no_value(input.argument.name);
    held[input.argument.name] = *input.fallback;
  }
  if (!asks_flow_stress(request, form)) return held;
  const auto said = request.inputs.find("sigma_f_MPa");
  if (said == request.inputs.end()) no_value("sigma_f_MPa");
  held["sigma_f_MPa"] = flow_stress_of(said->second);
  return held;
}

namespace {

template <class Number> Number shear_yield(const Number& flow_stress) {
  return flow_stress / std::sqrt(3.0);
}

// tau_R = min(rest, limit), where the limit is one number. Without rest, tau_R is the limit.
struct Limited {
  std::optional<Expr> rest;
  std::optional<double> limit;
};

class LimitSplit {
public:
  LimitSplit(const table::Table& table, const table::FixedStates& held) {
    for (const auto& [name, value] : table.constants)
      known_.emplace(name, value);
    for (const auto& [name, value] : held)
      known_.emplace(name, value);
  }

  Limited split(const Expr& e) const {
    if (const auto number = constant(e)) return {std::nullopt, number};
    const auto& a = e.operands();
    if (e.op() == expr::Op::minimum) {
      const auto first = constant(a[0]), second = constant(a[1]);
      if (!first && !second) return {e, std::nullopt};
      Limited out = split(first ? a[1] : a[0]);
      const double limit = first ? *first : *second;
      out.limit = out.limit ? std::min(*out.limit, limit) : limit;
      return out;
    }
    if (e.op() == expr::Op::maximum || e.op() == expr::Op::multiply) {
      const auto first = constant(a[0]), second = constant(a[1]);
      const std::optional<double> number = first ? first : second;
      if (!number || *number < 0) return {e, std::nullopt};
      const Limited inner = split(first ? a[1] : a[0]);
      if (!inner.limit || !inner.rest || *inner.limit < 0) return {e, std::nullopt};
      if (e.op() == expr::Op::multiply) return {*number * *inner.rest, *number * *inner.limit};
      return {maximum(*inner.rest, *number), std::max(*inner.limit, *number)};
    }
    return {e, std::nullopt};
  }

private:
  // Returns the value of an expression that depends on nothing that varies.
  std::optional<double> constant(const Expr& e) const {
    std::vector<std::string> names;
    std::vector<double> values;
    for (const std::string& name : expr::symbols(e)) {
      const auto found = known_.find(name);
      if (found == known_.end()) return std::nullopt;
      names.push_back(name);
      values.push_back(found->second);
    }
    const double value = expr::Program(e, {}, names)({}, values);
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
  }

  std::map<std::string, double> known_;
};

// A table at its fixed states, as a function of the columns.
class HeldTable {
public:
  HeldTable(const table::Table& table, const std::vector<NativeColumn>& columns,
            const table::FixedStates& held)
      : function_(table) {
    for (const std::string& name : function_.inputs()) {
      const auto at = std::find_if(columns.begin(), columns.end(),
                                   [&](const NativeColumn& c) { return c.argument.name == name; });
      const auto constant = held.find(name);
      column_.push_back(constant != held.end() ? none
                                               : static_cast<std::size_t>(at - columns.begin()));
      value_.push_back(constant != held.end() ? constant->second : 0);
    }
  }

  void evaluate(std::size_t rows, std::span<const double* const> columns,
                std::span<double> tau) const {
    std::vector<std::vector<double>> constants(column_.size());
    std::vector<const double*> all;
    for (std::size_t i = 0; i < column_.size(); ++i) {
      if (column_[i] == none) constants[i].assign(rows, value_[i]);
      all.push_back(column_[i] == none ? constants[i].data() : columns[column_[i]]);
    }
    function_.evaluate(rows, all, tau);
  }

private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  table::TableFunction function_;
  std::vector<std::size_t> column_;
  std::vector<double> value_;
};

NativeAxis axis_of(const ExportRequest& request, const NativeForm& form,
                   const NativeColumn& column) {
  const std::string& name = column.argument.name;
  const auto range = range_of(request.table, name);
  const bool asked = column.argument.used;
  if (!range && asked)
    throw InputError(input_place(name), "the range of " + name + " is not known",
                     "tabulate again, or hold it: \"constant:VALUE\"");
  NativeAxis axis;
  axis.state = name;
  axis.unit = column.argument.solver;
  axis.low = range ? range->first : 0;
  axis.high = range ? range->second : 1;
  axis.fewest = form.every_column ? 2 : 1;
  const data::Quantity* quantity = data::find_quantity(name);
  axis.log = quantity && quantity->log_axis;
  for (const table::TableAxis& own : request.table.axes) {
    if (own.name != name) continue;
    axis.log = own.log;
    if (!request.table.is_direct()) axis.kinks = own.nodes;
  }
  return axis;
}

double aim_of(const table::Table& table) {
  const double tolerance = table.record.tolerance_MPa.value_or(usual_tolerance_MPa);
  const double own = table.is_direct() ? 0 : table.record.worst_case_MPa.value_or(0);
  return std::max(share_of_tolerance * (tolerance - own), least_share * tolerance);
}

// Rounds the solver's limit as its text does.
double limit_as_written(double limit, const ExportRequest& request) {
  const SolverUnit stress = solver_unit("MPa", request.units);
  return stress.to_canonical(as_written(stress.from_canonical(limit)));
}

// Returns the first pressure of the table, below which solvers keep the coefficient constant. It is
// so low that this has no effect: tau_R of every state is below the aim, or every coefficient is at
// its largest.
double first_pressure(const NativeProblem& problem, std::size_t column, double aim_MPa) {
  std::vector<table::StateRange> ranges;
  for (const NativeAxis& axis : problem.axes)
    ranges.push_back({axis.state, axis.low, axis.high, ""});
  table::States states = table::box_points(ranges, 256);
  std::vector<double> tau(states.front().size());
  double pressure = problem.axes[column].low;
  for (; pressure > fortran::least_pressure; pressure *= 0.5) {
    std::fill(states[column].begin(), states[column].end(), pressure);
    problem.tau(tau.size(), pointers(states), tau);
    const auto [least, most] = std::minmax_element(tau.begin(), tau.end());
    if (std::min(*most, problem.limit_MPa.value_or(*most)) <= aim_MPa) break;
    if (problem.pressure == column && *least >= problem.most * pressure) break;
  }
  return pressure;
}

} // namespace

NativeProblem native_problem(const ExportRequest& request, const NativeForm& form) {
  check_table(request.table);
  const std::vector<NativeColumn> columns = native_columns(request, form);
  const table::FixedStates held = native_fixed_states(request, form);
  NativeProblem problem;
  problem.most = fortran::largest_coefficient;
  for (const NativeColumn& column : columns) {
    if (form.factor == NativeFactor::pressure && is_pressure(column))
      problem.pressure = problem.axes.size();
    problem.axes.push_back(axis_of(request, form, column));
  }
  if (form.factor == NativeFactor::shear_yield)
    problem.factor_MPa = shear_yield(held.at("sigma_f_MPa"));
  table::Table table = request.table;
  if (form.limits) {
    const Limited parts = LimitSplit(table, held).split(table.combine);
    if (parts.limit) problem.limit_MPa = limit_as_written(*parts.limit, request);
    if (parts.limit && !parts.rest) { // tau_R is the limit
      problem.tau = [slope = problem.most, p = problem.pressure](std::size_t rows, auto given,
                                                                 auto tau) {
        for (std::size_t i = 0; i < rows; ++i)
          tau[i] = slope * given[p][i];
      };
      return problem;
    }
    if (parts.rest) table.combine = *parts.rest;
  }
  const auto function = std::make_shared<HeldTable>(table, columns, held);
  problem.tau = [function](std::size_t rows, auto given, auto tau) {
    function->evaluate(rows, given, tau);
  };
  return problem;
}

NativeTable native_table(const ExportRequest& request, const NativeForm& form) {
  NativeProblem problem = native_problem(request, form);
  NativeTable out;
  out.columns = native_columns(request, form);
  out.fixed = native_fixed_states(request, form);
  out.aim_MPa = aim_of(request.table);
  for (std::size_t c = 0; c < out.columns.size(); ++c)
    if (out.columns[c].argument.name == "sigma_n_MPa" &&
        table::below_pressures(request.table) == table::Outside::law)
      problem.axes[c].low = first_pressure(problem, c, out.aim_MPa);
  NativeGoal goal;
  goal.aim_MPa = out.aim_MPa;
  NativeGrid grid = make_native_grid(problem, goal);
  out.values = std::move(grid.values);
  out.found_MPa = grid.found_MPa;
  out.met = grid.met;
  if (problem.limit_MPa)
    out.values.limit =
        as_written(solver_unit("MPa", request.units).from_canonical(*problem.limit_MPa));
  return out;
}

void drive_coefficient(const NativeForm& form, const NativeCoefficient& coefficient,
                       std::optional<double> limit, const ExportRequest& request, std::size_t rows,
                       std::span<const double* const> given, std::span<double> tau) {
  const std::vector<NativeColumn> columns = native_columns(request, form);
  const table::FixedStates held = native_fixed_states(request, form);
  const auto column_of = [&](const std::string& name) -> const double* {
    const std::optional<std::size_t> at = input_index(request.table, name);
    return at ? given[*at] : nullptr;
  };
  const SolverUnit stress = solver_unit("MPa", request.units);
  const double* flow_stress = column_of("sigma_f_MPa");
  const auto range = range_of(request.table, "sigma_n_MPa").value_or(std::pair{1.0, 1000.0});
  std::vector<const double*> sources;
  for (const NativeColumn& column : columns)
    sources.push_back(column_of(column.argument.name));
  const auto state_in = [&](std::size_t column, std::size_t row) {
    if (sources[column]) return sources[column][row];
    if (!is_pressure(columns[column])) return 0.0;
    // Varies a pressure that the law does not take over all of its range.
    const double w = static_cast<double>(row % 97) / 96;
    return range.first + w * (range.second - range.first);
  };
  std::vector<double> x(columns.size());
  for (std::size_t i = 0; i < rows; ++i) {
    double factor = 0; // in the solver's unit
    for (std::size_t c = 0; c < columns.size(); ++c) {
      x[c] = columns[c].argument.solver.from_canonical(state_in(c, i));
      if (is_pressure(columns[c])) factor = x[c];
    }
    if (form.factor == NativeFactor::shear_yield) {
      const double flow = flow_stress ? flow_stress[i] : held.at("sigma_f_MPa");
      factor = stress.from_canonical(shear_yield(flow));
    }
    double answer = factor * coefficient(x);
    if (limit && answer > *limit) answer = *limit;
    tau[i] = stress.to_canonical(answer);
  }
}

SourceBundle NativeTarget::generate(const ExportRequest& request) const {
  const NativeForm native = form(request);
  const NativeTable table = native_table(request, native);
  SourceBundle files = {
      {text_.file, write(request, table, native_comments(*this, request, native, table))}};
  files["recipe.json"] =
      native_recipe(*this, request, native, table, files, text_.entry, text_.input_deck);
  return explained(files, *this);
}

BuildVariant native_deck() {
  BuildVariant deck;
  deck.name = "deck";
  deck.eps = 5e-9; // nine digits
  return deck;
}

std::vector<BuildVariant> NativeTarget::variants(const ExportRequest&) const {
  return {native_deck()};
}

void NativeTarget::drive(const Built& built, const ExportRequest& request, std::size_t rows,
                         std::span<const double* const> columns, std::span<double> tau) const {
  const NativeForm native = form(request);
  const NativeValues values = read(io::read_file(built.directory / text_.file), request);
  const std::size_t expected = native_columns(request, native).size();
  if (values.nodes.size() != expected)
    throw std::runtime_error(fmt::format("the table was written for {} columns, it has {}",
                                         expected, values.nodes.size()));
  drive_coefficient(
      native, [&](std::span<const double> x) { return values.at(x); }, values.limit, request, rows,
      columns, tau);
}

bool NativeTarget::gives_mu(const ExportRequest& request) const {
  return form(request).factor == NativeFactor::pressure;
}

table::Table NativeTarget::own_table(const ExportRequest& request,
                                     const SourceBundle& files) const {
  const NativeForm native = form(request);
  const NativeValues values = read(files.at(text_.file), request);
  const std::vector<NativeColumn> columns = native_columns(request, native);
  const table::FixedStates held = native_fixed_states(request, native);
  table::Table out;
  out.model = request.table.model;
  out.value = values.value;
  // The first column varies fastest, which is the last axis here.
  for (std::size_t c = columns.size(); c-- > 0;) {
    if (values.nodes[c].size() < 2) continue;
    table::TableAxis axis;
    axis.name = columns[c].argument.name;
    for (const double node : values.nodes[c])
      axis.nodes.push_back(columns[c].argument.solver.to_canonical(node));
    out.axes.push_back(std::move(axis));
  }
  Expr factor = Expr::symbol("sigma_n_MPa");
  if (native.factor == NativeFactor::shear_yield) {
    const auto flow = held.find("sigma_f_MPa");
    factor = flow == held.end() ? shear_yield(Expr::symbol("sigma_f_MPa"))
                                : Expr(shear_yield(flow->second));
  }
  out.combine = Expr::symbol("value") * factor;
  if (values.limit)
    out.combine =
        minimum(out.combine, solver_unit("MPa", request.units).to_canonical(*values.limit));
  return out;
}

table::FixedStates NativeTarget::fixed_states(const ExportRequest& request) const {
  return native_fixed_states(request, form(request));
}

} // namespace frictab::codegen
