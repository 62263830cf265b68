// Fixed form to free form, line by line: what fixed_form and the templates write, no more.
#include <regex>
#include <sstream>

#include "codegen/fortran_core.h"

namespace frictab::fortran {

namespace {

// "ftmin" of "pure double precision function ftmin(a, b)"; empty for another line.
std::string unit_of(const std::string& line) {
  static const std::regex head(R"(^(?:[a-z ]+ )?(function|subroutine) ([a-z]+)\()");
  std::smatch found;
  return std::regex_search(line, found, head) ? found[1].str() + " " + found[2].str() : "";
}

std::string statement(const std::string& line) {
  static const std::regex bytes(R"(\binteger\*8)"),
      implied(R"(data \((\w+)\(i\),i=(\d+),(\d+)\)/)");
  const std::string kinds = std::regex_replace(line, bytes, "integer(c_int64_t)");
  return std::regex_replace(kinds, implied, "data $1($2:$3)/");
}

} // namespace

std::string free_form(const std::string& fixed) {
  std::istringstream in(fixed);
  std::string out, unit;
  for (std::string line; std::getline(in, line);) {
    if (line.empty()) continue;
    if (line[0] == 'C') {
      out += line.size() < 7 ? "  !\n" : "  ! " + line.substr(6) + "\n";
      continue;
    }
    if (line[5] == '&') { // both ends marked: the statement goes on where it was cut
      out.pop_back();
      out += "&\n    &" + line.substr(6) + "\n";
      continue;
    }
    std::string text = statement(line.substr(6));
    if (const std::string name = unit_of(text); !name.empty()) unit = name;
    if (text == "implicit none") continue; // the module says so
    if (text == "end") text += " " + unit;
    out += "  " + text + "\n";
  }
  return out;
}

} // namespace frictab::fortran
