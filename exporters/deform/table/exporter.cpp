// Target `deform_table`: FRCFAC of type 5, friction over pressure, temperature and surface stretch,
// in 2-D and 3-D.
#include "codegen/exporter.h"

#include <span>

#include "codegen/native_table.h"
#include "core/error.h"
#include "core/template.h"

namespace frictab::deform::table {

using namespace codegen;

namespace {

constexpr const char* file_name = "frictab_frcfac.key";
constexpr const char* friction_option = "deform_friction";

const std::vector<ExportOption> table_options = {
    {friction_option,
     {"coulomb", "shear"},
     "what DEFORM multiplies: coulomb = mu, by pressure (FricType 2); shear = m, by the shear "
     "yield stress (FricType 1)"}};

// True for shear friction. Rejects the third value of the option, which only the routine's target
// has.
bool is_shear(const ExportRequest& request) {
  const std::string said = request.option_or_empty(friction_option);
  if (!said.empty() && said != "shear" && said != "coulomb")
    throw InputError(at_job_key("export.options", friction_option),
                     "a FRCFAC table holds mu or m, not '" + said + "'",
                     "coulomb or shear; only deform_usrbcc takes constant");
  return said == "shear";
}

std::string number_line(std::span<const double> numbers) {
  std::string line;
  for (const double x : numbers)
    line += (line.empty() ? "" : " ") + native_number(x);
  return line;
}

std::vector<double> numbers(std::string_view line) {
  std::vector<double> out;
  for (const std::string_view cell : split_cells(line, ' '))
    out.push_back(read_number(cell));
  return out;
}

const char* const source_of_signature =
    "verified: FRCFAC of type 5 over pressure, temperature and surface stretch, the pressure "
    "varies fastest, FricType 1 = m and 2 = mu (keyword documentation of v14). recalled, check "
    "against your release: linear between and constant beyond the ends (the manual does not "
    "say), lines that start with * are comments, numbers are separated by blanks";

const std::string target_notes =
    std::string("Pressure, temperature and surface stretch are all this table knows, in 2-D as in "
                "3-D; every other state of the law, sliding speed and distance among them, ") +
    native_fixed_words +
    "deform_friction = \"shear\" writes m = tau_R/k with k = sigma_f/sqrt(3) at the held flow "
    "stress, which DEFORM multiplies by its own k; coulomb writes mu = tau_R/pressure, the shear "
    "limit within. "
    "Object numbers 1 and 2 are yours to change. The grid is made to table.tolerance_MPa with "
    "at most 30,000 values.";

class DeformTable final : public NativeTarget {
public:
  DeformTable()
      : NativeTarget(
            {.name = "deform_table",
             .order = 85,
             .title = "DEFORM FRCFAC table of friction, 2-D and 3-D, no user routine",
             .signature_source = source_of_signature,
             .notes = target_notes,
             .options = table_options},
            {.file = file_name,
             .entry = "FRCFAC",
             .input_deck =
                 "load frictab_frcfac.key in the preprocessor, with your object numbers in "
                 "its FRCFAC line",
             .plain_name = "deform",
             .plain_order = 6,
             .plain_title = "FRCFAC of type 5: mu over pressure, temperature, stretch"}) {}

private:
  NativeForm form(const ExportRequest& request) const override {
    NativeForm out;
    out.gives.states = {{.state = "sigma_n_MPa", .text = "Press, interface pressure"},
                        {.state = "T_contact_C", .text = "Temp, temperature"},
                        {.state = "psi", .text = "Stretch, surface stretch"}};
    out.factor = is_shear(request) ? NativeFactor::shear_yield : NativeFactor::pressure;
    out.every_column = true;
    out.interpolation = "rule not stated in the manual; taken as linear (recalled)";
    return out;
  }

  std::string write(const ExportRequest& request, const NativeTable& table,
                    const std::vector<std::string>& comments) const override {
    TemplateValues values;
    values.lists["comments"] = items(comments);
    values.text["type"] = is_shear(request) ? "1" : "2";
    const auto& nodes = table.values.nodes;
    for (std::size_t c = 0; c < 3; ++c)
      values.lists["axes"].push_back(item(number_line(nodes[c])));
    values.text["n_press"] = std::to_string(nodes[0].size());
    values.text["n_temp"] = std::to_string(nodes[1].size());
    values.text["n_stretch"] = std::to_string(nodes[2].size());
    const std::span<const double> all = table.values.value;
    for (std::size_t i = 0; i < all.size(); i += nodes[0].size())
      values.lists["rows"].push_back(item(number_line(all.subspan(i, nodes[0].size()))));
    return render_template("deform/table/frictab_frcfac.key", values);
  }

  NativeValues read(const std::string& text, const ExportRequest& request) const override {
    const auto lines = deck_lines(text, "*");
    if (lines.size() < 5 || !lines[0].starts_with("FRCFAC ")) throw std::runtime_error("no FRCFAC");
    const std::vector<double> head = numbers(lines[0].substr(7));
    if (head.size() != 7 || head[2] != (is_shear(request) ? 1 : 2) || head[3] != 5)
      throw std::runtime_error("FRCFAC is of another type");
    NativeValues out;
    for (std::size_t c = 0; c < 3; ++c) {
      out.nodes.push_back(numbers(lines[1 + c]));
      if (static_cast<double>(out.nodes[c].size()) != head[4 + c])
        throw std::runtime_error("an axis of FRCFAC has another number of places than it says");
    }
    for (std::size_t l = 4; l < lines.size(); ++l) {
      const std::vector<double> row = numbers(lines[l]);
      if (row.size() != out.nodes[0].size())
        throw std::runtime_error("a line of FRCFAC has not one value per pressure");
      out.value.insert(out.value.end(), row.begin(), row.end());
    }
    if (out.value.size() != out.nodes[0].size() * out.nodes[1].size() * out.nodes[2].size())
      throw std::runtime_error("FRCFAC has not one value per place");
    return out;
  }
};

const RegisteredNative<DeformTable> registered;

} // namespace

} // namespace frictab::deform::table
