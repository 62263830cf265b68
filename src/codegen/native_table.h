// A solver's own friction table as a target: the states that have columns, the numbers, and the
// result when the solver reads them. A target adds its text: how the numbers are written and read
// back.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "codegen/entry_arguments.h"
#include "codegen/native_grid.h"
#include "codegen/solver_inputs.h"
#include "table/plain_text.h"

namespace frictab::codegen {

enum class NativeFactor {
  pressure,   // Coulomb: tau_R = mu * pressure
  shear_yield // tau_R = m * k; the solver computes k = sigma_f/sqrt(3)
};

// Capabilities of a solver's table.
struct NativeForm {
  // Its columns, of which the first varies fastest: states, then fields if it has any.
  SolverGives gives;
  NativeFactor factor = NativeFactor::pressure;
  bool limits = false; // has a largest shear stress in addition to the table
  // Writes a column on which nothing depends as well, with two nodes.
  bool every_column = false;
  std::size_t most_fields = 0;
  // How the solver interpolates, and how certain that is; for comments.
  std::string interpolation;
};

struct NativeColumn {
  InputArgument argument;
  std::string state;     // row of the solver's table, "sigma_n_MPa"; empty: a field
  std::size_t field = 0; // number of the field, from 1
  std::string text;      // "column 2, slip rate"
};

// Returns the columns of this request's table, in the order of its text. Throws InputError with the
// faults of the job's [export.inputs], and if a state's value or range is unknown.
std::vector<NativeColumn> native_columns(const ExportRequest& request, const NativeForm& form);

// Returns the fixed states, those without a column, at the job's constants or the middle of their
// ranges.
table::FixedStates native_fixed_states(const ExportRequest& request, const NativeForm& form);

struct NativeTable {
  std::vector<NativeColumn> columns;
  NativeValues values; // nodes per column; empty: the law does not depend on it
  table::FixedStates fixed;
  double aim_MPa = 0, found_MPa = 0;
  bool met = false;
};

// Returns the function of the columns that such a table represents, tau_R at the fixed states.
NativeProblem native_problem(const ExportRequest& request, const NativeForm& form);

// Builds the table to the attribute tolerance_MPa of the request's table (0.5 if it has none). If
// that table has sampled values, its own drift is subtracted first.
NativeTable native_table(const ExportRequest& request, const NativeForm& form);

// Returns the texts that such files begin with: law, data, units.
std::vector<std::string> native_head(const Exporter& exporter, const ExportRequest& request);

// Returns comment lines without their mark, of at most 90 columns: law, data, units, the solver's
// interpolation, fixed states, drift of the grid.
std::vector<std::string> native_comments(const Exporter& exporter, const ExportRequest& request,
                                         const NativeForm& form, const NativeTable& table);

// Returns recipe.json: columns as `arguments`, `held`, `grid`. `input_deck`: lines to be pasted.
std::string native_recipe(const Exporter& exporter, const ExportRequest& request,
                          const NativeForm& form, const NativeTable& table,
                          const SourceBundle& files, const std::string& entry,
                          const std::string& input_deck);

// Computes tau_R from a coefficient of the columns (solver's units), at most `limit` (MPa in the
// solver's unit), as the solver does.
using NativeCoefficient = std::function<double(std::span<const double> columns)>;
void drive_coefficient(const NativeForm& form, const NativeCoefficient& coefficient,
                       std::optional<double> limit, const ExportRequest& request, std::size_t rows,
                       std::span<const double* const> columns, std::span<double> tau);

// The only variant of such a target: nothing is compiled, numbers have nine digits.
BuildVariant native_deck();

// Names of such a target's text, for its recipe and `frictab table convert`.
struct NativeText {
  std::string file;       // "frictab_friction.k"
  std::string entry;      // for the recipe: "*FRICTION"
  std::string input_deck; // lines to be pasted
  std::string plain_name;
  int plain_order = 0;
  std::string plain_title;
};

// A target with such a table: nothing is compiled, the text is read.
class NativeTarget : public Exporter {
public:
  SourceBundle generate(const ExportRequest& request) const final;
  std::vector<BuildVariant> variants(const ExportRequest& request) const final;
  void drive(const Built& built, const ExportRequest& request, std::size_t rows,
             std::span<const double* const> columns, std::span<double> tau) const final;
  bool is_routine() const final { return false; }
  // Returns a table that is linear between the nodes of its columns, tau_R from the coefficient.
  // Its inputs are the columns on which the coefficient depends, and those of the factor.
  table::Table own_table(const ExportRequest& request, const SourceBundle& files) const final;
  table::FixedStates fixed_states(const ExportRequest& request) const final;
  bool gives_mu(const ExportRequest& request) const final;

  // Writes the same text for `table convert`, with the constants of the command as fixed states.
  // Throws InputError for a state that is neither fixed nor a column.
  std::string plain_text(const table::PlainRequest& request) const;
  const NativeText& text() const { return text_; }

protected:
  NativeTarget(TargetDescription description, NativeText text)
      : Exporter(std::move(description)), text_(std::move(text)) {}

private:
  virtual NativeForm form(const ExportRequest& request) const = 0;
  virtual std::string write(const ExportRequest& request, const NativeTable& table,
                            const std::vector<std::string>& comments) const = 0;
  // Throws std::runtime_error if the text is not as it was written.
  virtual NativeValues read(const std::string& text, const ExportRequest& request) const = 0;

  NativeText text_;
};

table::PlainFormat native_plain_format(const std::shared_ptr<const NativeTarget>& target);

// Registers both, by `const RegisteredNative<Target> registered;` at the end of a target's file.
template <class Target> struct RegisteredNative {
  Registered<ExporterPointer> exporter{make_exporter<Target>};
  Registered<table::PlainFormat> plain_format{
      [] { return native_plain_format(std::make_shared<Target>()); }};
};

// Sentence for the notes of every such target about states without a column.
inline constexpr const char* native_fixed_words =
    "is held at the job's constant:VALUE, else in the middle of its range, as the file, "
    "recipe.json (held) and the run say; verify.json has what that costs on the validation rows. ";

// Returns the nodes at which value number i applies, one per column; NaN if the column is blank.
std::vector<double> place_of(const NativeValues& values, std::size_t i);

// Reads numbers strictly: throws std::runtime_error for text that is not a number, or a grid that
// is not complete.
double read_number(std::string_view text);
std::vector<std::string_view> split_cells(std::string_view line, char separator); // trimmed
// Returns the lines except those that start with `comment` or are blank.
std::vector<std::string_view> deck_lines(std::string_view text, std::string_view comment);
// Builds values from one line per value, preceded by its place in each column (NaN: blank); the
// first column varies fastest.
NativeValues values_of_rows(const std::vector<std::vector<double>>& places,
                            const std::vector<double>& value);

} // namespace frictab::codegen
