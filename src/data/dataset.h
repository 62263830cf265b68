// A tribometer campaign in canonical units: columns of rows, cut into experiments.
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

// What a column is to friction (data/roles.h).
enum class Role {
  undecided,
  state,    // a canonical quantity
  response, // what the measured stress is computed from, or equals
  setting,  // one value per test, or set by the rig
  channel,  // measured along with friction: may follow from it
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
  std::vector<double> values;      // one per row; the level's index where categorical
  std::vector<std::string> levels; // not empty: a text column; sorted
  Role role = Role::undecided;
  std::string why = {}; // it has this role
};

// What a row shows of friction (data/phases.h).
enum class Phase : std::uint8_t { sliding, rest, closing, opening, turning, unloaded };
inline constexpr std::size_t phase_count = 6;

// A column without a value in any row may be text as well as numbers. As text, its cells have the
// level of their own that empty cells of a text column have.
bool is_empty(const Column& column);
void make_empty_text(Column& column);

// Where two clocks of an experiment agree best (data/join.h).
struct ClockOffset {
  std::string experiment;
  double offset = 0;      // added to the second clock it gives the first
  double std_error = 0;   // from pieces of the common span, and from every other row of the second
  double correlation = 0; // of the two series at this offset
};

// What the forces of a test's two directions differ by, half of it (data/signs.h).
struct ForceOffset {
  double offset = 0, error = 0;  // of column; its standard error
  double friction = 0, load = 0; // in the middle
};

// A test whose friction or speed has a sign.
struct SignedTest {
  std::string experiment;
  std::string friction_column;
  int speed = 1, friction = 1; // their signs, where the test has one direction
  bool both = false;           // directions
  std::optional<ForceOffset> zero = {};
  std::optional<double> unloaded = {}; // what the friction column shows without load
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

// Files whose rows were held as means over blocks, and can be read once more.
class RowSource {
public:
  virtual ~RowSource() = default;
  // Calls take() for each experiment by itself, all of its rows at once, in any order and on any
  // thread. Throws InputError where the files have changed so that they cannot be read.
  virtual void read(const std::function<void(const Dataset& one)>& take) const = 0;
};

// Sum of a ratio over the rows of an experiment where what stands below is positive.
struct RatioSum {
  double sum = 0, rows = 0;
};

// What one experiment was before its rows became blocks: of all of its rows.
struct RowsOfExperiment {
  std::shared_ptr<const RowSource> source;
  std::string name; // as its source calls it
  std::size_t rows = 0;
  // Least and largest value of each column that holds numbers, and of each history, by name.
  std::map<std::string, std::pair<double, double>> spans;
  RatioSum over_pressure; // tau_R_MPa/sigma_n_MPa
  RatioSum over_flow;     // tau_R_MPa/sigma_f_MPa
};

// What a rig cannot have measured, or hardly (data/plausibility.h).
struct Implausible {
  std::string check; // its name, for data.allow_implausible
  std::size_t rows = 0, of = 0;
  std::string what; // "mu_meas is outside 0.001 to 1"
  std::string hint; // what it may be, and how to mend it
  // Whether it is an error; absent: where most rows fail.
  std::optional<bool> certain = {};
  bool most() const { return certain.value_or(2 * rows > of); }
};

// A quantity whose unit nobody gave: neither a header, nor a units row, nor its name, nor the job.
struct AssumedUnit {
  std::string quantity, column; // canonical; the file's own name
  std::string unit;             // taken: canonical, or that of a force over an area
  std::string from_name;        // another unit that its name ends with: "Force_kN"; else empty
  bool operator==(const AssumedUnit&) const = default;
};

// Rows held as means over blocks of neighbours (data/condense.h).
struct Condensed {
  std::vector<double> rows;        // per block: how many rows it stands for
  std::vector<double> within_MPa2; // per block: sum of squares of tau_R_MPa about its mean
  std::vector<Column> histories;   // per block: means of histories taken row by row (derived.h)
  std::vector<RowsOfExperiment> experiments;
  std::vector<Implausible> implausible; // counted over the rows, before check_plausibility
};

// Rows of one experiment are contiguous and in time order; an experiment is never split.
class Dataset {
public:
  std::vector<Column> columns;
  std::vector<std::string> experiments;  // names, in order of first appearance
  std::vector<std::size_t> first_row{0}; // experiments.size() + 1 entries
  // Of each experiment the number of the recording it is an interval of; empty: each is one.
  std::vector<std::size_t> recording;
  struct Filed {
    std::string file;      // as its tests are called
    bool interval = false; // one of several between header lines
  };
  std::vector<Filed> filed;         // of each experiment, while files are read
  std::vector<std::string> sources; // files read, as named by the user
  std::vector<std::string> file_of; // of each experiment; empty: unknown
  std::uint64_t hash = 0;           // of all values and names: the data's fingerprint
  struct Dropped {
    std::string rule; // "tau_R_MPa below 0.1"
    std::size_t rows;
  };
  std::vector<Dropped> dropped;                  // rows left out
  std::array<std::size_t, phase_count> phases{}; // rows read, by phase; all 0: phases are not known
  // Rows that were left out as not sliding, of rows that are held: time_s, s_mm and tau_R_MPa,
  // their number in the test from 1, `row`, and a text column `phase`.
  std::shared_ptr<const Dataset> aside;
  std::vector<RowsApart> apart;
  std::vector<SignedTest> signs;          // tests that are not plain
  std::vector<std::string> interventions; // notes on what was left out or changed, for summaries
  std::vector<std::string> at_rest;       // tests without a row that slides: they are left out
  std::vector<std::string> notes;  // what was derived: "s_mm integrated from v_rel_mm_s and time_s"
  std::vector<ClockOffset> clocks; // of data.join, where they were found
  std::vector<std::string> unused; // "tests.csv: K7": a test beside the data that none of them has
  std::vector<std::string> implausible; // what some rows cannot have been (data/plausibility.h)
  std::vector<Implausible> counted;     // by checks that look at rows which are left out
  std::vector<AssumedUnit> assumed;
  std::vector<std::string> unit_questions; // of those that may be another one (data/scale.h)
  // Synthetic data only: the noise-free tau_R per row; empty where it is not known. Not a column,
  // so that nothing can be fitted to it, and not part of the fingerprint.
  std::vector<double> oracle_MPa;
  // Set: a row is the mean over a block of rows. What counts rows asks rows_behind(), what sums
  // over them row_weights().
  std::optional<Condensed> condensed;

  std::size_t rows() const { return first_row.back(); } // that are held
  std::size_t rows_behind() const;                      // that were read
  std::size_t rows_behind(std::size_t experiment) const;
  // Per row how many it stands for; empty: one each.
  std::span<const double> row_weights() const;
  double row_weight(std::size_t row) const { return condensed ? condensed->rows[row] : 1; }
  const Column* find(std::string_view name) const;
  bool has(std::string_view name) const { return find(name) != nullptr; }
  // Throws std::logic_error where the column is absent: ask has() first.
  std::span<const double> values(std::string_view name) const;

  // What a test was set to: the text, or the number with six digits. Nothing where the column
  // varies within the test, or has no value there.
  std::optional<std::string> level_of_test(const Column& column, std::size_t experiment) const;

  // The experiments listed in `keep` (indices, ascending), whole.
  Dataset subset(std::span<const std::size_t> keep) const;
};

// Sets `hash` from names, values and experiments.
void fingerprint(Dataset& data);

// Of two datasets together: 16 hex digits.
std::string fingerprint(const Dataset& training, const Dataset& validation);

// Splits off round(share * units) of data/recordings.h (at least 1, leaving at least 1), drawn by
// seed from what their rows hold: the same tests in other files, or in another order, are split
// alike. Throws InputError where there are fewer than 2 experiments.
struct Split {
  Dataset training;
  Dataset validation;
};
Split hold_out(const Dataset& data, double share, std::uint64_t seed);

} // namespace frictab::data
