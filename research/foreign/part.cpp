// Columns of a part, and small statistics.
#include "foreign/part.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace frictab::foreign {

const Values& Part::at(const std::string& name) const {
  for (const data::Column& column : columns)
    if (column.name == name) return column.values;
  throw std::invalid_argument("no column " + name);
}

bool Part::has(const std::string& name) const {
  return std::any_of(columns.begin(), columns.end(),
                     [&](const data::Column& column) { return column.name == name; });
}

void Part::add(data::Column column) {
  columns.push_back(std::move(column));
}

void Part::add_per_test(const std::string& name, const Values& values,
                        std::vector<std::string> levels) {
  add({name, "", spread(values), std::move(levels)});
}

Values Part::per_test(const std::string& name) const {
  const Values& all = at(name);
  Values values;
  for (std::size_t e = 0; e < tests(); ++e)
    values.push_back(all[first_row[e]]);
  return values;
}

Values Part::spread(const Values& per_test) const {
  Values values(rows());
  for (std::size_t e = 0; e < tests(); ++e)
    for (std::size_t i = first_row[e]; i < first_row[e + 1]; ++i)
      values[i] = per_test[e];
  return values;
}

Values standardised(const Values& values, const Values& of) {
  const double n = static_cast<double>(of.size());
  double mean = 0, square = 0;
  for (const double x : of)
    mean += x / n;
  for (const double x : of)
    square += (x - mean) * (x - mean) / n;
  Values out = values;
  for (double& x : out)
    x = square > 0 ? (x - mean) / std::sqrt(square) : 0;
  return out;
}

double quantile(Values values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

} // namespace frictab::foreign
