// Blanks out the headers, which keeps the numbers of lines, and reads the rest as CSV.
#include "io/lvm.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "core/no_value.h"
#include "core/text.h"
#include "io/file_streams.h"
#include "io/number.h"

namespace frictab::io::lvm {

namespace {

constexpr std::string_view signature = "LabVIEW Measurement", byte_order_mark = "\xEF\xBB\xBF",
                           end_of_header = "***End_of_Header***",
                           start_of_special = "***Start_Special***",
                           end_of_special = "***End_Special***";

using Cells = std::vector<std::string>;

Cells cells_of(std::string_view line, char separator) {
  Cells cells;
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = std::min(line.find(separator, at), line.size());
    cells.push_back(to_utf8(trimmed(line.substr(at, end - at))));
    at = end + 1;
  }
  while (!cells.empty() && cells.back().empty())
    cells.pop_back();
  return cells;
}

// Cells of each tag of a header, without the tag.
using Tags = std::map<std::string, Cells>;

struct Segment {
  std::size_t names_line = 0; // from 0
  Cells names;                // of its columns
  Tags tags;
};

// Tags that say how the file is written, or hold a value per channel.
bool is_of_format(const std::string& tag) {
  static const std::set<std::string> known = {"LabVIEW Measurement",
                                              "Writer_Version",
                                              "Reader_Version",
                                              "Separator",
                                              "Decimal_Separator",
                                              "Multi_Headings",
                                              "X_Columns",
                                              "Time_Pref",
                                              "Time",
                                              "Channels",
                                              "Samples",
                                              "X_Dimension",
                                              "X0",
                                              "Delta_X",
                                              "Y_Unit_Label",
                                              "Y_Dimension",
                                              "X_Unit_Label",
                                              "***End_of_Header***"};
  return known.count(tag) > 0;
}

bool is_x(const std::string& name) {
  return name == "X_Value";
}

// The header's values of the columns `columns`. A value stands in the column of its channel, after
// the tag; some writers leave out the columns of X.
Cells values_of(const Segment& segment, const std::string& tag,
                const std::vector<std::size_t>& columns) {
  const auto found = segment.tags.find(tag);
  Cells values(columns.size());
  if (found == segment.tags.end()) return values;
  const bool tag_in_column = !segment.names.empty() && is_x(segment.names.front());
  Cells filled;
  std::size_t aligned = 0;
  for (const std::string& cell : found->second)
    if (!cell.empty()) filled.push_back(cell);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::size_t at = columns[i] - (tag_in_column ? 1 : 0);
    if (at < found->second.size()) values[i] = found->second[at];
    aligned += !values[i].empty();
  }
  return aligned < columns.size() && filled.size() == columns.size() ? filled : values;
}

class Parser {
public:
  Parser(std::string text, const std::string& file, CsvFormat format, FaultList& faults)
      : text_(std::move(text)), file_(file), format_(std::move(format)), faults_(faults) {}

  CsvTable table() {
    if (text_.find('\n') == text_.npos) std::replace(text_.begin(), text_.end(), '\r', '\n');
    split();
    blank_special_blocks();
    read_file_header();
    for (std::size_t at = next_end_of_header(data_); at < lines_.size();
         at = next_end_of_header(at + 1))
      read_segment(at);
    if (segments_.empty()) read_names(data_, {});
    pad_rows();
    CsvTable table = parse_csv(joined(), file_, format_, faults_);
    finish(table);
    return table;
  }

private:
  [[noreturn]] void fail(std::size_t line, const std::string& what) const {
    throw InputError(
        {file_, line + 1, 0}, what,
        "the file may be cut short or edited; write it again, or give its rows as CSV");
  }

  void split() {
    for (std::size_t at = 0; at <= text_.size();) {
      const std::size_t end = std::min(text_.find('\n', at), text_.size());
      lines_.push_back(std::string_view(text_).substr(at, end - at));
      at = end + 1;
    }
  }

  void blank_special_blocks() {
    std::optional<std::size_t> opened;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      const bool closes = lines_[i].starts_with(end_of_special);
      if (lines_[i].starts_with(start_of_special)) opened = i;
      if (!opened) continue;
      if (i != *opened && !closes) special_lines_.push_back(lines_[i]);
      lines_[i] = {};
      if (closes) opened.reset(), ++special_;
    }
    if (opened) fail(*opened, "a block ***Start_Special*** is never closed");
  }

  std::size_t next_end_of_header(std::size_t from) const {
    while (from < lines_.size() && !lines_[from].starts_with(end_of_header))
      ++from;
    return from;
  }

  // Value of a tag, before the separator is known.
  std::optional<std::string_view> value_of(std::string_view tag, std::size_t end) const {
    for (std::size_t i = 0; i < end; ++i)
      if (lines_[i].starts_with(tag) && lines_[i].size() > tag.size())
        return trimmed(lines_[i].substr(tag.size() + 1));
    return std::nullopt;
  }

  void read_file_header() {
    const std::size_t end = next_end_of_header(0);
    if (end == lines_.size()) fail(0, "the header has no line ***End_of_Header***");
    const std::string separator = lower_case(value_of("Separator", end).value_or("Tab"));
    if (separator != "tab" && !separator.starts_with("comma"))
      fail(0, fmt::format("the separator '{}' is neither Tab nor Comma", separator));
    format_.delimiter = separator == "tab" ? '\t' : ',';
    format_.decimal = value_of("Decimal_Separator", end).value_or(".").starts_with(",") ? ',' : '.';
    if (format_.delimiter == format_.decimal)
      fail(0, "the comma is the separator and the decimal sign");
    format_.thousands = 0;
    format_.units_row = false;
    format_.skip_footer = 0;
    format_.wanted.clear();
    format_.also_wanted = {};
    data_ = end + 1;
    for (std::size_t i = 0; i < data_; ++i) {
      const Cells cells = cells_of(lines_[i], format_.delimiter);
      if (!cells.empty()) of_file_[cells.front()] = {cells.begin() + 1, cells.end()};
      lines_[i] = {};
    }
  }

  // True for a line that can belong to a segment's header: a tag, then its values.
  bool is_tag(std::string_view line) const {
    const std::string_view first = trimmed(line.substr(0, line.find(format_.delimiter)));
    double ignored = 0;
    return !first.empty() && !read_number(first, format_.decimal, ignored) &&
           !is_x(std::string(first));
  }

  void read_segment(std::size_t end) {
    const std::size_t least = segments_.empty() ? data_ : segments_.back().names_line + 1;
    std::size_t first = end;
    while (first > least && is_tag(lines_[first - 1]))
      --first;
    Tags tags;
    for (std::size_t i = first; i <= end; ++i) {
      Cells cells = cells_of(lines_[i], format_.delimiter);
      const std::string tag = cells.front();
      tags[tag] = {cells.begin() + 1, cells.end()};
      lines_[i] = {};
    }
    read_names(end + 1, std::move(tags));
  }

  void read_names(std::size_t line, Tags tags) {
    while (line < lines_.size() && trimmed(lines_[line]).empty())
      ++line;
    if (line == lines_.size()) fail(line - 1, "the header has no line of column names after it");
    Segment segment{line, cells_of(lines_[line], format_.delimiter), std::move(tags)};
    if (segment.names.empty()) fail(line, "the line of column names has none");
    if (segments_.empty()) {
      format_.skip_rows = line;
      segments_.push_back(std::move(segment));
      return;
    }
    compare(segment);
    lines_[line] = lines_[segments_.front().names_line]; // a repeated header line is an interval
    segments_.push_back(std::move(segment));
  }

  void compare(const Segment& segment) {
    const Segment& first = segments_.front();
    const auto add = [&](const std::string& what, const Cells& here, const Cells& there) {
      faults_.add({file_, segment.names_line + 1, 0},
                  fmt::format("segment {} has the {} {}, the first has {}", segments_.size() + 1,
                              what, join(here, ", "), join(there, ", ")),
                  "segments are intervals of one recording; write others to a file of their own");
    };
    if (segment.names != first.names) return add("columns", segment.names, first.names);
    const auto units = [](const Segment& of) {
      return values_of(of, "Y_Unit_Label", channels_of(of));
    };
    if (units(segment) != units(first)) add("units", units(segment), units(first));
  }

  static bool has_comments(const Segment& segment) {
    return !segment.names.empty() && segment.names.back() == "Comment";
  }

  static std::vector<std::size_t> channels_of(const Segment& segment) {
    std::vector<std::size_t> columns;
    const std::size_t end = segment.names.size() - (has_comments(segment) ? 1 : 0);
    for (std::size_t i = 0; i < end; ++i)
      if (!is_x(segment.names[i])) columns.push_back(i);
    return columns;
  }

  // Adds the cell of the comment to rows that have none.
  void pad_rows() {
    const Segment& first = segments_.front();
    if (!has_comments(first)) return;
    for (std::size_t i = first.names_line + 1; i < lines_.size(); ++i) {
      const auto cells = std::count(lines_[i].begin(), lines_[i].end(), format_.delimiter) + 1;
      if (static_cast<std::size_t>(cells) + 1 == first.names.size() && !trimmed(lines_[i]).empty())
        short_rows_.push_back(i);
    }
  }

  std::string joined() const {
    std::string all;
    all.reserve(text_.size() + short_rows_.size());
    auto next = short_rows_.begin();
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      all += lines_[i].ends_with('\r') ? lines_[i].substr(0, lines_[i].size() - 1) : lines_[i];
      if (next != short_rows_.end() && *next == i)
        all += format_.delimiter + std::string("\"\""), ++next;
      all += '\n';
    }
    return all;
  }

  // ---- the table ----

  void finish(CsvTable& table) const {
    const Segment& first = segments_.front();
    set_units(table);
    const std::size_t comment = first.names.size() - 1;
    if (has_comments(first) && comment < table.columns.size() && is_empty(table.columns[comment]))
      table.columns.erase(table.columns.begin() + static_cast<std::ptrdiff_t>(comment));
    fill_x(table);
    number_x(table);
    note_samples(table);
    add_conditions(table);
    if (special_ > 0)
      table.notes.push_back(fmt::format("{} blocks ***Start_Special***: only lines of a name and a "
                                        "value are read",
                                        special_));
  }

  // Operator, description, test name and the like, as lines above the rows.
  void add_conditions(CsvTable& table) const {
    const auto add = [&](const Tags& tags) {
      for (const auto& [tag, cells] : tags) {
        std::set<std::string> values(cells.begin(), cells.end());
        values.erase("");
        if (!is_of_format(tag) && !values.empty())
          table.above.push_back({tag, join(std::vector(values.begin(), values.end()), "; ")});
      }
    };
    Tags same = segments_.front().tags;
    std::vector<std::string> different;
    for (const Segment& segment : segments_)
      std::erase_if(same, [&](const auto& one) {
        const auto other = segment.tags.find(one.first);
        const bool differs = other == segment.tags.end() || other->second != one.second;
        if (differs && !is_of_format(one.first) && one.first != "Date")
          different.push_back(one.first);
        return differs || of_file_.count(one.first) > 0;
      });
    add(of_file_);
    add(same);
    for (const std::string_view line : special_lines_) {
      Cells cells = cells_of(line, format_.delimiter);
      std::erase(cells, "");
      if (cells.size() == 2 && !is_of_format(cells.front()) &&
          std::ranges::find(table.above, cells.front(), &CsvAbove::name) == table.above.end())
        table.above.push_back({cells.front(), cells.back()});
    }
    if (!different.empty())
      table.notes.push_back("differs between the segments and is not read: " +
                            join(different, ", "));
  }

  void set_units(CsvTable& table) const {
    const Segment& first = segments_.front();
    const std::vector<std::size_t> channels = channels_of(first);
    const Cells units = values_of(first, "Y_Unit_Label", channels),
                dimensions = values_of(first, "X_Dimension", channels);
    for (std::size_t i = 0; i < channels.size() && channels[i] < table.columns.size(); ++i) {
      table.columns[channels[i]].unit = units[i];
      if (dimensions[i] != "Time") continue;
      for (std::size_t x = channels[i]; x-- > 0;)
        if (is_x(first.names[x])) {
          table.columns[x].unit = "s";
          break;
        }
    }
  }

  static bool is_empty(const CsvColumn& column) {
    return column.texts.size() == column.numbers.size() &&
           std::all_of(column.texts.begin(), column.texts.end(),
                       [](const CsvTexts::Text& cell) { return cell.text.empty(); });
  }

  // Computes X_Value where the file gives only its first value and its step.
  void fill_x(CsvTable& table) const {
    const Segment& first = segments_.front();
    const bool has_column = is_x(first.names.front());
    if (has_column && !is_empty(table.columns.front())) return;
    if (has_column) table.columns.erase(table.columns.begin());
    CsvColumn x;
    x.name = "X_Value";
    std::vector<std::array<double, 2>> steps;
    for (const Segment& segment : segments_) {
      const auto step = step_of(segment);
      if (!step) return;
      steps.push_back(*step);
    }
    const Cells dimensions = values_of(first, "X_Dimension", channels_of(first));
    if (!dimensions.empty() && dimensions.front() == "Time") x.unit = "s";
    std::size_t row = 0;
    for (std::size_t i = 0; i < table.rows(); ++i, ++row) {
      if (i > 0 && table.interval[i] != table.interval[i - 1]) row = 0;
      const auto& [start, step] = steps[std::min(table.interval[i], steps.size() - 1)];
      x.numbers.push_back(start + static_cast<double>(row) * step);
    }
    table.columns.insert(table.columns.begin(), std::move(x));
  }

  // X0 and Delta_X, if all channels of the segment share them.
  std::optional<std::array<double, 2>> step_of(const Segment& segment) const {
    std::array<double, 2> step{};
    const std::array<const char*, 2> tags = {"X0", "Delta_X"};
    for (std::size_t i = 0; i < tags.size(); ++i) {
      const Cells cells = values_of(segment, tags[i], channels_of(segment));
      if (cells.empty() || !read_number(cells.front(), format_.decimal, step[i]) ||
          std::any_of(cells.begin(), cells.end(),
                      [&](const std::string& cell) { return cell != cells.front(); }))
        return std::nullopt;
    }
    return step;
  }

  static bool is_equal(const CsvColumn& a, const CsvColumn& b) {
    return a.texts.empty() && b.texts.empty() && a.numbers == b.numbers;
  }

  // Keeps one of equal columns X_Value, and makes the names of others unique.
  static void number_x(CsvTable& table) {
    std::size_t count = 0, equal = 0;
    for (std::size_t i = 0, first = 0; i < table.columns.size(); ++i) {
      if (!is_x(table.columns[i].name)) continue;
      if (++count == 1) {
        first = i;
      } else if (is_equal(table.columns[i], table.columns[first])) {
        table.columns.erase(table.columns.begin() + static_cast<std::ptrdiff_t>(i--));
        ++equal;
      } else {
        table.columns[i].name = fmt::format("X_Value({})", count);
      }
    }
    if (equal > 0)
      table.notes.push_back(
          fmt::format("{} more columns X_Value are equal to the first, which is read", equal));
  }

  void note_samples(CsvTable& table) const {
    std::vector<std::size_t> rows(segments_.size());
    for (const std::size_t interval : table.interval)
      if (interval < rows.size()) ++rows[interval];
    for (std::size_t s = 0; s < segments_.size(); ++s) {
      double most = 0;
      for (const std::string& cell :
           values_of(segments_[s], "Samples", channels_of(segments_[s]))) {
        double samples = 0;
        if (read_number(cell, format_.decimal, samples)) most = std::max(most, samples);
      }
      if (static_cast<double>(rows[s]) < most)
        table.notes.push_back(fmt::format("segment {} has {} rows, its header counts {} samples",
                                          s + 1, thousands(rows[s]), shortest(most)));
    }
  }

  std::string text_;
  const std::string& file_;
  CsvFormat format_;
  FaultList& faults_;
  std::vector<std::string_view> lines_; // of text_; header lines become empty
  std::size_t data_ = 0;                // first line after the file's header
  Tags of_file_;                        // of the file's header
  std::vector<Segment> segments_;
  std::vector<std::size_t> short_rows_;         // lines without a comment
  std::vector<std::string_view> special_lines_; // of text_, inside such blocks
  std::size_t special_ = 0;                     // blocks
};

} // namespace

} // namespace frictab::io::lvm

namespace frictab::io {

bool looks_like_lvm(const std::filesystem::path& file) {
  using lvm::byte_order_mark, lvm::signature;
  const std::string start = first_bytes(file, byte_order_mark.size() + signature.size());
  std::string_view text = start;
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  return text.starts_with(signature);
}

CsvTable parse_lvm(std::string text, const std::string& file, const CsvFormat& format,
                   FaultList& faults) {
  return lvm::Parser(std::move(text), file, format, faults).table();
}

} // namespace frictab::io
