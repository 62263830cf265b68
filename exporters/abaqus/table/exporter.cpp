// Target `abaqus_table`: data lines of *FRICTION without USER, for Abaqus/Standard and /Explicit.
#include "codegen/exporter.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "codegen/native_table.h"
#include "core/error.h"
#include "core/template.h"

namespace frictab::abaqus::table {

using namespace codegen;

namespace {

constexpr const char* file_name = "frictab_friction.inp";
// Cells after the coefficient: rate, pressure, temperature.
constexpr std::size_t first_field = 3;

std::size_t cell_of(const NativeColumn& column) {
  if (column.field > 0) return first_field + column.field - 1;
  if (column.state == "T_contact_C") return 2;
  return column.state == "sigma_n_MPa" ? 1 : 0;
}

// Counts the fields of *FRICTION, which are numbered from 1 without a gap.
std::size_t field_count(const std::vector<NativeColumn>& columns) {
  std::size_t count = 0, last = 0;
  for (const NativeColumn& column : columns) {
    count += column.field > 0;
    last = std::max(last, column.field);
  }
  if (count != last)
    throw InputError(
        at_job_key("export.inputs", ""),
        fmt::format("*FRICTION counts its fields from 1: {} of {} are used", count, last),
        "field:1, field:2, ... without a gap");
  return count;
}

std::string data_lines(const NativeTable& table, std::size_t fields) {
  std::string out;
  for (std::size_t i = 0; i < table.values.value.size(); ++i) {
    const std::vector<double> place = place_of(table.values, i);
    std::vector<std::string> cells(first_field + fields);
    for (std::size_t c = 0; c < place.size(); ++c)
      if (!std::isnan(place[c])) cells[cell_of(table.columns[c])] = " " + native_number(place[c]);
    while (!cells.empty() && cells.back().empty())
      cells.pop_back();
    out += " " + native_number(table.values.value[i]);
    for (const std::string& cell : cells)
      out += "," + cell;
    out += "\n";
  }
  out.pop_back();
  return out;
}

// Reads the limit from "*FRICTION, TAUMAX=350".
void read_keyword(std::string_view line, NativeValues& values) {
  const auto cells = split_cells(line, ',');
  if (cells[0] != "*FRICTION") throw std::runtime_error("no *FRICTION line");
  for (std::size_t i = 1; i < cells.size(); ++i)
    if (cells[i].starts_with("TAUMAX=")) values.limit = read_number(cells[i].substr(7));
}

const char* const source_of_signature =
    "verified: order of the columns, DEPENDENCIES and TAUMAX (keyword guide). recalled, check "
    "against your release: the slip rate varies fastest, linear between lines, constant beyond "
    "the ends";

const std::string target_notes =
    std::string("Columns for slip rate, pressure, temperature, and field variables where "
                "[export.inputs] says field:N (up to 4, counted from 1); every other state of the "
                "law ") +
    native_fixed_words +
    "A column the law does not depend on stays blank. TAUMAX holds the law's shear limit at the "
    "held flow stress. The grid is made to table.tolerance_MPa with at most 30,000 lines. Beyond "
    "the ends Abaqus keeps "
    "the coefficient there; downwards the table goes to where tau_R is below the tolerance.";

class AbaqusTable final : public NativeTarget {
public:
  AbaqusTable()
      : NativeTarget(
            {.name = "abaqus_table",
             .order = 70,
             .title = "Abaqus *FRICTION data lines, no user routine",
             .signature_source = source_of_signature,
             .notes = target_notes},
            {.file = file_name,
             .entry = "*FRICTION",
             .input_deck =
                 "*Surface Interaction, name=FRICTAB\n*Include, input=frictab_friction.inp\n",
             .plain_name = "abaqus",
             .plain_order = 3,
             .plain_title = "*FRICTION data lines: mu over slip rate, pressure, temperature"}) {}

private:
  NativeForm form(const ExportRequest&) const override {
    NativeForm out;
    out.gives = {.states = {{.state = "v_rel_mm_s", .text = "column 2, slip rate"},
                            {.state = "sigma_n_MPa", .text = "column 3, contact pressure"},
                            {.state = "T_contact_C",
                             .text = "column 4, average temperature of both surfaces"}},
                 .field = {.text = "field variable @{field}"}};
    out.limits = true;
    out.most_fields = 4; // further fields need another line
    out.interpolation = "linear between the lines, the slip rate varies fastest (recalled); TAUMAX "
                        "limits the stress";
    return out;
  }

  std::string write(const ExportRequest&, const NativeTable& table,
                    const std::vector<std::string>& comments) const override {
    const std::size_t fields = field_count(table.columns);
    TemplateValues values;
    values.lists["comments"] = items(comments);
    values.text["taumax"] =
        table.values.limit ? ", TAUMAX=" + native_number(*table.values.limit) : "";
    values.text["dependencies"] = fields > 0 ? fmt::format(", DEPENDENCIES={}", fields) : "";
    values.text["data"] = data_lines(table, fields);
    return render_template("abaqus/table/frictab_friction.inp", values);
  }

  NativeValues read(const std::string& text, const ExportRequest& request) const override {
    const std::vector<NativeColumn> columns = native_columns(request, form(request));
    const auto lines = deck_lines(text, "**");
    if (lines.empty()) throw std::runtime_error("no *FRICTION line");
    NativeValues keyword;
    read_keyword(lines[0], keyword);
    std::vector<std::vector<double>> places;
    std::vector<double> value;
    for (std::size_t l = 1; l < lines.size(); ++l) {
      const auto cells = split_cells(lines[l], ',');
      value.push_back(read_number(cells[0]));
      std::vector<double> place(columns.size(), std::nan(""));
      for (std::size_t c = 0; c < columns.size(); ++c)
        if (const std::size_t at = cell_of(columns[c]) + 1; at < cells.size() && !cells[at].empty())
          place[c] = read_number(cells[at]);
      places.push_back(std::move(place));
    }
    NativeValues out = values_of_rows(places, value);
    out.limit = keyword.limit;
    return out;
  }
};

const RegisteredNative<AbaqusTable> registered;

} // namespace

} // namespace frictab::abaqus::table
