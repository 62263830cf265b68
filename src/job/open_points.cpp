#include "job/open_points.h"

#include <algorithm>
#include <numbers>
#include <set>

#include <fmt/format.h>

#include "core/text.h"
#include "core/units.h"
#include "data/computed.h"
#include "data/name_words.h"
#include "data/quantity.h"
#include "data/scale.h"
#include "guess/column_names.h"

namespace frictab::job {

namespace {

bool is_named_torque(const guess::Column& column) {
  const std::string name = lower_case(column.name);
  return name.find("torque") != name.npos || name.find("drehmoment") != name.npos ||
         name.find("reibmoment") != name.npos || name == "moment" || name == "couple";
}

// Unit of a torque: the file's, the one at the end of the name, or N m; empty for other columns.
std::string unit_of_torque(const guess::Column& column) {
  if (!column.canonical.empty() || column.text || column.above) return "";
  if (!column.unit.empty()) return convert(column.unit, "N m") ? column.unit : "";
  const std::string unit = data::unit_in_name(column.name, "N m");
  return unit.empty() && is_named_torque(column) ? "N m" : unit;
}

bool has_unit_to_name(const guess::Column& column) {
  const data::Quantity* quantity = data::find_quantity(column.canonical);
  return quantity && quantity->unit != "1" && !column.coefficient && !column.text &&
         column.unit.empty() && column.name != column.canonical;
}

} // namespace

std::string shown_name(const guess::Column& column) {
  return column.name.empty() ? fmt::format("column {}", column.number) : column.name;
}

std::string unit_besides(const guess::Column& column) {
  if (!has_unit_to_name(column)) return "";
  if (!column.answered_unit.empty()) return column.answered_unit;
  return data::unit_in_name(column.name, data::find_quantity(column.canonical)->unit);
}

bool lacks_unit(const guess::Column& column) {
  return has_unit_to_name(column) && unit_besides(column).empty();
}

bool OpenPoints::has(const std::string& canonical) const {
  return is_of_rows(canonical) || campaign_.constants.count(canonical) > 0 ||
         (campaign_.tests && campaign_.tests->find(canonical));
}

bool OpenPoints::is_of_rows(const std::string& canonical) const {
  const bool by_formula = (canonical == "sigma_n_MPa" && !file_.pressure.empty()) ||
                          (canonical == "F_R_N" && !file_.friction.empty());
  return by_formula || file_.find(canonical);
}

double OpenPoints::common_area() const {
  const double area = campaign_.files.front().area_mm2;
  const bool same = std::ranges::all_of(
      campaign_.files, [&](const guess::File& file) { return file.area_mm2 == area; });
  return same ? area : 0;
}

double OpenPoints::example_area_mm2() const {
  if (common_area() > 0) return common_area();
  const double outer = file_.radius_mm, inner = file_.inner_radius_mm;
  return inner > 0 && outer > inner ? std::numbers::pi * (outer * outer - inner * inner) : 0;
}

double OpenPoints::example_radius_mm() const {
  const double outer = file_.radius_mm, inner = file_.inner_radius_mm;
  return inner > 0 && outer > 0 ? (outer + inner) / 2 : std::max(outer, inner);
}

bool OpenPoints::lacks_tests() const {
  return campaign_.files.size() == 1 && !file_.find("experiment") && !file_.intervals &&
         !file_.rows && !file_.side_by_side && !file_.wide_known;
}

bool OpenPoints::lacks_pressure() const {
  return !has("sigma_n_MPa") && !(common_area() > 0 && file_.find("F_N_N"));
}

bool OpenPoints::lacks_friction() const {
  return !has("tau_R_MPa") && !has("F_R_N");
}

bool OpenPoints::lacks_normal_force() const {
  return has("F_R_N") && !has("F_N_N") && !has("tau_R_MPa");
}

const guess::Column* OpenPoints::torque() const {
  for (const guess::Column& column : file_.columns)
    if (!unit_of_torque(column).empty()) return &column;
  return nullptr;
}

const guess::Column* OpenPoints::likely_coefficient() const {
  const guess::Column* found = nullptr;
  for (const guess::Column& column : file_.columns) {
    const bool has_unit = !column.unit.empty() && !convert(column.unit, "1");
    if (!column.canonical.empty() || !column.as_small || has_unit) continue;
    if (found) return nullptr;
    found = &column;
  }
  return found;
}

std::vector<const guess::Column*> OpenPoints::columns() const {
  std::vector<const guess::Column*> all;
  for (const guess::Column& column : file_.columns)
    all.push_back(&column);
  if (campaign_.tests)
    for (const guess::Column& column : campaign_.tests->columns)
      all.push_back(&column);
  return all;
}

const guess::Column* OpenPoints::rotation() const {
  const guess::Column* found = nullptr;
  for (const guess::Column* column : columns())
    if (!has("v_rel_mm_s") && !guess::turn_factor(*column).empty() &&
        (!found || (guess::names_wanted(*found) && !guess::names_wanted(*column))))
      found = column;
  return found;
}

std::vector<const guess::Column*> OpenPoints::temperatures() const {
  std::vector<const guess::Column*> found = columns();
  std::set<std::string> names;
  std::erase_if(found, [&](const guess::Column* column) {
    return has("T_contact_C") || !column->beside_contact || !names.insert(column->name).second;
  });
  return found;
}

const guess::Column* OpenPoints::only_force() const {
  const guess::Column* found = nullptr;
  for (const guess::Column& column : file_.columns) {
    const bool is_normal = data::has_word(data::words_of_name(column.name),
                                          {"normal", "vertical", "axial", "vertikal"});
    if (!column.canonical.empty() || column.text || column.above || is_normal ||
        !convert(column.unit, "N"))
      continue;
    if (found) return nullptr;
    found = &column;
  }
  return found;
}

std::string torque_question(const guess::Column& torque) {
  return fmt::format("At which radius does friction act? {} is a torque, in {}{}.",
                     printable(shown_name(torque)), printable(unit_of_torque(torque)),
                     torque.unit.empty() ? " as is assumed" : "");
}

std::string force_of_torque(const guess::Column& torque, const std::string& radius_m) {
  const double newton_metres = convert(unit_of_torque(torque), "N m")->factor;
  return fmt::format("{}{}/{}", newton_metres == 1 ? "" : shortest(newton_metres) + "*",
                     data::name_in_formulas(torque.name), radius_m);
}

} // namespace frictab::job
