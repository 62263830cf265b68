// The keys of [data]: the source of rows, and the format of a rig's file.
#include <algorithm>
#include <array>
#include <cmath>

#include "data/plausibility.h"
#include "data/quantity.h"
#include "data/roles.h"
#include "job/key_builder.h"

namespace frictab::job::schema {

namespace {

Problem constant_problem(const std::string& name, const KeyValue& value) {
  const data::Quantity* quantity = data::find_quantity(name.substr(name.rfind('.') + 1));
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

// Returns "sigma_n_MPa" for "1.sigma_n_MPa" of the first [[data.files]], and for "sigma_n_MPa" of
// all files.
std::string name_of_column(const std::string& name) {
  return name.substr(name.rfind('.') + 1);
}

// A column's source, for all files or for those of a rule.
data::ColumnSource& of_all(Job& job, const std::string& name) {
  return job.data.columns[name];
}
data::ColumnSource& of_some(Job& job, const std::string& name) {
  return file_rule(job, name).columns[name_of_column(name)];
}
data::FileRule& join_rule(Job& job, const std::string&) {
  return job.data.join.how;
}
data::ColumnSource& of_join(Job& job, const std::string& name) {
  return job.data.join.how.columns[name];
}

template <SourceOf source> std::vector<KeyRule> column_keys(const std::string& section) {
  return {
      column_key<source>(section),
      unit_key<source>(section),
      named<std::string>(
          section + ".*.times",
          [](Job & job, const std::string& name) -> auto& { return source(job, name).times; },
          "the column is a coefficient: it is multiplied with this canonical column",
          "not multiplied", "\"sigma_n_MPa\"") |
          Allowed{"quantity", quantity_names},
      named<double>(
          section + ".*.area_mm2",
          [](Job & job, const std::string& name) -> auto& { return source(job, name).area_mm2; },
          "the column is a force in N: over this nominal area it gives a stress", "not divided",
          "78.5") |
          above(0),
      named<std::size_t>(
          section + ".*.slope_rows",
          [](Job & job, const std::string& name) -> auto& { return source(job, name).slope_rows; },
          "the column is a path: |d column/d time| by a straight line through this many rows",
          "not differentiated", "5") |
          at_least(2),
      formula_key<source>(section),
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
std::vector<std::string> missing_words() { // in the order of data::Missing
  return {"error", "drop"};
}
std::vector<std::string> row_words() { // in the order of data::UsedRows
  return {"sliding", "all"};
}
std::vector<std::string> zero_words() { // in the order of data::ForceZero
  return {"auto", "remove", "keep"};
}

std::vector<KeyRule> file_keys() {
  return {
      key<std::vector<std::string>>(
          "data.training", [](Job & job) -> auto& { return job.data.training; },
          "CSV or HDF5 file, a folder, names with * (\"tests/*.csv\"), or a list of these; they "
          "are joined; relative to the job file",
          "an error: the one key a job needs", "\"training.csv\""),
      key<std::vector<std::string>>(
          "data.validation", [](Job & job) -> auto& { return job.data.validation; },
          "file or files to validate on, as data.training, never used to calibrate",
          "see data.holdout", "\"validation.csv\""),
      key<std::vector<std::string>>(
          "data.oracle", [](Job & job) -> auto& { return job.data.oracle; },
          "SYNTHETIC data only: file or files with experiment, row and tau_oracle_MPa as `frictab "
          "twin --oracle` writes them; the noise floor is then known exactly. Never used to "
          "calibrate",
          "the noise floor is estimated", "\"validation_oracle.csv\""),
      key<std::optional<double>>(
          "data.holdout", [](Job & job) -> auto& { return job.data.holdout; },
          "share of the EXPERIMENTS that is held out where data.validation is absent",
          "below 30 experiments each is left out in turn, of more 0.25 are held out; one is fitted "
          "only",
          "0.25") |
          between(0, 1),
      key<char>(
          "data.delimiter", [](Job & job) -> auto& { return job.data.delimiter; },
          "what separates the columns", "found from the header line", "\",\"") |
          Allowed{"", delimiters},
      key<char>(
          "data.decimal", [](Job & job) -> auto& { return job.data.decimal; },
          "the decimal sign of numbers") |
          Allowed{"", decimals},
      key<char>(
          "data.thousands", [](Job & job) -> auto& { return job.data.thousands; },
          "what stands between groups of three digits", "nothing", "\"'\"") |
          Allowed{"", groupings},
      key<std::vector<std::string>>(
          "data.sheet", [](Job & job) -> auto& { return job.data.sheets; },
          "the sheet of a workbook (.xlsx), or several that are a test each: a name, names with *, "
          "or a list",
          "the sheets with the column of friction", "\"Messung\""),
      key<std::string>(
          "data.tests", [](Job & job) -> auto& { return job.data.tests; },
          "a file with one row per experiment (humidity, batch, tool) and a column experiment: its "
          "columns are joined by name, also that of a file",
          "none", "\"tests.csv\""),
      key<std::string>(
          "data.tests_sheet", [](Job & job) -> auto& { return job.data.tests_sheet; },
          "the sheet of data.tests, if that is a workbook", "the one with the column experiment",
          "\"Plan\""),
      key<std::string>(
          "data.wide.columns", [](Job & job) -> auto& { return job.data.wide; },
          "a regular expression: columns whose name it fits are one test each; its named groups "
          "become columns, the group experiment names the test, the group column the column that "
          "the values go to (else it is called value)",
          "no such columns", "'OA(?<oa_pct>\\d+)_(?<experiment>.*)'"),
      key<std::size_t>(
          "data.skip_rows", [](Job & job) -> auto& { return job.data.skip_rows; },
          "lines before the header line") |
          at_least(0),
      key<std::size_t>(
          "data.skip_footer", [](Job & job) -> auto& { return job.data.skip_footer; },
          "lines after the data") |
          at_least(0),
      key<bool>(
          "data.units_row", [](Job & job) -> auto& { return job.data.units_row; },
          "the line below the header holds units"),
      key<std::optional<bool>>(
          "data.header", [](Job & job) -> auto& { return job.data.header; },
          "false: there is no line of names; columns are taken by number, or as column_1, column_2",
          "true, unless that line would be numbers and all columns are taken by number", "false"),
      key<std::size_t>(
          "data.header_rows", [](Job & job) -> auto& { return job.data.header_rows; },
          "lines of names, joined by column: \"Kraft\" over \"Soll\" is \"Kraft Soll\"") |
          at_least(1),
      key<std::string>(
          "data.segments.begins", [](Job & job) -> auto& { return job.data.segments.begins; },
          "a regular expression: a line that fits it opens a run of rows, an interval; its named "
          "groups become columns of these rows",
          "all lines below the header may be rows", "'^Step (?<step>\\d+)'"),
      key<std::string>(
          "data.segments.ends", [](Job & job) -> auto& { return job.data.segments.ends; },
          "a regular expression: a line that fits it closes the run; lines up to the next are not "
          "read",
          "a run ends where the next begins", "'^End of step'"),
      key<std::vector<std::string>>(
          "data.missing_values", [](Job & job) -> auto& { return job.data.missing_values; },
          "cells that stand for no value: texts, or numbers as texts",
          "empty cells, NaN, NA, n/a, #N/A and null", "[\"OVER\", \"-9999\"]"),
      key<data::Missing>(
          "data.missing", [](Job & job) -> auto& { return job.data.missing; },
          "an empty cell of a quantity: an error, or its row is left out and counted") |
          Allowed{"", missing_words},
      key<data::UsedRows>(
          "data.rows", [](Job & job) -> auto& { return job.data.rows; },
          "which rows are fitted: those that slide, without rest, the turns of strokes and what "
          "has "
          "no load; or \"all\"") |
          Allowed{"", row_words},
      key<data::ForceZero>(
          "data.force_zero", [](Job & job) -> auto& { return job.data.force_zero; },
          "what the forces of a test's two directions differ by: \"remove\" takes it off as the "
          "zero of the force cell, \"keep\" leaves it as friction; \"auto\" keeps it where it "
          "grows in proportion to the load over three tests or more") |
          Allowed{"", zero_words},
      key<std::vector<std::string>>(
          "data.allow_implausible", [](Job & job) -> auto& { return job.data.allow_implausible; },
          "plausibility checks that most rows may fail, without which that is an error, and whose "
          "single rows are kept",
          "none", "[\"friction_coefficient\"]") |
          Allowed{"plausibility check", data::plausibility_checks},
      key<std::string>(
          "data.experiment", [](Job & job) -> auto& { return job.data.experiment; },
          "what an experiment is: \"file\", \"interval\" (from one header line of a file to the "
          "next), \"pause\" (what slides between rows at rest or without load), \"row\" (each row "
          "is a test), \"columns\" (those of the same names side by side "
          "are a test each), a column of the file, or both: \"file+COLUMN\"",
          "the column experiment where there is one, else the file", "\"file\""),
      key<std::string>(
          "data.recording", [](Job & job) -> auto& { return job.data.recording; },
          "which experiments are intervals of one recording, to be held out and left out together: "
          "those of a \"file\", those whose \"name\" differs in its last number only, those of one "
          "value of a column, or \"none\"",
          "intervals of one file, a column recording, or a clock that goes on from one to the next",
          "\"name\""),
      key<data::AutoNumber>(
          "data.condense", [](Job & job) -> auto& { return job.data.condense; },
          "blocks of neighbouring rows per experiment that are held instead of its rows, which are "
          "read one experiment at a time, and once more for the errors of laws; 0: rows are held; "
          "\"auto\": above ten million rows up to "
          "3520, fewer where there are many experiments") |
          at_least(0) | blocks_problem,
      key<std::vector<std::string>>(
          "data.above", [](Job & job) -> auto& { return job.data.above; },
          "conditions that files give above their rows (\"Oil: A\", \"Radius;3 mm\"), to keep as "
          "columns; those that data.columns or a formula names are read without it",
          "not kept", "[\"Oil\", \"Radius\"]"),
      key<std::optional<std::vector<std::string>>>(
          "data.bystanders", [](Job & job) -> auto& { return job.data.bystanders; },
          "columns of the files to keep that no law uses; those of tests, join, labels and "
          "constants, origin and the direction of signed tests, are kept in any case",
          "all other columns are kept", "[\"room_C\"]"),
  };
}

std::vector<KeyRule> mapping_keys() {
  return {
      named<std::optional<double>>(
          "data.drop.*.below",
          [](Job & job, const std::string& name) -> auto& { return drop_rule(job, name).below; },
          "rows with a smaller value are left out, and counted in the report", "none", "0.1"),
      named<std::optional<double>>(
          "data.drop.*.above",
          [](Job & job, const std::string& name) -> auto& { return drop_rule(job, name).above; },
          "rows with a larger value are left out, and counted in the report", "none", "3000"),
      named<std::vector<std::string>>(
          "data.drop.*.texts",
          [](Job & job, const std::string& name) -> auto& { return drop_rule(job, name).texts; },
          "rows with one of these texts in a recorded column are left out, and counted in the "
          "report: tests that are judged to be invalid; in `experiment`: tests of these names",
          "none", "[\"FALSE\"]"),
      named<data::Role>(
          "data.roles.*",
          [](Job & job, const std::string& name) -> auto& { return job.data.roles[name].role; },
          "what a recorded column is: channels and outcomes may follow from friction and are leads "
          "of a trace, settings and labels may be its causes, the others are not looked at",
          "inferred, with a reason (frictab data)", "\"channel\"") |
          Allowed{"", data::role_names},
      named<double>(
          "data.constants.*",
          [](Job & job, const std::string& name) -> auto& { return job.data.constants[name]; },
          "the same value for every row, in the canonical unit", "from the file's column",
          "480.0") |
          constant_problem,
  };
}

using RuleOf = data::FileRule& (*)(Job&, const std::string&);

// Keys that apply to some files only: those of a rule, or of data.join.
template <RuleOf rule> std::vector<KeyRule> rule_keys(const std::string& section) {
  const std::string as_all = "as for all files";
  return {
      named<std::optional<char>>(
          section + ".delimiter",
          [](Job & job, const std::string& name) -> auto& { return rule(job, name).delimiter; },
          "what separates the columns", as_all, "\";\"") |
          Allowed{"", delimiters},
      named<std::optional<char>>(
          section + ".decimal",
          [](Job & job, const std::string& name) -> auto& { return rule(job, name).decimal; },
          "the decimal sign of numbers", as_all, "\",\"") |
          Allowed{"", decimals},
      named<std::optional<char>>(
          section + ".thousands",
          [](Job & job, const std::string& name) -> auto& { return rule(job, name).thousands; },
          "what stands between groups of three digits", as_all, "\".\"") |
          Allowed{"", groupings},
      named<std::optional<std::size_t>>(
          section + ".skip_rows",
          [](Job & job, const std::string& name) -> auto& { return rule(job, name).skip_rows; },
          "lines before the header line", as_all, "2") |
          at_least(0),
      named<std::optional<std::size_t>>(
          section + ".skip_footer",
          [](Job & job, const std::string& name) -> auto& { return rule(job, name).skip_footer; },
          "lines after the data", as_all, "1") |
          at_least(0),
      named<std::optional<bool>>(
          section + ".units_row",
          [](Job & job, const std::string& name) -> auto& { return rule(job, name).units_row; },
          "the line below the header holds units", as_all, "true"),
      named<std::optional<bool>>(
          section + ".header",
          [](Job & job, const std::string& name) -> auto& { return rule(job, name).header; },
          "false: there is no line of names", as_all, "false"),
      named<std::optional<std::size_t>>(
          section + ".header_rows",
          [](Job & job, const std::string& name) -> auto& { return rule(job, name).header_rows; },
          "lines of names", as_all, "2") |
          at_least(1),
      named<std::string>(
          section + ".segments.begins", [](Job & job, const std::string& name) -> auto& {
            return rule(job, name).segments.begins;
          },
          "as data.segments.begins", as_all, "'^Step (?<step>\\d+)'"),
      named<std::string>(
          section + ".segments.ends",
          [](Job & job, const std::string& name) -> auto& { return rule(job, name).segments.ends; },
          "as data.segments.ends", as_all, "'^End of step'"),
      named<std::vector<std::string>>(
          section + ".sheet",
          [](Job & job, const std::string& name) -> auto& { return rule(job, name).sheets; },
          "the sheets of a workbook, as data.sheet", as_all, "\"Messung\""),
      named<std::string>(
          section + ".from_name",
          [](Job & job, const std::string& name) -> auto& { return rule(job, name).from_name; },
          "a regular expression that is found in the file's name with its folder; its named groups "
          "become columns: quantities in their canonical units, numbers, or texts; the group "
          "experiment names the test",
          "nothing is taken from the name", "'(?<material>\\w+)_(?<radius_mm>\\d+)mm'"),
      named<std::string>(
          section + ".experiment",
          [](Job & job, const std::string& name) -> auto& { return rule(job, name).experiment; },
          "what an experiment is, as data.experiment", as_all, "\"file\""),
      named<double>(
          section + ".constants.*", [](Job & job, const std::string& name) -> auto& {
            return rule(job, name).constants[name_of_column(name)];
          },
          "the same value for every row: a quantity in its canonical unit, or a column of another "
          "name",
          "from the file's column", "12.0") |
          constant_problem,
      named<std::string>(
          section + ".labels.*", [](Job & job, const std::string& name) -> auto& {
            return rule(job, name).labels[name_of_column(name)];
          },
          "a column of text, the same in every row", "no such column", "\"316SS\""),
  };
}

std::vector<KeyRule> match_key() {
  return {named<std::string>(
      "data.files.*.match",
      [](Job & job, const std::string& name) -> auto& { return file_rule(job, name).match; },
      "which files, with * for any letters: by the file's name, or by the whole name where "
      "this one holds a /; the first rule that matches a file counts; the own name of data.tests: "
      "its dialect",
      "an error", "\"pin_*.csv\"")};
}

std::vector<std::string> clocks() {
  return {"time_s", "s_mm"};
}

std::vector<KeyRule> join_keys() {
  return {
      key<std::vector<std::string>>(
          "data.join.files", [](Job & job) -> auto& { return job.data.join.files; },
          "files, folders or names with *, as data.training; a test is known by its name", "none",
          "\"fe/*.csv\""),
      key<std::string>(
          "data.join.by", [](Job & job) -> auto& { return job.data.join.by; },
          "the clock that both have; between the rows of these files values are linear, beyond "
          "their ends a row is left out and counted") |
          Allowed{"", clocks},
      key<data::AutoNumber>(
          "data.join.offset", [](Job & job) -> auto& { return job.data.join.offset; },
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

KeyRule or_auto(std::string path, std::optional<double>& (*at)(Job&), std::string meaning) {
  KeyRule rule = key(std::move(path), at, std::move(meaning));
  rule.type = KeyType::automatic;
  rule.store = [at](Job& job, const std::string&, KeyValue value) {
    at(job) = Kind<data::AutoNumber>::from(value).value;
  };
  rule.show = [at](const Job& job) {
    Job copy = job;
    return Kind<data::AutoNumber>::show({at(copy)});
  };
  return rule;
}

template <> data::Missing Kind<data::Missing>::from(KeyValue& v) {
  return std::get<std::string>(v) == "drop" ? data::Missing::drop : data::Missing::error;
}

template <> data::Role Kind<data::Role>::from(KeyValue& v) {
  const auto names = data::role_names();
  const auto at = std::find(names.begin(), names.end(), std::get<std::string>(v)) - names.begin();
  return static_cast<data::Role>(static_cast<long>(data::Role::response) + at);
}
template <> std::string Kind<data::Role>::show(data::Role v) {
  return toml_quoted(data::role_name(v));
}
template <> std::string Kind<data::Missing>::show(data::Missing v) {
  return toml_quoted(missing_words()[static_cast<std::size_t>(v)]);
}

template <> data::UsedRows Kind<data::UsedRows>::from(KeyValue& v) {
  return std::get<std::string>(v) == "all" ? data::UsedRows::all : data::UsedRows::sliding;
}

template <> std::string Kind<data::UsedRows>::show(data::UsedRows v) {
  return toml_quoted(row_words()[static_cast<std::size_t>(v)]);
}

template <> data::ForceZero Kind<data::ForceZero>::from(KeyValue& v) {
  const std::string& word = std::get<std::string>(v);
  return word == "remove" ? data::ForceZero::remove
         : word == "keep" ? data::ForceZero::keep
                          : data::ForceZero::automatic;
}

template <> std::string Kind<data::ForceZero>::show(data::ForceZero v) {
  return toml_quoted(zero_words()[static_cast<std::size_t>(v)]);
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
  for (data::DropRule& rule : job.data.drop)
    if (rule.column == name) return rule;
  job.data.drop.push_back({name, {}, {}, {}});
  return job.data.drop.back();
}

std::vector<std::string> quantity_names() {
  std::vector<std::string> names;
  for (const data::Quantity& quantity : data::quantities())
    names.push_back(quantity.name);
  return names;
}

std::vector<std::string> column_names() {
  std::vector<std::string> names = quantity_names();
  names.insert(names.begin(), "experiment");
  return names;
}

std::vector<std::string> state_names() {
  std::vector<std::string> names;
  for (const data::Quantity& quantity : data::quantities())
    if (quantity.state) names.push_back(quantity.name);
  return names;
}

// measured quantities and time cannot be constant
std::vector<std::string> constant_names() {
  std::vector<std::string> names;
  for (const data::Quantity& quantity : data::quantities())
    if (quantity.name != "time_s" && quantity.name != "tau_R_MPa" && quantity.name != "F_R_N")
      names.push_back(quantity.name);
  return names;
}

std::vector<KeyRule> data_keys() {
  std::vector<KeyRule> rules = file_keys();
  for (std::vector<KeyRule>& more :
       std::array{mapping_keys(), column_keys<of_all>("data.columns"), match_key(),
                  rule_keys<file_rule>("data.files.*"),
                  column_keys<of_some>("data.files.*.columns"), join_keys(),
                  rule_keys<join_rule>("data.join"), column_keys<of_join>("data.join.columns")})
    for (KeyRule& rule : more)
      rules.push_back(std::move(rule));
  return rules;
}

} // namespace frictab::job::schema
