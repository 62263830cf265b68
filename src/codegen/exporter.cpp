// The registry of targets.
#include "codegen/exporter.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"

namespace frictab::codegen {

namespace {

std::string value_or_empty(const std::map<std::string, std::string>& values,
                           const std::string& name) {
  const auto found = values.find(name);
  return found == values.end() ? "" : found->second;
}

} // namespace

std::string ExportRequest::option_or_empty(const std::string& name) const {
  return value_or_empty(options, name);
}

std::string ExportRequest::input_or_empty(const std::string& name) const {
  return value_or_empty(inputs, name);
}

table::Table Exporter::own_table(const ExportRequest&, const SourceBundle&) const {
  throw std::logic_error(name + " is a routine");
}

void Exporter::batch(void*, const ExportRequest&, std::size_t, std::span<const double* const>,
                     std::span<double>) const {
  throw std::logic_error(name + " has no batch entry");
}

CombinedBundle Exporter::combine(const std::vector<ExportRequest>&,
                                 const std::vector<std::string>&) const {
  throw std::logic_error(name + " combines no laws");
}

const std::string& Exporter::option(const ExportRequest& request, const std::string& wanted) const {
  if (const auto given = request.options.find(wanted); given != request.options.end())
    return given->second;
  for (const ExportOption& option : options)
    if (option.name == wanted) return option.allowed.front();
  throw std::logic_error(name + " has no option " + wanted);
}

bool Exporter::offers(std::string_view option) const {
  return std::any_of(options.begin(), options.end(),
                     [&](const ExportOption& one) { return one.name == option; });
}

std::vector<ExportOption> all_export_options() {
  std::vector<ExportOption> all;
  for (const Exporter& exporter : all_exporters())
    for (const ExportOption& option : exporter.options)
      if (std::none_of(all.begin(), all.end(),
                       [&](const ExportOption& other) { return other.name == option.name; }))
        all.push_back(option);
  return all;
}

std::vector<std::reference_wrapper<const Exporter>> all_exporters() {
  std::vector<std::reference_wrapper<const Exporter>> all;
  for (const ExporterPointer& exporter : Registry<ExporterPointer>::instance().all())
    all.emplace_back(*exporter);
  return all;
}

const Exporter* find_exporter(std::string_view name) {
  const ExporterPointer* found = Registry<ExporterPointer>::instance().find(name);
  return found ? found->get() : nullptr;
}

std::vector<const Exporter*> exporters_named(const std::vector<std::string>& names) {
  std::vector<std::string> known{"all"};
  for (const Exporter& exporter : all_exporters())
    known.push_back(exporter.name);
  for (const std::string& name : names)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError({}, fmt::format("there is no target '{}'", name), suggest(name, known));
  std::vector<const Exporter*> chosen;
  for (const Exporter& exporter : all_exporters())
    if (std::any_of(names.begin(), names.end(), [&](const std::string& name) {
          return name == "all" || name == exporter.name;
        }))
      chosen.push_back(&exporter);
  return chosen;
}

} // namespace frictab::codegen
