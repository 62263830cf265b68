// Writes and reads tables as HDF5 with dimension scales.
#include "table/table_file.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "data/meaning.h"
#include "data/quantity.h"
#include "io/number.h"
#include "models/law.h"
#include "table/beyond_data.h"
#include "table/frictab_kernel.h"
#include "table/sampling.h"
#include "table/self_description.h"
#include "table/spline.h"

namespace frictab::table {

namespace {

std::string numbers_text(const std::vector<double>& numbers) {
  std::vector<std::string> texts;
  for (const double number : numbers)
    texts.push_back(shortest(number));
  return join(texts, " ");
}

// HDF5 keeps less than 64 KiB in one attribute; a network's formula is longer. It continues in
// extension_2, extension_3, ...
constexpr std::size_t attribute_characters = 60000;

// The schema distinguishes the contents of `value` where its transform is log.
constexpr const char* schema = "frictab/table/2"; // values, in the unit that the file names
// their logarithms, as in release 0.1
constexpr const char* schema_of_logarithms = "frictab/table/1";

std::string part_name(std::size_t part) {
  return part == 0 ? "extension" : fmt::format("extension_{}", part + 1);
}

void write_extension(io::Hdf5Writer& out, const std::string& formula) {
  for (std::size_t part = 0; part * attribute_characters < formula.size(); ++part)
    out.attribute("value", part_name(part),
                  formula.substr(part * attribute_characters, attribute_characters));
}

void write_outside(io::Hdf5Writer& out, const TableAxis& axis) { // absent: clamp
  if (axis.below != Outside::clamp)
    out.attribute(axis.name, "outside_low", std::string(outside_name(axis.below)));
  if (axis.above != Outside::clamp)
    out.attribute(axis.name, "outside_high", std::string(outside_name(axis.above)));
}

void write_data_range(io::Hdf5Writer& out, const TableAxis& axis) { // absent: not known
  if (!axis.data) return;
  out.attribute(axis.name, "data_low", axis.data->first);
  out.attribute(axis.name, "data_high", axis.data->second);
  out.attribute(axis.name, "share_beyond_data", share_beyond_data(axis));
}

// Writes the logarithm as a coordinate in which netCDF tools may interpolate as usual.
void write_logarithm(io::Hdf5Writer& out, const TableAxis& axis) {
  const std::string name = logarithm_name(axis);
  if (name.empty()) return;
  const std::size_t size = axis.nodes.size();
  out.dataset(name, {&size, 1}, axis.coordinates());
  out.attribute(name, "units", std::string("1"));
  out.attribute(name, "long_name",
                fmt::format("natural logarithm of {} in {}", axis.name, axis.unit));
  out.dimension_scale(name, 0, axis.name);
}

void write_axes(io::Hdf5Writer& out, const Table& table) {
  for (const TableAxis& axis : table.axes) {
    const std::size_t size = axis.nodes.size();
    out.dataset(axis.name, {&size, 1}, axis.nodes);
    out.attribute(axis.name, "units", axis.unit);
    out.attribute(axis.name, "long_name", axis.long_name);
    out.attribute(axis.name, "transform", std::string(axis.log ? "log" : "linear"));
    if (table.interpolation == Interpolation::cubic && !axis.kinks.empty())
      out.attribute(axis.name, "kinks", numbers_text(axis.kinks));
    write_outside(out, axis);
    write_data_range(out, axis);
  }
}

void write_coordinates(io::Hdf5Writer& out, const Table& table) {
  std::vector<std::string> logarithms;
  for (std::size_t a = 0; a < table.axes.size(); ++a) {
    const TableAxis& axis = table.axes[a];
    out.dimension_scale("value", a, axis.name);
    write_logarithm(out, axis);
    if (const std::string name = logarithm_name(axis); !name.empty()) logarithms.push_back(name);
  }
  // CF convention
  if (!logarithms.empty()) out.attribute("value", "coordinates", join(logarithms, " "));
}

void write_distance(io::Hdf5Writer& out, const Table& table, const io::Hdf5Storage& storage) {
  if (table.distance.empty()) return;
  out.dataset("distance", table.shape(), table.distance, storage);
  out.attribute("distance", "units", std::string("1"));
  out.attribute("distance", "long_name", std::string("distance from half a test"));
  out.attribute(
      "distance", "comment",
      std::string(
          "radius that holds half a test's worth of rows, each row counting as its share of "
          "its test; Euclidean over the axes, each in its own coordinate (ln where its "
          "transform is log) and divided by what the data span of it: 1 is the "
          "whole range of the data of one axis"));
  for (std::size_t a = 0; a < table.axes.size(); ++a)
    out.dimension_scale("distance", a, table.axes[a].name);
}

void write_attributes(io::Hdf5Writer& out, const Table& table) {
  write_coordinates(out, table);
  out.attribute("value", "comment", value_comment(table));
  out.attribute("value", "quantity", std::string(models::quantity_name(table.quantity)));
  out.attribute("value", "units", std::string(models::quantity_unit(table.quantity)));
  out.attribute("value", "transform", std::string(table.log_value ? "log" : "linear"));
  out.attribute("value", "interpolation", std::string(interpolation_name(table.interpolation)));
  if (table.interpolation == Interpolation::cubic)
    out.attribute("value", "spline", std::string(spline_name));
  out.attribute("value", "combine", expr::to_text(table.combine));
  if (table.extension) write_extension(out, expr::to_text(*table.extension));
  std::vector<std::string> names;
  for (const auto& [name, value] : table.constants) {
    out.attribute("value", name, value);
    names.push_back(name);
  }
  out.attribute("value", "constants", join(names, " "));
  out.attribute("/", "schema", std::string(schema));
  TableAttributes attributes = root_attributes(table);
  attributes.texts.merge(root_description(table)); // keeps a title that someone gave
  for (const auto& [name, text] : attributes.texts)
    out.attribute("/", name, text);
  for (const auto& [name, value] : attributes.numbers)
    out.attribute("/", name, value);
}

} // namespace

TableAttributes root_attributes(const Table& table) {
  TableAttributes attributes = attributes_of(table.record);
  if (!table.model.empty() && table.model != foreign_model) attributes.texts["model"] = table.model;
  return attributes;
}

void write_table(const Table& table, const std::filesystem::path& file,
                 const io::Hdf5Storage& storage) {
  io::Hdf5Writer out(file);
  write_axes(out, table);
  out.dataset("value", table.shape(), table.value, storage);
  write_attributes(out, table);
  write_distance(out, table, storage);
  out.close();
}

namespace {

class TableReader {
public:
  explicit TableReader(const std::filesystem::path& file)
      : named_(file.string()), in_(file, file.string()) {}
  TableReader(const io::Hdf5Contents& contents, const std::string& named)
      : named_(named), in_(contents, named) {}

  Table read() {
    Table table = describe();
    read_numbers(table);
    faults_.throw_if_any();
    return table;
  }

  io::Hdf5Layout layout() const { return in_.layout("value"); }

  Table describe() {
    if (!in_.has("value")) {
      fault("there is no dataset 'value': this is not a friction table",
            "a table has one dataset 'value' and one dimension scale per axis");
      faults_.throw_if_any();
    }
    read_value();
    read_axes();
    faults_.throw_if_any();
    read_combine();
    read_extension();
    faults_.throw_if_any();
    read_record();
    check_numbers();
    faults_.throw_if_any();
    return std::move(table_);
  }

private:
  void fault(const std::string& what, const std::string& hint = "") {
    faults_.add({named_, 0, 0}, what, hint);
  }

  std::string text(const std::string& object, const std::string& name,
                   std::initializer_list<const char*> allowed) {
    const auto found = in_.text_attribute(object, name);
    const std::vector<std::string> known(allowed.begin(), allowed.end());
    if (!found) {
      fault(fmt::format("'{}' has no text attribute '{}'", object, name),
            known.empty() ? "" : "it is one of " + join(known, ", "));
      return "";
    }
    if (!known.empty() && std::ranges::find(known, *found) == known.end())
      fault(fmt::format("attribute '{}' of '{}' is '{}'", name, object, *found),
            "it is one of " + join(known, ", "));
    return *found;
  }

  void read_record() {
    table_.model = foreign_model;
    table_.drift_is_claimed = true;
    for (const std::string& name : in_.attributes("/")) {
      const auto text = in_.text_attribute("/", name);
      if (text && name == "model")
        table_.model = models::checked_model_name(*text, named_);
      else if (text && name != "schema")
        take_attribute(table_.record, name, *text);
      else if (const auto number = in_.number_attribute("/", name))
        take_attribute(table_.record, name, *number);
    }
    // not kept: derived again from the table when it is written
    for (const auto& [name, text] : root_description(table_))
      if (const auto found = table_.record.others.texts.find(name);
          found != table_.record.others.texts.end() && found->second == text)
        table_.record.others.texts.erase(found);
  }

  void read_value() {
    shape_ = in_.shape("value");
    if (shape_.size() > FT_MAX_AXES) {
      fault(fmt::format("'value' has {} axes", shape_.size()),
            fmt::format("a table has at most {}", FT_MAX_AXES));
      faults_.throw_if_any();
    }
    table_.quantity = text("value", "quantity", {"mu", "tau_R"}) == "tau_R"
                          ? models::PieceQuantity::tau_R
                          : models::PieceQuantity::mu;
    table_.log_value = text("value", "transform", {"linear", "log"}) == "log";
    const std::string layout = in_.text_attribute("/", "schema").value_or("");
    if (layout.starts_with("frictab/") && layout != schema && layout != schema_of_logarithms)
      fault("the layout is " + layout,
            fmt::format("this version reads {} and {}", schema, schema_of_logarithms));
    holds_logarithms_ = table_.log_value && layout == schema_of_logarithms;
    if (table_.log_value && layout.empty())
      fault("the root has no attribute 'schema', which says what 'value' holds where its transform "
            "is log",
            fmt::format("{}: values as their units say; {}: their logarithms", schema,
                        schema_of_logarithms));
    table_.interpolation = find_interpolation(text("value", "interpolation", {"linear", "cubic"}))
                               .value_or(Interpolation::linear);
    if (table_.interpolation == Interpolation::cubic) text("value", "spline", {spline_name});
  }

  void read_numbers(Table& table) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const double above = table.log_value ? 0 : -infinite;
    if (!fits_into_memory(table.nodes())) {
      fault(fmt::format("'value' has {} nodes ({}), more than half of this machine's memory",
                        thousands(table.nodes()),
                        human_bytes(static_cast<double>(table.nodes() * sizeof(double)))),
            "a friction table rarely needs more than some 10,000 nodes: make a smaller one");
      return;
    }
    table.value = in_.values("value");
    if (holds_logarithms_)
      for (double& value : table.value)
        value = std::exp(value);
    const auto bad = static_cast<std::size_t>(
        std::ranges::find_if(table.value,
                             [&](double value) { return !(value > above && value < infinite); }) -
        table.value.begin());
    if (bad < table.nodes())
      fault(fmt::format("value {} of {} is not finite{}", bad, table.nodes(),
                        table.log_value ? " and above 0, as its logarithm asks" : ""));
  }

  void read_axes() {
    for (std::size_t a = 0; a < shape_.size(); ++a) {
      const auto name = in_.scale("value", a);
      if (!name) {
        fault(fmt::format("axis {} of 'value' has no dimension scale", a),
              "attach one with the canonical name of its quantity");
        continue;
      }
      TableAxis axis;
      axis.name = *name;
      axis.nodes = in_.values(axis.name);
      axis.unit = text(axis.name, "units", {});
      axis.long_name = in_.text_attribute(axis.name, "long_name").value_or("");
      axis.log = text(axis.name, "transform", {"linear", "log"}) == "log";
      check_axis(axis, shape_[a]);
      read_kinks(axis);
      axis.below = read_outside(axis, "outside_low");
      axis.above = read_outside(axis, "outside_high");
      axis.data = read_data_range(axis);
      table_.axes.push_back(axis);
    }
  }

  void check_axis(const TableAxis& axis, std::size_t size) {
    if (axis.nodes.size() != size)
      fault(fmt::format("axis '{}' has {} nodes, 'value' has {}", axis.name, axis.nodes.size(),
                        size));
    if (axis.nodes.size() < 2) fault(fmt::format("axis '{}' has fewer than 2 nodes", axis.name));
    for (std::size_t i = 0; i < axis.nodes.size(); ++i) {
      const bool ascending = i == 0 || axis.nodes[i] > axis.nodes[i - 1];
      if (!std::isfinite(axis.nodes[i]) || !ascending) {
        fault(fmt::format("axis '{}' does not ascend at node {}", axis.name, i));
        break;
      }
    }
    if (axis.log && !axis.nodes.empty() && axis.nodes.front() <= 0)
      fault(
          fmt::format("axis '{}' is logarithmic and starts at {}", axis.name, axis.nodes.front()));
    const data::Quantity* quantity = data::find_quantity(axis.name);
    if (quantity && axis.unit != quantity->unit)
      fault(fmt::format("axis '{}' is in '{}'", axis.name, axis.unit),
            "its unit is " + quantity->unit);
  }

  // Only a cubic spline uses kinks: a linear table bends at every node.
  void read_kinks(TableAxis& axis) {
    if (table_.interpolation != Interpolation::cubic) return;
    std::istringstream words(in_.text_attribute(axis.name, "kinks").value_or(""));
    for (std::string word; words >> word;) {
      double kink = std::nan("");
      io::scan_number(word.data(), word.data() + word.size(), '.', kink);
      if (std::ranges::find(axis.nodes, kink) == axis.nodes.end())
        fault(fmt::format("axis '{}' has a kink at '{}', where it has no node", axis.name, word),
              "a kink is a node, written so that it reads back to the same bits");
      else
        axis.kinks.push_back(kink);
    }
  }

  Outside read_outside(const TableAxis& axis, const std::string& side) {
    if (!in_.text_attribute(axis.name, side)) return Outside::clamp;
    return find_outside(text(axis.name, side, {"clamp", "error", "law"})).value_or(Outside::clamp);
  }

  std::optional<std::pair<double, double>> read_data_range(const TableAxis& axis) const {
    const auto low = in_.number_attribute(axis.name, "data_low");
    const auto high = in_.number_attribute(axis.name, "data_high");
    if (!low || !high) return std::nullopt;
    return std::pair{*low, *high};
  }

  bool is_axis(const std::string& name) const {
    return std::ranges::any_of(table_.axes,
                               [&](const TableAxis& axis) { return axis.name == name; });
  }

  // Whether the name is a canonical state, or an input of an effect: the table then gives its
  // range.
  bool is_input(const std::string& name) const {
    return data::meaning_of(name).state || (in_.number_attribute("/", "range_low_" + name) &&
                                            in_.number_attribute("/", "range_high_" + name));
  }

  // True of a parameter that its law bounds so; of a table of an unknown law, by the usual meaning
  // of its name.
  bool is_never_negative(const std::string& constant) const {
    if (constant == "k" || constant == "k_MPa") return true;
    if (table_.model == foreign_model) return constant == "m" || constant == "mu";
    const models::Law* law = models::find_law(table_.model);
    return law && std::ranges::any_of(law->parameters, [&](const models::Parameter& parameter) {
             return parameter.name == constant && parameter.lower >= 0;
           });
  }

  // Checks the numbers with which generated sources would compute.
  void check_numbers() {
    for (const auto& [name, number] : table_.constants)
      if (!std::isfinite(number) || (number < 0 && is_never_negative(name)))
        fault(fmt::format("the constant '{}' is {}{}", name, number,
                          std::isfinite(number) ? ", and is never below 0" : ""));
    for (const TableAxis& axis : table_.axes)
      if (axis.data && !(axis.data->first <= axis.data->second))
        fault(fmt::format("the data of axis '{}' reach from {} to {}", axis.name, axis.data->first,
                          axis.data->second));
    for (const auto& [name, input] : table_.record.inputs)
      if (input.low && input.high && !(*input.low <= *input.high))
        fault(fmt::format("the range of '{}' is from {} to {}", name, *input.low, *input.high));
    const double quantile = table_.quantile(), gain = table_.record.gain.value_or(1);
    if (!(quantile > 0 && quantile < 1)) fault(fmt::format("the quantile is {}", quantile));
    if (!(gain > 0) || !std::isfinite(gain)) fault(fmt::format("the gain is {}", gain));
    const double share = table_.record.share_far.value_or(0);
    if (!(share >= 0 && share <= 1)) fault(fmt::format("share_far is {}", share));
  }

  void read_extension() {
    std::string formula;
    for (std::size_t part = 0; const auto more = in_.text_attribute("value", part_name(part));
         ++part)
      formula += *more;
    if (formula.empty()) {
      for (const TableAxis& axis : table_.axes)
        if (axis.below == Outside::law || axis.above == Outside::law)
          fault(
              fmt::format("axis '{}' goes on by the law, and 'value' has no attribute 'extension'",
                          axis.name),
              "add the law's own formula of 'value', or outside_low and outside_high = clamp");
      return;
    }
    table_.extension = expr::parse_expr(formula, named_);
    for (const std::string& name : expr::symbols(*table_.extension)) {
      if (is_axis(name)) continue;
      if (const auto number = in_.number_attribute("value", name))
        table_.constants[name] = *number;
      else
        fault(
            fmt::format("extension uses '{}', which is neither an axis nor an attribute of 'value'",
                        name),
            "add the constant as a number attribute of 'value'");
    }
  }

  void read_combine() {
    const std::string formula = text("value", "combine", {});
    faults_.throw_if_any();
    table_.combine = expr::parse_expr(formula, named_);
    for (const std::string& name : expr::symbols(table_.combine)) {
      if (name == "value" || is_axis(name) || is_input(name)) continue;
      if (const auto number = in_.number_attribute("value", name))
        table_.constants[name] = *number;
      else
        fault(
            fmt::format("combine uses '{}', which is neither a state nor an attribute of 'value'",
                        name),
            "add the constant as a number attribute of 'value', or the range of a recorded column "
            "as range_low_" +
                name + " and range_high_" + name);
    }
  }

  std::string named_;
  io::Hdf5Reader in_;
  FaultList faults_;
  Table table_;
  bool holds_logarithms_ = false; // instead of the values themselves
  std::vector<std::size_t> shape_;
};

} // namespace

Table read_table(const std::filesystem::path& file) {
  return TableReader(file).read();
}

Table read_table(const io::Hdf5Contents& contents, const std::string& named) {
  return TableReader(contents, named).read();
}

TableDescription read_description(const std::filesystem::path& file) {
  TableReader reader(file);
  TableDescription out;
  out.table = reader.describe();
  out.layout = reader.layout();
  out.file_bytes = std::filesystem::file_size(file);
  return out;
}

} // namespace frictab::table
