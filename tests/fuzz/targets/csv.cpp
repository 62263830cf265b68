// Delimited text. The first byte says how it is written: a fuzzer finds decimal commas by itself.
#include <cmath>
#include <memory>
#include <sstream>

#include "fuzz/target.h"
#include "io/csv.h"

namespace frictab::fuzz::csv_target {
namespace {

io::CsvFormat format_of(unsigned char bits) {
  io::CsvFormat format;
  if (bits & 1) format.decimal = ',';
  if (bits & 2) format.thousands = format.decimal == ',' ? '.' : ',';
  if (bits & 4) format.units_row = true;
  if (bits & 8) format.skip_rows = 1;
  if (bits & 16) format.skip_footer = 1;
  if (bits & 32) format.delimiter = bits & 1 ? ';' : '\t';
  if (bits & 64) format.wanted = {"sigma_n_MPa", "F_N_N", "experiment"};
  if (bits & 128) format.text_columns = {"lot"};
  const auto both = [&](unsigned char mask) { return (bits & mask) == mask; };
  if (both(8 | 16)) format.header = false;
  if (both(4 | 8)) format.header_rows = 2;
  if (both(4 | 16))
    format.segments = std::make_shared<io::CsvSegments>(
        io::CsvSegments{Pattern("^Step (?<step>\\d+)", {}), Pattern("^End", {})});
  return format;
}

void check(const io::CsvTable& table) {
  promise(table.rows() > 0 && !table.columns.empty(), "a table that is taken has rows and columns");
  promise(table.interval.size() == table.rows(), "each row has its interval");
  for (std::size_t i = 1; i < table.rows(); ++i)
    promise(table.line[i - 1] < table.line[i], "rows stand in ascending lines");
  for (const io::CsvColumn& column : table.columns) {
    promise(column.numbers.size() == table.rows(), "each column has all rows");
    std::size_t next = 0;
    for (std::size_t i = 0; i < table.rows(); ++i) {
      const bool text = next < column.texts.size() && column.texts[next].row == i;
      promise(std::isfinite(column.numbers[i]) != text, "a cell is a finite number or a text");
      if (text) ++next;
    }
    promise(next == column.texts.size(), "texts stand in ascending rows");
  }
}

// The same file a few bytes at a time: other faults, but no other table.
void check_pieces(std::string_view text, const io::CsvFormat& format, const io::CsvTable& whole) {
  io::CsvPieces pieces(std::make_unique<std::istringstream>(std::string(text)), "a.csv", format,
                       16);
  if (!pieces.whole_because().empty()) return;
  FaultList faults;
  io::CsvTable all;
  for (auto next = pieces.next(faults); !next.empty(); next = pieces.next(faults))
    for (io::CsvTable& piece : next)
      if (all.columns.empty())
        all = std::move(piece);
      else
        io::append(all, std::move(piece));
  if (!faults.empty()) return;
  check(all);
  promise(all.line == whole.line && all.interval == whole.interval, "pieces have the same rows");
  promise(all.columns.size() == whole.columns.size(), "pieces have the same columns");
  for (std::size_t c = 0; c < all.columns.size(); ++c)
    for (std::size_t i = 0; i < all.rows(); ++i) {
      const double a = all.columns[c].numbers[i], b = whole.columns[c].numbers[i];
      promise(a == b || (std::isnan(a) && std::isnan(b)), "pieces have the same cells");
    }
}

void read(std::string_view bytes) {
  if (bytes.empty()) return;
  FaultList faults;
  const auto bits = static_cast<unsigned char>(bytes.front());
  const io::CsvTable table = io::parse_csv(bytes.substr(1), "a.csv", format_of(bits), faults);
  faults.throw_if_any();
  check(table);
  check_pieces(bytes.substr(1), format_of(bits), table);
}

const Registered<Target> registered([] { return Target{"csv", read}; });

} // namespace
} // namespace frictab::fuzz::csv_target
