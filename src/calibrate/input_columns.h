// Columns of a dataset for a law's inputs: recorded ones, and histories along each experiment.
#pragma once

#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "data/dataset.h"
#include "models/assembled_law.h"

namespace frictab::calibrate {

// Returns the inputs that the data neither record nor allow to derive: "humidity_pct",
// "friction_work (from s_mm)".
std::vector<std::string> missing_inputs(const std::vector<std::string>& names,
                                        const data::Dataset& data);

// Columns by input. An input with the name of a derived quantity (data/derived.h) is always
// derived, even if a column of that name is recorded; any other is a recorded column, found by its
// name or by its symbol_of. Text columns are numbered by the law's levels, not by the file's.
class InputColumns {
public:
  // The data must outlive this. Throws InputError that names all inputs missing from the data,
  // levels unknown to the law, or a numeric column with an empty cell.
  InputColumns(const models::Law& law, std::vector<std::string> names, const data::Dataset& data);

  InputColumns(InputColumns&&) = default; // not copied: pointers_ may point into it
  InputColumns& operator=(InputColumns&&) = default;

  // Whether some follow the law's own shear stress (friction work and power). These are 0 until
  // derive_from_tau().
  bool need_tau() const;
  // Derives those inputs from the stress.
  void derive_from_tau(std::span<const double> tau);

  const std::vector<std::string>& names() const { return names_; }
  const std::vector<const double*>& pointers() const { return pointers_; }
  std::span<const double> operator[](std::size_t input) const;
  std::vector<std::vector<double>> values() const; // copies
  // Returns the range of each input by name, ignoring empty cells; inputs without a value are
  // omitted.
  std::map<std::string, std::pair<double, double>> ranges() const;
  // Range of one input, over the source rows of condensed data; NaN if all cells are empty.
  std::pair<double, double> range(std::size_t input) const;

private:
  const double* find(const models::Law& law, std::size_t input);

  const data::Dataset* data_;
  std::vector<std::string> names_;
  std::vector<std::vector<double>> own_; // per input; empty: the dataset's own
  std::vector<bool> follows_;
  std::vector<const double*> pointers_;
};

// Columns at the model's own shear stress (self-consistent, never the measured one), and that
// stress. `names` must include the inputs of the model's law.
struct Predicted {
  InputColumns columns;
  std::vector<double> tau_MPa;
};
Predicted predict_with_columns(const models::AssembledLaw& law, std::vector<std::string> names,
                               const data::Dataset& data);

// Throws InputError if a formula has no value in a row, such as the logarithm of a negative number.
void check_stress(const std::string& law, const Predicted& predicted, const data::Dataset& data);

// Returns the columns alone; predicts the stress only if a history needs it.
InputColumns input_columns(const models::AssembledLaw& law, std::vector<std::string> names,
                           const data::Dataset& data);

} // namespace frictab::calibrate
