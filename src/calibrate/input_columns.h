// The columns of a dataset that a law's inputs stand for: recorded ones, and histories along each
// experiment.
#pragma once

#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "data/dataset.h"
#include "models/assembled_law.h"

namespace frictab::calibrate {

// Which of these inputs the data neither record nor allow to derive: "humidity_pct", "friction_work
// (from s_mm)".
std::vector<std::string> missing_inputs(const std::vector<std::string>& names,
                                        const data::Dataset& data);

// An input with the name of a derived quantity (data/derived.h) is that, whatever is recorded; any
// other is a recorded column, found by its name or by its symbol_of. Numbers of a text column are
// those of the law's levels, whatever the file's.
class InputColumns {
public:
  // The data must outlive this. Throws InputError that names all inputs the data do not have,
  // levels the law does not know, and a column of numbers with a cell that has none.
  InputColumns(const models::Law& law, std::vector<std::string> names, const data::Dataset& data);

  InputColumns(InputColumns&&) = default; // not copied: columns may lie in it
  InputColumns& operator=(InputColumns&&) = default;

  // Some follow the shear stress of the law itself: friction work and power. They are 0 until
  // derive_from_tau().
  bool need_tau() const;
  // Derives those from it.
  void derive_from_tau(std::span<const double> tau);

  const std::vector<std::string>& names() const { return names_; }
  const std::vector<const double*>& pointers() const { return pointers_; }
  std::span<const double> operator[](std::size_t input) const;
  std::vector<std::vector<double>> values() const; // copies
  // Least and largest of each by name, empty cells left aside; none where all cells are empty.
  std::map<std::string, std::pair<double, double>> ranges() const;
  // Of one, over the rows behind condensed data; NaN where all cells are empty.
  std::pair<double, double> range(std::size_t input) const;

private:
  const double* find(const models::Law& law, std::size_t input);

  const data::Dataset* data_;
  std::vector<std::string> names_;
  std::vector<std::vector<double>> own_; // per input; empty: the dataset's own
  std::vector<bool> follows_;
  std::vector<const double*> pointers_;
};

// These columns at the model's own shear stress (self-consistent, never the measured one), and that
// stress. The inputs must hold those of the model's law.
struct Predicted {
  InputColumns columns;
  std::vector<double> tau_MPa;
};
Predicted predict_with_columns(const models::AssembledLaw& law, std::vector<std::string> names,
                               const data::Dataset& data);

// Throws InputError where a formula has no value, as a logarithm below 0.
void check_stress(const std::string& law, const Predicted& predicted, const data::Dataset& data);

// The columns alone; nothing is predicted where no history asks for it.
InputColumns input_columns(const models::AssembledLaw& law, std::vector<std::string> names,
                           const data::Dataset& data);

} // namespace frictab::calibrate
