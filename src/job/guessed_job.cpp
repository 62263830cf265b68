// Writes guesses as lines of TOML, each with its reason.
#include "job/guessed_job.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "core/text.h"
#include "data/computed.h"
#include "data/name_words.h"
#include "data/quantity.h"
#include "data/scale.h"
#include "data/test_table.h"
#include "guess/column_names.h"
#include "io/csv.h"
#include "job/open_points.h"
#include "job/toml_tree.h"

namespace frictab::job {

namespace {

// Writes a line of TOML with its comment at a common column.
std::string line(const std::string& text, const std::string& comment) {
  return comment.empty() ? text + "\n" : fmt::format("{:<44} # {}\n", text, comment);
}

// Puts a text of the user on one line.
std::string shown(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += static_cast<unsigned char>(c) < ' ' || c == '\x7f' ? ' ' : c;
  return out;
}

// Whether the file is read only with its own decimal sign, which has to be named.
bool needs_decimal(const guess::File& file) {
  return !file.own_decimal && !file.any_decimal;
}

std::string dialect_lines(const guess::File& file) {
  std::string out;
  if (file.thousands != 0)
    out += line(fmt::format("thousands = {}", toml_quoted(std::string(1, file.thousands))),
                "digits stand in groups of three");
  if (file.skip_rows > 0)
    out += line(fmt::format("skip_rows = {}", file.skip_rows),
                file.header ? "lines before the one of the names" : "lines before the first row");
  if (file.skip_footer > 0)
    out += line(fmt::format("skip_footer = {}", file.skip_footer), "lines below the last row");
  if (!file.header) out += line("header = false", "no line of names: columns are taken by number");
  if (file.header_rows > 1)
    out += line(fmt::format("header_rows = {}", file.header_rows),
                "the names of one line alone are not unique");
  if (file.units_row) out += line("units_row = true", "the line below the names holds units");
  if (file.intervals && file.phases)
    out += line("experiment = \"file\"", "the header line comes again, for parts of very different "
                                         "length; \"interval\": each is a test");
  else if (file.intervals)
    out += line("experiment = \"interval\"", "the header line comes again: a test each time");
  else if (file.side_by_side)
    out += line("experiment = \"columns\"", "the same columns come again for each test");
  if (file.rows)
    out += line("experiment = \"row\"", "settings change from row to row: each row is a test");
  return out;
}

// The number of the column, or its name in the file, without its unit where that is enough to find
// it.
std::string source_of(const guess::Column& column, const guess::File& file) {
  if (column.number > 0) return std::to_string(column.number);
  const std::string bare = io::read_header_name(column.name).name;
  const auto alike = std::ranges::count_if(file.columns, [&](const guess::Column& c) {
    return io::read_header_name(c.name).name == bare;
  });
  return toml_quoted(alike > 1 ? column.name : bare);
}

// A surface enlargement given as an increase: psi is A1/A0.
std::string increase_line(const guess::Column& column, const char* before) {
  const bool percent = column.unit == "%";
  return line(fmt::format("{}psi = {{ formula = {} }}", before,
                          toml_quoted(fmt::format("1 + {}{}", data::name_in_formulas(column.name),
                                                  percent ? "/100" : ""))),
              "first values: " + shown(column.first_values) +
                  "; an increase of the area, so that psi is A1/A0");
}

// The comment on the unit of a quantity.
std::string comment_on_unit(const guess::Column& column, const std::string& other_unit,
                            const std::string& canonical_unit) {
  if (column.clock) return "; seconds since the first";
  if (!column.answered_unit.empty()) return fmt::format("; in {}, as answered", other_unit);
  if (other_unit == "kgf" && guess::is_in_mass(column))
    return "; the weight of a mass in kg, as the file says";
  if (!other_unit.empty()) return fmt::format("; in {}, by the end of its name", other_unit);
  return column.unit.empty() ? fmt::format("; no unit is given: {} is assumed", canonical_unit)
                             : fmt::format("; in {}, as the file says", shown(column.unit));
}

std::string column_line(const guess::Column& column, const guess::File& file) {
  if (is_increase(column)) return increase_line(column, "");
  const data::Quantity* quantity = data::find_quantity(column.canonical);
  const std::string source = source_of(column, file);
  std::string value = column.number > 0 ? fmt::format("{{ column = {} }}", source) : source;
  if (column.coefficient) value = fmt::format("{{ column = {}, times = \"sigma_n_MPa\" }}", source);
  const std::string other_unit = unit_besides(column);
  if (!other_unit.empty() && other_unit != quantity->unit)
    value = fmt::format("{{ column = {}, unit = {} }}", source, toml_quoted(other_unit));
  std::string comment =
      (column.above ? "above the rows: " : "first values: ") + shown(column.first_values);
  if (quantity && !column.coefficient)
    comment += comment_on_unit(column, other_unit, quantity->unit);
  if (column.coefficient) comment += "; a coefficient of friction";
  return line(fmt::format("{} = {}", column.canonical, value), comment);
}

// Whether a column needs no line: it has the canonical name, and the file does not give another
// unit.
bool says_itself(const guess::Column& column) {
  return column.name == column.canonical && column.number == 0;
}

// Quantities that are computed.
std::string formula_lines(const guess::File& file) {
  std::string out;
  if (!file.pressure.empty())
    out += line(fmt::format("sigma_n_MPa = {{ formula = {} }}", toml_quoted(file.pressure)),
                "the force over the area of contact, where the model is in N and mm");
  for (const auto& [canonical_name, formula] :
       {std::pair("F_R_N", &file.friction), std::pair("v_rel_mm_s", &file.speed)})
    if (!formula->empty())
      out +=
          line(fmt::format("{} = {{ formula = {} }}", canonical_name, toml_quoted(formula->text)),
               shown(formula->comment));
  return out;
}

// `taken`: names of lines above the rows; `tests`: the table of tests, whose column of their names
// has its own name.
std::string columns_lines(const guess::File& file, const std::set<std::string>& taken,
                          const guess::File* tests = nullptr) {
  const guess::Column *const own = file.find("experiment"), *const other =
                                                                tests ? tests->find("experiment")
                                                                      : nullptr;
  const bool two_names = own && other && own->number == 0 && own->name != other->name;
  std::string out;
  if (two_names)
    out += line("experiment = " + toml_list({own->name, other->name}),
                "the names of tests, in the rows and in their table");
  std::vector<std::string> canonical, others, above;
  for (const guess::Column& column : file.columns)
    if (taken.count(column.name) > 0 && column.above)
      continue;
    else if (column.canonical.empty() && column.above)
      above.push_back(shown(column.name));
    else if (file.wide_known && std::ranges::find(file.wide, column.name) != file.wide.end())
      continue;
    else if (column.canonical.empty())
      others.push_back(shown(shown_name(column)));
    else if (two_names && &column == own)
      continue;
    else if (says_itself(column))
      canonical.push_back(column.name);
    else
      out += column_line(column, file);
  out += formula_lines(file);
  if (!canonical.empty()) out += "# known by their names: " + join(canonical, ", ") + "\n";
  if (!others.empty())
    out +=
        "# kept as recorded; what changes friction may be among them: " + join(others, ", ") + "\n";
  if (!above.empty())
    out += "# above the rows, kept where data.above names them: " + join(above, ", ") + "\n";
  return out;
}

// Conditions that all files give above their rows, with values that differ; texts only where files
// share them. The table of tests goes first.
std::set<std::string> above_that_differ(const guess::Campaign& campaign) {
  const std::vector<guess::File>& files = campaign.files;
  struct Seen {
    std::size_t files = 0;
    bool text = false;
    std::set<std::string> values;
    std::size_t counts_rows = 0; // files
  };
  std::map<std::string, Seen> seen;
  for (const guess::File& file : files)
    for (const guess::Column& column : file.columns)
      if (column.above && column.canonical.empty()) {
        Seen& one = seen[column.name];
        ++one.files;
        one.text = one.text || column.text;
        one.counts_rows += column.counts_rows;
        one.values.insert(column.first_values);
      }
  std::set<std::string> out;
  for (const auto& [name, one] : seen)
    if (one.files == files.size() && one.values.size() > 1 && one.counts_rows < files.size() &&
        (!one.text || 2 * one.values.size() <= files.size()))
      out.insert(name);
  if (campaign.tests)
    for (const guess::Column& column : campaign.tests->columns)
      out.erase(column.name);
  return out;
}

// Takes a group out of the pattern of names.
void forget_group(guess::NamePattern& names, const std::string& group) {
  names.pattern = replace_all(names.pattern, "(?<" + group + ">", "(?:");
  std::erase_if(names.parts, [&](const guess::NamePart& part) { return part.group == group; });
  if (names.parts.empty()) names = {};
}

// True if the table of tests has the names of most files.
bool lists_files(const guess::Campaign& campaign) {
  const guess::Column* const listed = campaign.tests ? campaign.tests->find("experiment") : nullptr;
  if (!listed) return false;
  std::set<std::string> keys;
  for (const std::string& name : listed->names)
    keys.insert(data::test_key(name));
  const auto found =
      std::count_if(campaign.files.begin(), campaign.files.end(), [&](const guess::File& file) {
        return keys.count(data::test_key(file.label())) > 0;
      });
  return found > 0 && 2 * static_cast<std::size_t>(found) >= campaign.files.size();
}

// The pattern of names without groups that would hide or repeat what the files have: the name of
// the test where a table lists the files, and names of columns.
guess::NamePattern without_known(guess::NamePattern names, const guess::Campaign& campaign) {
  if (lists_files(campaign)) forget_group(names, "experiment");
  std::vector<guess::File> all = campaign.files;
  if (campaign.tests) all.push_back(*campaign.tests);
  for (const guess::File& file : all)
    for (const guess::Column& column : file.columns)
      if (!column.above && column.name != "experiment" &&
          std::any_of(names.parts.begin(), names.parts.end(),
                      [&](const guess::NamePart& part) { return part.group == column.name; }))
        forget_group(names, column.name);
  return names;
}

class Writer {
public:
  Writer(const guess::Campaign& campaign, const guess::NamePattern& names,
         const std::vector<std::string>& training)
      : campaign_(campaign), files_(campaign.files), points_(campaign), most_(points_.file()),
        names_(without_known(names, campaign)), training_(training),
        above_(above_that_differ(campaign)),
        decimal_(campaign.tests && needs_decimal(*campaign.tests) ? campaign.tests->decimal
                                                                  : most_.decimal) {}

  GuessedJob write() {
    add_head();
    out_.text += "\n[data.columns]\n" +
                 columns_lines(most_, above_, campaign_.tests ? &*campaign_.tests : nullptr);
    if (!has_names()) ask_for_names();
    add_columns_of_tests();
    add_pressure_by_area();
    ask_for_units();
    ask_for_enlargement();
    ask_for_speed();
    ask_for_temperature();
    if (has_names()) ask_for_pressure();
    if (has_names()) ask_for_friction();
    add_titles();
    add_constants();
    ask_for_wide();
    add_rules();
    out_.text += "\n[output]\ndirectory = \"out\"\n";
    return std::move(out_);
  }

private:
  // Whether columns have names, in the file or as answered.
  bool has_names() const {
    return most_.header || std::ranges::any_of(most_.columns, [](const auto& column) {
             return !column.canonical.empty();
           });
  }

  void add_head() {
    out_.text = "# Guessed from the files; every line may be wrong. frictab data shows what is "
                "read with it,\n# frictab explain job what else there is.\n\n[data]\n";
    const char* const noun = most_.sheet.empty() ? "file" : "sheet";
    out_.text += line("training = " + toml_list(training_),
                      fmt::format("{} {}{}", files_.size(), noun, files_.size() == 1 ? "" : "s"));
    add_sheets();
    for (const guess::LeftFile& left : campaign_.left) {
      out_.left.push_back(shown(left.file + ": " + left.why));
      if (left.may_list_tests && !campaign_.tests)
        out_.left.back() += "; if it has a row per test, write tests = " + toml_quoted(left.file);
      out_.text += "# not read: " + out_.left.back() + "\n";
    }
    if (decimal_ != '.')
      out_.text += line(fmt::format("decimal = {}", toml_quoted(std::string(1, decimal_))),
                        decimal_ == most_.decimal ? "more cells are numbers than with a point"
                                                  : "of the table of tests");
    out_.text += dialect_lines(most_);
    ask_for_groups();
    add_missing();
    add_fill_down();
    if (!above_.empty())
      out_.text += line("above = " + toml_list({above_.begin(), above_.end()}),
                        "lines above the rows that differ between the files");
    add_experiment();
    add_tests();
  }

  void add_sheets() {
    const std::string passed =
        campaign_.passed.empty() ? "" : "not read: " + shown(join(campaign_.passed, ", "));
    if (!campaign_.sheets.empty())
      out_.text += line("sheet = " + toml_list(campaign_.sheets), passed);
    else if (!passed.empty())
      out_.text += "# " + passed + "\n";
  }

  void ask_for_groups() {
    if (most_.grouped > 0)
      ask(fmt::format("Is {:.3f} meant as {:.0f}? Every point stands before three digits, as "
                      "between thousands.",
                      most_.grouped, 1000 * most_.grouped),
          "# decimal = \",\"\n# thousands = \".\"\n");
  }

  void add_columns_of_tests() {
    if (!campaign_.tests) return;
    guess::File tests = *campaign_.tests;
    tests.pressure.clear();
    if (most_.find("experiment")) // stands among the columns of the rows
      std::erase_if(tests.columns, [](const auto& one) { return one.canonical == "experiment"; });
    for (guess::Column& column : tests.columns)
      if (column.canonical != "experiment" && points_.is_of_rows(column.canonical))
        column.canonical.clear(); // the rows have it themselves
    out_.text += "# of " + shown(tests.label()) + ":\n";
    if (most_.wide_known) {
      guess::Column& names =
          *std::ranges::find(tests.columns, "experiment", &guess::Column::canonical);
      out_.text += line("experiment = " + toml_list({names.name, "experiment"}),
                        "the names of tests, in their table and by [data.wide]");
      tests.columns.erase(tests.columns.begin() + (&names - tests.columns.data()));
    }
    out_.text += columns_lines(tests, {});
  }

  void add_missing() {
    std::set<std::string> markers;
    for (const guess::File& file : files_)
      markers.insert(file.missing.begin(), file.missing.end());
    if (markers.empty()) return;
    out_.text += line("missing_values = " + toml_list({markers.begin(), markers.end()}),
                      "far from all other numbers: taken for no value");
    out_.text += line("missing = \"drop\"", "leaves out rows in which a law lacks a value");
  }

  // Cells that may have been merged: of a row per test, texts of other rows, names of tests.
  void add_fill_down() {
    std::vector<std::string> names, counts;
    const auto is_remark = [](const guess::Column& column) {
      return data::has_word(data::words_of_name(column.name),
                            {"comment", "remark", "note", "bemerkung", "kommentar"});
    };
    const auto look_at = [&](const guess::File& file, bool all) {
      for (const guess::Column& column : file.columns)
        if (column.empty_below > 0 && (all || column.text) && column.canonical != "experiment" &&
            !is_remark(column) && std::ranges::find(names, column.name) == names.end()) {
          names.push_back(column.name);
          counts.push_back(fmt::format("{} ({} cells)", shown(column.name), column.empty_below));
        }
    };
    const guess::Column* const tests = most_.find("experiment");
    if (tests && tests->empty_below > 0)
      out_.text += line("fill_down = " + toml_list({tests->name}),
                        "only the first row of each test has its name");
    look_at(most_, most_.rows);
    if (campaign_.tests) look_at(*campaign_.tests, true);
    if (names.empty()) return;
    if (tests && tests->empty_below > 0) names.insert(names.begin(), tests->name);
    ask(fmt::format("Have empty cells the value above, as merged cells leave them? They are empty "
                    "in {}. This line {}.",
                    join(counts, ", "),
                    tests && tests->empty_below > 0 ? "replaces the one above" : "fills them"),
        "# fill_down = " + toml_list(names) + "\n");
  }

  // A table with one row per test.
  void add_tests() {
    if (!campaign_.tests) return;
    const guess::File& tests = *campaign_.tests;
    out_.text += line("tests = " + toml_quoted(tests.file),
                      "a row per test, found by the name or its number: " +
                          shown(source_of(*tests.find("experiment"), tests)));
    if (!tests.sheet.empty()) out_.text += "tests_sheet = " + toml_quoted(tests.sheet) + "\n";
  }

  void add_experiment() {
    if (most_.find("experiment") || most_.intervals || most_.rows || most_.side_by_side ||
        most_.wide_known)
      return;
    if (!points_.lacks_tests())
      out_.text += line("experiment = \"file\"",
                        most_.sheet.empty() ? "no column names the tests: each file is one"
                                            : "no column names the tests: each sheet is one");
    else
      ask("Which column names the tests? None was found: the file is taken as one test.",
          "# experiment = \"COLUMN\"\n");
  }

  void ask(const std::string& question, const std::string& lines) {
    out_.questions.push_back(question);
    out_.text += "# ? " + question + "\n" + lines;
  }

  void ask_for_names() {
    std::string lines;
    for (std::size_t i = 0; i < most_.columns.size(); ++i)
      lines +=
          line(fmt::format("# QUANTITY = {{ column = {} }}", i + 1),
               "first values: " + shown(most_.columns[i].first_values) +
                   (most_.columns[i].as_small ? "; as small as coefficients of friction" : ""));
    ask("Which columns are these? The files have no line of names; frictab list quantities has "
        "those that a column may be.",
        lines);
  }

  void ask_for_units() {
    std::vector<std::string> names;
    std::string lines;
    for (const guess::Column& column : most_.columns) {
      if (!lacks_unit(column)) continue;
      const std::string& unit = data::find_quantity(column.canonical)->unit;
      const auto others = data::other_units(unit);
      names.push_back(fmt::format("{} ({})", shown(shown_name(column)), unit));
      lines +=
          line(fmt::format("# {} = {{ column = {}, unit = {} }}", column.canonical,
                           source_of(column, most_), toml_quoted(others.front())),
               fmt::format("or {}, {}", unit, fmt::join(others.begin() + 1, others.end(), ", ")));
      if (column.canonical == "F_N_N" && is_pressure_by_area())
        lines += fmt::format("# sigma_n_MPa = {{ column = {}, area_mm2 = {}, unit = {} }}\n",
                             source_of(column, most_), shortest(points_.common_area()),
                             toml_quoted(others.front()));
    }
    if (names.empty()) return;
    ask(fmt::format("In which units? The file does not say, and these are taken: {}. A line here "
                    "replaces the one above.",
                    join(names, ", ")),
        lines);
  }

  // Percent above 100 may be A1/A0 or an increase.
  void ask_for_enlargement() {
    const guess::Column* const psi = most_.find("psi");
    if (psi && psi->unit == "%" && psi->number == 0 && psi->name != "psi" && !is_increase(*psi))
      ask(fmt::format("Is {} the new area over the old one, A1/A0, as is taken? This line takes it "
                      "for the increase.",
                      shown(shown_name(*psi))),
          increase_line(*psi, "# "));
  }

  void ask_for_speed() {
    if (points_.has("v_rel_mm_s")) return;
    if (const guess::Column* const turns = points_.rotation())
      ask_for_radius_of(*turns);
    else
      ask_for_speed_of_strokes();
  }

  void ask_for_radius_of(const guess::Column& turns) {
    const double radius_mm = points_.example_radius_mm();
    const std::string radius = radius_mm > 0 ? fmt::format("{:.4g}", radius_mm) : "RADIUS_MM";
    ask(fmt::format("At which radius is the contact? {} is a speed of rotation.",
                    shown(shown_name(turns))),
        line(fmt::format("# v_rel_mm_s = {{ formula = {} }}",
                         toml_quoted(speed_of_turns(turns, radius))),
             radius_mm > 0 ? "the radius in mm, by the lines above the rows"
                           : "RADIUS_MM: a number, in mm"));
  }

  void ask_for_speed_of_strokes() {
    const std::string formula = speed_of_strokes(points_);
    const guess::Column* const position = points_.aid(guess::Aid::position);
    std::string lines;
    if (!formula.empty())
      lines += line(fmt::format("# v_rel_mm_s = {{ formula = {} }}", toml_quoted(formula)),
                    "mean speed of a stroke to and fro");
    if (position && most_.find("time_s"))
      lines += line(fmt::format("# v_rel_mm_s = {{ column = {}, slope_rows = 5 }}",
                                source_of(*position, most_)),
                    "slope of the path over the time");
    if (!lines.empty())
      ask("How fast does it slide? No column is a speed, but others give one.", lines);
  }

  void ask_for_temperature() {
    std::vector<std::string> names;
    std::string lines;
    for (const guess::Column* column : points_.temperatures()) {
      names.push_back(shown(shown_name(*column)));
      const std::string unit = column->unit.empty() ? data::unit_in_name(column->name, "degC") : "";
      const bool of_tool = data::has_word(data::words_of_name(column->name),
                                          {"tool", "die", "punch", "pin", "werkzeug", "stempel"});
      const std::string bare = io::read_header_name(column->name).name;
      lines += fmt::format("# {} = {{ column = {}{} }}\n", of_tool ? "T_tool_C" : "T_contact_C",
                           column->number > 0 ? std::to_string(column->number) : toml_quoted(bare),
                           unit.empty() ? "" : ", unit = " + toml_quoted(unit));
    }
    if (!names.empty())
      ask(fmt::format("Is it the temperature of the contact, or of the tool? By its name it may be "
                      "of something else, or of another time: {}.",
                      join(names, ", ")),
          lines);
  }

  bool is_pressure_by_area() const {
    return !points_.lacks_pressure() && !points_.has("sigma_n_MPa");
  }

  void add_pressure_by_area() {
    if (!is_pressure_by_area()) return;
    const guess::Column& force = *most_.find("F_N_N");
    const std::string unit = unit_besides(force);
    out_.text +=
        line(fmt::format("sigma_n_MPa = {{ column = {}, area_mm2 = {}{} }}",
                         source_of(force, most_), shortest(points_.common_area()),
                         unit.empty() || unit == "N" ? "" : ", unit = " + toml_quoted(unit)),
             "the force over the area of contact, as the file or an answer gives it");
  }

  void ask_for_pressure() {
    if (!points_.lacks_pressure()) return;
    const guess::File& with_force =
        !most_.find("F_N_N") && campaign_.tests ? *campaign_.tests : most_;
    const guess::Column* force = with_force.find("F_N_N");
    const double area = points_.example_area_mm2();
    const std::string unit = force ? unit_besides(*force) : "";
    ask("Where does the contact normal stress come from? None was found.",
        fmt::format(
            "{}# sigma_n_MPa = \"COLUMN\"\n{}"
            "# or one value for all rows, in [data.constants] below\n",
            pressure_lines(),
            line(fmt::format("# sigma_n_MPa = {{ column = {}, area_mm2 = {}{} }}",
                             force ? source_of(*force, with_force) : "\"FORCE\"",
                             area > 0 ? fmt::format("{:.4g}", area) : "78.5",
                             unit.empty() || unit == "N" ? "" : ", unit = " + toml_quoted(unit)),
                 area > 0 ? "a force over the nominal contact area: this one by the lines "
                            "above the rows"
                          : "a force over the nominal contact area")));
  }

  // Stresses from the load and a body whose size is known.
  std::string pressure_lines() const {
    std::string lines;
    if (const std::string formula = pressure_of_pin(points_); !formula.empty())
      lines += line(fmt::format("# sigma_n_MPa = {{ formula = {} }}", toml_quoted(formula)),
                    points_.has("psi") ? "the load over the area, which grows with psi"
                                       : "the load over the area by the diameter");
    if (const std::string formula = pressure_of_ball(points_); !formula.empty())
      lines += line(fmt::format("# sigma_n_MPa = {{ formula = {} }}", toml_quoted(formula)),
                    "a ball has no constant area: mean stress by Hertz before wear, of steel on "
                    "steel (E* 115385 MPa)");
    return lines;
  }

  void ask_for_friction() {
    if (!points_.lacks_friction()) {
      ask_for_other_friction();
      if (points_.lacks_normal_force())
        ask("Which normal force belongs to the friction force? None was found.",
            "# F_N_N = \"COLUMN\"\n# or one value for all rows, in [data.constants] below\n");
    } else if (points_.torque()) {
      ask_for_radius_of_torques();
    } else if (const guess::Column* voltage = points_.aid(guess::Aid::voltage)) {
      ask_for_calibration(*voltage);
    } else {
      ask_where_friction_is();
    }
  }

  // Readings of friction in one file may differ: one drifts, or is the sum of several.
  void ask_for_other_friction() {
    std::vector<const guess::Column*> torques = points_.torques();
    if (points_.has("tau_R_MPa") || torques.empty()) return;
    const guess::Column* const force = most_.find("F_R_N");
    if (!force) torques.erase(torques.begin());
    if (torques.empty()) return;
    const std::string radius = points_.radius_in("m").term;
    std::string lines;
    for (const guess::Column* const torque : torques)
      lines += line(
          fmt::format("# F_R_N = {{ formula = {} }}",
                      toml_quoted(force_of_torque(*torque, radius.empty() ? "RADIUS_M" : radius))),
          radius.empty() ? "RADIUS_M: a number, in m" : "instead of the line above");
    ask(fmt::format("Is {} the better reading of friction? {} is taken.", names_of(torques),
                    shown(shown_name(force ? *force : *points_.torque()))),
        lines);
  }

  static std::string names_of(const std::vector<const guess::Column*>& columns) {
    std::vector<std::string> names;
    for (const guess::Column* const column : columns)
      names.push_back(shown(shown_name(*column)));
    return join(names, " or ");
  }

  void ask_for_radius_of_torques() {
    const double radius_mm = points_.example_radius_mm();
    const std::string radius = radius_mm > 0 ? fmt::format("{:.4g}", radius_mm / 1000) : "RADIUS_M";
    const std::vector<const guess::Column*> torques = points_.torques();
    std::string lines, others;
    for (const guess::Column* const torque : torques)
      lines += line(fmt::format("# F_R_N = {{ formula = {} }}",
                                toml_quoted(force_of_torque(*torque, radius))),
                    torque != torques.front() ? "instead, if this one is the friction"
                    : radius_mm > 0           ? "the radius in m, by the lines above the rows"
                                              : "RADIUS_M: a number, in m");
    if (torques.size() > 1)
      others = " Others are " + names_of({torques.begin() + 1, torques.end()}) + ".";
    ask(torque_question(*torques.front()) + others, lines);
  }

  void ask_for_calibration(const guess::Column& voltage) {
    const guess::Column* const calibration = points_.aid(guess::Aid::calibration);
    const std::string formula = force_of_voltage(voltage, calibration, "N_PER_UNIT");
    ask(calibration ? fmt::format("Is friction {} times {}? It is a voltage.",
                                  shown(shown_name(voltage)), shown(shown_name(*calibration)))
                    : fmt::format("How many newtons is one unit of {}? It is a voltage.",
                                  shown(shown_name(voltage))),
        line(fmt::format("# F_R_N = {{ formula = {} }}", toml_quoted(formula)),
             calibration ? "the factor of calibration, as the files give it"
                         : "N_PER_UNIT: a number"));
  }

  void ask_where_friction_is() {
    if (most_.wide_known) {
      ask("Which form of friction do the columns of the tests have? Their values are the column "
          "`value`.",
          "# tau_R_MPa = { column = \"value\", times = \"sigma_n_MPa\" } # a coefficient\n"
          "# F_R_N = \"value\"\n# tau_R_MPa = \"value\"\n");
    } else if (const guess::Column* likely = points_.likely_coefficient()) {
      ask(fmt::format("Is {} a coefficient of friction? Its numbers are as small, and nothing else "
                      "is friction.",
                      shown(shown_name(*likely))),
          fmt::format("# tau_R_MPa = {{ column = {}, times = \"sigma_n_MPa\" }}\n",
                      source_of(*likely, most_)) +
              line(fmt::format(
                       "# tau_R_MPa = {{ formula = {} }}",
                       toml_quoted(data::name_in_formulas(likely->name) + "*sigma_f_MPa/3**0.5")),
                   "if it is a friction factor m"));
    } else if (const guess::Column* force = points_.only_force()) {
      ask(fmt::format(
              "Is {} the friction force? It is the only force left, and nothing else is friction.",
              shown(shown_name(*force))),
          fmt::format("# F_R_N = {{ column = {} }}\n", source_of(*force, most_)));
    } else {
      ask("Where is friction? Neither a shear stress, nor a coefficient, nor a friction force was "
          "found.",
          "# F_R_N = \"COLUMN\"\n# tau_R_MPa = \"COLUMN\"\n"
          "# tau_R_MPa = { column = \"COLUMN\", times = \"sigma_n_MPa\" }\n");
    }
  }

  void add_titles() {
    if (!most_.titles.empty())
      out_.text += "\n[data.segments]\n" + line(fmt::format("begins = '{}'", most_.titles),
                                                "lines of one text in front of parts of the rows");
  }

  // Writes a single section, so that any of its lines can be uncommented.
  void add_constants() {
    std::string lines;
    for (const auto& [name, value] : campaign_.constants)
      lines += line(name + " = " + shortest(value), "for all rows, as answered");
    if (points_.lacks_pressure()) lines += "# sigma_n_MPa = 500.0\n";
    if (points_.lacks_normal_force()) lines += "# F_N_N = 50.0\n";
    if (!points_.has("sigma_f_MPa"))
      lines += line("# sigma_f_MPa = 480.0",
                    "flow stress of the workpiece: laws with a shear limit need it");
    if (!lines.empty()) out_.text += "\n[data.constants]\n" + lines;
  }

  void ask_for_wide() {
    if (most_.wide.empty()) return;
    out_.text += "\n";
    if (most_.wide_known) {
      out_.text += "[data.wide]\n" + line("columns = " + toml_quoted(most_.wide_pattern),
                                          "columns with the names of tests");
      return;
    }
    ask(fmt::format("Is each of the {} columns like {} a test? Then their friction is the column "
                    "`value` above.",
                    most_.wide.size(), shown(most_.wide.front())),
        fmt::format("# [data.wide]\n# columns = {}\n", toml_quoted(most_.wide_pattern)));
  }

  void add_names() {
    const bool plain = names_.pattern.find('\'') == std::string::npos;
    out_.text +=
        "from_name = " + (plain ? "'" + names_.pattern + "'" : toml_quoted(names_.pattern)) + "\n";
    for (const guess::NamePart& part : names_.parts)
      out_.text += fmt::format("# {}: {}{}\n", part.group, shown(part.values),
                               part.group == "experiment" ? " (the name of the test)" : "");
    out_.text += "# Give the groups names that say what they are; one without a meaning may go.\n";
  }

  // The dialect of the table of tests where [data] has another one.
  void add_rule_of_tests() {
    if (!campaign_.tests || !campaign_.tests->sheet.empty() || campaign_.tests->own_decimal) return;
    const guess::File& tests = *campaign_.tests;
    std::string dialect;
    if (tests.thousands != 0 && tests.thousands != most_.thousands)
      dialect += line(fmt::format("thousands = {}", toml_quoted(std::string(1, tests.thousands))),
                      "digits stand in groups of three");
    if (tests.skip_rows > 0) dialect += fmt::format("skip_rows = {}\n", tests.skip_rows);
    if (tests.header_rows > 1 && tests.header_rows != most_.header_rows)
      dialect += fmt::format("header_rows = {}\n", tests.header_rows);
    if (!dialect.empty())
      out_.text +=
          fmt::format("\n[[data.files]]\nmatch = {}\n{}", toml_quoted(tests.file), dialect);
  }

  // Adds rules for files that are read differently from most_, and for values in file names.
  void add_rules() {
    add_rule_of_tests();
    for (const guess::File& file : files_) {
      if (file.is_read_as(most_)) continue;
      out_.text += fmt::format("\n[[data.files]]\nmatch = {}\n", toml_quoted(file.file));
      out_.text += decimal_lines(file);
      out_.text += dialect_lines(file);
      out_.text += plain_lines(file);
      if (!names_.pattern.empty()) add_names();
      out_.text += "\n[data.files.columns]\n" + columns_lines(file, above_);
    }
    const std::string decimal = decimal_lines(most_);
    if (names_.pattern.empty() && decimal.empty()) return;
    out_.text += "\n[[data.files]]\nmatch = \"*\"\n" + decimal;
    if (!names_.pattern.empty()) add_names();
  }

  // The decimal sign where [data] has another one.
  std::string decimal_lines(const guess::File& file) const {
    if (!needs_decimal(file) || file.decimal == decimal_) return "";
    return line(fmt::format("decimal = {}", toml_quoted(std::string(1, file.decimal))),
                file.decimal == ',' ? "more cells are numbers than with a point" : "");
  }

  // Restores defaults for this file where [data] sets something else for the others.
  std::string plain_lines(const guess::File& file) const {
    std::string out;
    if (file.skip_rows == 0 && most_.skip_rows > 0) out += "skip_rows = 0\n";
    if (file.skip_footer == 0 && most_.skip_footer > 0) out += "skip_footer = 0\n";
    if (file.header && !most_.header) out += "header = true\n";
    if (!file.units_row && most_.units_row) out += "units_row = false\n";
    if (!file.intervals && !file.rows && !file.side_by_side &&
        (most_.intervals || most_.rows || most_.side_by_side))
      out += "experiment = \"file\"\n";
    return out;
  }

  const guess::Campaign& campaign_;
  const std::vector<guess::File>& files_;
  const OpenPoints points_;
  const guess::File& most_;
  const guess::NamePattern names_;
  const std::vector<std::string>& training_;
  const std::set<std::string> above_; // lines above the rows that are proposed as columns
  const char decimal_;                // of [data], by which the table of tests is read
  GuessedJob out_;
};

} // namespace

GuessedJob guessed_job(const guess::Campaign& campaign, const guess::NamePattern& names,
                       const std::vector<std::string>& training) {
  guess::Campaign completed = campaign;
  take_known_formulas(completed);
  return Writer(completed, names, training).write();
}

} // namespace frictab::job
