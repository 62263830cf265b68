// Rows of states against what one contact point, and one call, can be.
#include "codegen/driver.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>

#include <dlfcn.h>

#include "codegen/compile.h"
#include "codegen/histories.h"

namespace frictab {

namespace {

constexpr double some_flow_stress = 480; // MPa, where a law does not ask for one

using Ftdriv = void(const std::int32_t* points, const std::int32_t* states, const double* v,
                    const std::int32_t* properties, const double* property,
                    const std::int32_t* fields, const double* field, const std::int32_t* histories,
                    const double* history, double* tau);

// Points of one call, as ftdriv takes them.
struct Block {
  std::vector<double> v, property, field, history, tau;
};

class Routine {
public:
  Routine(const Driver& driver, const Built& built, const ExportRequest& request)
      : driver_(driver), inputs_(solver_inputs(request, driver.gives)),
        stress_(solver_unit("MPa", request.units)),
        call_(reinterpret_cast<Ftdriv*>(Library::address(built.library, "ftdriv_"))),
        constants_(static_cast<double*>(dlsym(built.library, "ftcons_"))) {
    for (const SolverInput& input : inputs_)
      fields_ = std::max(fields_, input.field);
  }

  const std::vector<SolverInput>& inputs() const { return inputs_; }

  // False where a row contradicts itself; NaN does not.
  bool posed(std::span<const double* const> columns, std::size_t row) const {
    const double pressure = canonical("sigma_n_MPa", columns, row).value_or(lowest_pressure());
    std::optional<double> slip;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      if (inputs_[c].source != Source::given || inputs_[c].given != "s_mm") continue;
      if (slip && *slip != columns[c][row]) return false;
      slip = columns[c][row];
    }
    if (!history_posed(inputs_, columns, row)) return false;
    if (driver_.zero_is_no_temperature && canonical("T_contact_C", columns, row) == 0.0)
      return false;
    const auto peak = canonical("peak_sigma_n", columns, row);
    return !peak || !(*peak < pressure);
  }

  void run(std::span<const std::size_t> rows, std::span<const double* const> columns,
           std::span<double> tau) const {
    const std::vector<GivenState>& states = driver_.gives.states;
    Block b;
    b.property.assign(property_count(inputs_), 0.0);
    b.tau.assign(rows.size(), 0.0);
    for (const std::size_t row : rows) {
      for (const GivenState& state : states)
        b.v.push_back(value_of(state.state, columns, row));
      add_row(b, columns, row);
    }
    const auto n = static_cast<std::int32_t>(rows.size());
    const auto ns = static_cast<std::int32_t>(states.size());
    const auto np = static_cast<std::int32_t>(b.property.size());
    const auto nf = static_cast<std::int32_t>(fields_);
    const auto nh = static_cast<std::int32_t>(b.history.size() / rows.size());
    call_(&n, &ns, b.v.data(), &np, b.property.data(), &nf, b.field.data(), &nh, b.history.data(),
          b.tau.data());
    for (std::size_t k = 0; k < rows.size(); ++k)
      tau[rows[k]] = stress_of(b.tau[k], columns, rows[k]);
  }

private:
  // Below it no peak is one, where the law does not say the pressure.
  double lowest_pressure() const {
    return driver_.peak_presses ? std::numeric_limits<double>::denorm_min() : driver_.pressure;
  }

  // What the law takes from the solver's table; nothing where it takes no such state from there.
  std::optional<double> canonical(const std::string& state, std::span<const double* const> columns,
                                  std::size_t row) const {
    for (std::size_t c = 0; c < columns.size(); ++c)
      if (inputs_[c].source == Source::given && inputs_[c].given == state) return columns[c][row];
    return std::nullopt;
  }

  double pressure(std::span<const double* const> columns, std::size_t row) const {
    if (const auto given = canonical("sigma_n_MPa", columns, row)) return *given;
    const auto peak = canonical("peak_sigma_n", columns, row);
    return driver_.peak_presses && peak ? *peak : driver_.pressure;
  }

  // The law's own, wherever it has it from.
  double flow_stress(std::span<const double* const> columns, std::size_t row) const {
    for (std::size_t c = 0; c < columns.size(); ++c)
      if (inputs_[c].argument.name == "sigma_f_MPa") return columns[c][row];
    return some_flow_stress;
  }

  double value_of(const std::string& state, std::span<const double* const> columns,
                  std::size_t row) const {
    for (std::size_t c = 0; c < columns.size(); ++c)
      if (inputs_[c].source == Source::given && inputs_[c].given == state)
        return inputs_[c].argument.solver.from_canonical(columns[c][row]);
    if (state == "sigma_n_MPa") return stress_.from_canonical(pressure(columns, row));
    return state == "sigma_f_MPa" ? stress_.from_canonical(flow_stress(columns, row)) : 0.0;
  }

  void add_row(Block& b, std::span<const double* const> columns, std::size_t row) const {
    b.field.resize(b.field.size() + fields_, 0.0);
    double* const field = b.field.data() + (b.field.size() - fields_);
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const double value = inputs_[c].argument.solver.from_canonical(columns[c][row]);
      if (inputs_[c].source == Source::property) b.property[inputs_[c].property - 1] = value;
      if (inputs_[c].source == Source::field) field[inputs_[c].field - 1] = value;
      if (inputs_[c].source == Source::constant && constants_) constants_[c] = columns[c][row];
    }
    const std::vector<double> past = history_values(inputs_, columns, row);
    b.history.insert(b.history.end(), past.begin(), past.end());
  }

  double stress_of(double result, std::span<const double* const> columns, std::size_t row) const {
    switch (driver_.result) {
    case fortran::Coefficient::stress:
      return stress_.to_canonical(result);
    case fortran::Coefficient::coulomb:
      return result * std::abs(pressure(columns, row));
    case fortran::Coefficient::shear:
      break;
    }
    return result * flow_stress(columns, row) * std::numbers::inv_sqrt3;
  }

  const Driver& driver_;
  std::vector<SolverInput> inputs_;
  SolverUnit stress_;
  Ftdriv* call_;
  double* constants_; // null where the source has none that can be set
  std::size_t fields_ = 0;
};

// These rows in groups that can share a call, at most `most` each: properties are constants of a
// call, so all rows of a group agree in them.
std::vector<std::vector<std::size_t>> call_groups(const std::vector<SolverInput>& inputs,
                                                  std::vector<std::size_t> rows,
                                                  std::span<const double* const> columns,
                                                  std::size_t most) {
  std::vector<const double*> properties;
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (inputs[c].source == Source::property) properties.push_back(columns[c]);
  for (std::size_t p = properties.size(); p-- > 0;)
    std::stable_sort(rows.begin(), rows.end(), [x = properties[p]](std::size_t a, std::size_t b) {
      return std::strong_order(x[a], x[b]) < 0;
    });
  std::vector<std::vector<std::size_t>> groups;
  for (const std::size_t row : rows) {
    const auto differs = [&](const double* x) { return x[groups.back().front()] != x[row]; };
    if (groups.empty() || groups.back().size() == most ||
        std::any_of(properties.begin(), properties.end(), differs))
      groups.emplace_back();
    groups.back().push_back(row);
  }
  return groups;
}

} // namespace

void drive_routine(const Driver& driver, const Built& built, const ExportRequest& request,
                   std::size_t rows, std::span<const double* const> columns,
                   std::span<double> tau) {
  const Routine routine(driver, built, request);
  std::vector<std::size_t> asked;
  for (std::size_t row = 0; row < rows; ++row)
    if (routine.posed(columns, row)) asked.push_back(row);
  for (const std::vector<std::size_t>& group :
       call_groups(routine.inputs(), std::move(asked), columns, driver.most_points))
    routine.run(group, columns, tau);
}

void add_driver(BuildVariant& variant, const std::string& text) {
  variant.command.push_back("@{dir}/driver.f");
  variant.extra["driver.f"] = text;
}

} // namespace frictab
