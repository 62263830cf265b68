// Slopes, formulas, products and integrals of columns.
#include "data/computed.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "core/no_value.h"
#include "core/text.h"
#include "core/units.h"
#include "data/quantity.h"
#include "data/signs.h"
#include "expr/expr.h"
#include "expr/program.h"

namespace frictab::data {

namespace {

bool is_plain(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0;
}

// Replaces all but letters and digits in a name by _, once per character; `ascii`: also letters
// beyond ASCII.
std::string written_name(const std::string& column, bool ascii) {
  const std::string name = io::read_header_name(column).name;
  std::string out;
  for (std::string_view left = name; !left.empty();) {
    const std::size_t letter = expr::letter_length(left),
                      length = std::max<std::size_t>(1, utf8_length(left));
    if (is_plain(left.front()) || (letter > 0 && !ascii))
      out += left.substr(0, length);
    else
      out += '_';
    left.remove_prefix(length);
  }
  return out;
}

} // namespace

std::string name_in_formulas(const std::string& column) {
  return written_name(column, false);
}

bool is_named_by(const std::set<std::string>& names, const std::string& column) {
  if (names.count(column) > 0 || names.count(name_in_formulas(column)) > 0) return true;
  std::string by_byte = io::read_header_name(column).name; // as jobs had to be written once
  std::replace_if(
      by_byte.begin(), by_byte.end(), [](char c) { return !is_plain(c); }, '_');
  return names.count(written_name(column, true)) > 0 || names.count(by_byte) > 0;
}

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
    slopes[i] = sty / stt; // NaN if t is constant in the window
  }
  return slopes;
}

// ---- formulas ----

// The column that a name in a formula refers to; nullptr if there is none.
const Column* meant(Part& part, const std::string& name) {
  if (const Column* column = part.find(name)) return column;
  for (const Column& column : part.data.columns)
    if (is_named_by({name}, column.name)) return &column;
  return nullptr;
}

std::string unit_of(const Part& part, const Column& column) {
  if (!column.unit.empty()) return column.unit;
  for (const io::CsvColumn& raw : part.raw.columns)
    if (raw.name == column.name)
      return raw.unit.empty() ? io::read_header_name(raw.name).unit : raw.unit;
  return "";
}

// The x of abs(x) and of sqrt(x^2), in any notation; nullptr for other expressions.
const expr::Expr* under_magnitude(const expr::Expr& e) {
  using expr::Op;
  const auto negates = [](const expr::Expr& a, const expr::Expr& b) {
    return a.op() == Op::negate && a.operands()[0].id() == b.id();
  };
  const auto& of = e.operands();
  if (e.op() == Op::maximum && negates(of[1], of[0])) return &of[0];
  if (e.op() == Op::maximum && negates(of[0], of[1])) return &of[1];
  const bool is_root = e.op() == Op::sqrt || (e.op() == Op::power && of[1].is_constant(0.5));
  if (!is_root) return nullptr;
  const expr::Expr& square = of[0];
  const bool is_square =
      (square.op() == Op::power && square.operands()[1].is_constant(2)) ||
      (square.op() == Op::multiply && square.operands()[0].id() == square.operands()[1].id());
  return is_square ? &square.operands()[0] : nullptr;
}

// The formula with abs(x) replaced by x; nullopt if it has no such term.
std::optional<expr::Expr> without_magnitudes(const expr::Expr& formula) {
  std::vector<std::pair<expr::Expr, expr::Expr>> nodes;
  expr::for_each_part(formula, [&](const expr::Expr& part) {
    if (const expr::Expr* x = under_magnitude(part)) nodes.emplace_back(part, *x);
  });
  if (nodes.empty()) return {};
  return expr::substitute(formula, nodes);
}

class Formulas {
public:
  Formulas(Part& part, const ReadRequest& options) : part_(part), options_(options) {}

  void compute() {
    std::map<std::string, expr::Expr> open;
    for (const auto& [canonical, from] : options_.columns)
      if (!from.formula.empty()) open.emplace(canonical, parsed(from));
    // Computes the formulas whose inputs are ready, until none is left.
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
      if (!options_.find_quantity(column->name)) note_empty_cells(canonical, *column);
      if (const std::string unit = unit_of(part_, *column); !unit.empty())
        inputs.push_back(name + " in " + unit);
    }
    const Quantity& quantity = *options_.find_quantity(canonical);
    const ColumnSource& from = options_.columns.at(canonical);
    const auto values_of = [&](const expr::Expr& of) {
      std::vector<double> out(part_.row.size());
      expr::Program(of, names, {}).evaluate(out.size(), values, {}, out.data());
      if (!from.unit.empty()) // checked with the job
        for (double& value : out)
          value = (*convert(from.unit, quantity.unit))(value);
      return out;
    };
    Column out{canonical, quantity.unit, values_of(formula), {}};
    const auto with_sign = has_direction(canonical) ? without_magnitudes(formula) : std::nullopt;
    if (with_sign) keep_if_same(canonical, out.values, values_of(*with_sign));
    part_.data.columns.push_back(std::move(out));
    part_.data.notes.push_back(fmt::format("{} = {}{}", canonical, from.formula,
                                           inputs.empty() ? "" : ", " + join(inputs, ", ")));
  }

  // Empty cells of a recorded column count as faults only where a formula needs them.
  void note_empty_cells(const std::string& canonical, const Column& column) {
    for (std::size_t i = 0; i < column.values.size(); ++i)
      if (std::isnan(column.values[i]))
        part_.cell_faults.push_back({part_.row[i],
                                     {part_.place(i),
                                      fmt::format("{} is empty here, which the formula of {} needs",
                                                  column.name, canonical),
                                      "repair it, or data.missing = \"drop\" leaves such rows out"},
                                     canonical + " of " + column.name,
                                     true});
  }

  static bool has_direction(const std::string& canonical) {
    return canonical == "v_rel_mm_s" || canonical == "tau_R_MPa" || canonical == "F_R_N";
  }

  // Keeps the signed values only if they equal the formula up to sign, which abs(x) + abs(y) does
  // not.
  void keep_if_same(const std::string& canonical, const std::vector<double>& magnitudes,
                    std::vector<double> with_sign) {
    constexpr double rounding = 1e-9;
    for (std::size_t i = 0; i < magnitudes.size(); ++i)
      if (std::abs(std::abs(with_sign[i]) - magnitudes[i]) > rounding * magnitudes[i]) return;
    keep_signed(part_, canonical, std::move(with_sign));
  }

  const Column* input(const std::string& canonical, const std::string& name) {
    const Place& place = options_.columns.at(canonical).place;
    const Column* column = meant(part_, name);
    if (!column) {
      std::vector<std::string> known = {"pi"};
      for (const Column& one : part_.data.columns)
        known.push_back(options_.find_quantity(one.name) ? one.name : name_in_formulas(one.name));
      part_.faults.add(
          place,
          fmt::format("the formula of {} needs {}, which the data do not have", canonical, name),
          hint_of_mapped(name).value_or(suggest(name, known)));
    } else if (!column->levels.empty()) {
      part_.faults.add(place,
                       fmt::format("the formula of {} needs {}, which is text", canonical, name));
      return nullptr;
    }
    return column;
  }

  // A column that is mapped to a quantity has that name from then on.
  std::optional<std::string> hint_of_mapped(const std::string& name) const {
    for (const auto& [canonical, from] : options_.columns) {
      const Quantity* const quantity = options_.find_quantity(canonical);
      if (quantity && std::any_of(from.names.begin(), from.names.end(),
                                  [&](const auto& column) { return is_named_by({name}, column); }))
        return fmt::format("that column is {} here: write {} in the formula, in {}", canonical,
                           canonical, quantity->unit);
    }
    return {};
  }

  Part& part_;
  const ReadRequest& options_;
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
      std::copy(slopes.begin(), slopes.end(), column->values.begin() + static_cast<long>(first));
    }
    std::vector<double> with_sign = column->values;
    for (double& slope : column->values)
      slope = std::abs(slope);
    if (canonical == "v_rel_mm_s") keep_signed(part, canonical, std::move(with_sign));
    std::string note =
        fmt::format("{} = slope over {} rows of its column", canonical, from.slope_rows);
    if (shorter > 0)
      note += fmt::format(", over all of {} of {} tests, which have fewer", thousands(shorter),
                          thousands(part.data.experiments.size()));
    part.data.notes.push_back(std::move(note));
  }
}

namespace {

// Calls take(canonical, names in its formula) for the formulas of the job.
template <class Take> void for_each_formula(const DataOptions& options, const Take& take) {
  const auto look_at = [&](const std::map<std::string, ColumnSource>& columns) {
    for (const auto& [canonical, from] : columns)
      if (!from.formula.empty()) take(canonical, expr::symbols(expr::parse_expr(from.formula)));
  };
  look_at(options.columns);
  for (const FileRule& rule : options.files)
    look_at(rule.columns);
}

} // namespace

std::set<std::string> names_in_formulas(const DataOptions& options) {
  std::set<std::string> all;
  for_each_formula(options, [&](const std::string&, const auto& names) {
    all.insert(names.begin(), names.end());
  });
  return all;
}

std::vector<std::string> computed_from(const DataOptions& options, const std::string& column) {
  std::vector<std::string> quantities;
  for_each_formula(options, [&](const std::string& canonical, const auto& names) {
    if (is_named_by(names, column)) quantities.push_back(canonical);
  });
  return quantities;
}

void compute_formulas(Part& part, const ReadRequest& options) {
  Formulas(part, options).compute();
  if (!options.bystanders) return;
  // Kept, together with the columns that formulas used.
  const std::vector<std::string>& keep = *options.bystanders;
  std::erase_if(part.data.columns, [&](const Column& column) {
    return !options.find_quantity(column.name) && !computed_from(options, column.name).empty() &&
           std::find(keep.begin(), keep.end(), column.name) == keep.end();
  });
}

void multiply_coefficients(Part& part, const DataOptions& options) {
  for (const auto& [canonical, from] : options.columns) {
    if (from.times.empty()) continue;
    Column* target = part.find(canonical);
    const Column* factor = part.find(from.times);
    if (!factor && !options.columns.count(from.times)) // otherwise already reported
      part.faults.add(from.place, fmt::format("{}: times = '{}', which the data do not have",
                                              canonical, from.times));
    if (!target || !factor) continue;
    for (std::size_t i = 0; i < target->values.size(); ++i)
      target->values[i] *= factor->values[i];
    part.data.notes.push_back(canonical + " = measured coefficient times " + from.times);
  }
}

void derive_shear_stress(Part& part, const ReadRequest& options) {
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
  if (!stress) return; // reported by check_needed
  part.measured_tau = false;
  part.data.columns.push_back({"tau_R_MPa", "MPa", std::vector<double>(stress->values.size()), {}});
  fill_shear_stress(part);
  part.data.notes.push_back("tau_R_MPa = F_R_N/F_N_N * sigma_n_MPa (eq. 1)");
}

void fill_shear_stress(Part& part) {
  Column* const tau = part.find("tau_R_MPa");
  if (!tau) return;
  const auto &friction = part.find("F_R_N")->values, &normal = part.find("F_N_N")->values,
             &stress = part.find("sigma_n_MPa")->values;
  // NaN, because the coefficient is undefined without load; check_values reports the load unless
  // the row is left out before.
  for (std::size_t i = 0; i < tau->values.size(); ++i)
    tau->values[i] = normal[i] > 0 ? friction[i] / normal[i] * stress[i] : no_value;
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
