// The keys of [data]: where rows come from and how a rig's file is read.
#include "data/quantity.h"
#include "job/key_builder.h"

namespace frictab::job::schema {

namespace {

data::ColumnSource& column(Job& job, const std::string& name) {
  return job.data.columns[name];
}

Problem constant_problem(const std::string& name, const KeyValue& value) {
  const data::Quantity& quantity = *data::find_quantity(name);
  const double number = std::get<double>(value);
  if (number >= quantity.lowest) return {};
  return {"must be a number >= " + shortest(quantity.lowest) + ", not " + shortest(number),
          quantity.meaning};
}

KeyRule column_key() {
  KeyRule rule;
  rule.path = "data.columns.*.column";
  rule.type = KeyType::column;
  rule.meaning = "the file's own name of the column, a list of names (the first one that is there "
                 "counts), or the column's number from 1";
  rule.absent = "the canonical name";
  rule.example = "\"Normal stress\"";
  rule.bounds = at_least(1);
  rule.store = [](Job& job, const std::string& name, KeyValue value) {
    if (const auto* number = std::get_if<std::uint64_t>(&value))
      column(job, name).number = *number;
    else
      column(job, name).names = std::get<std::vector<std::string>>(std::move(value));
  };
  return rule;
}

std::vector<std::string> delimiters() {
  return {",", ";", "\t", "|", " ", "comma", "semicolon", "tab", "bar", "space"};
}
std::vector<std::string> decimals() {
  return {".", ","};
}

std::vector<KeyRule> file_keys() {
  return {
      key<std::vector<std::string>>(
          "data.training", [](Job & job) -> auto& { return job.data.training; },
          "CSV or HDF5 file, or a list of files that are joined; relative to the job file",
          "an error: the one key a job needs", "\"training.csv\""),
      key<std::vector<std::string>>(
          "data.validation", [](Job & job) -> auto& { return job.data.validation; },
          "file or files to validate on, never used to calibrate",
          "the share data.holdout of the experiments is held out", "\"validation.csv\""),
      key<std::vector<std::string>>(
          "data.oracle", [](Job & job) -> auto& { return job.data.oracle; },
          "SYNTHETIC data only: file or files with experiment, row and tau_oracle_MPa as `frictab "
          "twin --oracle` writes them; the noise floor is then known exactly. Never used to "
          "calibrate",
          "the noise floor is estimated", "\"validation_oracle.csv\""),
      key<double>(
          "data.holdout", [](Job & job) -> auto& { return job.data.holdout; },
          "share of the EXPERIMENTS that is held out where data.validation is absent") |
          between(0, 1),
      key<char>(
          "data.delimiter", [](Job & job) -> auto& { return job.data.delimiter; },
          "what separates the columns", "found from the header line", "\",\"") |
          Allowed{"", delimiters},
      key<char>(
          "data.decimal", [](Job & job) -> auto& { return job.data.decimal; },
          "the decimal sign of numbers") |
          Allowed{"", decimals},
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
      key<std::optional<std::vector<std::string>>>(
          "data.bystanders", [](Job & job) -> auto& { return job.data.bystanders; },
          "columns to keep that no law uses", "all other columns are kept", "[\"room_C\"]"),
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
      column_key(),
      named<std::string>(
          "data.columns.*.unit",
          [](Job & job, const std::string& name) -> auto& { return column(job, name).unit; },
          "the file's unit; values are converted", "the canonical unit", "\"Pa\""),
      named<std::string>(
          "data.columns.*.times",
          [](Job & job, const std::string& name) -> auto& { return column(job, name).times; },
          "the column is a coefficient: it is multiplied with this canonical column",
          "not multiplied", "\"sigma_n_MPa\"") |
          Allowed{"quantity", quantity_names},
      named<double>(
          "data.columns.*.area_mm2",
          [](Job & job, const std::string& name) -> auto& { return column(job, name).area_mm2; },
          "the column is a force in N: over this nominal area it gives a stress", "not divided",
          "78.5") |
          above(0),
      named<std::size_t>(
          "data.columns.*.slope_rows",
          [](Job & job, const std::string& name) -> auto& { return column(job, name).slope_rows; },
          "the column is a path: |d column/d time| by a straight line through this many rows",
          "not differentiated", "5") |
          at_least(2),
      named<double>(
          "data.constants.*",
          [](Job & job, const std::string& name) -> auto& { return job.data.constants[name]; },
          "the same value for every row, in the canonical unit", "from the file's column",
          "480.0") |
          constant_problem,
  };
}

} // namespace

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

std::vector<std::string> constant_names() { // what was measured, and time, cannot be one value
  std::vector<std::string> names;
  for (const data::Quantity& quantity : data::quantities())
    if (quantity.name != "time_s" && quantity.name != "tau_R_MPa" && quantity.name != "F_R_N")
      names.push_back(quantity.name);
  return names;
}

std::vector<KeyRule> data_keys() {
  std::vector<KeyRule> rules = file_keys();
  for (KeyRule& rule : mapping_keys())
    rules.push_back(std::move(rule));
  return rules;
}

} // namespace frictab::job::schema
