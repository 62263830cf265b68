#include "job/open_points.h"

#include <algorithm>
#include <cmath>
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

// Energies have the dimension of torques.
bool names_energy(const guess::Column& column) {
  const std::string name = data::words_of_name(column.name);
  return name.find("energ") != name.npos || name.find("arbeit") != name.npos ||
         data::has_word(name, {"work"});
}

// Unit of a torque: the file's, the one at the end of the name, or N m; empty for other columns.
std::string unit_of_torque(const guess::Column& column) {
  if (!column.canonical.empty() || column.text || column.above || names_energy(column)) return "";
  if (!column.unit.empty()) return convert(column.unit, "N m") ? column.unit : "";
  const std::string unit = data::unit_in_name(column.name, "N m");
  return unit.empty() && is_named_torque(column) ? "N m" : unit;
}

// Friction of a head or a bearing surface before any other, and that before a total or a drive.
int rank_of_torque(const guess::Column& column) {
  const std::string name = data::words_of_name(column.name);
  const auto has = [&](const char* part) { return name.find(part) != name.npos; };
  const bool is_of_thread = has("gewinde") || has("thread");
  if (!is_of_thread && (has("kopf") || data::has_word(name, {"head", "underhead"}))) return 3;
  if (!is_of_thread && (has("reib") || has("friction"))) return 2;
  const bool is_sum = has("gesamt") || has("total") || has("drive") || has("antrieb") ||
                      has("motor") || has("anzieh") || has("tightening");
  return is_sum || is_of_thread ? 0 : 1;
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
  if (column.canonical == "F_N_N" && guess::is_in_mass(column)) return "kgf";
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
                          (canonical == "F_R_N" && !file_.friction.empty()) ||
                          (canonical == "v_rel_mm_s" && !file_.speed.empty());
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

std::vector<const guess::Column*> OpenPoints::torques() const {
  std::vector<const guess::Column*> found;
  for (const guess::Column& column : file_.columns)
    if (!unit_of_torque(column).empty()) found.push_back(&column);
  std::stable_sort(found.begin(), found.end(), [](const auto* a, const auto* b) {
    return rank_of_torque(*a) > rank_of_torque(*b);
  });
  return found;
}

const guess::Column* OpenPoints::torque() const {
  const auto all = torques();
  return all.empty() ? nullptr : all.front();
}

const guess::Column* OpenPoints::aid(guess::Aid aid) const {
  for (const guess::Column* column : columns())
    if (guess::is_aid(*column, aid)) return column;
  return nullptr;
}

OpenPoints::Radius OpenPoints::radius_in(const std::string& unit) const {
  if (const guess::Column* const radius = aid(guess::Aid::track_radius))
    return {guess::term_of(*radius, unit), radius};
  if (const guess::Column* const diameter = aid(guess::Aid::track_diameter))
    return {guess::term_of(*diameter, unit, 2), diameter};
  return {};
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
  const auto gives = [](const guess::File& file, const guess::Column& condition) {
    return std::any_of(file.columns.begin(), file.columns.end(), [&](const guess::Column& column) {
      return column.above && column.name == condition.name;
    });
  };
  std::vector<const guess::Column*> all;
  for (const guess::Column& column : file_.columns)
    if (!column.above || std::all_of(campaign_.files.begin(), campaign_.files.end(),
                                     [&](const auto& file) { return gives(file, column); }))
      all.push_back(&column);
  if (campaign_.tests)
    for (const guess::Column& column : campaign_.tests->columns)
      if (!column.above) all.push_back(&column);
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

void take_known_formulas(guess::Campaign& campaign) {
  const OpenPoints points(campaign);
  // True if all files have the column, or the table of tests has it.
  const auto is_everywhere = [&](const guess::Column* column) {
    const auto has = [&](const guess::File& file) {
      return std::any_of(file.columns.begin(), file.columns.end(),
                         [&](const guess::Column& one) { return one.name == column->name; });
    };
    return column && ((campaign.tests && has(*campaign.tests)) ||
                      std::all_of(campaign.files.begin(), campaign.files.end(), has));
  };
  guess::Formula speed, friction;
  const OpenPoints::Radius in_mm = points.radius_in("mm"), in_m = points.radius_in("m");
  if (!is_everywhere(in_mm.column)) return;
  const std::string radius = printable(shown_name(*in_mm.column));
  const std::string assumed =
      !in_mm.column->unit.empty() || !data::unit_in_name(in_mm.column->name, "mm").empty()
          ? ""
          : "; no unit is given: mm is assumed";
  if (const guess::Column* const turns = points.rotation(); is_everywhere(turns))
    speed = {speed_of_turns(*turns, in_mm.term),
             fmt::format("a rotation at the radius by {}{}", radius, assumed)};
  if (const guess::Column* const torque = points.torque();
      is_everywhere(torque) && points.lacks_friction())
    friction = {force_of_torque(*torque, assumed.empty() ? in_m.term : in_mm.term + "/1000"),
                fmt::format("a torque over the radius by {}{}", radius, assumed)};
  const guess::File most = points.file();
  for (guess::File& file : campaign.files)
    if (file.is_read_as(most)) {
      if (!speed.empty()) file.speed = speed;
      if (!friction.empty()) file.friction = friction;
    }
}

std::string speed_of_turns(const guess::Column& turns, const std::string& radius_mm) {
  const std::string factor = guess::turn_factor(turns);
  return fmt::format("{}*{}{}", data::name_in_formulas(turns.name),
                     factor == "1" ? "" : factor + "*", radius_mm);
}

std::string force_of_voltage(const guess::Column& voltage, const guess::Column* calibration,
                             const std::string& factor) {
  const std::string name = data::name_in_formulas(voltage.name);
  if (!calibration) return name + "*" + factor;
  const double newtons = guess::factor_to(*calibration, "N/V") * guess::factor_to(voltage, "V");
  const bool is_one = std::abs(newtons - 1) < 1e-9;
  return fmt::format("{}{}*{}", is_one ? "" : fmt::format("{:.10g}*", newtons), name,
                     data::name_in_formulas(calibration->name));
}

std::string speed_of_strokes(const OpenPoints& points) {
  const guess::Column *const stroke = points.aid(guess::Aid::stroke), *const frequency = points.aid(
                                                                          guess::Aid::frequency);
  return stroke && frequency ? fmt::format("2*{}*{}", guess::term_of(*stroke, "mm"),
                                           guess::term_of(*frequency, "Hz"))
                             : "";
}

std::string pressure_of_pin(const OpenPoints& points) {
  const guess::Column* const diameter = points.aid(guess::Aid::pin_diameter);
  if (!diameter) return "";
  const std::string term = guess::term_of(*diameter, "mm");
  const bool is_name = term.find_first_of("*/") == term.npos;
  return fmt::format("F_N_N/(pi/4*{}**2{})", is_name ? term : "(" + term + ")",
                     points.has("psi") ? "*psi" : "");
}

std::string pressure_of_ball(const OpenPoints& points) {
  const guess::Column *const radius = points.aid(guess::Aid::ball_radius),
                             *const diameter = points.aid(guess::Aid::ball_diameter);
  if (!radius && !diameter) return "";
  const std::string radius_mm =
      radius ? guess::term_of(*radius, "mm") : guess::term_of(*diameter, "mm", 2);
  return fmt::format("F_N_N/(pi*(3*F_N_N*{}/(4*115385))**(2/3))", radius_mm);
}

bool is_increase(const guess::Column& column) {
  constexpr double ratio = 0.9; // for scatter
  if (column.canonical != "psi" || column.name == "psi" || column.number > 0) return false;
  const auto whole = convert(column.unit.empty() ? "1" : column.unit, "1");
  return whole && column.least * whole->factor < ratio;
}

std::string torque_question(const guess::Column& torque) {
  return fmt::format("At which radius does friction act? {} is a torque, in {}{}.",
                     printable(shown_name(torque)), printable(unit_of_torque(torque)),
                     torque.unit.empty() ? " as is assumed" : "");
}

std::string force_of_torque(const guess::Column& torque, const std::string& radius_m) {
  const double newton_metres = convert(unit_of_torque(torque), "N m")->factor;
  const bool is_product = radius_m.find_first_of("*/") != radius_m.npos;
  return fmt::format("{}{}/{}", newton_metres == 1 ? "" : shortest(newton_metres) + "*",
                     data::name_in_formulas(torque.name),
                     is_product ? "(" + radius_m + ")" : radius_m);
}

} // namespace frictab::job
