// Converts fixed form to free form, line by line; handles only the text that fixed_form and the
// templates write.
#include <regex>
#include <sstream>

#include "codegen/fortran_core.h"

namespace frictab::codegen::fortran {

namespace {

// Returns "ftmin" for "pure double precision function ftmin(a, b)"; empty for other lines.
std::string unit_of(const std::string& line) {
  static const std::regex head(R"(^(?:[a-z][a-z ]* )?(function|subroutine) ([a-z]+)\()");
  std::smatch found;
  return std::regex_search(line, found, head) ? found[1].str() + " " + found[2].str() : "";
}

std::string statement(const std::string& line) {
  static const std::regex bytes(R"(\binteger\(8\))"),
      implied(R"(data \((\w+)\(i\),i=(\d+),(\d+)\)/)");
  const std::string kinds = std::regex_replace(line, bytes, "integer(c_int64_t)");
  return std::regex_replace(kinds, implied, "data $1($2:$3)/");
}

} // namespace

std::string free_form(const std::string& fixed) {
  std::istringstream in(fixed);
  std::string out, unit, indent = "  ";
  for (std::string line; std::getline(in, line);) {
    if (line.empty()) continue;
    if (line[0] == 'C') { // a "C" without text separates units
      out += line.size() < 7 ? "\n" : indent + "! " + line.substr(6) + "\n";
      continue;
    }
    if (line[0] == '!') { // a directive for the compiler
      out += indent + line + "\n";
      continue;
    }
    // Both ends are marked, so that the statement continues exactly where it was cut.
    if (line[5] == '&') {
      out.back() = '&';
      out += "\n" + indent + "  &" + line.substr(6) + "\n";
      continue;
    }
    const std::string text = statement(line.substr(6)), name = unit_of(text);
    if (text == "implicit none" || text == "return")
      continue; // implied by the module or the end of the unit
    if (!name.empty() || text == "end") indent = "  ";
    out += indent + text + (text == "end" ? " " + unit : "") + "\n";
    if (name.empty()) continue;
    unit = name;
    indent = "    ";
  }
  if (!out.empty()) out.pop_back();
  return out;
}

} // namespace frictab::codegen::fortran
