// Fills templates/abaqus/frictab_vufield.f.
#include "contact_fields.h"

#include <fmt/format.h>

#include "codegen/fortran_parts.h"
#include "codegen/solver_units.h"
#include "core/error.h"

namespace frictab::abaqus {

using namespace codegen;

namespace {

constexpr const char* fields_key = "contact_fields";
constexpr unsigned last_field = 3;

const char* const source_of_signature =
    "verified: argument list and sizes in the v2024 reference, and in the public routine and deck "
    "of RWTH WZL that ran in production (*Field, user, number=4; FV in *Element Output). Recalled, "
    "check against your release: kField of fields that are not updated all at once; whether "
    "VUFIELD is called before or after the friction routine of an increment";

} // namespace

ExportOption contact_fields_option() {
  return {
      fields_key,
      {"none", "vufield", "vufield_windows"},
      "contour plots: a VUFIELD next to the routine gives the coefficient, the frictional shear "
      "stress and the increments outside the range at the nodes as field variables 1 to 3"};
}

bool has_contact_fields(const ExportRequest& request) {
  return request.option_or_empty(fields_key).starts_with("vufield");
}

std::string contact_fields_source(const ExportRequest& request) {
  TemplateValues values;
  values.text["stress"] = solver_unit("MPa", request.units).name;
  values.lists["source"] = fortran::comments({source_of_signature});
  const bool windows = request.option_or_empty(fields_key) == "vufield_windows";
  values.flags["windows"] = windows;
  values.text["locks"] = fortran::locks("fv", windows);
  return render_template("abaqus/frictab_vufield.f", values);
}

void check_contact_fields(const ExportRequest& request, const std::vector<SolverInput>& inputs) {
  if (!has_contact_fields(request)) return;
  for (const SolverInput& input : inputs)
    if (input.source == Source::field && input.field <= last_field)
      throw InputError({},
                       fmt::format("contact_fields shows friction in field variables 1 to {}, and "
                                   "the law takes {} from field {}",
                                   last_field, input.argument.name, input.field),
                       fmt::format("[export.inputs] {} = \"field:{}\"", input.argument.name,
                                   last_field + input.field));
}

std::string contact_fields_lines(const ExportRequest& request) {
  if (!has_contact_fields(request)) return "";
  return fmt::format("** and in the step, for contour plots of coefficient, stress and increments "
                     "outside:\n"
                     "*Field, user, number={}\n <nodes of the contact surfaces>\n"
                     "*Output, field\n*Element Output\n FV\n",
                     last_field);
}

} // namespace frictab::abaqus
