// Counts cells line by line.
#include "data/first_lines.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/text.h"
#include "data/file_list.h"
#include "data/raw.h"
#include "data/rig_files.h"
#include "io/hdf5.h"
#include "io/number.h"
#include "io/text_file.h"
#include "io/workbook.h"

namespace frictab::data {

namespace {

constexpr std::size_t lines_shown = 8, widest = 60;

std::string described(const std::string& line, const io::CsvFormat& format) {
  const std::vector<std::string> cells = io::cells_of_line(line, format);
  if (cells.empty()) return "blank";
  double ignored = 0;
  std::size_t numbers = 0;
  std::vector<std::string> known;
  for (const std::string& cell : cells) {
    numbers += io::read_number(cell, format.decimal, ignored);
    if (io::is_wanted(cell, format)) known.push_back(io::read_header_name(cell).name);
  }
  return fmt::format("{} {}, {} {}{}", cells.size(), cells.size() == 1 ? "cell" : "cells", numbers,
                     numbers == 1 ? "number" : "numbers",
                     known.empty() ? "" : ", known: " + join(known, ", "));
}

std::string text_of(const FilePlan& plan) {
  const std::string path = path_of(plan).string();
  if (is_rig_file(path) || io::looks_like_hdf5(path)) return "";
  if (!io::looks_like_workbook(path)) return io::read_text_file(path, plan.name);
  return io::Workbook(path, plan.name).read(plan.options.sheets.front()).text;
}

std::string lines_of(const std::string& text, const io::CsvFormat& format) {
  std::string out;
  std::size_t begin = 0;
  for (std::size_t number = 1; number <= lines_shown && begin < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string line = to_utf8(text.substr(begin, end - begin));
    const std::string words = described(line, format);
    std::replace(line.begin(), line.end(), '\t', ' ');
    line.erase(line.find_last_not_of(" \r") + 1);
    line = printable(utf8_start(line, widest));
    line.resize(line.size() + widest - std::min(characters(line), widest), ' ');
    out += fmt::format("{:>5} | {} | {}\n", number, line, words);
    begin = end + 1;
  }
  return out;
}

} // namespace

std::string first_lines(const std::string& named, const DataOptions& options) {
  try {
    std::vector<std::string> files = options.training;
    files.insert(files.end(), options.validation.begin(), options.validation.end());
    const FilePlans plans =
        plan_files(find_files(files, options.base, options.place), ReadRequest(options));
    for (const FilePlan& plan : plans.files)
      if (plan.name == named)
        return lines_of(text_of(plan), csv_format(path_of(plan).string(), plan.options));
  } catch (const InputError&) { // the file is at fault in another way
  }
  return "";
}

} // namespace frictab::data
