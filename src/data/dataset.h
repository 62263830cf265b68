// A tribometer campaign in canonical units: columns of rows, grouped by experiment.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace frictab::data {

// Role of a column with respect to friction (data/roles.h).
enum class Role {
  undecided,
  state,    // a canonical quantity
  response, // the measured stress, or a column from which it is computed
  setting,  // one value per test, or set by the rig
  channel,  // measured along with friction, so it may be caused by friction
  outcome,  // known only after the test
  label,
  order,
  clock,
  test,
  ignore
};

struct Column {
  std::string name;                // canonical name, or the file's own for a bystander
  std::string unit;                // canonical unit; empty for a bystander
  std::vector<double> values;      // one per row; the level's index if categorical
  std::vector<std::string> levels; // sorted; not empty for a text column
  Role role = Role::undecided;
  std::string why = {}; // reason for the role
};

// Phase of motion or load in a row (data/phases.h).
enum class Phase : std::uint8_t { sliding, rest, closing, opening, turning, unloaded };
inline constexpr std::size_t phase_count = 6;

// True for a column without a value in any row, which may be text as well as numbers. As text, its
// cells have the level of empty cells in a text column.
bool is_empty(const Column& column);
void make_empty_text(Column& column);

// Offset with the best agreement between two clocks of an experiment (data/join.h).
struct ClockOffset {
  std::string experiment;
  double offset = 0; // added to the second clock it gives the first
  // From pieces of the common span, and from every other row of the second.
  double std_error = 0;
  double correlation = 0; // of the two series at this offset
};

// Half of the difference between the forces of a test's two directions (data/signs.h).
struct ForceOffset {
  double offset = 0, error = 0;  // of column; its standard error
  double friction = 0, load = 0; // medians
};

// A test with signed friction or speed.
struct SignedTest {
  std::string experiment;
  std::string friction_column;
  int speed = 1, friction = 1; // their signs, if the test has one direction
  bool both = false;           // has both directions
  std::optional<ForceOffset> zero = {};
  // The same where the force keeps its sign in both directions: a magnitude, or a zero above the
  // friction. With data.force_zero = "remove" it is `zero`.
  std::optional<ForceOffset> above_friction = {};
  std::optional<double> unloaded = {}; // value of the friction column without load
  // Medians of the friction column at rest and in sliding, and of the load
  struct Rest {
    double friction, sliding, load;
  };
  std::optional<Rest> rest = {};
  // Pieces that slide, with pauses between, where they differ in load or speed; else 1
  std::size_t pieces = 1;
};

// Rows that no rig can measure, left out of fits (data/plausibility.h).
struct RowsApart {
  static constexpr std::size_t named = 3;
  std::string check; // its name, for data.allow_implausible
  std::string what;  // "tau_R_MPa is above the shear yield stress"
  std::size_t rows = 0;
  std::vector<std::string> first; // "t03.csv:21: 812 MPa in test 't03'"
};

class Dataset;

// Files whose rows were condensed to block means and can be read again.
class RowSource {
public:
  virtual ~RowSource() = default;
  // Calls take() once per experiment with all of its rows, in any order and on any thread. Throws
  // InputError if the files have changed and cannot be read.
  virtual void read(const std::function<void(const Dataset& one)>& take) const = 0;
};

// Sum of a ratio over the rows of an experiment with a positive denominator.
struct RatioSum {
  double sum = 0, rows = 0;
};

// Summary of all rows of one experiment before they became blocks.
struct RowsOfExperiment {
  std::shared_ptr<const RowSource> source;
  std::string name; // its name in the source
  std::size_t rows = 0;
  // Smallest and largest value of each numeric column and each history, by name.
  std::map<std::string, std::pair<double, double>> spans;
  RatioSum over_pressure; // tau_R_MPa/sigma_n_MPa
  RatioSum over_flow;     // tau_R_MPa/sigma_f_MPa
};

// A measurement that is impossible or unlikely on any rig (data/plausibility.h).
struct Implausible {
  std::string check; // its name, for data.allow_implausible
  std::size_t rows = 0, of = 0;
  std::string what; // "mu_meas is outside 0.001 to 1"
  std::string hint; // possible cause and remedy
  // True if it is an error; absent: an error if most rows fail.
  std::optional<bool> certain = {};
  bool most() const { return certain.value_or(2 * rows > of); }
};

// A quantity without a unit in the header, the units row, its name or the job.
struct AssumedUnit {
  std::string quantity, column; // canonical; the file's own name
  std::string unit;             // assumed: canonical, or that of a force over an area
  std::string from_name;        // different unit at the end of its name: "Force_kN"; else empty
  bool operator==(const AssumedUnit&) const = default;
};

// How one file, or one sheet of a workbook, was read.
struct FileRead {
  std::string file;
  std::string form;            // "text, cells by ;", "sheet", "HDF5"
  std::size_t header_line = 0; // 0: none
  std::size_t units_line = 0;
  std::size_t rows = 0;
  std::vector<std::string> not_read;         // columns, by name or number
  bool is_like(const FileRead& other) const; // names and rows may differ
};

// Block means of neighbouring rows (data/condense.h).
struct Condensed {
  std::vector<double> rows;        // per block: number of its rows
  std::vector<double> within_MPa2; // per block: sum of squares of tau_R_MPa about its mean
  std::vector<Column> histories;   // per block: means of histories computed row by row (derived.h)
  std::vector<RowsOfExperiment> experiments;
  std::vector<Implausible> implausible; // counted over the rows, before check_plausibility
};

// Rows of one experiment are contiguous and in time order; an experiment is never split.
class Dataset {
public:
  std::vector<Column> columns;
  std::vector<std::string> experiments;  // names, in order of first appearance
  std::vector<std::size_t> first_row{0}; // experiments.size() + 1 entries
  // Number of the recording that each experiment is an interval of; empty: each is one.
  std::vector<std::size_t> recording;
  struct Filed {
    std::string file;      // the name of its tests
    bool interval = false; // one of several between header lines
  };
  std::vector<Filed> filed;         // of each experiment, while files are read
  std::vector<std::string> sources; // files read, as named by the user
  std::vector<FileRead> files;
  std::vector<std::string> file_of; // of each experiment; empty: unknown
  std::uint64_t hash = 0;           // hash of all values and names: the data's fingerprint
  struct Dropped {
    std::string rule; // "tau_R_MPa below 0.1"
    std::size_t rows;
  };
  std::vector<Dropped> dropped;                  // rows left out
  std::array<std::size_t, phase_count> phases{}; // rows read, by phase; all 0: phases are unknown
  // Rows left out as not sliding, if the rows are in memory: time_s, s_mm and tau_R_MPa, `row` (the
  // number in the test from 1), and a text column `phase`.
  std::shared_ptr<const Dataset> aside;
  std::vector<RowsApart> apart;
  std::vector<SignedTest> signs;          // tests with signs, an offset or both directions
  std::vector<std::string> interventions; // notes on rows left out or changed, for summaries
  std::vector<std::string> at_rest;       // tests without a sliding row, which are left out
  // Derived columns: "s_mm integrated from v_rel_mm_s and time_s".
  std::vector<std::string> notes;
  std::vector<ClockOffset> clocks; // of data.join, if found
  // "tests.csv: K7": a test of data.tests or data.join that the data do not have
  std::vector<std::string> unused;
  // Notes on some rows (data/plausibility.h).
  std::vector<std::string> implausible;
  std::vector<std::string> cautions; // what changes the meaning of results; of all parts together
  std::vector<Implausible> counted;  // by checks of rows that are left out
  std::vector<AssumedUnit> assumed;
  std::vector<std::string> unit_questions; // about units that may differ (data/scale.h)
  // Synthetic data only: the noise-free tau_R per row; empty if unknown. Not a column, so that
  // nothing can be fitted to it, and not part of the fingerprint.
  std::vector<double> oracle_MPa;
  // Set if each row is the mean over a block of rows. To count rows use source_rows(), to sum over
  // them row_weights().
  std::optional<Condensed> condensed;

  std::size_t rows() const { return first_row.back(); } // rows in memory
  std::size_t source_rows() const;                      // rows that were read
  std::size_t source_rows(std::size_t experiment) const;
  // Number of source rows per row; empty: one each.
  std::span<const double> row_weights() const;
  double row_weight(std::size_t row) const { return condensed ? condensed->rows[row] : 1; }
  const Column* find(std::string_view name) const;
  bool has(std::string_view name) const { return find(name) != nullptr; }
  // Throws std::logic_error if the column is absent: check has() first.
  std::span<const double> values(std::string_view name) const;

  // The rows of one test in a column of all rows.
  std::span<const double> of_test(std::span<const double> column, std::size_t experiment) const {
    return column.subspan(first_row[experiment], first_row[experiment + 1] - first_row[experiment]);
  }

  // The setting of a test: the text, or the number with six digits. nullopt if the column varies
  // within the test or has no value there.
  std::optional<std::string> level_of_test(const Column& column, std::size_t experiment) const;

  // Copies the experiments listed in `keep` (indices, ascending), with all their rows.
  Dataset subset(std::span<const std::size_t> keep) const;
};

// Sets `hash` from names, values and experiments.
void fingerprint(Dataset& data);

// Fingerprint of two datasets together: 16 hex digits.
std::string fingerprint(const Dataset& training, const Dataset& validation);

// Splits off round(share * units) units of data/recordings.h (at least 1, leaving at least 1),
// drawn with a seed from the contents of their rows: the same tests in other files or another order
// are split alike. Throws InputError for fewer than 2 experiments.
struct Split {
  Dataset training;
  Dataset validation;
};
Split hold_out(const Dataset& data, double share, std::uint64_t seed);

} // namespace frictab::data
