// Reads the list with the reader of data files.
#include "study/campaign_list.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "core/names.h"
#include "core/text.h"
#include "io/csv.h"
#include "io/text_file.h"

namespace frictab::study {

namespace {

using Column = std::vector<std::string>; // a cell per row

io::CsvTable parse(std::string_view text, const std::string& file,
                   const std::vector<std::string>& text_columns) {
  io::CsvFormat format;
  format.text_columns = text_columns;
  format.wanted = {"name", "files"};
  FaultList faults;
  io::CsvTable table = io::parse_csv(text, file, format, faults);
  faults.throw_if_any();
  return table;
}

Column cells_of(const io::CsvColumn& column, std::size_t rows) {
  Column cells(rows);
  for (const io::CsvColumn::Text& cell : column.texts)
    cells[cell.row] = cell.text;
  return cells;
}

std::vector<std::string> parts_of(const std::string& cell) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= cell.size();) {
    const std::size_t end = std::min(cell.find(';', begin), cell.size());
    std::string part = cell.substr(begin, end - begin);
    part.erase(0, part.find_first_not_of(' '));
    part.erase(part.find_last_not_of(' ') + 1);
    if (!part.empty()) parts.push_back(std::move(part));
    begin = end + 1;
  }
  return parts;
}

void check_names(const std::vector<std::string>& names, const Place& place, FaultList& faults) {
  for (const char* needed : {"name", "files"})
    if (std::ranges::find(names, needed) == names.end())
      faults.add(place, fmt::format("there is no column {}", needed),
                 "the list has the columns name and files, and one per factor");
  std::vector<std::string> sorted = names;
  std::ranges::sort(sorted);
  if (const auto twice = std::ranges::adjacent_find(sorted); twice != sorted.end())
    faults.add(place, fmt::format("column {} stands twice", *twice));
}

} // namespace

std::vector<WrittenCampaign> read_campaign_list(const std::string& file) {
  return parse_campaign_list(io::read_text_file(file, file), file);
}

std::vector<WrittenCampaign> parse_campaign_list(std::string_view text, const std::string& file) {
  const std::vector<std::string> names =
      all_names(parse(text, file, {}).columns, &io::CsvColumn::name);
  const io::CsvTable table = parse(text, file, names);
  FaultList faults;
  check_names(names, {file, table.header_line, 0}, faults);
  faults.throw_if_any();
  std::vector<WrittenCampaign> campaigns(table.rows());
  for (std::size_t row = 0; row < campaigns.size(); ++row)
    campaigns[row].place = {file, table.line[row], 0};
  for (const io::CsvColumn& column : table.columns) {
    const Column cells = cells_of(column, table.rows());
    for (std::size_t row = 0; row < campaigns.size(); ++row) {
      WrittenCampaign& one = campaigns[row];
      if (column.name == "name")
        one.name = cells[row];
      else if (column.name == "files")
        one.files = parts_of(cells[row]);
      else if (column.name == "validation")
        one.validation = parts_of(cells[row]);
      else if (column.name == "set")
        one.set = parts_of(cells[row]);
      else
        one.factors.emplace_back(column.name, cells[row]);
    }
  }
  return campaigns;
}

} // namespace frictab::study
