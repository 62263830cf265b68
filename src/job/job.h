// The job file (TOML) as plain values, with the place of every key for later messages.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"
#include "io/hdf5.h"

namespace frictab {

// How one canonical column is taken from a file.
struct ColumnSource {
  std::vector<std::string> names; // the file's own name; several = the first one present
  std::size_t number = 0;         // or the column's number in the file, from 1
  std::string unit;               // the file's unit; empty = canonical
  std::string times;              // a measured coefficient: multiplied with this canonical column
  double area_mm2 = 0;            // a force over this nominal area gives a stress
  std::size_t slope_rows = 0;     // |d column/d time| by a least-squares line over this many rows
  Place place;
};

struct DropRule {
  std::string column; // canonical
  std::optional<double> below;
  std::optional<double> above;
  Place place;
};

struct DataOptions {
  std::vector<std::string> training;
  std::vector<std::string> validation; // empty: `holdout` of the experiments is held out
  std::vector<std::string> oracle;     // synthetic data: files of the noise-free stress
  double holdout = 0.25;               // share of EXPERIMENTS
  char delimiter = 0;                  // 0: found from the header line (, ; tab | or blanks)
  char decimal = '.';
  std::size_t skip_rows = 0;   // preamble lines before the header
  std::size_t skip_footer = 0; // lines after the data
  bool units_row = false;      // a line of units below the header
  std::vector<DropRule> drop;
  std::map<std::string, ColumnSource> columns;        // by canonical name
  std::map<std::string, double> constants;            // by canonical name
  std::optional<std::vector<std::string>> bystanders; // other columns to keep; absent: all
  std::string base;                                   // directory that relative paths start from
  Place place;                                        // of [data] or of data.training
  Place oracle_place;
};

enum class Loss { l2, l1, huber };

struct ModelOptions {
  std::vector<std::string> use;      // empty: all that the columns allow
  std::string shear_yield = "mises"; // mises | tresca | flow_stress
  bool shear_limit = true;           // tau_R <= k
  Place place;
};

struct CalibrationOptions {
  Loss loss = Loss::l2;
  double huber_delta_MPa = 10; // where |residual| turns from square to linear
  std::uint64_t seed = 1;
  std::size_t bootstrap = 1000;          // resamples of experiments for intervals and comparisons
  std::optional<double> condition_on_mm; // gain per experiment from its first millimetres
  Place place;                           // of condition_on_mm
};

struct AxisOptions {
  std::optional<std::pair<double, double>> range;
  std::optional<std::size_t> nodes;
  std::optional<std::string> spacing;        // "log" | "linear"
  std::vector<std::string> outside{"clamp"}; // clamp | error | law: both sides, or low and high
  Place place;
};

struct TableOptions {
  std::vector<std::string> model{"best"}; // best | names | all
  std::vector<double> quantile{0.5};      // of the experiments: one table each
  double tolerance_MPa = 0.5;
  std::optional<std::string> interpolation; // linear | cubic; absent: linear where that is small
  std::string coordinates = "law";          // law: those in which it is straight | plain: none
  std::optional<std::size_t> nodes;         // the closest table of so many nodes ...
  std::optional<std::size_t> max_bytes;     // ... or so large, instead of one to a tolerance
  std::map<std::string, AxisOptions> axes;  // by canonical name
  double memory_limit_MiB = 256;            // of values; a larger table stays on disk
  Hdf5Storage hdf5;
  Place place;
};

struct ExportOptions {
  std::vector<std::string> targets{"c", "abaqus_vfric"}; // names, or all
  std::string units = "mm-t-s";                          // mm-t-s (MPa, mm/s) | m-kg-s (Pa, m/s)
  std::string form = "table";                            // table | direct: the law itself
  // Where a state comes from that the solver does not give: "constant:1.0", "property" (input deck
  // constant), "field:2" (predefined field variable) or what the target gives by itself ("state",
  // "temperature", "solver"). By canonical name, or by the symbol of a traced law's further input.
  std::map<std::string, std::string> inputs;
  std::map<std::string, Place> input_places;
  std::map<std::string, std::string> options; // choices that targets offer, by their names
  Place place;
};

struct VerifyOptions {
  std::optional<double> max_drift_MPa; // absent: table.tolerance_MPa
  std::size_t samples = 200000;        // points over the whole range
};

struct TraceOptions {
  std::vector<std::string> models{"best"}; // best | names | all that were calibrated
  double alpha = 0.02;                     // family-wise error of a false alarm
  std::vector<std::string> ignore;         // columns that cannot be a cause
  std::optional<double> repeatability;     // relative scatter between repeated tests
  std::string order;                       // column that gives the order of tests
  std::string
      tool_distance; // column of the tool's wear: may be shipped though it follows the order
  Place ignore_place, order_place, tool_distance_place;
};

struct Job {
  std::string file; // as given by the user
  DataOptions data;
  ModelOptions models;
  CalibrationOptions calibration;
  TableOptions table;
  ExportOptions exports;
  VerifyOptions verify;
  TraceOptions trace;
  std::string directory = "out"; // relative to the job file, already joined with its directory
};

// Reads and checks a job file; `set` holds "key=value" overrides (TOML values, dotted keys). Throws
// InputError with every fault of the file: syntax, unknown keys (naming the nearest known one),
// wrong types, values out of bounds, unknown laws, targets and quantities.
Job read_job(const std::string& file, const std::vector<std::string>& set = {});
Job parse_job(std::string_view text, const std::string& file,
              const std::vector<std::string>& set = {});

} // namespace frictab
