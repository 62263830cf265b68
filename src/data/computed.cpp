// Slopes, formulas, products and integrals of columns.
#include "data/computed.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>

#include <fmt/format.h>

#include "core/no_value.h"
#include "core/text.h"
#include "core/units.h"
#include "data/quantity.h"
#include "expr/program.h"

namespace frictab::data {

namespace {

// Slope of the least-squares line of y over t in a window of `width` rows around each row.
std::vector<double> local_slopes(std::span<const double> t, std::span<const double> y,
                                 std::size_t width) {
  std::vector<double> slopes(t.size());
  for (std::size_t i = 0; i < t.size(); ++i) {
    const std::size_t half = width / 2;
    const std::size_t begin =
        i > half ? std::min(i - half, t.size() - std::min(width, t.size())) : 0;
    const std::size_t end = std::min(begin + width, t.size());
    double mt = 0, my = 0, stt = 0, sty = 0;
    const double n = static_cast<double>(end - begin);
    for (std::size_t j = begin; j < end; ++j) {
      mt += t[j] / n;
      my += y[j] / n;
    }
    for (std::size_t j = begin; j < end; ++j) {
      stt += (t[j] - mt) * (t[j] - mt);
      sty += (t[j] - mt) * (y[j] - my);
    }
    slopes[i] = sty / stt; // NaN where time stands still
  }
  return slopes;
}

// ---- formulas ----

// As a formula writes a column's name: "Drehzahl innen [1/min]" is Drehzahl_innen.
std::string written(const std::string& column) {
  std::string out;
  for (const char c : io::read_header_name(column).name)
    out += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return out;
}

// The column that a name of a formula means; nullptr where there is none.
const Column* meant(Part& part, const std::string& name) {
  if (const Column* column = part.find(name)) return column;
  for (const Column& column : part.data.columns)
    if (written(column.name) == name) return &column;
  return nullptr;
}

std::string unit_of(const Part& part, const Column& column) {
  if (!column.unit.empty()) return column.unit;
  for (const io::CsvColumn& raw : part.raw.columns)
    if (raw.name == column.name)
      return raw.unit.empty() ? io::read_header_name(raw.name).unit : raw.unit;
  return "";
}

class Formulas {
public:
  Formulas(Part& part, const DataOptions& options) : part_(part), options_(options) {}

  void compute() {
    std::map<std::string, expr::Expr> open;
    for (const auto& [canonical, from] : options_.columns)
      if (!from.formula.empty()) open.emplace(canonical, parsed(from));
    // Those that need no other one first.
    for (bool any = true; any && !open.empty();) {
      any = false;
      for (auto next = open.begin(); next != open.end();) {
        const bool ready = std::none_of(open.begin(), open.end(), [&](const auto& other) {
          return expr::symbols(next->second).count(other.first) > 0;
        });
        if (ready) evaluate(next->first, next->second);
        any = any || ready;
        next = ready ? open.erase(next) : std::next(next);
      }
    }
    for (const auto& [canonical, formula] : open)
      part_.faults.add(options_.columns.at(canonical).place,
                       fmt::format("the formula of {} needs itself", canonical),
                       "a formula is computed from other columns");
  }

private:
  expr::Expr parsed(const ColumnSource& from) {
    const expr::Expr formula = expr::parse_expr(from.formula);
    if (part_.find("pi")) return formula;
    return expr::substitute(formula, {{"pi", expr::Expr(std::numbers::pi)}});
  }

  void evaluate(const std::string& canonical, const expr::Expr& formula) {
    std::vector<std::string> names;
    std::vector<const double*> values;
    std::vector<std::string> inputs; // with units
    for (const std::string& name : expr::symbols(formula)) {
      const Column* column = input(canonical, name);
      if (!column) return;
      names.push_back(name);
      values.push_back(column->values.data());
      if (const std::string unit = unit_of(part_, *column); !unit.empty())
        inputs.push_back(name + " in " + unit);
    }
    const Quantity& quantity = *find_quantity(canonical);
    Column out{canonical, quantity.unit, std::vector<double>(part_.row.size()), {}};
    expr::Program(formula, names, {}).evaluate(part_.row.size(), values, {}, out.values.data());
    const ColumnSource& from = options_.columns.at(canonical);
    if (!from.unit.empty()) // checked with the job
      for (double& value : out.values)
        value = (*convert(from.unit, quantity.unit))(value);
    part_.data.columns.push_back(std::move(out));
    part_.data.notes.push_back(fmt::format("{} = {}{}", canonical, from.formula,
                                           inputs.empty() ? "" : ", " + join(inputs, ", ")));
  }

  const Column* input(const std::string& canonical, const std::string& name) {
    const Place& place = options_.columns.at(canonical).place;
    const Column* column = meant(part_, name);
    if (!column) {
      std::vector<std::string> known = {"pi"};
      for (const Column& one : part_.data.columns)
        known.push_back(find_quantity(one.name) ? one.name : written(one.name));
      part_.faults.add(place,
                       fmt::format("the formula of {} needs {}, which {} does not have", canonical,
                                   name, part_.raw.file),
                       suggest(name, known));
    } else if (!column->levels.empty()) {
      part_.faults.add(place,
                       fmt::format("the formula of {} needs {}, which is text", canonical, name));
      return nullptr;
    }
    return column;
  }

  Part& part_;
  const DataOptions& options_;
};

} // namespace

void take_slopes(Part& part, const DataOptions& options) {
  for (const auto& [canonical, from] : options.columns) {
    if (from.slope_rows == 0) continue;
    Column* column = part.find(canonical);
    const Column* time = part.find("time_s");
    if (!column) continue;
    if (!time) {
      part.faults.add(from.place, canonical + ": a slope needs time_s, which the data do not have");
      continue;
    }
    std::size_t shorter = 0; // tests
    for (std::size_t e = 0; e < part.data.experiments.size(); ++e) {
      const std::size_t first = part.data.first_row[e], n = part.data.first_row[e + 1] - first;
      if (n < from.slope_rows) ++shorter;
      const auto slopes = local_slopes({time->values.data() + first, n},
                                       {column->values.data() + first, n}, from.slope_rows);
      for (std::size_t i = 0; i < n; ++i)
        column->values[first + i] = std::abs(slopes[i]);
    }
    std::string note =
        fmt::format("{} = slope over {} rows of its column", canonical, from.slope_rows);
    if (shorter > 0)
      note += fmt::format(", over all of {} of {} tests, which have fewer", thousands(shorter),
                          thousands(part.data.experiments.size()));
    part.data.notes.push_back(std::move(note));
  }
}

std::vector<std::string> computed_from(const DataOptions& options, const std::string& column) {
  std::vector<std::string> quantities;
  const auto look_at = [&](const std::map<std::string, ColumnSource>& columns) {
    for (const auto& [canonical, from] : columns) {
      if (from.formula.empty()) continue;
      const auto names = expr::symbols(expr::parse_expr(from.formula));
      if (names.count(column) > 0 || names.count(written(column)) > 0)
        quantities.push_back(canonical);
    }
  };
  look_at(options.columns);
  for (const FileRule& rule : options.files)
    look_at(rule.columns);
  return quantities;
}

void compute_formulas(Part& part, const DataOptions& options) {
  Formulas(part, options).compute();
  if (!options.bystanders) return;
  const std::vector<std::string>& keep = *options.bystanders; // beside them, what formulas used
  std::erase_if(part.data.columns, [&](const Column& column) {
    return !find_quantity(column.name) && !computed_from(options, column.name).empty() &&
           std::find(keep.begin(), keep.end(), column.name) == keep.end();
  });
}

void multiply_coefficients(Part& part, const DataOptions& options) {
  for (const auto& [canonical, from] : options.columns) {
    if (from.times.empty()) continue;
    Column* target = part.find(canonical);
    const Column* factor = part.find(from.times);
    if (!factor && !options.columns.count(from.times)) // else told already
      part.faults.add(from.place, fmt::format("{}: times = '{}', which the data do not have",
                                              canonical, from.times));
    if (!target || !factor) continue;
    for (std::size_t i = 0; i < target->values.size(); ++i)
      target->values[i] *= factor->values[i];
    part.data.notes.push_back(canonical + " = measured coefficient times " + from.times);
  }
}

void derive_shear_stress(Part& part, const DataOptions& options) {
  if (part.find("tau_R_MPa")) return;
  const Column* friction = part.find("F_R_N");
  const Column* normal = part.find("F_N_N");
  const Column* stress = part.find("sigma_n_MPa");
  if (!options.measured && (!friction || !normal)) return;
  if (!friction || !normal) {
    part.faults.add(part.header(), "there is neither tau_R_MPa nor the pair F_R_N, F_N_N",
                    "map it in [data.columns]; the file has: " + join(part.raw_names(), ", "));
    return;
  }
  if (!stress) return; // told by check_needed
  Column tau{"tau_R_MPa", "MPa", std::vector<double>(stress->values.size()), {}};
  part.measured_tau = false;
  // No load, no coefficient: NaN; check_values reports the load unless the row is left out before.
  for (std::size_t i = 0; i < tau.values.size(); ++i)
    tau.values[i] = normal->values[i] > 0
                        ? friction->values[i] / normal->values[i] * stress->values[i]
                        : no_value;
  part.data.columns.push_back(std::move(tau));
  part.data.notes.push_back("tau_R_MPa = F_R_N/F_N_N * sigma_n_MPa (eq. 1)");
}

void integrate_distance(Part& part) {
  const Column* speed = part.find("v_rel_mm_s");
  const Column* time = part.find("time_s");
  if (part.find("s_mm") || !speed || !time) return;
  Column distance{"s_mm", "mm", std::vector<double>(speed->values.size()), {}};
  for (std::size_t e = 0; e < part.data.experiments.size(); ++e)
    for (std::size_t i = part.data.first_row[e] + 1; i < part.data.first_row[e + 1]; ++i)
      distance.values[i] = distance.values[i - 1] + 0.5 *
                                                        (speed->values[i] + speed->values[i - 1]) *
                                                        (time->values[i] - time->values[i - 1]);
  part.data.columns.push_back(std::move(distance));
  part.data.notes.push_back("s_mm integrated from v_rel_mm_s and time_s");
}

} // namespace frictab::data
