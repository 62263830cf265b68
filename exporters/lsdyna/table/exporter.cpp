// Target `lsdyna_table`: *DEFINE_TABLE of relative velocities, each with a curve of the coefficient
// over pressure, as FS=2 of *CONTACT_..._SURFACE_TO_SURFACE reads it.
#include "codegen/exporter.h"

#include <fmt/format.h>

#include "codegen/native_table.h"
#include "codegen/solver_units.h"
#include "core/template.h"

namespace frictab::lsdyna::table {

using namespace codegen;

namespace {

constexpr const char* file_name = "frictab_friction.k";
constexpr int table_id = 90000; // curves have the numbers that follow
constexpr std::size_t width = 20;

Lines curves(const NativeTable& table) {
  const auto &pressure = table.values.nodes[0], &speed = table.values.nodes[1];
  Lines out;
  for (std::size_t s = 0; s < speed.size(); ++s) {
    std::string points;
    for (std::size_t p = 0; p < pressure.size(); ++p)
      points += fmt::format("{:>20}{:>20}{}", native_number(pressure[p]),
                            native_number(table.values.value[s * pressure.size() + p]),
                            p + 1 < pressure.size() ? "\n" : "");
    out.push_back({.text = {{"id", fmt::format("{:>10}", table_id + 1 + static_cast<int>(s))},
                            {"points", points}}});
  }
  return out;
}

std::string input_deck() {
  return fmt::format("*INCLUDE\n{}\n$ *CONTACT_..._SURFACE_TO_SURFACE, card 2: FS=2, FD={} (the "
                     "table), with the thickness offset option\n$        fs        fd\n"
                     "       2.0   {}.0\n",
                     file_name, table_id, table_id);
}

double card(std::string_view line, std::size_t cell) {
  if (line.size() < width * (cell + 1)) throw std::runtime_error("a card is too short");
  const auto cells = split_cells(line.substr(width * cell, width), ' ');
  if (cells.size() != 1) throw std::runtime_error("a card has no number where one belongs");
  return read_number(cells[0]);
}

double number_of(std::string_view line) {
  const auto cells = split_cells(line, ' ');
  return read_number(cells.size() == 1 ? cells[0] : line);
}

const char* const source_of_signature =
    "verified: FS=2 with FD the number of a table over relative velocity and pressure, together "
    "with the thickness offset option; in such tables a curve over pressure per velocity (fields "
    "of the keywords). recalled, check against your release: the curves stand directly after "
    "*DEFINE_TABLE in the order of its values, linear between, constant beyond the ends";

const std::string target_notes =
    std::string("Velocity and pressure are all this table knows; every other state of the law ") +
    native_fixed_words +
    "The shear limit is part of the table, at the held flow stress. Table and curves are numbered "
    "from 90000: renumber them where your deck has these. The grid is made to "
    "table.tolerance_MPa with at most 30,000 points.";

class LsdynaTable final : public NativeTarget {
public:
  LsdynaTable()
      : NativeTarget(
            {.name = "lsdyna_table",
             .order = 75,
             .title =
                 "LS-DYNA *DEFINE_TABLE of friction over velocity and pressure, no user routine",
             .signature_source = source_of_signature,
             .notes = target_notes},
            {.file = file_name,
             .entry = fmt::format("*DEFINE_TABLE {}", table_id),
             .input_deck = input_deck(),
             .plain_name = "lsdyna",
             .plain_order = 4,
             .plain_title =
                 "*DEFINE_TABLE and *DEFINE_CURVE: mu over pressure, a curve per speed"}) {}

private:
  NativeForm form(const ExportRequest&) const override {
    NativeForm out;
    out.gives.states = {
        {.state = "sigma_n_MPa", .text = "abscissa of the curves, interface pressure"},
        {.state = "v_rel_mm_s", .text = "value of the table, relative velocity"}};
    out.every_column = true;
    out.interpolation = "linear along each curve and between curves (recalled)";
    return out;
  }

  std::string write(const ExportRequest& request, const NativeTable& table,
                    const std::vector<std::string>& comments) const override {
    TemplateValues values;
    values.lists["comments"] = items(comments);
    values.text["id"] = fmt::format("{:>10}", table_id);
    values.text["stress"] = solver_unit("MPa", request.units).name;
    values.text["speed"] = solver_unit("mm/s", request.units).name;
    for (const double speed : table.values.nodes[1])
      values.lists["speeds"].push_back(item(fmt::format("{:>20}", native_number(speed))));
    values.lists["curves"] = curves(table);
    return render_template("lsdyna/table/frictab_friction.k", values);
  }

  NativeValues read(const std::string& text, const ExportRequest&) const override {
    const auto lines = deck_lines(text, "$");
    if (lines.empty() || lines[0] != "*DEFINE_TABLE") throw std::runtime_error("no *DEFINE_TABLE");
    std::vector<double> speeds, value;
    std::vector<std::vector<double>> places;
    if (lines.size() < 2 || number_of(lines[1]) != table_id)
      throw std::runtime_error("no number of the table");
    std::size_t at = 2;
    for (; at < lines.size() && lines[at][0] != '*'; ++at)
      speeds.push_back(card(lines[at], 0));
    // The curves are in the order of the table's values.
    for (const double speed : speeds) {
      if (at >= lines.size() || lines[at] != "*DEFINE_CURVE")
        throw std::runtime_error("fewer curves than values of the table");
      if (++at >= lines.size() || !(number_of(lines[at]) > table_id))
        throw std::runtime_error("no number of a curve");
      for (++at; at < lines.size() && lines[at][0] != '*'; ++at) {
        places.push_back({card(lines[at], 0), speed});
        value.push_back(card(lines[at], 1));
      }
    }
    if (at < lines.size() && lines[at] != "*END")
      throw std::runtime_error("more curves than values of the table");
    return values_of_rows(places, value);
  }
};

const RegisteredNative<LsdynaTable> registered;

} // namespace

} // namespace frictab::lsdyna::table
