// Data files as a job reads them: whatever comes through is what a dataset promises.
#include <cmath>

#include "data/load.h"
#include "data/quantity.h"
#include "fuzz/target.h"
#include "fuzz/temporary_file.h"

namespace frictab::fuzz::data_target {
namespace {

void check(const data::Dataset& data) {
  promise(data.rows() > 0, "a dataset has rows");
  promise(data.first_row.size() == data.experiments.size() + 1, "each experiment has its rows");
  promise(data.has("sigma_n_MPa") && data.has("tau_R_MPa"), "a dataset has pressure and friction");
  for (const data::Column& column : data.columns) {
    promise(column.values.size() == data.rows(), "each column has all rows");
    const data::Quantity* quantity = data::find_quantity(column.name);
    for (const double value : column.values) {
      promise(!quantity || (std::isfinite(value) && value >= quantity->lowest),
              "a quantity is finite and not below its lowest value");
      promise(column.levels.empty() || (value >= 0 && value < double(column.levels.size())),
              "a text is one of its levels");
    }
  }
}

void read(std::string_view bytes) {
  static const TemporaryFile file("a.csv");
  file.write(bytes);
  check(data::load_dataset({file.path().string()}, {}));
}

const Registered<Target> registered([] { return Target{"data", read}; });

} // namespace
} // namespace frictab::fuzz::data_target
