// A friction law on a dense grid. It is self-contained (axes, values, the formula that combines
// them to tau_R), so that code which reads a table needs no law.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "expr/expr.h"
#include "models/piece_quantity.h"
#include "table/interpolation.h"
#include "table/record.h"

namespace frictab::table {

// Answer to a query beyond one end of an axis (table/outside.h).
enum class Outside {
  // the tabulated piece at that end; `combine` takes the state itself, unclamped
  clamp,
  error, // NaN; a solver's routine stops the analysis
  law    // the law's own formula, Table::extension
};
const char* outside_name(Outside outside); // "clamp", "error", "law"
std::optional<Outside> find_outside(std::string_view name);

struct TableAxis {
  std::string name;          // canonical
  std::string unit;          // canonical
  std::string long_name;     // meaning, in words
  bool log = false;          // interpolate in ln x
  std::vector<double> nodes; // ascending, canonical unit, >= 2
  // inner nodes at which a cubic spline may bend; it is C2 elsewhere
  std::vector<double> kinks = {};
  Outside below = Outside::clamp; // answer to queries below the first node
  Outside above = Outside::clamp; // answer to queries above the last node
  // Smallest and largest value in the data on which the law was calibrated; absent if not known.
  // The nodes may extend further (table/beyond_data.h).
  std::optional<std::pair<double, double>> data = {};

  std::vector<double> coordinates() const; // x, or ln x
  double
  per_step() const; // 1/step where the coordinates are evenly spaced (1e-9 of a step), else 0
};

// Values of the axes at one node of their grid, row-major.
std::vector<double> values_at(const std::vector<TableAxis>& axes, std::size_t node);

// Drift as stored in a table and in verify.json. All in MPa.
struct Drift {
  double max_abs = 0;
  double mean_abs = 0;
  double rms = 0;
  double p99 = 0;
};

struct Table {
  std::string model;           // law name
  std::vector<TableAxis> axes; // none: the value is one constant
  // row-major, last axis fastest. Empty: the direct form, whose axes only give the range it covers
  std::vector<double> value;
  // Distance of each node from the tests (table/distance.h); empty when unknown; not loaded
  // from files.
  std::vector<double> distance;
  models::PieceQuantity quantity = models::PieceQuantity::mu;
  bool log_value = false; // interpolate in ln value; all values are then > 0
  Interpolation interpolation = Interpolation::linear;
  expr::Expr combine; // tau_R_MPa from "value", state names and constants
  std::optional<expr::Expr>
      extension; // the law's own "value" (never its logarithm) from axes and constants
  std::map<std::string, double> constants; // used in combine and extension
  TableRecord record;
  // the record was read from a file, so that nothing here vouches for its drift
  bool drift_is_claimed = false;

  // States the table needs, in canonical order: axes and the states of combine.
  std::vector<std::string> inputs() const;
  // Range of an input: its axis' if it is one, else the record's; nullopt if there is neither.
  std::optional<std::pair<double, double>> range(const std::string& name) const;
  // Quantile of the experiments that the table represents; 0.5 is the law itself.
  double quantile() const { return record.quantile.value_or(0.5); }
  bool is_direct() const { return interpolation == Interpolation::none; }
  // the value or its ln: the number that is interpolated
  double coordinate(double value_at_a_node) const;
  std::vector<double> value_coordinates() const; // of all values
  std::vector<std::size_t> shape() const;        // nodes per axis
  std::size_t nodes() const;                     // product of shape(); 0 in the direct form
  std::size_t bytes() const;                     // size of values, nodes and constants as doubles
};

// Limit on the states that a table may need, axes included.
inline constexpr std::size_t most_inputs = 24;

// Evaluates a table by the kernel that the generated sources contain.
class TableFunction {
public:
  // Throws InputError where the table needs more than most_inputs.
  explicit TableFunction(const Table& table);
  ~TableFunction();
  TableFunction(const TableFunction&) = delete;
  TableFunction& operator=(const TableFunction&) = delete;

  const std::vector<std::string>& inputs() const;

  // Returns tau_R in MPa for one state, in the order of inputs(). Bit d of *outside: the state lies
  // beyond the d-th of all_ends (table/outside.h): the axes, then inputs that the law clamps.
  double operator()(std::span<const double> state, unsigned* outside = nullptr) const;

  // Returns the same value, and its derivatives by each state (MPa per canonical unit) in one pass.
  // At a node or kink it is one of the two one-sided derivatives; 0 for an axis that was clamped.
  double gradient(std::span<const double> state, std::span<double> derivative,
                  unsigned* outside = nullptr) const;

  // Evaluates all rows; columns in the order of inputs(); outside may be empty. Parallel.
  void evaluate(std::size_t rows, std::span<const double* const> columns, std::span<double> tau,
                std::span<unsigned> outside = {}) const;

private:
  struct Data;
  std::unique_ptr<Data> data_;
};

} // namespace frictab::table
