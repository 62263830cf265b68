// Computes values as the kernels read them, and the size of a source, counted in numbers.
#include "codegen/baked_table.h"

#include <fmt/format.h>

#include "codegen/layer.h"
#include "table/spline.h"

namespace frictab::codegen {

namespace {

// Counts the numbers per node: for a table its position, 1/width and the polynomials of its cell;
// for the law itself, whose axes have only two ends, the end.
std::size_t numbers_per_node(const table::Table& table) {
  if (table.is_direct()) return 1;
  return is_cubic(table) ? 18 : 2;
}

} // namespace

bool is_cubic(const table::Table& table) {
  return table.interpolation == table::Interpolation::cubic && !table.axes.empty();
}

std::vector<double> baked_values(const table::Table& table) {
  if (!is_cubic(table)) return table.value_coordinates();
  std::vector<table::SplineAxis> axes;
  for (const table::TableAxis& axis : table.axes)
    axes.push_back(table::spline_axis(axis));
  return table::spline_coefficients(axes, table.value_coordinates());
}

std::string baked_values_text(const table::Table& table, const std::string& coefficients) {
  return fmt::format("{}{}{}, last axis fastest", is_cubic(table) ? coefficients : "",
                     table.log_value ? "ln " : "", models::quantity_name(table.quantity));
}

std::size_t baked_numbers(const table::Table& table) {
  std::size_t numbers = table.nodes() + table.constants.size() + count_numbers(table.combine);
  for (const table::TableAxis& axis : table.axes)
    numbers += axis.nodes.size() * numbers_per_node(table);
  if (!table.extension) return numbers;
  const LayeredFormula law = split_layer(*table.extension);
  return numbers + law.layer.numbers() + count_numbers(law.rest);
}

} // namespace frictab::codegen
