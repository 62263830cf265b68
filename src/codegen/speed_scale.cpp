// The property that says by how much a simulation is faster than its process.
#include "codegen/speed_scale.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace frictab::codegen {

namespace {

constexpr const char* option_name = "speed_scale";
constexpr const char* meaning = "how many times faster than the process the simulation runs";

bool is_scaled(const ExportRequest& request) {
  const auto said = request.options.find(option_name);
  return said != request.options.end() && said->second == "property";
}

} // namespace

ExportOption speed_scale_option() {
  return {option_name,
          {"none", "property"},
          "for simulations scaled in speed or time: a property of the deck, behind those of the "
          "states, says how many times faster than the process they run; the law gets the "
          "process's speeds and times"};
}

std::size_t speed_scale_property(const ExportRequest& request,
                                 const std::vector<SolverInput>& inputs) {
  return is_scaled(request) ? property_count(inputs) + 1 : 0;
}

std::size_t all_properties(const ExportRequest& request, const std::vector<SolverInput>& inputs) {
  return property_count(inputs) + (is_scaled(request) ? 1 : 0);
}

std::vector<std::string> speed_scale_placeholder(const ExportRequest& request) {
  if (!is_scaled(request)) return {};
  return {fmt::format("<{}>", meaning)};
}

std::vector<std::string> speed_scale_line(const ExportRequest& request,
                                          const std::vector<SolverInput>& inputs) {
  if (!is_scaled(request)) return {};
  return {fmt::format("{} {}, above 0 (1)", property_count(inputs) + 1, meaning)};
}

void add_speed_scale(nlohmann::ordered_json& properties, const ExportRequest& request,
                     const std::vector<SolverInput>& inputs) {
  if (!is_scaled(request)) return;
  properties.push_back({{"number", property_count(inputs) + 1},
                        {"quantity", option_name},
                        {"unit", "1"},
                        {"meaning", meaning},
                        {"used_when", "always"},
                        {"where_absent", 1}});
}

} // namespace frictab::codegen
