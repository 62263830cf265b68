// Writes the wanted table as well, so that every attribute that the writer knows is compared.
#include "verify/compare_table.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "core/program.h"
#include "core/text.h"
#include "data/meaning.h"
#include "io/hdf5.h"
#include "table/build.h"
#include "table/sampling.h"
#include "table/table_file.h"
#include "verify/quoted.h"

namespace frictab::verify {

namespace {

constexpr double same_number = 1e-9; // relative; the mathematics libraries of machines differ less

bool agree(double a, double b) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
  return a == b || std::abs(a - b) <= same_number * std::max(std::abs(a), std::abs(b));
}

// One attribute as a reader takes it.
struct Attribute {
  std::optional<std::string> text;
  std::optional<double> number;

  Attribute(const io::Hdf5Reader& file, const std::string& object, const std::string& name)
      : text(file.text_attribute(object, name)), number(file.number_attribute(object, name)) {}

  bool operator==(const Attribute& other) const {
    if (text || other.text) return text == other.text;
    if (!number || !other.number) return !number && !other.number;
    return agree(*number, *other.number);
  }
};

std::string shown(const Attribute& one, const Attribute& other) {
  if (one.text) return quoted(*one.text, other.text.value_or(""));
  return one.number ? shortest(*one.number) : "missing";
}

class Comparison {
public:
  Comparison(const std::filesystem::path& file, const std::filesystem::path& wanted)
      : named_(file.string()), is_(file, named_), wanted_(wanted, wanted.string()) {}

  std::vector<Finding> findings() {
    compare_attributes("/");
    const std::vector<std::string> known = wanted_.datasets();
    for (const std::string& name : known)
      compare_dataset(name);
    for (const std::string& name : is_.datasets())
      if (std::find(known.begin(), known.end(), name) == known.end())
        add(name, "is none of the datasets that frictab writes", false);
    return std::move(findings_);
  }

private:
  void add(const std::string& where, const std::string& what, bool failed = true) {
    findings_.push_back({"", named_, where, what, "", failed});
  }

  void compare_attributes(const std::string& object) {
    std::set<std::string> names;
    for (const io::Hdf5Reader* file : {&is_, &wanted_})
      for (const std::string& name : file->attributes(object))
        names.insert(name);
    for (const std::string& name : names) {
      const Attribute is(is_, object, name), wanted(wanted_, object, name);
      if (is == wanted) continue;
      const std::string where = object == "/" ? name : name + " of " + object;
      if (wanted.text || wanted.number)
        add(where, fmt::format("is {}, made as {}", shown(is, wanted), shown(wanted, is)));
      else
        add(where, fmt::format("is {}, made without it", shown(is, wanted)),
            object != "/" || is_of_record(name, is));
    }
  }

  // Whether readers of tables take a root attribute for more than a remark.
  static bool is_of_record(const std::string& name, const Attribute& attribute) {
    table::TableRecord record;
    if (attribute.text)
      table::take_attribute(record, name, *attribute.text);
    else
      table::take_attribute(record, name, attribute.number.value_or(0));
    return record.others == table::TableAttributes();
  }

  void compare_dataset(const std::string& name) {
    if (!is_.has(name)) return add(name, "is missing");
    compare_attributes(name);
    const std::vector<std::size_t> shape = wanted_.shape(name);
    if (is_.shape(name) != shape)
      return add("shape of " + name,
                 fmt::format("is {}, made as {}", sizes(is_.shape(name)), sizes(shape)));
    for (std::size_t axis = 0; axis < shape.size(); ++axis)
      if (is_.scale(name, axis) != wanted_.scale(name, axis))
        add(fmt::format("scale of axis {} of {}", axis, name),
            fmt::format("is '{}', made as '{}'", is_.scale(name, axis).value_or("missing"),
                        wanted_.scale(name, axis).value_or("missing")));
    compare_values(name);
  }

  void compare_values(const std::string& name) {
    const std::vector<double> is = is_.values(name), wanted = wanted_.values(name);
    std::size_t differ = 0, first = 0;
    for (std::size_t i = 0; i < is.size(); ++i)
      if (!agree(is[i], wanted[i]) && differ++ == 0) first = i;
    if (differ == 0) return;
    add(fmt::format("{}[{}]", name, first),
        fmt::format("is {}, made as {}{}", shortest(is[first]), shortest(wanted[first]),
                    differ == 1 ? "" : fmt::format(" ({} values differ)", thousands(differ))));
  }

  static std::string sizes(const std::vector<std::size_t>& shape) {
    return fmt::format("{}", fmt::join(shape, " x "));
  }

  std::string named_;
  io::Hdf5Reader is_, wanted_;
  std::vector<Finding> findings_;
};

} // namespace

std::vector<Finding> compare_table(const std::filesystem::path& file, const table::Table& wanted) {
  const TemporaryDirectory place;
  const std::filesystem::path written = place.path() / "wanted.h5";
  table::write_table(wanted, written);
  return Comparison(file, written).findings();
}

bool is_drift_figure(const Finding& finding) {
  return finding.where == "worst_case_MPa" || finding.where == "proven_drift_MPa" ||
         finding.where.starts_with("worst_case_at_");
}

namespace {

void take_from_law(table::TableAxis& axis, const models::Law& law, const calibrate::ModelFit& fit) {
  const data::Meaning meaning = data::meaning_of(axis.name);
  axis.unit = meaning.unit;
  axis.long_name = meaning.text;
  axis.kinks.clear();
  if (const auto kinks = law.kinks.find(axis.name); kinks != law.kinks.end())
    for (const double kink : kinks->second)
      if (kink > axis.nodes.front() && kink < axis.nodes.back()) axis.kinks.push_back(kink);
  if (const auto range = fit.data_range.find(axis.name); axis.data && range != fit.data_range.end())
    axis.data = range->second;
}

// The record of the file, with the law's description of itself.
table::TableRecord record_of(const table::TableRecord& file, const table::TableRecord& law) {
  table::TableRecord record = file;
  record.quantile = law.quantile;
  record.gain = law.gain;
  record.formula = law.formula;
  record.shear_yield = law.shear_yield;
  for (const auto& [name, input] : law.inputs) {
    table::InputRecord& own = record.inputs[name];
    own.unit = input.unit;
    own.long_name = input.long_name;
    own.levels = input.levels;
  }
  return record;
}

} // namespace

table::Table table_of_model(const models::AssembledLaw& law, const calibrate::ModelFit& fit,
                            const table::Table& table, const std::filesystem::path& file) {
  std::vector<table::StateRange> ranges = table::table_ranges(table, nullptr, file.string());
  std::vector<table::TableAxis> axes = table.axes;
  for (table::TableAxis& axis : axes)
    take_from_law(axis, *law.model.law, fit);
  table::Table wanted =
      table::describe_table(law, ranges, std::move(axes), table.interpolation, table.log_value);
  wanted.record = record_of(table.record, wanted.record);
  wanted.value.resize(table.value.size());
  table::sample_nodes(table::Pieces(law, ranges), ranges, wanted.axes, 0, wanted.value);
  const io::Hdf5Reader reader(file, file.string());
  if (reader.has("distance")) wanted.distance = reader.values("distance");
  return wanted;
}

} // namespace frictab::verify
