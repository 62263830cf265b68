// Builds laws from the texts in the program.
#include "job/literature.h"

#include <sstream>
#include <stdexcept>

#include "core/template.h"
#include "job/reader.h"

namespace frictab::job {

namespace {

constexpr std::string_view folder = "laws/";

// Returns all laws of templates/laws, read once.
const models::Laws& laws_of_texts() {
  static const models::Laws laws = [] {
    JobReader reader;
    reader.of_program = true;
    for (const std::string_view path : embedded_paths(folder)) {
      const std::string file = "templates/" + std::string(path);
      read_laws(reader, parse_toml(embedded_template(path), file));
    }
    make_laws(reader);
    if (!reader.faults.empty()) // a fault of the program, not of its user
      throw std::logic_error(InputError(reader.faults).what());
    return reader.job.models.laws;
  }();
  return laws;
}

bool is_of_registry(const models::Law& law) {
  return law.order < models::order_of_user_laws;
}

const Registered<models::Law> registered{[] {
  std::vector<models::Law> laws;
  for (const auto& law : laws_of_texts().own())
    if (is_of_registry(*law)) laws.push_back(*law);
  return laws;
}};

bool heads_table_of(const std::string& line, const std::string& law) {
  return line.starts_with("[" + law + "]") || line.starts_with("[" + law + ".");
}

} // namespace

const models::Laws& literature() {
  static const models::Laws laws = [] {
    models::Laws literature;
    for (const auto& law : laws_of_texts().own())
      if (!is_of_registry(*law)) literature.add(*law);
    return literature;
  }();
  return laws;
}

std::string literature_text(const std::string& name) {
  const models::Law* law = laws_of_texts().find(name);
  if (!law || is_of_registry(*law)) return "";
  for (const std::string_view path : embedded_paths(folder)) {
    std::istringstream lines{std::string(embedded_template(path))};
    std::string out;
    bool within = false;
    for (std::string line; std::getline(lines, line);) {
      const bool head = line.starts_with("[");
      if (head) within = heads_table_of(line, name);
      if (within) out += (head ? "[models." + line.substr(1) : line) + "\n";
    }
    while (out.ends_with("\n\n"))
      out.pop_back();
    if (!out.empty()) return out;
  }
  return "";
}

} // namespace frictab::job
