// Small tables made by hand, one per way a table can differ; no law is needed.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "codegen/exporter.h"
#include "table/table.h"

namespace frictab::test {

table::Table constant_table();  // no axis: mu = 0.08, tau = mu sigma_N
table::Table one_axis_table();  // psi, even nodes; the table is tau_R itself
table::Table four_axis_table(); // log and linear, even and uneven nodes; ln value; shear limit
table::Table branching_table(); // sliding distance; where, minimum, maximum, power, exp, constants
table::Table traced_table();    // six axes, one of them a column that is not canonical
// Every history that needs a state variable of its own, one of them an axis; neither speed nor
// temperature is a state.
table::Table further_histories_table();
table::Table
spline_table(); // cubic: axes of 7 (with a kink), 5, 3 and 2 nodes; ln value; shear limit
table::Table spline_axis_table(); // cubic, one axis

// No axis; what a traced effect brought in: a number held at 30 and 60.
table::Table held_inputs_table();

table::Table sides_table();    // each way to go on beyond an end; uneven nodes; ln value
table::Table direct_table();   // no values: a closed form, on some sides held at its range
table::Table direct_network(); // no values: three nets of four units

// Of plain numbers, for people to read: what every target writes of it lies in examples/generated.
table::Table example_table();

// Axes friction_work and peak_sigma_n, as traced effects add them; not among sample_tables().
table::Table history_table();

struct NamedTable {
  std::string name;
  table::Table table;
};
const std::vector<NamedTable>& sample_tables();
// Units and the choices that a target offers change what stands around the core of a routine, not
// the core: they are swept over these samples, which have arguments and histories of every kind.
// (LongAgreement takes all samples through each target with a core of its own, SlowCalculix with
// bounds checked.)
bool has_every_kind_of_argument(const NamedTable& sample);

// The job's [export.inputs] for a sample: a flow stress for targets whose solver knows none and
// takes a constant, or holds it. The samples have no range of it to take one from.
std::map<std::string, std::string> sample_inputs(const codegen::Exporter& exporter);

// What a target is asked for of a sample: sample_inputs(); a solver's own table gets a tolerance
// that keeps its text short (the samples' values are rough).
class SampleRequest {
public:
  SampleRequest(const codegen::Exporter& exporter, const table::Table& table,
                const codegen::SolverUnits& units);
  codegen::ExportRequest get() const { return {table_, units_, inputs_}; }

private:
  table::Table table_;
  codegen::SolverUnits units_;
  std::map<std::string, std::string> inputs_;
};

// Rows of states, column-wise in the order of table.inputs(), `spread` (0.1 = 10 %) beyond every
// end of its axes; states that are no axis lie in 100 .. 1000. States in `fixed` (name, value) keep
// that value.
class States {
public:
  States(const table::Table& table, std::size_t rows, std::uint64_t seed, double spread = 0.1,
         const std::map<std::string, double>& fixed = {});
  std::size_t rows() const { return rows_; }
  const std::vector<const double*>& columns() const { return pointers_; }
  std::vector<double>& column(std::size_t c) { return values_[c]; }

private:
  std::size_t rows_;
  std::vector<std::vector<double>> values_;
  std::vector<const double*> pointers_;
};

// tau_R by frictab itself, through the shared kernel.
std::vector<double> expected(const table::Table& table, const States& states);

// Largest |a-b| / max(|b|, floor); infinite where one is NaN and the other is not.
double worst_relative(const std::vector<double>& a, const std::vector<double>& b,
                      double floor = 1e-3);

} // namespace frictab::test
