// The property with the factor by which a simulation is faster than its process.
#include "codegen/speed_scale.h"

namespace frictab::codegen {

namespace {

constexpr const char* scale_key = "speed_scale";

} // namespace

ExportOption speed_scale_option() {
  return {scale_key,
          {"none", "property"},
          "for simulations scaled in speed or time: a property of the deck, after those of the "
          "states, says how many times faster than the process they run; the law gets the "
          "process's speeds and times"};
}

FurtherProperties speed_scale(const ExportRequest& request,
                              const std::vector<SolverInput>& inputs) {
  if (request.option_or_empty(scale_key) != "property") return {};
  const std::string meaning = "how many times faster than the process the simulation runs";
  return {{.number = property_count(inputs) + 1,
           .quantity = scale_key,
           .unit = "1",
           .meaning = meaning,
           .line = meaning + ", above 0 (1)",
           .placeholder = "<" + meaning + ">",
           .where_absent = 1}};
}

std::size_t speed_scale_property(const ExportRequest& request,
                                 const std::vector<SolverInput>& inputs) {
  const FurtherProperties property = speed_scale(request, inputs);
  return property.empty() ? 0 : property.front().number;
}

void add_speed_scale(TemplateValues& values, const ExportRequest& request,
                     const std::vector<SolverInput>& inputs) {
  const FurtherProperties property = speed_scale(request, inputs);
  values.flags["scaled"] = !property.empty();
  if (!property.empty()) values.text["scale"] = std::to_string(property.front().number);
}

} // namespace frictab::codegen
