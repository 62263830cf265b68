// A solver's own friction table as a target: which states it has columns for, the numbers it holds,
// and what it gives when the solver reads them. A target adds its text: how the numbers are written
// and read back.
#pragma once

#include <memory>
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
  shear_yield // tau_R = m * k, k = sigma_f/sqrt(3) by the solver
};

// What a solver's table can hold.
struct NativeForm {
  // Its columns, the first varies fastest: states, then fields where it has any.
  SolverGives gives;
  NativeFactor factor = NativeFactor::pressure;
  bool limits = false;       // it has a largest shear stress beside the table
  bool every_column = false; // a column on which nothing depends is there as well, two nodes
  std::size_t most_fields = 0;
  std::string interpolation; // how the solver reads it, and how sure that is; for comments
};

struct NativeColumn {
  InputArgument argument;
  std::string state;     // the row's, "sigma_n_MPa"; empty: a field
  std::size_t field = 0; // from 1, where it is one
  std::string text;      // "column 2, slip rate"
};

// The columns of this request's table, in the order of its text. Throws InputError with the faults
// of the job's [export.inputs], and where a state's value or range is not known.
std::vector<NativeColumn> native_columns(const ExportRequest& request, const NativeForm& form);

// The states without a column, at the job's constants or the middle of their ranges.
table::HeldStates native_held(const ExportRequest& request, const NativeForm& form);

struct NativeTable {
  std::vector<NativeColumn> columns;
  NativeValues values; // nodes per column; empty: the law does not depend on it
  table::HeldStates held;
  double aim_MPa = 0, found_MPa = 0;
  bool met = false;
};

// Made to the attribute tolerance_MPa of the request's table (0.5 where it has none), of which its
// own drift is taken off where it holds values.
NativeTable native_table(const ExportRequest& request, const NativeForm& form);

// Comment lines without their mark, of at most 90 columns: law, data, units, how the solver reads
// the table, held states, drift of the grid.
std::vector<std::string> native_comments(const Exporter& exporter, const ExportRequest& request,
                                         const NativeForm& form, const NativeTable& table);

// recipe.json: columns as `arguments`, `held`, `grid`. `input_deck`: lines to be pasted.
std::string native_recipe(const Exporter& exporter, const ExportRequest& request,
                          const NativeForm& form, const NativeTable& table,
                          const SourceBundle& files, const std::string& entry,
                          const std::string& input_deck);

// The same as a table of ours: linear between the nodes of its columns, tau_R from the coefficient.
// Its inputs are the columns on which the coefficient depends, and those of the factor.
table::Table native_as_table(const NativeForm& form, const NativeValues& values,
                             const ExportRequest& request);

// tau_R as the solver computes it from values read back from a text. Throws std::runtime_error
// where they do not fit the request.
void drive_native(const NativeForm& form, const NativeValues& values, const ExportRequest& request,
                  std::size_t rows, std::span<const double* const> columns, std::span<double> tau);

// What the text of such a target is called, in its recipe and by `frictab table convert`.
struct NativeText {
  std::string file;       // "frictab_friction.k"
  std::string entry;      // for the recipe: "*FRICTION"
  std::string input_deck; // lines to be pasted
  std::string plain_name;
  int plain_order = 0;
  std::string plain_title;
};

// A target of this kind: nothing is compiled, the text is read.
class NativeTarget : public Exporter {
public:
  SourceBundle generate(const ExportRequest& request) const final;
  std::vector<BuildVariant> variants(const ExportRequest& request) const final;
  void drive(const Built& built, const ExportRequest& request, std::size_t rows,
             std::span<const double* const> columns, std::span<double> tau) const final;
  bool is_routine() const final { return false; }
  table::Table own_table(const ExportRequest& request, const SourceBundle& files) const final;
  table::HeldStates held(const ExportRequest& request) const final;
  bool gives_mu(const ExportRequest& request) const final;

  // The same text as `table convert` writes it, with what the command holds as constants. Throws
  // InputError for a state that is neither held nor a column.
  std::string plain_text(const table::PlainRequest& request) const;
  const NativeText& text() const { return text_; }

protected:
  NativeTarget(TargetDescription description, NativeText text)
      : Exporter(std::move(description)), text_(std::move(text)) {}

private:
  virtual NativeForm form(const ExportRequest& request) const = 0;
  virtual std::string write(const ExportRequest& request, const NativeTable& table,
                            const std::vector<std::string>& comments) const = 0;
  // Throws std::runtime_error where the text is not what was written.
  virtual NativeValues read(const std::string& text, const ExportRequest& request) const = 0;

  NativeText text_;
};

table::PlainFormat native_plain_format(const std::shared_ptr<const NativeTarget>& target);

// `const RegisteredNative<Target> registered;` at the end of a target's file registers both.
template <class Target> struct RegisteredNative {
  Registered<ExporterPointer> exporter{make_exporter<Target>};
  Registered<table::PlainFormat> plain_format{
      [] { return native_plain_format(std::make_shared<Target>()); }};
};

// What the notes of every such target say of a state that is no column.
inline constexpr const char* native_held_states =
    "is held at the job's constant:VALUE, else in the middle of its range, as the file, "
    "recipe.json (held) and the run say; verify.json has what that costs on the validation rows. ";

// The nodes at which value number i holds, one per column; NaN where the column is blank.
std::vector<double> place_of(const NativeValues& values, std::size_t i);

// Reading back, strict: what is no number, or a grid that is not complete, throws
// std::runtime_error.
double read_number(std::string_view text);
std::vector<std::string_view> split_cells(std::string_view line, char separator); // trimmed
// Lines without those that start with `comment` or are blank.
std::vector<std::string_view> deck_lines(std::string_view text, std::string_view comment);
// From one line per value, its place in each column (NaN: blank) before it, the first column
// fastest.
NativeValues values_of_rows(const std::vector<std::vector<double>>& places,
                            const std::vector<double>& value);

} // namespace frictab::codegen
