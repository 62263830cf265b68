// A friction law on a dense grid. Self-contained: axes, values, how to combine them to tau_R. What
// reads a table needs no law.
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

// What a query beyond one end of an axis gets (table/outside.h).
enum class Outside {
  clamp, // the tabulated piece at that end; the formula behind it takes the state as it is
  error, // NaN; a solver's routine stops the analysis
  law    // the law's own formula, Table::extension
};
const char* outside_name(Outside outside); // "clamp", "error", "law"
std::optional<Outside> find_outside(std::string_view name);

struct TableAxis {
  std::string name;               // canonical
  std::string unit;               // canonical
  std::string long_name;          // meaning
  bool log = false;               // interpolate in ln x
  std::vector<double> nodes;      // ascending, canonical unit, >= 2
  std::vector<double> kinks = {}; // inner nodes at which a cubic spline may bend; else it is C2
  Outside below = Outside::clamp; // queries under the first node
  Outside above = Outside::clamp; // and over the last
  // Least and largest in the data that the law was calibrated on; absent: not known. The nodes may
  // reach further (table/beyond_data.h).
  std::optional<std::pair<double, double>> data = {};

  std::vector<double> coordinates() const; // x, or ln x
  double
  per_step() const; // 1/step where the coordinates are evenly spaced (1e-9 of a step), else 0
};

// Drift as it is written into a table and into verify.json. All in MPa.
struct Drift {
  double max_abs = 0;
  double mean_abs = 0;
  double rms = 0;
  double p99 = 0;
};

struct Table {
  std::string model;           // law name
  std::vector<TableAxis> axes; // none: the value is one constant
  std::vector<double> value;   // row-major, last axis fastest. Empty: the direct form, whose axes
                               // say only over which range it holds
  // Per node, how far it is from the nearest test (table/distance.h); empty: not known, or read
  // from a file, where it is for others to read.
  std::vector<double> distance;
  models::PieceQuantity quantity = models::PieceQuantity::mu;
  bool log_value = false; // interpolate in ln value; every value is then > 0
  Interpolation interpolation = Interpolation::linear;
  expr::Expr combine; // tau_R_MPa of "value", state names and constants
  std::optional<expr::Expr>
      extension; // the law's own "value" (never its logarithm) of axes and constants
  std::map<std::string, double> constants; // of combine and extension
  TableRecord record;
  bool drift_is_claimed = false; // the record was read from a file that nothing here vouches for

  // States the table needs, canonical order: axes and the states of combine.
  std::vector<std::string> inputs() const;
  // Of an input: its axis', else the record's; nullopt where neither is there.
  std::optional<std::pair<double, double>> range(const std::string& name) const;
  // Of the experiments; 0.5 is the law itself.
  double quantile() const { return record.quantile.value_or(0.5); }
  bool is_direct() const { return interpolation == Interpolation::none; }
  double coordinate(double value_at_a_node) const; // it, or its ln: what is interpolated
  std::vector<double> value_coordinates() const;   // of all values
  std::vector<std::size_t> shape() const;          // nodes per axis
  std::size_t nodes() const;                       // their product; 0 in the direct form
  std::size_t bytes() const;                       // values, nodes and constants as doubles
};

// States that a table may need, axes included.
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

  // tau_R in MPa for one state, in the order of inputs(). Bit d of *outside: the state lies beyond
  // the d-th of all_ends (table/outside.h): the axes, then inputs that are held.
  double operator()(std::span<const double> state, unsigned* outside = nullptr) const;

  // The same value, and its derivatives by each state (MPa per canonical unit) in one pass. At a
  // node or kink one of the two one-sided derivatives; 0 by an axis that was clamped.
  double gradient(std::span<const double> state, std::span<double> derivative,
                  unsigned* outside = nullptr) const;

  // For all rows; columns in the order of inputs(); outside may be empty. Parallel.
  void evaluate(std::size_t rows, std::span<const double* const> columns, std::span<double> tau,
                std::span<unsigned> outside = {}) const;

private:
  struct Data;
  std::unique_ptr<Data> data_;
};

} // namespace frictab::table
