// Guesses as lines of TOML with the reason behind each.
#include "job/guessed_job.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/text.h"
#include "core/units.h"
#include "data/quantity.h"
#include "io/csv.h"
#include "job/toml_tree.h"

namespace frictab::job {

namespace {

using data::GuessedColumn;
using data::GuessedFile;

// A line of TOML with its comment at a common column.
std::string line(const std::string& text, const std::string& comment) {
  return comment.empty() ? text + "\n" : fmt::format("{:<44} # {}\n", text, comment);
}

// Of what a user calls things: on one line.
std::string shown(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  return out;
}

std::string dialect_lines(const GuessedFile& file) {
  std::string out;
  if (file.decimal != '.')
    out += line(fmt::format("decimal = {}", toml_quoted(std::string(1, file.decimal))),
                "more cells are numbers than with a point");
  if (file.thousands != 0)
    out += line(fmt::format("thousands = {}", toml_quoted(std::string(1, file.thousands))),
                "digits stand in groups of three");
  if (file.units_row) out += line("units_row = true", "the line below the names holds units");
  if (file.intervals)
    out += line("experiment = \"interval\"", "the header line comes again: a test each time");
  return out;
}

std::string source_of(const GuessedColumn& column) {
  return toml_quoted(io::read_header_name(column.name).name == column.name
                         ? column.name
                         : io::read_header_name(column.name).name);
}

std::string column_line(const GuessedColumn& column) {
  const data::Quantity* quantity = data::find_quantity(column.canonical);
  std::string value = source_of(column);
  if (column.coefficient) value = fmt::format("{{ column = {}, times = \"sigma_n_MPa\" }}", value);
  std::string comment = "first values: " + shown(column.first_values);
  if (quantity && !column.coefficient)
    comment += column.unit.empty()
                   ? fmt::format("; no unit is given: {} is assumed", quantity->unit)
                   : fmt::format("; in {}, as the file says", shown(column.unit));
  if (column.coefficient) comment += "; a coefficient of friction";
  return line(fmt::format("{} = {}", column.canonical, value), comment);
}

// Columns that need no line: they have the canonical name.
bool says_itself(const GuessedColumn& column) {
  return column.name == column.canonical;
}

std::string columns_lines(const GuessedFile& file, const std::string& section) {
  std::string out, others;
  for (const GuessedColumn& column : file.columns) {
    if (column.canonical.empty())
      others += (others.empty() ? "" : ", ") + shown(column.name);
    else
      out += says_itself(column) ? "# " + column_line(column) : column_line(column);
  }
  if (!others.empty())
    out += "# kept as recorded; what changes friction may be among them: " + others + "\n";
  return out.empty() ? "" : "\n[" + section + "]\n" + out;
}

class Writer {
public:
  Writer(const std::vector<GuessedFile>& files, const data::GuessedNames& names,
         const std::vector<std::string>& training)
      : files_(files), names_(names), training_(training) {}

  GuessedJob write() {
    add_head();
    out_.text += columns_lines(files_.front(), "data.columns");
    add_questions();
    add_rules();
    out_.text += "\n[output]\ndirectory = \"out\"\n";
    return std::move(out_);
  }

private:
  const GuessedFile& first() const { return files_.front(); }
  bool has(const char* canonical) const { return first().find(canonical) != nullptr; }

  void add_head() {
    std::vector<std::string> quoted;
    for (const std::string& name : training_)
      quoted.push_back(toml_quoted(name));
    const std::string list = quoted.size() == 1 ? quoted[0] : "[" + join(quoted, ", ") + "]";
    out_.text =
        "# Guessed from the files; every line may be wrong. frictab data shows what is read "
        "with it,\n# frictab explain job what else there is.\n\n[data]\n";
    out_.text += line("training = " + list,
                      fmt::format("{} {}", files_.size(), files_.size() == 1 ? "file" : "files"));
    out_.text += dialect_lines(first());
    add_experiment();
  }

  void add_experiment() {
    if (has("experiment") || first().intervals) return;
    if (files_.size() > 1)
      out_.text += line("experiment = \"file\"", "no column names the tests: each file is one");
    else
      out_.text += "# ? One file, and no column that names its tests: it is taken as one test.\n"
                   "# experiment = \"COLUMN\"\n";
  }

  void ask(const std::string& question, const std::string& lines) {
    out_.questions.push_back(question);
    out_.text += "# ? " + question + "\n" + lines;
  }

  void ask_for_friction() {
    const bool friction = has("F_R_N"), normal = has("F_N_N");
    if (has("tau_R_MPa") || (friction && normal)) return;
    out_.text += "\n";
    if (friction)
      ask("Which normal force belongs to the friction force? None was found.",
          "# [data.constants]\n# F_N_N = 50.0\n# or in [data.columns]: F_N_N = \"COLUMN\"\n");
    else
      ask("Where is friction? Neither a shear stress, nor a coefficient, nor a friction force was "
          "found.",
          "# in [data.columns], one of:\n# F_R_N = \"COLUMN\"\n# tau_R_MPa = \"COLUMN\"\n"
          "# tau_R_MPa = { column = \"COLUMN\", times = \"sigma_n_MPa\" }\n");
  }

  void add_questions() {
    if (!has("sigma_n_MPa")) {
      out_.text += "\n";
      ask("Where does the contact normal stress come from? None was found.",
          "# [data.constants]\n# sigma_n_MPa = 500.0\n# or in [data.columns], from a force over "
          "the "
          "nominal contact area:\n# sigma_n_MPa = { column = \"FORCE\", area_mm2 = 78.5 }\n");
    }
    ask_for_friction();
    if (!has("sigma_f_MPa"))
      out_.text +=
          "\n# Laws with a shear limit need the flow stress of the workpiece, as a column or "
          "here:\n# [data.constants]\n# sigma_f_MPa = 480.0\n";
  }

  void add_names() {
    const bool plain = names_.pattern.find('\'') == std::string::npos;
    out_.text +=
        "from_name = " + (plain ? "'" + names_.pattern + "'" : toml_quoted(names_.pattern)) + "\n";
    for (const data::NamePart& part : names_.parts)
      out_.text += fmt::format("# {}: {}{}\n", part.group, shown(part.values),
                               part.group == "experiment" ? " (the name of the test)"
                                                          : " - what is it? Give the group a name");
  }

  // What is read in another way than the first file, and what the names say.
  void add_rules() {
    for (const GuessedFile& file : files_) {
      if (file.reads_like(first())) continue;
      out_.text += fmt::format("\n[[data.files]]\nmatch = {}\n", toml_quoted(file.file));
      out_.text += dialect_lines(file);
      if (file.decimal == '.' && first().decimal != '.') out_.text += "decimal = \".\"\n";
      if (!file.units_row && first().units_row) out_.text += "units_row = false\n";
      if (!names_.pattern.empty()) add_names();
      out_.text += columns_lines(file, "data.files.columns");
    }
    if (names_.pattern.empty()) return;
    out_.text += "\n[[data.files]]\nmatch = \"*\"\n";
    add_names();
  }

  const std::vector<GuessedFile>& files_;
  const data::GuessedNames& names_;
  const std::vector<std::string>& training_;
  GuessedJob out_;
};

} // namespace

GuessedJob guessed_job(const std::vector<GuessedFile>& files, const data::GuessedNames& names,
                       const std::vector<std::string>& training) {
  return Writer(files, names, training).write();
}

} // namespace frictab::job
