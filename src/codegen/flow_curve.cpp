// Puts curve and factor into a table's formula, and finds the strain for a flow stress.
#include "codegen/flow_curve.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "codegen/entry_arguments.h"
#include "core/error.h"
#include "core/no_value.h"
#include "core/text.h"
#include "data/quantity.h"
#include "expr/program.h"

namespace frictab::codegen {

namespace {

constexpr const char* stress_name = "sigma_f_MPa";
constexpr std::string_view curve_choice = "curve:";

const Place curve_place = at_job_key("export.inputs", "sigma_f_MPa");

void check_curve(const expr::Expr& curve, const table::Table& table) {
  std::vector<std::string> known = table.inputs();
  std::erase(known, stress_name);
  for (const char* name : {strain_name, "T_contact_C"})
    if (std::find(known.begin(), known.end(), name) == known.end()) known.push_back(name);
  for (const std::string& name : symbols(curve))
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError(curve_place, "the curve has '" + name + "', which is not a state",
                       suggest(name, known));
  if (input_index(table, strain_name))
    throw InputError(curve_place, "the law has a state of its own that is called strain",
                     "\"field:1\" or \"property\", or another name for that column of the data");
  if (!symbols(curve).contains(strain_name))
    throw InputError(curve_place, "the curve does not depend on strain",
                     "a formula in strain (equivalent plastic strain), or \"constant:480\"");
  if (table::find_axis(table, stress_name))
    throw InputError(curve_place,
                     "a curve cannot take the place of sigma_f_MPa, which is an axis of the table",
                     "\"field:1\" or \"property\"");
}

// Default of a state for which the job has no value.
double usual_value(const table::Table& table, const std::string& name) {
  if (const auto typical = typical_value(table, name)) return *typical;
  const data::Quantity* known = data::find_quantity(name);
  return known ? known->unknown.value_or(0) : 0;
}

std::vector<std::string> other_states(const expr::Expr& curve) {
  const std::set<std::string> all = symbols(curve);
  std::vector<std::string> others(all.begin(), all.end());
  std::erase(others, strain_name);
  return others;
}

// Returns a column by name: the law's own states from `columns`, others at their default.
std::vector<double> column_of(const table::Table& table, const std::string& name, std::size_t rows,
                              std::span<const double* const> columns) {
  const std::optional<std::size_t> at = input_index(table, name);
  if (!at) return std::vector<double>(rows, usual_value(table, name));
  return {columns[*at], columns[*at] + rows};
}

std::vector<double> picked(const std::vector<double>& values,
                           const std::vector<std::size_t>& rows) {
  std::vector<double> out;
  for (const std::size_t row : rows)
    out.push_back(values[row]);
  return out;
}

// The curve as a function of strain, at one state of its other inputs.
class AlongStrain {
public:
  explicit AlongStrain(const expr::Expr& curve)
      : others_(other_states(curve)), program_(curve, with_strain(others_), {}),
        row_(others_.size() + 1) {}

  const std::vector<std::string>& others() const { return others_; }
  void set_other(std::size_t i, double value) { row_[i] = value; }
  double operator()(double value) {
    row_.back() = value;
    return program_(row_, {});
  }

  // Returns the smallest strain with this flow stress; NaN if there is none.
  double solve(double wanted) {
    double low = 0, at_low = (*this)(low)-wanted;
    for (int cell = 1; cell <= cells && at_low != 0; ++cell) {
      const double high = most_strain * cell / cells, at_high = (*this)(high)-wanted;
      if (at_low * at_high <= 0) return bisect(low, high, at_low, wanted);
      low = high;
      at_low = at_high;
    }
    return at_low == 0 ? low : no_value;
  }

  static constexpr int cells = 200;

private:
  static std::vector<std::string> with_strain(std::vector<std::string> others) {
    others.emplace_back(strain_name);
    return others;
  }

  double bisect(double low, double high, double at_low, double wanted) {
    for (double middle = 0.5 * (low + high); low < middle && middle < high;
         middle = 0.5 * (low + high)) {
      const double at_middle = (*this)(middle)-wanted;
      (at_low * at_middle > 0 ? low : high) = middle;
    }
    return high;
  }

  std::vector<std::string> others_;
  expr::Program program_;
  std::vector<double> row_; // the last is the strain
};

} // namespace

CurvedRequest::CurvedRequest(const ExportRequest& request, const SolverGives& gives)
    : original_(request) {
  const std::string stress = request.input_or_empty(stress_name),
                    zones = request.input_or_empty(zone_name);
  has_curve_ = input_index(request.table, stress_name) && stress.starts_with(curve_choice);
  if (!has_curve_ && zones.empty()) return;
  if (has_curve_ && gives.find(stress_name))
    throw InputError(curve_place, "the solver gives this state itself",
                     "\"solver\", or the curve for other targets: [export.TARGET.inputs]");
  table_ = request.table;
  curved_.emplace(ExportRequest{table_, request.units, request.inputs, request.options});
  curved_->law_name = request.law_name;
  curved_->law_stem = request.law_stem;
  if (has_curve_) add_curve(stress.substr(curve_choice.size()));
  if (!zones.empty()) add_zones(zones);
}

void CurvedRequest::add_curve(const std::string& text) {
  curve_ = expr::parse_expr(text, format_place(curve_place));
  check_curve(curve_, original_.table);
  table_.combine = substitute(table_.combine, {{stress_name, curve_}});
  set_range();
  curved_->inputs.erase(stress_name);
}

void CurvedRequest::add_zones(const std::string& choice) {
  if (choice != "property" && !choice.starts_with("field:"))
    throw InputError(input_place(zone_name), "a factor by zones is a field or a property",
                     "\"field:1\", or \"property\" for one factor of an interface");
  const expr::Expr value = expr::Expr::symbol("value");
  table_.combine = substitute(table_.combine, {{"value", value * expr::Expr::symbol(zone_name)}});
  table::InputRecord& record = table_.record.inputs[zone_name];
  record.low = 0;
  record.high = 2; // its middle stands where the deck gives none
  record.long_name = "factor of friction by zones of the surface";
  record.unit = "1";
}

// Sets the range of strains in which the curve stays within the tested flow stresses.
void CurvedRequest::set_range() {
  const auto tested = original_.table.range(stress_name);
  AlongStrain curve(curve_);
  for (std::size_t i = 0; i < curve.others().size(); ++i)
    curve.set_other(i, usual_value(original_.table, curve.others()[i]));
  double low = most_strain, high = 0, smallest = HUGE_VAL, largest = -HUGE_VAL;
  for (int cell = 0; cell <= AlongStrain::cells; ++cell) {
    const double at = most_strain * cell / AlongStrain::cells, value = curve(at);
    smallest = std::min(smallest, value);
    largest = std::max(largest, value);
    if (tested && (value < tested->first || value > tested->second)) continue;
    low = std::min(low, at);
    high = std::max(high, at);
  }
  if (low > high)
    throw InputError(curve_place,
                     fmt::format("the curve gives {:.4g} .. {:.4g} MPa for strains of 0 to {:g}, "
                                 "the law was made for {:.4g} .. {:.4g} MPa",
                                 smallest, largest, most_strain, tested->first, tested->second),
                     "a curve in MPa, of the material that was tested");
  table::InputRecord& record = table_.record.inputs[strain_name];
  record.low = low;
  record.high = high;
  record.long_name = "equivalent plastic strain";
  record.unit = "1";
  table_.record.inputs.erase(stress_name);
}

std::vector<double> CurvedRequest::strains(std::size_t rows,
                                           std::span<const double* const> columns) const {
  AlongStrain curve(curve_);
  std::vector<std::vector<double>> others;
  for (const std::string& name : curve.others())
    others.push_back(column_of(original_.table, name, rows, columns));
  const std::vector<double> wanted = column_of(original_.table, stress_name, rows, columns);
  std::vector<double> out(rows);
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t i = 0; i < others.size(); ++i)
      curve.set_other(i, others[i][row]);
    out[row] = curve.solve(wanted[row]);
  }
  return out;
}

void CurvedRequest::drive(std::size_t rows, std::span<const double* const> columns,
                          std::span<double> tau, const Drive& drive) const {
  if (!curved_) return drive(rows, columns, tau);
  const std::vector<double> strain_of =
      has_curve_ ? strains(rows, columns) : std::vector<double>(rows);
  const std::vector<double> no_zones(rows, 1.0);
  std::vector<std::size_t> asked;
  for (std::size_t row = 0; row < rows; ++row)
    if (!std::isnan(strain_of[row])) asked.push_back(row);
  std::vector<std::vector<double>> states;
  for (const std::string& name : table_.inputs())
    states.push_back(picked(name == zone_name ? no_zones
                            : has_curve_ && name == strain_name
                                ? strain_of
                                : column_of(original_.table, name, rows, columns),
                            asked));
  std::vector<const double*> pointers;
  for (const std::vector<double>& one : states)
    pointers.push_back(one.data());
  std::vector<double> answers = picked({tau.begin(), tau.end()}, asked);
  drive(asked.size(), pointers, answers);
  for (std::size_t i = 0; i < asked.size(); ++i)
    tau[asked[i]] = answers[i];
}

} // namespace frictab::codegen
