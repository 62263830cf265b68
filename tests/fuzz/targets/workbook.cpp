// The XML of a workbook: the input is three parts with a 0 byte between them: styles, shared
// strings, and a sheet.
#include "io/workbook.h"
#include "fuzz/target.h"
#include "io/csv.h"
#include "support/workbook.h"

namespace frictab::workbook_fuzz {

namespace {

void read_workbook(std::string_view bytes) {
  auto parts = test::workbook_parts({{{"A", ""}}});
  for (const char* name : {"xl/styles.xml", "xl/sharedStrings.xml", "xl/worksheets/sheet1.xml"}) {
    const std::size_t end = std::min(bytes.find('\0'), bytes.size());
    parts[name] = bytes.substr(0, end);
    bytes.remove_prefix(std::min(end + 1, bytes.size()));
  }
  const io::Workbook book(
      [&](const std::string& name) -> std::optional<std::string> {
        const auto found = parts.find(name);
        return found == parts.end() ? std::nullopt : std::optional(found->second);
      },
      "a.xlsx");
  const io::Sheet sheet = book.read("A");
  const auto lines =
      static_cast<std::size_t>(std::count(sheet.text.begin(), sheet.text.end(), '\n'));
  for (const auto& kinds : sheet.kinds)
    fuzz::promise(kinds.size() <= lines, "a line of text per row");
  fuzz::promise(sheet.text.find('\0') == sheet.text.npos, "no 0 bytes");
  FaultList faults;
  io::CsvFormat format;
  format.delimiter = ',';
  io::parse_csv(sheet.text, "a.xlsx", format, faults);
}

const Registered<fuzz::Target> registered{[] {
  return fuzz::Target{"workbook", read_workbook, 30};
}};

} // namespace

} // namespace frictab::workbook_fuzz
