// Cuts statements and DATA at the last column.
#include "codegen/fixed_form.h"

#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "codegen/number_text.h"

namespace frictab::codegen {

namespace {

constexpr std::size_t statement_columns = 66; // 7..72
constexpr std::size_t continuations = 19;

// Returns the place of the cut: after the last blank or comma that fits, or anywhere (blanks have
// no meaning).
std::size_t cut(std::string_view text, std::size_t columns) {
  if (text.size() <= columns) return text.size();
  const std::size_t at = text.find_last_of(" ,", columns - 1);
  return at == std::string_view::npos || at == 0 ? columns : at + 1;
}

std::string data_statement(const std::string& head, const std::vector<std::string>& lines) {
  std::string out = "      " + head;
  for (const std::string& line : lines)
    out += "\n     & " + line;
  return out + "/\n";
}

std::string data(const std::string& name, const std::vector<std::string>& numbers) {
  std::string out;
  std::vector<std::string> lines;
  std::size_t first = 0;
  const auto finish = [&](std::size_t next) {
    lines.back().pop_back(); // the comma
    out += data_statement(fmt::format("data ({}(i),i={},{})/", name, first + 1, next), lines);
    lines.clear();
    first = next;
  };
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::string item = numbers[i] + ",";
    // Uses one column less than available, because the last line ends with a slash as well.
    if (!lines.empty() && lines.back().size() + item.size() <= statement_columns - 1) {
      lines.back() += item;
    } else {
      if (lines.size() == continuations) finish(i);
      lines.push_back(item);
    }
  }
  if (!lines.empty()) finish(numbers.size());
  if (!out.empty()) out.pop_back(); // the template ends the line
  return out;
}

} // namespace

std::string fixed_form(const std::string& statement) {
  std::string_view rest = statement;
  std::string out, set_in; // indentation for lines cut between words
  for (std::size_t line = 0; !rest.empty(); ++line) {
    if (line > continuations) throw std::logic_error("Fortran statement too long: " + statement);
    const std::size_t end = cut(rest, statement_columns - set_in.size());
    std::string piece(rest.substr(0, end));
    const bool between = piece.back() == ' ' || piece.back() == ',';
    while (!piece.empty() && piece.back() == ' ')
      piece.pop_back();
    out += (line == 0 ? "      " : "\n     &" + set_in) + piece;
    set_in = between ? "  " : "";
    rest.remove_prefix(end);
  }
  return out;
}

std::string fixed_form_data(const std::string& name, std::span<const double> values) {
  std::vector<std::string> numbers;
  for (const double value : values)
    numbers.push_back(fortran_number(value));
  return data(name, numbers);
}

std::string fixed_form_data(const std::string& name, const std::vector<int>& values) {
  std::vector<std::string> numbers;
  for (const int value : values)
    numbers.push_back(std::to_string(value));
  return data(name, numbers);
}

} // namespace frictab::codegen
