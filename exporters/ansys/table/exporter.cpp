// Target `ansys_table`: TB,FRIC with TBFIELD over temperature, pressure, sliding distance, sliding
// velocity and user fields.
#include "codegen/exporter.h"

#include <cmath>
#include <map>

#include <fmt/format.h>

#include "codegen/native_table.h"
#include "core/template.h"

namespace frictab::ansys::table {

using namespace codegen;

namespace {

constexpr const char* file_name = "frictab_friction.mac";

std::string field_name(const NativeColumn& column) {
  if (column.field > 0) return fmt::format("UF0{}", column.field);
  return column.text.substr(0, column.text.find(',')); // "SLRV, sliding velocity"
}

// Writes the commands. A field is repeated only where its value changes, the slowest first.
std::string commands(const NativeTable& table) {
  std::string out;
  std::vector<double> before;
  for (std::size_t i = 0; i < table.values.value.size(); ++i) {
    const std::vector<double> place = place_of(table.values, i);
    bool slower = false; // a field that varies more slowly has just changed
    for (std::size_t c = place.size(); c-- > 0;) {
      if (std::isnan(place[c])) continue;
      slower = slower || before.empty() || place[c] != before[c];
      if (slower)
        out +=
            fmt::format("TBFIELD,{},{}\n", field_name(table.columns[c]), native_number(place[c]));
    }
    out += fmt::format("TBDATA,1,{}\n", native_number(table.values.value[i]));
    before = place;
  }
  out.pop_back();
  return out;
}

const char* const source_of_signature =
    "verified: TB,FRIC,,,,ISO with TBFIELD over TEMP, NPRES, SLDI (total sliding distance, "
    "absolute), SLRV and UF01 to UF09, ascending, a field that is named stays active (command "
    "reference). recalled, check against your release: linear between, constant beyond the "
    "ends; TAUMAX is real constant 9 of the contact elements";

const std::string target_notes =
    std::string("Fields for pressure, sliding velocity, sliding distance, temperature, and UF0N "
                "where [export.inputs] says field:N (1 to 9); every other state of the law ") +
    native_fixed_words +
    "RMODIF sets TAUMAX to the "
    "law's shear limit at the held flow stress: without it the friction exceeds the limit. Set "
    "ft_mat and ft_real to your material and real constant set. The grid is made to "
    "table.tolerance_MPa with at most 30,000 values.";

class AnsysTable final : public NativeTarget {
public:
  AnsysTable()
      : NativeTarget(
            {.name = "ansys_table",
             .order = 80,
             .title = "ANSYS MAPDL TB,FRIC with TBFIELD, no user routine",
             .signature_source = source_of_signature,
             .notes = target_notes},
            {.file = file_name,
             .entry = "TB,FRIC",
             .input_deck =
                 "/PREP7\nft_mat = 1   ! material of the contact pair\nft_real = 1  ! its real "
                 "constant set\n/INPUT,frictab_friction,mac\n",
             .plain_name = "ansys",
             .plain_order = 5,
             .plain_title = "TB,FRIC with TBFIELD: mu over pressure, velocity, sliding distance, "
                            "temperature"}) {}

private:
  NativeForm form(const ExportRequest&) const override {
    NativeForm out;
    out.gives = {.states = {{.state = "sigma_n_MPa", .text = "NPRES, normal pressure"},
                            {.state = "v_rel_mm_s", .text = "SLRV, sliding velocity"},
                            {.state = "s_mm", .text = "SLDI, total sliding distance (absolute)"},
                            {.state = "T_contact_C", .text = "TEMP"}},
                 .field = {.text = "UF0@{field}, user-defined field"}};
    out.limits = true;
    out.most_fields = 9;
    out.interpolation =
        "linear between the values of every field (recalled); TAUMAX, real constant "
        "9 of the contact elements, limits the stress (recalled)";
    return out;
  }

  std::string write(const ExportRequest&, const NativeTable& table,
                    const std::vector<std::string>& comments) const override {
    TemplateValues values;
    values.lists["comments"] = items(comments);
    values.flags["limited"] = table.values.limit.has_value();
    values.text["limit"] = table.values.limit ? native_number(*table.values.limit) : "";
    values.text["commands"] = commands(table);
    return render_template("ansys/table/frictab_friction.mac", values);
  }

  NativeValues read(const std::string& text, const ExportRequest& request) const override {
    const std::vector<NativeColumn> columns = native_columns(request, form(request));
    std::map<std::string, double, std::less<>> now;
    std::vector<std::vector<double>> places;
    std::vector<double> value;
    std::optional<double> limit;
    for (const std::string_view line : deck_lines(text, "!")) {
      const auto cells = split_cells(line, ',');
      if (cells[0] == "TBFIELD" && cells.size() == 3) {
        now[std::string(cells[1])] = read_number(cells[2]);
      } else if (cells[0] == "TBDATA" && cells.size() == 3 && cells[1] == "1") {
        std::vector<double> place;
        for (const NativeColumn& column : columns) {
          const auto found = now.find(field_name(column));
          place.push_back(found == now.end() ? std::nan("") : found->second);
        }
        places.push_back(std::move(place));
        value.push_back(read_number(cells[2]));
      } else if (cells[0] == "RMODIF" && cells.size() == 4) {
        limit = read_number(cells[3]);
      } else if (cells[0] != "TB") {
        throw std::runtime_error(fmt::format("unknown command '{}'", line));
      }
    }
    NativeValues out = values_of_rows(places, value);
    out.limit = limit;
    return out;
  }
};

const RegisteredNative<AnsysTable> registered;

} // namespace

} // namespace frictab::ansys::table
