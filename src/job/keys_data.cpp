// The keys of [data]: the source of rows, and the format of a rig's file.
#include <algorithm>
#include <array>
#include <cmath>
#include <ranges>

#include "core/names.h"
#include "data/plausibility.h"
#include "data/quantity.h"
#include "data/roles.h"
#include "job/key_builder.h"

namespace frictab::job::schema {

using data::ColumnSource;
using data::DataOptions;
using data::FileRule;

template <> std::vector<std::string> words_of<data::Missing>() {
  return {"error", "drop"};
}
template <> std::vector<std::string> words_of<data::UsedRows>() {
  return {"sliding", "all"};
}
template <> std::vector<std::string> words_of<data::ForceZero>() {
  return {"auto", "remove", "keep"};
}
template <> std::vector<std::string> words_of<data::Role>() {
  return data::role_names();
}

namespace {

Problem constant_problem(const std::string& name, const KeyValue& value) {
  const data::Quantity* quantity = data::find_quantity(last_part(name));
  const double number = std::get<double>(value);
  if (!quantity || number >= quantity->lowest) return {};
  return {"must be a number >= " + shortest(quantity->lowest) + ", not " + shortest(number),
          quantity->meaning};
}

// Requires a whole number where blocks are counted.
Problem blocks_problem(const std::string&, const KeyValue& value) {
  const auto* number = std::get_if<double>(&value);
  if (!number || *number == std::floor(*number)) return {};
  return {"must be a whole number or \"auto\", not " + shortest(*number),
          "blocks per experiment; 0: rows are held"};
}

// A column's source, for all files or for those of a rule.
ColumnSource& of_all(Job& job, const std::string& name) {
  return job.data.columns[name];
}
// `name`: "1.sigma_n_MPa" for the first [[data.files]].
ColumnSource& of_some(Job& job, const std::string& name) {
  return file_rule(job, name).columns[last_part(name)];
}
FileRule& join_rule(Job& job, const std::string&) {
  return job.data.join.how;
}
ColumnSource& of_join(Job& job, const std::string& name) {
  return job.data.join.how.columns[name];
}

std::vector<KeyRule> column_keys(const std::string& section, SourceOf source) {
  const KeysOf column(section + ".*", source);
  return {
      column_key(section, source),
      unit_key(section, source),
      column("times", &ColumnSource::times,
             "the column is a coefficient: it is multiplied with this canonical column",
             "not multiplied", "\"sigma_n_MPa\"") |
          Allowed{"quantity", quantity_names},
      column("area_mm2", &ColumnSource::area_mm2,
             "the column is a force in N: over this nominal area it gives a stress", "not divided",
             "78.5") |
          above(0),
      column("slope_rows", &ColumnSource::slope_rows,
             "the column is a path: |d column/d time| by a straight line through this many rows",
             "not differentiated", "5") |
          at_least(2),
      formula_key(section, source),
  };
}

std::vector<std::string> delimiters() {
  return {",", ";", "\t", "|", " ", "comma", "semicolon", "tab", "bar", "space"};
}
std::vector<std::string> decimals() {
  return {".", ","};
}
std::vector<std::string> groupings() {
  return {".", ",", "'", " "};
}

std::vector<KeyRule> file_keys() {
  const KeysOf data("data", part_of<&Job::data>);
  const KeysOf segments("data.segments", part_of<&Job::data, &DataOptions::segments>);
  return {
      data("training", &DataOptions::training,
           "CSV or HDF5 file, a folder, names with * (\"tests/*.csv\"), or a list of these; they "
           "are joined; relative to the job file",
           "an error: the one key a job needs", "\"training.csv\"") |
          names_files,
      data("validation", &DataOptions::validation,
           "file or files to validate on, as data.training, never used to calibrate",
           "see data.holdout", "\"validation.csv\"") |
          names_files,
      data("oracle", &DataOptions::oracle,
           "SYNTHETIC data only: file or files with experiment, row and tau_oracle_MPa as `frictab "
           "twin --oracle` writes them; the noise floor is then known exactly. Never used to "
           "calibrate",
           "the noise floor is estimated", "\"validation_oracle.csv\"") |
          names_files,
      data("holdout", &DataOptions::holdout,
           "share of the EXPERIMENTS that is held out where data.validation is absent",
           "below 30 experiments each is left out in turn, of more 0.25 are held out; one is "
           "fitted only",
           "0.25") |
          between(0, 1),
      data("delimiter", &DataOptions::delimiter, "what separates the columns",
           "found from the header line", "\",\"") |
          Allowed{"", delimiters},
      data("decimal", &DataOptions::decimal, "the decimal sign of numbers") | Allowed{"", decimals},
      data("thousands", &DataOptions::thousands, "what stands between groups of three digits",
           "nothing", "\"'\"") |
          Allowed{"", groupings},
      data("sheet", &DataOptions::sheets,
           "the sheet of a workbook (.xlsx), or several that are a test each: a name, names with "
           "*, or a list",
           "the sheets with the column of friction", "\"Messung\""),
      data("tests", &DataOptions::tests,
           "a file with one row per experiment (humidity, batch, tool) and a column experiment: "
           "its columns are joined by name, also that of a file",
           "none", "\"tests.csv\"") |
          names_files,
      data("tests_sheet", &DataOptions::tests_sheet,
           "the sheet of data.tests, if that is a workbook", "the one with the column experiment",
           "\"Plan\""),
      data("wide.columns", &DataOptions::wide,
           "a regular expression: columns whose name it fits are one test each; its named groups "
           "become columns, the group experiment names the test, the group column the column that "
           "the values go to (else it is called value)",
           "no such columns", "'OA(?<oa_pct>\\d+)_(?<experiment>.*)'"),
      data("skip_rows", &DataOptions::skip_rows, "lines before the header line") | at_least(0),
      data("skip_footer", &DataOptions::skip_footer, "lines after the data") | at_least(0),
      data("units_row", &DataOptions::units_row, "the line below the header holds units"),
      data(
          "header", &DataOptions::header,
          "false: there is no line of names; columns are taken by number, or as column_1, column_2",
          "true, unless that line would be numbers and all columns are taken by number", "false"),
      data("header_rows", &DataOptions::header_rows,
           "lines of names, joined by column: \"Kraft\" over \"Soll\" is \"Kraft Soll\"") |
          at_least(1),
      segments("begins", &data::SegmentRules::begins,
               "a regular expression: a line that fits it opens a run of rows, an interval; its "
               "named groups become columns of these rows",
               "all lines below the header may be rows", "'^Step (?<step>\\d+)'"),
      segments("ends", &data::SegmentRules::ends,
               "a regular expression: a line that fits it closes the run; lines up to the next are "
               "not read",
               "a run ends where the next begins", "'^End of step'"),
      data("missing_values", &DataOptions::missing_values,
           "cells that stand for no value: texts, or numbers as texts",
           "empty cells, NaN, NA, n/a, #N/A and null", "[\"OVER\", \"-9999\"]"),
      data("fill_down", &DataOptions::fill_down,
           "columns of a table whose empty cells have the value of the last filled cell above, as "
           "cells that were merged leave them; the cells are counted",
           "empty cells have no value", "[\"Oil\", \"Batch\"]"),
      data("missing", &DataOptions::missing,
           "an empty cell of a quantity: an error, or its row is left out and counted") |
          Allowed{"", words_of<data::Missing>},
      data("rows", &DataOptions::rows,
           "which rows are fitted: those that slide, without rest, the turns of strokes and what "
           "has no load; or \"all\"") |
          Allowed{"", words_of<data::UsedRows>},
      data("force_zero", &DataOptions::force_zero,
           "what the forces of a test's two directions differ by: \"remove\" takes it off as the "
           "zero of the force cell, \"keep\" leaves it as friction; \"auto\" keeps it where it "
           "grows in proportion to the load over three tests or more") |
          Allowed{"", words_of<data::ForceZero>},
      data("allow_implausible", &DataOptions::allow_implausible,
           "plausibility checks that most rows may fail, without which that is an error, and whose "
           "single rows are kept",
           "none", "[\"friction_coefficient\"]") |
          Allowed{"plausibility check", data::plausibility_checks},
      data("experiment", &DataOptions::experiment,
           "what an experiment is: \"file\", \"interval\" (from one header line of a file to the "
           "next), \"pause\" (what slides between rows at rest or without load), \"row\" (each row "
           "is a test), \"columns\" (those of the same names side by side are a test each), a "
           "column of the file, or both: \"file+COLUMN\"",
           "the column experiment where there is one, else the file", "\"file\""),
      data(
          "recording", &DataOptions::recording,
          "which experiments are intervals of one recording, to be held out and left out together: "
          "those of a \"file\", those whose \"name\" differs in its last number only, those of one "
          "value of a column, or \"none\"",
          "intervals of one file, a column recording, or a clock that goes on from one to the next",
          "\"name\""),
      data(
          "condense", &DataOptions::condense,
          "blocks of neighbouring rows per experiment that are held instead of its rows, which are "
          "read one experiment at a time, and once more for the errors of laws; 0: rows are held; "
          "\"auto\": above ten million rows up to 3520, fewer where there are many experiments") |
          at_least(0) | blocks_problem,
      data("above", &DataOptions::above,
           "conditions that files give above their rows (\"Oil: A\", \"Radius;3 mm\"), to keep as "
           "columns; those that data.columns or a formula names are read without it",
           "not kept", "[\"Oil\", \"Radius\"]"),
      data("bystanders", &DataOptions::bystanders,
           "columns of the files to keep that no law uses; those of tests, join, labels and "
           "constants, origin and the direction of signed tests, are kept in any case",
           "all other columns are kept", "[\"room_C\"]"),
  };
}

std::vector<KeyRule> mapping_keys() {
  const KeysOf drop("data.drop.*", drop_rule);
  return {
      drop("below", &data::DropRule::below,
           "rows with a smaller value are left out, and counted in the report", "none", "0.1"),
      drop("above", &data::DropRule::above,
           "rows with a larger value are left out, and counted in the report", "none", "3000"),
      drop("texts", &data::DropRule::texts,
           "rows with one of these texts in a recorded column are left out, and counted in the "
           "report: tests that are judged to be invalid; in `experiment`: tests of these names",
           "none", "[\"FALSE\"]"),
      key(
          "data.roles.*",
          [](Job & job, const std::string& name) -> auto& { return job.data.roles[name].role; },
          "what a recorded column is: channels and outcomes may follow from friction and are leads "
          "of a trace, settings and labels may be its causes, the others are not looked at",
          "inferred, with a reason (frictab data)", "\"channel\"") |
          Allowed{"", words_of<data::Role>},
      key(
          "data.constants.*",
          [](Job & job, const std::string& name) -> auto& { return job.data.constants[name]; },
          "the same value for every row, in the canonical unit", "from the file's column",
          "480.0") |
          constant_problem,
  };
}

using RuleOf = FileRule& (*)(Job&, const std::string&);

// Keys that apply to some files only: those of a rule, or of data.join.
std::vector<KeyRule> rule_keys(const std::string& section, RuleOf rule) {
  const KeysOf keys(section, rule);
  const KeysOf segments(
      section + ".segments", [rule](Job & job, const std::string& name) -> auto& {
        return rule(job, name).segments;
      });
  const std::string as_all = "as for all files";
  return {
      keys("delimiter", &FileRule::delimiter, "what separates the columns", as_all, "\";\"") |
          Allowed{"", delimiters},
      keys("decimal", &FileRule::decimal, "the decimal sign of numbers", as_all, "\",\"") |
          Allowed{"", decimals},
      keys("thousands", &FileRule::thousands, "what stands between groups of three digits", as_all,
           "\".\"") |
          Allowed{"", groupings},
      keys("skip_rows", &FileRule::skip_rows, "lines before the header line", as_all, "2") |
          at_least(0),
      keys("skip_footer", &FileRule::skip_footer, "lines after the data", as_all, "1") |
          at_least(0),
      keys("units_row", &FileRule::units_row, "the line below the header holds units", as_all,
           "true"),
      keys("header", &FileRule::header, "false: there is no line of names", as_all, "false"),
      keys("header_rows", &FileRule::header_rows, "lines of names", as_all, "2") | at_least(1),
      segments("begins", &data::SegmentRules::begins, "as data.segments.begins", as_all,
               "'^Step (?<step>\\d+)'"),
      segments("ends", &data::SegmentRules::ends, "as data.segments.ends", as_all,
               "'^End of step'"),
      keys("sheet", &FileRule::sheets, "the sheets of a workbook, as data.sheet", as_all,
           "\"Messung\""),
      keys("from_name", &FileRule::from_name,
           "a regular expression that is found in the file's name with its folder; its named "
           "groups become columns: quantities in their canonical units, numbers, or texts; the "
           "group experiment names the test",
           "nothing is taken from the name", "'(?<material>\\w+)_(?<radius_mm>\\d+)mm'"),
      keys("experiment", &FileRule::experiment, "what an experiment is, as data.experiment", as_all,
           "\"file\""),
      key(
          section + ".constants.*",
          [rule](Job & job, const std::string& name) -> auto& {
            return rule(job, name).constants[last_part(name)];
          },
          "the same value for every row: a quantity in its canonical unit, or a column of another "
          "name",
          "from the file's column", "12.0") |
          constant_problem,
      key(
          section + ".labels.*",
          [rule](Job & job, const std::string& name) -> auto& {
            return rule(job, name).labels[last_part(name)];
          },
          "a column of text, the same in every row", "no such column", "\"316SS\""),
  };
}

std::vector<KeyRule> match_key() {
  return {KeysOf("data.files.*", file_rule)(
      "match", &FileRule::match,
      "which files, with * for any letters: by the file's name, or by the whole name where this "
      "one holds a /; a sheet of a workbook also by its own name, or as \"tests.xlsx/T01\"; the "
      "first rule that matches a file counts; the own name of data.tests: its dialect",
      "an error", "\"pin_*.csv\"")};
}

std::vector<std::string> clocks() {
  return {"time_s", "s_mm"};
}

std::vector<KeyRule> join_keys() {
  const KeysOf join("data.join", part_of<&Job::data, &DataOptions::join>);
  return {
      join("files", &data::JoinOptions::files,
           "files, folders or names with *, as data.training; a test is known by its name", "none",
           "\"fe/*.csv\"") |
          names_files,
      join("by", &data::JoinOptions::by,
           "the clock that both have; between the rows of these files values are linear, beyond "
           "their ends a row is left out and counted") |
          Allowed{"", clocks},
      join("offset", &data::JoinOptions::offset,
           "what is added to the clock of these files; \"auto\": where F_N_N, else s_mm, of both "
           "agrees best, for each test"),
  };
}

} // namespace

data::FileRule& file_rule(Job& job, const std::string& name) {
  const std::size_t number = std::stoul(name);
  if (job.data.files.size() < number) job.data.files.resize(number);
  return job.data.files[number - 1];
}

data::AutoNumber Kind<data::AutoNumber>::from(KeyValue& v) {
  if (const double* number = std::get_if<double>(&v)) return {*number};
  return {};
}

std::string Kind<data::AutoNumber>::show(const data::AutoNumber& v) {
  return v.value ? shortest(*v.value) : toml_quoted("auto");
}

char Kind<char>::from(KeyValue& v) {
  const std::string& text = std::get<std::string>(v);
  if (text == "comma") return ',';
  if (text == "semicolon") return ';';
  if (text == "tab") return '\t';
  if (text == "bar") return '|';
  if (text == "space") return ' ';
  return text[0];
}

data::DropRule& drop_rule(Job& job, const std::string& name) {
  return find_or_add(job.data.drop, &data::DropRule::column, name);
}

KeyRule column_key(const std::string& section, SourceOf source) {
  KeyRule rule;
  rule.path = section + ".*.column";
  rule.type = KeyType::column;
  rule.meaning = "the file's own name of the column, a list of names (the first one that is there "
                 "counts), or the column's number from 1";
  rule.absent = "the canonical name";
  rule.example = "\"Normal stress\"";
  rule.bounds = at_least(1);
  rule.store = [source](Job& job, const std::string& name, KeyValue value) {
    if (const auto* number = std::get_if<std::uint64_t>(&value))
      source(job, name).number = *number;
    else
      source(job, name).names = std::get<std::vector<std::string>>(std::move(value));
  };
  return rule;
}

KeyRule unit_key(const std::string& section, SourceOf source) {
  return KeysOf(section + ".*", source)(
      "unit", &ColumnSource::unit, "the file's unit; values are converted",
      "what a units row says, or the header after the name: \"F_N [kN]\"; else the canonical unit",
      "\"Pa\"");
}

KeyRule formula_key(const std::string& section, SourceOf source) {
  return KeysOf(section + ".*",
                source)("formula", &ColumnSource::formula,
                        "computed from other columns, by their names (_ for signs other than "
                        "letters and digits): quantities in their canonical units, others as the "
                        "file gives them; pi is known, `unit` is that of the result",
                        "a column of the file", "\"rpm*radius_mm*2*pi/60\"");
}

std::vector<std::string> quantity_names() {
  return all_names(data::quantities(), &data::Quantity::name);
}

std::vector<std::string> column_names() {
  std::vector<std::string> names = quantity_names();
  names.insert(names.begin(), "experiment");
  return names;
}

std::vector<std::string> state_names() {
  return all_names(data::quantities() | std::views::filter(&data::Quantity::state),
                   &data::Quantity::name);
}

// measured quantities and time cannot be constant
std::vector<std::string> constant_names() {
  std::vector<std::string> names = quantity_names();
  std::erase_if(names, [](const std::string& name) {
    return name == "time_s" || name == "tau_R_MPa" || name == "F_R_N";
  });
  return names;
}

std::vector<KeyRule> data_keys() {
  std::vector<KeyRule> rules = file_keys();
  for (std::vector<KeyRule>& more :
       std::array{mapping_keys(), column_keys("data.columns", of_all), match_key(),
                  rule_keys("data.files.*", file_rule),
                  column_keys("data.files.*.columns", of_some), join_keys(),
                  rule_keys("data.join", join_rule), column_keys("data.join.columns", of_join)})
    for (KeyRule& rule : more)
      rules.push_back(std::move(rule));
  return rules;
}

} // namespace frictab::job::schema
