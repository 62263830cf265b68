// Composes texts that describe the table; nothing here is read back.
#include "table/self_description.h"

#include <vector>

#include <fmt/format.h>

#include "core/names.h"
#include "core/text.h"
#include "expr/expr.h"

namespace frictab::table {

namespace {

std::string source(const TableRecord& record) {
  std::string text = "frictab";
  if (record.tool_version) text += " " + *record.tool_version;
  if (record.data_origin) text += fmt::format(", law calibrated on {} data", *record.data_origin);
  if (record.data_hash) text += fmt::format(" (data_hash {})", *record.data_hash);
  return text;
}

// "linear in ln_sigma_n_MPa, T_contact_C"
std::string coordinates(const Table& table) {
  std::vector<std::string> names;
  for (const TableAxis& axis : table.axes) {
    const std::string logarithm = logarithm_name(axis);
    if (axis.log && logarithm.empty())
      names.push_back("ln " + axis.name);
    else
      names.push_back(axis.log ? logarithm : axis.name);
  }
  return join(names, ", ");
}

bool is_plainly_linear(const Table& table) {
  if (table.interpolation != Interpolation::linear || table.log_value) return false;
  for (const TableAxis& axis : table.axes)
    if (axis.log) return false;
  return true;
}

} // namespace

std::map<std::string, std::string> root_description(const Table& table) {
  const std::vector<std::string> axes = all_names(table.axes);
  return {
      {"Conventions", "CF-1.8, ACDD-1.3"},
      {"title", fmt::format("Friction table of {}{}{}", table.model.empty() ? "a law" : table.model,
                            axes.empty() ? "" : " over ", join(axes, ", "))},
      {"source", source(table.record)},
      {"comment", "The friction shear stress in MPa is the formula in the attribute combine of "
                  "value: of the interpolated value, states and the constants next to it. The "
                  "comment of value says how it is interpolated."}};
}

std::string value_comment(const Table& table) {
  if (table.axes.empty()) return "A constant. tau_R in MPa is the attribute combine.";
  const std::string between =
      fmt::format("{} is {} in {}", table.log_value ? "The logarithm of value" : "value",
                  table.interpolation == Interpolation::cubic ? "a cubic spline" : "linear",
                  coordinates(table));
  if (is_plainly_linear(table)) return between + "; tau_R in MPa is the attribute combine.";
  return between + ", so that value.interp(...) of xarray is WRONG between the nodes. In Python: "
                   "frictab.open(FILE).tau_R(...), or import frictab.accessor and "
                   "dataset.frictab.tau_R(...).";
}

std::string logarithm_name(const TableAxis& axis) {
  return axis.log && expr::is_name(axis.name) ? "ln_" + axis.name : "";
}

} // namespace frictab::table
