// Reads the noise-free stress and assigns it to its rows.
#include "data/oracle.h"

#include <cmath>
#include <filesystem>
#include <map>

#include <fmt/format.h>

#include "core/text.h"
#include "data/raw.h"

namespace frictab::data {

namespace {

namespace fs = std::filesystem;

using Truth = std::map<std::string, std::vector<double>>; // per experiment, in row order

const io::CsvColumn& needed(const io::CsvTable& table, const std::string& name) {
  for (const io::CsvColumn& column : table.columns)
    if (column.name == name) return column;
  throw InputError({table.file, table.header_line, 0},
                   "there is no column " + name + ", which a file of data.oracle needs",
                   "`frictab twin --oracle` writes such files: experiment, row, tau_oracle_MPa");
}

// Cells of a column as text, including numbers.
std::vector<std::string> texts_of(const io::CsvColumn& column) {
  std::vector<std::string> texts(column.numbers.size());
  for (std::size_t i = 0; i < texts.size(); ++i)
    if (std::isfinite(column.numbers[i])) texts[i] = shortest(column.numbers[i]);
  for (const io::CsvColumn::Text& cell : column.texts)
    texts[cell.row] = cell.text;
  return texts;
}

void read_file_into(Truth& truth, const std::string& file, const DataOptions& options) {
  DataOptions plain; // not in the rig's dialect
  const fs::path path = options.base.empty() ? fs::path(file) : fs::path(options.base) / file;
  FaultList faults;
  const io::CsvTable table = read_raw(path.string(), file, plain, faults);
  faults.throw_if_any();
  const auto experiments = texts_of(needed(table, "experiment"));
  const std::vector<double>& row = needed(table, "row").numbers;
  const std::vector<double>& tau = needed(table, "tau_oracle_MPa").numbers;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    std::vector<double>& values = truth[experiments[i]];
    if (!std::isfinite(tau[i]))
      faults.add(row_place(table, i), "tau_oracle_MPa is not a number");
    else if (row[i] != static_cast<double>(values.size() + 1))
      faults.add(row_place(table, i),
                 fmt::format("row is {}, expected {} of experiment '{}'", row[i], values.size() + 1,
                             experiments[i]),
                 "rows of an experiment count from 1, in the order of the data file");
    values.push_back(tau[i]);
  }
  faults.throw_if_any();
}

void attach(Dataset& data, const Truth& truth, const Place& place, std::size_t& found) {
  std::vector<double> all;
  FaultList faults;
  std::size_t here = 0;
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    const auto values = truth.find(data.experiments[e]);
    if (values == truth.end()) continue;
    ++here;
    const std::size_t rows = data.first_row[e + 1] - data.first_row[e];
    if (values->second.size() != rows)
      faults.add(place,
                 fmt::format("data.oracle has {} rows of experiment '{}', the data have {}",
                             values->second.size(), data.experiments[e], rows),
                 "it must belong to the same data, with no row left out by data.drop");
    all.insert(all.end(), values->second.begin(), values->second.end());
  }
  faults.throw_if_any();
  found += here;
  if (here == data.experiments.size()) data.oracle_MPa = std::move(all);
  if (here > 0 && here < data.experiments.size())
    throw InputError(place,
                     fmt::format("data.oracle has {} of the {} experiments of {}", here,
                                 data.experiments.size(), join(data.sources, ", ")),
                     "give the oracle of every experiment of a file, or leave the file out");
}

} // namespace

void read_oracle(const DataOptions& options, Dataset& training, Dataset& validation) {
  Truth truth;
  for (const std::string& file : options.oracle)
    read_file_into(truth, file, options);
  std::size_t found = 0;
  attach(training, truth, options.oracle_place, found);
  attach(validation, truth, options.oracle_place, found);
  if (found == 0)
    throw InputError(options.oracle_place, "data.oracle has none of the experiments of the data",
                     "it belongs to other data: compare the names of the experiments");
}

} // namespace frictab::data
