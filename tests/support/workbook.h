// Workbooks by hand: XML files in a ZIP archive.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <zip.h>

#include "core/text.h"

namespace frictab::test {

// Content of a cell as XML: <c r="A1" .../>; `kind` is its attributes.
struct XmlCell {
  std::string attributes, content;
};
inline XmlCell text_cell(const std::string& text) {
  return {"t=\"inlineStr\"", "<is><t xml:space=\"preserve\">" + text + "</t></is>"};
}
inline XmlCell number_cell(const std::string& number, int style = 0) {
  return {fmt::format("s=\"{}\"", style), "<v>" + number + "</v>"};
}

inline std::string column_letters(std::size_t column) {
  std::string letters;
  for (std::size_t n = column + 1; n > 0; n = (n - 1) / 26)
    letters.insert(letters.begin(), static_cast<char>('A' + (n - 1) % 26));
  return letters;
}

inline std::string xml_row(std::size_t number, const std::vector<XmlCell>& cells) {
  std::string xml = fmt::format("<row r=\"{}\">", number);
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (!cells[i].content.empty())
      xml += fmt::format("<c r=\"{}{}\" {}>{}</c>", column_letters(i), number, cells[i].attributes,
                         cells[i].content);
  return xml + "</row>";
}

// Rows from lines of cells between semicolons, numbers where they read as such.
inline std::string xml_rows(const std::string& lines) {
  std::string xml;
  std::size_t number = 0, begin = 0;
  while (begin < lines.size()) {
    const std::size_t end = std::min(lines.find('\n', begin), lines.size());
    std::vector<XmlCell> cells;
    std::string line = lines.substr(begin, end - begin) + ";";
    for (std::size_t from = 0, to = 0; (to = line.find(';', from)) != line.npos; from = to + 1) {
      const std::string cell = line.substr(from, to - from);
      const bool number_like =
          !cell.empty() && cell.find_first_not_of("+-.0123456789eE") == cell.npos;
      cells.push_back(cell.empty() ? XmlCell{} : number_like ? number_cell(cell) : text_cell(cell));
    }
    xml += xml_row(++number, cells);
    begin = end + 1;
  }
  return xml;
}

struct XmlSheet {
  std::string name, rows;
  std::string after = {}; // elements after the rows, as <mergeCells>
  std::string state = "visible";
};

struct XmlWorkbook {
  std::vector<XmlSheet> sheets;
  std::vector<std::string> formats = {}; // number format of style 1, 2, ...
  std::vector<std::string> strings = {}; // contents of the shared <si>
  std::string properties = {};           // attributes of <workbookPr>
};

inline void write_archive(const std::filesystem::path& path,
                          const std::map<std::string, std::string>& files) {
  zip_t* archive = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, nullptr);
  for (const auto& [name, text] : files)
    zip_file_add(archive, name.c_str(), zip_source_buffer(archive, text.data(), text.size(), 0),
                 ZIP_FL_ENC_UTF_8);
  zip_close(archive);
}

// The parts of a workbook by their names in the archive.
inline std::map<std::string, std::string> workbook_parts(const XmlWorkbook& book) {
  const std::string main = "xmlns=\"http://schemas.openxmlformats.org/spreadsheetml/2006/main\"",
                    office = "http://schemas.openxmlformats.org/officeDocument/2006/relationships",
                    relations = "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/"
                                "2006/relationships\">";
  std::map<std::string, std::string> parts;
  std::string sheets, targets;
  const auto relate = [&](const std::string& id, const std::string& type,
                          const std::string& target) {
    targets += fmt::format("<Relationship Id=\"{}\" Type=\"{}/{}\" Target=\"{}\"/>", id, office,
                           type, target);
  };
  for (std::size_t i = 0; i < book.sheets.size(); ++i) {
    const XmlSheet& sheet = book.sheets[i];
    const std::string part = fmt::format("worksheets/sheet{}.xml", i + 1);
    sheets += fmt::format("<sheet name=\"{}\" sheetId=\"{}\" state=\"{}\" r:id=\"s{}\"/>",
                          sheet.name, i + 1, sheet.state, i + 1);
    relate(fmt::format("s{}", i + 1), "worksheet", part);
    parts["xl/" + part] = fmt::format("<worksheet {}><sheetData>{}</sheetData>{}</worksheet>", main,
                                      sheet.rows, sheet.after);
  }
  relate("st", "styles", "styles.xml");
  relate("ss", "sharedStrings", "/xl/sharedStrings.xml");
  std::string formats, styles = "<xf numFmtId=\"0\"/>", strings;
  for (std::size_t i = 0; i < book.formats.size(); ++i) {
    formats += fmt::format("<numFmt numFmtId=\"{}\" formatCode=\"{}\"/>", 164 + i,
                           replace_all(book.formats[i], "\"", "&quot;"));
    styles += fmt::format("<xf numFmtId=\"{}\"/>", 164 + i);
  }
  for (const std::string& text : book.strings)
    strings += "<si>" + text + "</si>";
  parts["xl/workbook.xml"] =
      fmt::format("<workbook {} xmlns:r=\"{}\"><workbookPr {}/><sheets>{}</sheets></workbook>",
                  main, office, book.properties, sheets);
  parts["xl/_rels/workbook.xml.rels"] = relations + targets + "</Relationships>";
  parts["xl/styles.xml"] =
      fmt::format("<styleSheet {}><numFmts>{}</numFmts><cellXfs>{}</cellXfs></styleSheet>", main,
                  formats, styles);
  parts["xl/sharedStrings.xml"] = fmt::format("<sst {}>{}</sst>", main, strings);
  parts["_rels/.rels"] = relations + "<Relationship Id=\"r1\" Type=\"" + office +
                         "/officeDocument\" Target=\"xl/workbook.xml\"/></Relationships>";
  return parts;
}

inline void write_workbook(const std::filesystem::path& path, const XmlWorkbook& book) {
  write_archive(path, workbook_parts(book));
}

} // namespace frictab::test
