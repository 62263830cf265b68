// Reads the parts of a workbook's archive as XML.
#include "io/workbook.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "core/error.h"
#include "core/text.h"
#include "io/csv.h"
#include "io/file_streams.h"
#include "io/number.h"
#include "io/number_format.h"
#include "io/zip_archive.h"

namespace frictab::io {

namespace {

constexpr std::uint32_t last_row = 1048576, last_column = 16384; // of Excel
constexpr std::size_t most_bytes = std::size_t{1} << 30;         // of a sheet as text

// The name without the prefix of its namespace, which writers may choose.
std::string_view local_name(const char* name) {
  const std::string_view all = name;
  const std::size_t colon = all.find(':');
  return colon == all.npos ? all : all.substr(colon + 1);
}

pugi::xml_node child(const pugi::xml_node& node, std::string_view name) {
  for (const pugi::xml_node one : node.children())
    if (local_name(one.name()) == name) return one;
  return {};
}

template <class Take>
void for_each_child(const pugi::xml_node& node, std::string_view name, const Take& take) {
  for (const pugi::xml_node one : node.children())
    if (local_name(one.name()) == name) take(one);
}

std::string attribute(const pugi::xml_node& node, std::string_view name) {
  for (const pugi::xml_attribute one : node.attributes())
    if (local_name(one.name()) == name) return one.value();
  return "";
}

bool is_on(const std::string& flag) {
  return flag == "1" || flag == "true" || flag == "on";
}

// The text of a cell or a shared string: of all its runs, without phonetic guides.
std::string text_of(const pugi::xml_node& node) {
  std::string text;
  for (const pugi::xml_node one : node.children()) {
    const std::string_view name = local_name(one.name());
    if (name == "t") text += one.child_value();
    if (name == "r") text += text_of(one);
  }
  return text;
}

struct CellPlace {
  std::uint32_t column, row; // from 0
  bool operator<(const CellPlace& other) const {
    return std::pair(row, column) < std::pair(other.row, other.column);
  }
};

// "BC12"; nullopt beyond Excel's last row or column.
std::optional<CellPlace> place_of(std::string_view reference) {
  std::uint32_t column = 0, row = 0;
  std::size_t i = 0;
  for (; i < reference.size() && reference[i] >= 'A' && reference[i] <= 'Z'; ++i)
    if ((column = column * 26 + static_cast<std::uint32_t>(reference[i] - 'A') + 1) > last_column)
      return std::nullopt;
  for (; i < reference.size() && reference[i] >= '0' && reference[i] <= '9'; ++i)
    if ((row = row * 10 + static_cast<std::uint32_t>(reference[i] - '0')) > last_row)
      return std::nullopt;
  if (i != reference.size() || column == 0 || row == 0) return std::nullopt;
  return CellPlace{column - 1, row - 1};
}

struct Area {
  CellPlace first, last;
};

std::optional<Area> area_of(const std::string& reference) {
  const std::size_t colon = reference.find(':');
  if (colon == reference.npos) return std::nullopt;
  const auto first = place_of(reference.substr(0, colon)),
             last = place_of(reference.substr(colon + 1));
  if (!first || !last || last->row < first->row || last->column < first->column)
    return std::nullopt;
  return Area{*first, *last};
}

struct Cell {
  CellPlace place;
  CellKind kind;
  std::string text;
};

// Folder of a part in the archive, with a slash.
std::string folder_of(const std::string& part) {
  const std::size_t slash = part.rfind('/');
  return slash == part.npos ? "" : part.substr(0, slash + 1);
}

// "/xl/worksheets/sheet1.xml" or "worksheets/sheet1.xml" or "../a.xml", seen from `folder`.
std::string resolved(const std::string& folder, const std::string& target) {
  if (target.starts_with("/")) return target.substr(1);
  return (std::filesystem::path(folder) / target).lexically_normal().generic_string();
}

std::string relations_of(const std::string& part) {
  const std::string folder = folder_of(part);
  return folder + "_rels/" + part.substr(folder.size()) + ".rels";
}

} // namespace

struct Workbook::Data {
  std::string named;
  Parts parts;
  std::vector<Entry> sheets;
  std::vector<std::string> strings;
  std::vector<CellKind> kind_of_style;
  bool since_1904 = false;

  [[noreturn]] void refuse(const std::string& what, const std::string& hint) const {
    throw InputError({named, 0, 0}, what, hint);
  }

  // Parses a part in place; `text` must outlive the document.
  void parse(const std::string& part, std::string& text, pugi::xml_document& document) const {
    const auto result = document.load_buffer_inplace(
        text.data(), text.size(), pugi::parse_default | pugi::parse_ws_pcdata_single);
    if (!result)
      refuse(fmt::format("'{}' in it is damaged: {}", part, result.description()),
             "open the workbook in a spreadsheet program and save it again");
  }

  // Calls take(root) for a part; false if there is none.
  template <class Take> bool with_part(const std::string& part, const Take& take) const {
    std::optional<std::string> text = parts(part);
    if (!text) return false;
    pugi::xml_document document;
    parse(part, *text, document);
    take(document.document_element());
    return true;
  }

  struct Relation {
    std::string type, target;
  };
  std::map<std::string, Relation> relations(const std::string& part) const {
    std::map<std::string, Relation> out;
    with_part(relations_of(part), [&](const pugi::xml_node& root) {
      for_each_child(root, "Relationship", [&](const pugi::xml_node& one) {
        const std::string type = attribute(one, "Type");
        out[attribute(one, "Id")] = {type.substr(type.rfind('/') + 1),
                                     resolved(folder_of(part), attribute(one, "Target"))};
      });
    });
    return out;
  }

  std::string main_part() const {
    for (const auto& [id, relation] : relations(""))
      if (relation.type == "officeDocument") return relation.target;
    return "xl/workbook.xml";
  }

  void read_sheets(const std::string& part, const std::map<std::string, Relation>& known) {
    std::map<std::string, std::string> sheet_of_part;
    const bool there = with_part(part, [&](const pugi::xml_node& root) {
      since_1904 = is_on(attribute(child(root, "workbookPr"), "date1904"));
      for_each_child(child(root, "sheets"), "sheet", [&](const pugi::xml_node& one) {
        const auto found = known.find(attribute(one, "id"));
        if (found == known.end() || found->second.type != "worksheet") return;
        const Entry sheet{attribute(one, "name"), found->second.target,
                          attribute(one, "state").find("idden") != std::string::npos};
        const auto [first, is_new] = sheet_of_part.emplace(sheet.part, sheet.name);
        if (!is_new)
          refuse(
              fmt::format("its sheets '{}' and '{}' are one file in it", first->second, sheet.name),
              "open the workbook in a spreadsheet program and save it again");
        sheets.push_back(sheet);
      });
    });
    if (!there)
      refuse("is an archive, but no workbook of Excel",
             parts("content.xml")
                 ? "a workbook of LibreOffice (.ods)? File, Save as, Excel 2007-365 (.xlsx)"
             : parts("xl/workbook.bin") ? "a binary workbook (.xlsb)? Save it as .xlsx"
                                        : "unpack it, and name the files in it");
  }

  void read_strings(const std::string& part) {
    with_part(part, [&](const pugi::xml_node& root) {
      for_each_child(root, "si",
                     [&](const pugi::xml_node& one) { strings.push_back(text_of(one)); });
    });
  }

  void read_styles(const std::string& part) {
    std::map<int, CellKind> custom;
    with_part(part, [&](const pugi::xml_node& root) {
      for_each_child(child(root, "numFmts"), "numFmt", [&](const pugi::xml_node& one) {
        custom[std::atoi(attribute(one, "numFmtId").c_str())] =
            kind_of_format(attribute(one, "formatCode"));
      });
      for_each_child(child(root, "cellXfs"), "xf", [&](const pugi::xml_node& one) {
        const int id = std::atoi(attribute(one, "numFmtId").c_str());
        const auto own = custom.find(id);
        kind_of_style.push_back(own == custom.end() ? kind_of_built_in_format(id) : own->second);
      });
    });
  }

  void read_all() {
    const std::string part = main_part();
    const auto known = relations(part);
    read_sheets(part, known);
    for (const auto& [id, relation] : known) {
      if (relation.type == "sharedStrings") read_strings(relation.target);
      if (relation.type == "styles") read_styles(relation.target);
    }
  }

  CellKind kind_of(const pugi::xml_node& cell) const {
    const std::size_t style = static_cast<std::size_t>(std::atoi(attribute(cell, "s").c_str()));
    return style < kind_of_style.size() ? kind_of_style[style] : CellKind::number;
  }

  // The value of a cell that is stored as a number.
  Cell number_cell(const CellPlace& place, const std::string& stored, CellKind kind) const {
    double value = 0;
    if (!read_number(stored, '.', value)) return {place, CellKind::text, stored};
    if (kind == CellKind::date) return {place, kind, date_text(value, since_1904)};
    if (kind == CellKind::time) return {place, kind, shortest(seconds_of_days(value))};
    return {place, kind, stored};
  }

  Cell cell_of(const pugi::xml_node& cell, const CellPlace& place) const {
    const std::string type = attribute(cell, "t"), stored = child(cell, "v").child_value();
    if (type == "inlineStr") return {place, CellKind::text, text_of(child(cell, "is"))};
    if (type == "s") {
      const auto at = static_cast<std::size_t>(std::strtoull(stored.c_str(), nullptr, 10));
      if (at >= strings.size())
        refuse(fmt::format("a cell names text {} of {}", stored, strings.size()),
               "open the workbook in a spreadsheet program and save it again");
      return {place, CellKind::text, strings[at]};
    }
    if (type == "d") return {place, CellKind::date, stored};
    if (type == "b") return {place, CellKind::number, stored};
    if (type == "str" || type == "e") return {place, CellKind::text, stored};
    return number_cell(place, stored, kind_of(cell));
  }

  // Cells may share one long text, so that what they take is known only here.
  void check_size(std::size_t bytes) const {
    if (bytes > most_bytes)
      refuse("a sheet of it is larger than 1 GiB as text", "save the sheet as CSV");
  }

  // All cells with content, by row and column.
  std::vector<Cell> cells_of(const pugi::xml_node& root, Sheet& sheet) const {
    std::size_t bytes = 0;
    std::vector<Cell> cells;
    CellPlace next{0, 0};
    for_each_child(child(root, "sheetData"), "row", [&](const pugi::xml_node& row) {
      const auto number = static_cast<std::uint32_t>(std::atoi(attribute(row, "r").c_str()));
      if (number > 0) next.row = number - 1;
      next.column = 0;
      for_each_child(row, "c", [&](const pugi::xml_node& one) {
        const std::string reference = attribute(one, "r");
        const auto place = reference.empty() ? next : place_of(reference);
        if (!place || place->row >= last_row || place->column >= last_column)
          refuse(fmt::format("there is no cell '{}' in a sheet", reference),
                 "open the workbook in a spreadsheet program and save it again");
        Cell cell = cell_of(one, *place);
        if (cell.text.empty()) sheet.uncalculated += !child(one, "f").empty();
        check_size(bytes += cell.text.size());
        if (!cell.text.empty()) cells.push_back(std::move(cell));
        next.column = place->column + 1;
      });
      ++next.row;
    });
    std::stable_sort(cells.begin(), cells.end(),
                     [](const Cell& a, const Cell& b) { return a.place < b.place; });
    return cells;
  }

  // Gives every cell of a merged area its value, which the file holds in the first one.
  void fill_merged(const pugi::xml_node& root, std::vector<Cell>& cells, Sheet& sheet) const {
    constexpr std::size_t most = 1'000'000;
    std::size_t bytes = 0;
    const auto before = [](const Cell& cell, const CellPlace& place) { return cell.place < place; };
    std::vector<Cell> more;
    for_each_child(child(root, "mergeCells"), "mergeCell", [&](const pugi::xml_node& one) {
      const auto area = area_of(attribute(one, "ref"));
      if (!area) return;
      const auto first = std::lower_bound(cells.begin(), cells.end(), area->first, before);
      if (first == cells.end() || area->first < first->place) return; // an empty area
      const std::uint32_t end = std::min(area->last.row, cells.back().place.row);
      for (std::uint32_t row = area->first.row; row <= end; ++row)
        for (std::uint32_t column = area->first.column; column <= area->last.column; ++column)
          if (row != area->first.row || column != area->first.column) {
            check_size(bytes += first->text.size());
            more.push_back({{column, row}, first->kind, first->text});
            if (more.size() > most)
              refuse("more than a million cells of a sheet are merged", "save the sheet as CSV");
          }
    });
    sheet.merged_cells = more.size();
    const auto own = static_cast<std::ptrdiff_t>(cells.size());
    cells.insert(cells.end(), std::make_move_iterator(more.begin()),
                 std::make_move_iterator(more.end()));
    const auto less = [](const Cell& a, const Cell& b) { return a.place < b.place; };
    std::stable_sort(cells.begin() + own, cells.end(), less);
    std::inplace_merge(cells.begin(), cells.begin() + own, cells.end(), less);
    cells.erase(std::unique(cells.begin(), cells.end(),
                            [&](const Cell& a, const Cell& b) {
                              return !less(a, b) && !less(b, a); // a filled one gives way
                            }),
                cells.end());
  }

  // A line per row, so that lines in messages are rows; line breaks in cells become blanks.
  void write(std::vector<Cell>&& cells, Sheet& sheet) const {
    CellPlace at{0, 0};
    for (Cell& cell : cells) {
      const auto [column, row] = cell.place;
      if (row > at.row) {
        sheet.text.append(row - at.row, '\n');
        at = {0, row};
      }
      sheet.text.append(column - at.column, ',');
      at.column = column;
      const bool plain = cell.kind != CellKind::text && cell.kind != CellKind::date;
      for (char& c : cell.text)
        if (c == '\n' || c == '\r') c = ' ';
      sheet.text += plain ? cell.text : csv_cell(cell.text);
      check_size(sheet.text.size());
      if (sheet.kinds.size() <= column) sheet.kinds.resize(column + 1);
      std::vector<Sheet::KindRun>& runs = sheet.kinds[column];
      if (!runs.empty() && runs.back().end == row && runs.back().kind == cell.kind)
        ++runs.back().end;
      else
        runs.push_back({row, row + std::size_t{1}, cell.kind});
    }
    if (!sheet.text.empty()) sheet.text += '\n';
  }
};

CellKind Sheet::kind(std::size_t column, std::size_t row) const {
  if (column >= kinds.size()) return CellKind::empty;
  const auto run = std::upper_bound(kinds[column].begin(), kinds[column].end(), row,
                                    [](std::size_t r, const KindRun& one) { return r < one.end; });
  return run != kinds[column].end() && row >= run->first ? run->kind : CellKind::empty;
}

namespace {

constexpr std::string_view archive_sign = "PK\x03\x04", old_sign = "\xD0\xCF\x11\xE0\xA1\xB1";

} // namespace

bool looks_like_workbook(const std::filesystem::path& path) {
  const std::string start = first_bytes(path, old_sign.size());
  return start.starts_with(archive_sign) || start == old_sign;
}

Workbook::Workbook(const std::filesystem::path& path, const std::string& named) {
  if (first_bytes(path, old_sign.size()) == old_sign)
    throw InputError({named, 0, 0}, "is an old workbook (.xls), or one with a password",
                     "File, Save as, Excel workbook (.xlsx), without a password");
  *this = Workbook([archive = std::make_shared<ZipArchive>(path, named)](
                       const std::string& name) { return archive->read(name); },
                   named);
}

Workbook::Workbook(Parts parts, const std::string& named) : data_(std::make_unique<Data>()) {
  data_->named = named;
  data_->parts = std::move(parts);
  data_->read_all();
}

Workbook::Workbook(Workbook&&) noexcept = default;
Workbook& Workbook::operator=(Workbook&&) noexcept = default;
Workbook::~Workbook() = default;

const std::vector<Workbook::Entry>& Workbook::sheets() const {
  return data_->sheets;
}

Sheet Workbook::read(const std::string& name) const {
  const auto found = std::find_if(data_->sheets.begin(), data_->sheets.end(),
                                  [&](const Entry& one) { return one.name == name; });
  if (found == data_->sheets.end()) {
    std::vector<std::string> names;
    for (const Entry& one : data_->sheets)
      names.push_back(one.name);
    data_->refuse(fmt::format("holds no sheet '{}'", name),
                  names.empty() ? "it holds no sheet of cells at all" : suggest(name, names));
  }
  Sheet sheet;
  const bool there = data_->with_part(found->part, [&](const pugi::xml_node& root) {
    std::vector<Cell> cells = data_->cells_of(root, sheet);
    if (!cells.empty()) data_->fill_merged(root, cells, sheet);
    data_->write(std::move(cells), sheet);
  });
  if (!there)
    data_->refuse(fmt::format("lacks the cells of its sheet '{}'", name),
                  "open the workbook in a spreadsheet program and save it again");
  return sheet;
}

} // namespace frictab::io
