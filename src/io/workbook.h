// Workbooks of Excel (.xlsx, .xlsm), sheet by sheet, as text that parse_csv reads. Source of the
// format: ECMA-376 part 1, SpreadsheetML.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace frictab::io {

// Kind of a cell, by its type and number format. The value of a percent cell is its fraction, that
// of a time cell its seconds; dates are texts: 2026-03-02, 2026-03-02T14:37:48.2.
enum class CellKind : char { empty, text, number, percent, time, date };

struct Sheet {
  // CSV with commas and decimal points; its lines are the sheet's rows, its cells start at column
  // A.
  std::string text;
  // Rows first .. end-1 of a column, all of one kind.
  struct KindRun {
    std::size_t first, end;
    CellKind kind;
  };
  std::vector<std::vector<KindRun>> kinds; // by column, ascending; cells in no run are empty
  std::size_t merged_cells = 0;            // cells that got the value of their merged area
  std::size_t uncalculated = 0;            // formulas without a stored value: empty cells

  CellKind kind(std::size_t column, std::size_t row) const;
};

class Workbook {
public:
  struct Entry {
    std::string name; // in UTF-8
    std::string part; // in the archive
    bool hidden = false;
  };

  // Throws InputError, with the file's name in messages (`named`), if the file is another
  // kind of file, damaged, or protected by a password.
  Workbook(const std::filesystem::path& path, const std::string& named);
  // The same from the parts of a workbook; nullopt where there is none of a name.
  using Parts = std::function<std::optional<std::string>(const std::string& name)>;
  Workbook(Parts parts, const std::string& named);
  Workbook(Workbook&&) noexcept;
  Workbook& operator=(Workbook&&) noexcept;
  ~Workbook();

  const std::vector<Entry>& sheets() const; // sheets of cells, in the order of their tabs
  // Throws InputError for damaged sheets, for ones beyond the limits of size, and if there is none
  // of this name.
  Sheet read(const std::string& name) const;

private:
  struct Data;
  std::unique_ptr<Data> data_;
};

// True for files that begin as workbooks of Excel or LibreOffice do, old ones included; names do
// not matter.
bool looks_like_workbook(const std::filesystem::path& path);

} // namespace frictab::io
