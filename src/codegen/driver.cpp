// Groups rows of states into the calls of a routine that one contact point and one call allow.
#include "codegen/driver.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdint>
#include <limits>
#include <numbers>

#include "codegen/combine.h"
#include "codegen/compile.h"
#include "codegen/histories.h"
#include "codegen/solver_units.h"

namespace frictab::codegen {

namespace {

constexpr double some_flow_stress = 480; // MPa, if a law does not take one
// MPa, if a law does not take one: far above the pressures at which a coefficient is limited. A
// power of two changes no bits in mm-t-s.
constexpr double usual_pressure = 1024;

using Ftdriv = void(const std::int32_t* points, const std::int32_t* states, const double* v,
                    const std::int32_t* properties, const double* property,
                    const std::int32_t* fields, const double* field, const std::int32_t* histories,
                    const double* history, double* tau);

// The points of one call, as ftdriv takes them.
struct Block {
  std::vector<double> v, property, field, history, tau;
};

// The routine, and the columns of a table of rows, sorted by the way the driver hands them over.
class Routine {
public:
  Routine(const Driver& driver, const std::vector<SolverInput>& inputs, const Built& built,
          const ExportRequest& request, std::span<const double* const> columns)
      : driver_(driver), inputs_(inputs), columns_(columns),
        stress_(solver_unit("MPa", request.units)),
        call_(reinterpret_cast<Ftdriv*>(Library::address(built.library, "ftdriv_"))),
        constants_(static_cast<double*>(
            Library::address_or_null(built.library, stem(request) + "cons_"))) {
    for (const SolverInput& input : inputs_)
      fields_ = std::max(fields_, input.field);
    direction_ = table_row(direction_name).column;
    turn_ = turn_of(request.table);
    for (const GivenState& state : driver.gives.states)
      table_rows_.push_back(table_row(state.state));
    pressure_ = table_row("sigma_n_MPa").column;
    peak_ = table_row("peak_sigma_n").column;
    temperature_ = table_row("T_contact_C");
    speed_ = table_row("v_rel_mm_s").column;
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      if (is_given(c, "s_mm")) slips_.push_back(columns_[c]);
      // The law's own flow stress, from any source.
      if (inputs_[c].argument.name == "sigma_f_MPa") flow_stress_ = columns_[c];
      if (columns_[c] == direction_) reference_ = inputs_[c].reference;
    }
  }

  // True if a contact point can be in the state of this row, which is not the case if the row
  // contradicts itself. NaN contradicts nothing.
  bool is_representable(std::size_t row) const {
    for (std::size_t i = 1; i < slips_.size(); ++i)
      if (slips_[i - 1][row] != slips_[i][row]) return false;
    if (!histories_are_representable(inputs_, columns_, row)) return false;
    if (direction_ && !turn_.represents(direction_[row], reference_)) return false;
    if (direction_ && speed_ && speed_[row] == 0) return false; // nothing slips that way
    if (driver_.zero_is_no_temperature && temperature_.column &&
        solver_value(temperature_, row) == 0.0)
      return false;
    return !peak_ || !(peak_[row] < (pressure_ ? pressure_[row] : lowest_pressure()));
  }

  void run(std::span<const std::size_t> rows, std::span<double> tau) const {
    Block b;
    b.property.assign(property_count(inputs_), 0.0);
    b.tau.assign(rows.size(), 0.0);
    for (const std::size_t row : rows) {
      for (const TableRow& state : table_rows_)
        b.v.push_back(solver_value(state, row));
      add_row(b, row);
    }
    const auto n = static_cast<std::int32_t>(rows.size());
    const auto ns = static_cast<std::int32_t>(table_rows_.size());
    const auto np = static_cast<std::int32_t>(b.property.size());
    const auto nf = static_cast<std::int32_t>(fields_);
    const auto nh = static_cast<std::int32_t>(b.history.size() / rows.size());
    call_(&n, &ns, b.v.data(), &np, b.property.data(), &nf, b.field.data(), &nh, b.history.data(),
          b.tau.data());
    for (std::size_t k = 0; k < rows.size(); ++k)
      tau[rows[k]] = stress_of(b.tau[k], rows[k]);
  }

private:
  // Values in a row of the solver's table that the law does not take from there.
  enum class Otherwise { zero, pressure, flow_stress, speed };

  struct TableRow {
    const double* column = nullptr; // canonical; null if the law does not take it from there
    SolverUnit unit = {};
    Otherwise otherwise = Otherwise::zero;
  };

  bool is_given(std::size_t column, std::string_view state) const {
    const Source source = inputs_[column].source;
    return inputs_[column].given == state &&
           (source == Source::given || inputs_[column].smoothed_over > 0);
  }

  TableRow table_row(std::string_view state) const {
    for (std::size_t c = 0; c < columns_.size(); ++c)
      if (is_given(c, state)) return {columns_[c], inputs_[c].argument.solver};
    if (state == "sigma_n_MPa") return {nullptr, stress_, Otherwise::pressure};
    if (state == "sigma_f_MPa") return {nullptr, stress_, Otherwise::flow_stress};
    if (state == "v_rel_mm_s" && direction_) return {nullptr, {}, Otherwise::speed};
    return {};
  }

  // The pressure below which a peak is not one, if the law does not take the pressure.
  double lowest_pressure() const {
    return driver_.peak_presses ? std::numeric_limits<double>::denorm_min() : usual_pressure;
  }

  double pressure(std::size_t row) const {
    if (pressure_) return pressure_[row];
    return driver_.peak_presses && peak_ ? peak_[row] : usual_pressure;
  }

  double flow_stress(std::size_t row) const {
    return flow_stress_ ? flow_stress_[row] : some_flow_stress;
  }

  double solver_value(const TableRow& state, std::size_t row) const {
    if (state.column) return state.unit.from_canonical(state.column[row]);
    switch (state.otherwise) {
    case Otherwise::pressure:
      return state.unit.from_canonical(pressure(row));
    case Otherwise::flow_stress:
      return state.unit.from_canonical(flow_stress(row));
    case Otherwise::speed:
      return 1; // any that has a direction
    case Otherwise::zero:
      break;
    }
    return 0.0;
  }

  void add_row(Block& b, std::size_t row) const {
    b.field.resize(b.field.size() + fields_, 0.0);
    double* const field = b.field.data() + (b.field.size() - fields_);
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const double value = inputs_[c].argument.solver.from_canonical(columns_[c][row]);
      if (inputs_[c].source == Source::property) b.property[inputs_[c].property - 1] = value;
      if (inputs_[c].source == Source::field) field[inputs_[c].field - 1] = value;
      if (inputs_[c].source == Source::constant && constants_) constants_[c] = columns_[c][row];
    }
    const std::vector<double> past = history_values(inputs_, columns_, row);
    b.history.insert(b.history.end(), past.begin(), past.end());
  }

  double stress_of(double result, std::size_t row) const {
    switch (driver_.result) {
    case fortran::Coefficient::stress:
      return stress_.to_canonical(result);
    case fortran::Coefficient::coulomb:
      return result * std::abs(pressure(row));
    case fortran::Coefficient::shear:
      break;
    }
    return result * flow_stress(row) * std::numbers::inv_sqrt3;
  }

  const Driver& driver_;
  const std::vector<SolverInput>& inputs_;
  std::span<const double* const> columns_; // canonical, the first of inputs_
  SolverUnit stress_;
  Ftdriv* call_;
  double* constants_; // null if the source has no constants that can be set
  std::size_t fields_ = 0;
  std::vector<TableRow> table_rows_; // in the order of Driver::gives
  std::vector<const double*> slips_; // sliding distances that share the solver's one row
  TableRow temperature_;
  // Null if the law does not take them (the first two: from the solver).
  const double *pressure_ = nullptr, *peak_ = nullptr, *flow_stress_ = nullptr;
  const double *speed_ = nullptr, *direction_ = nullptr;
  Turn turn_;
  Axis reference_ = {};
};

// Groups rows that can share a call, at most `most` each: properties are constants of a call, so
// all rows of a group have the same.
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

void drive_routine(const Driver& driver, const std::vector<SolverInput>& inputs, const Built& built,
                   const ExportRequest& request, std::size_t rows,
                   std::span<const double* const> columns, std::span<double> tau) {
  const Routine routine(driver, inputs, built, request, columns);
  std::vector<std::size_t> asked;
  for (std::size_t row = 0; row < rows; ++row)
    if (routine.is_representable(row)) asked.push_back(row);
  for (const std::vector<std::size_t>& group :
       call_groups(inputs, std::move(asked), columns, driver.most_points))
    routine.run(group, tau);
}

} // namespace frictab::codegen
