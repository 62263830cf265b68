// Decides when values leave the source, and describes their file.
#include "codegen/values_file.h"

#include <bit>
#include <cstring>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <zlib.h>

#include "codegen/baked_table.h"
#include "codegen/table_checks.h"
#include "core/error.h"
#include "core/text.h"

namespace frictab::codegen {

namespace {

static_assert(std::endian::native == std::endian::little, "the file is written as memory holds it");

constexpr const char* values_key = "values";

std::string bytes_of(const std::vector<double>& numbers) {
  std::string bytes(numbers.size() * sizeof(double), '\0');
  if (!numbers.empty()) std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

std::uint32_t crc32_of(const char* bytes, std::size_t size) {
  return static_cast<std::uint32_t>(
      crc32_z(crc32_z(0, nullptr, 0), reinterpret_cast<const Bytef*>(bytes), size));
}

void check_values(const table::Table& table) {
  if (table.nodes() <= most_filed_values) return;
  throw InputError({},
                   fmt::format("the table of {} has {} values; a routine holds at most {} of them "
                               "in memory",
                               table.model, thousands(table.nodes()), thousands(most_filed_values)),
                   smaller_table);
}

void check_size(const ExportRequest& request) {
  const bool file = values_in_file(request);
  if (file) check_values(request.table);
  const bool held_back = request.options.count(values_key) > 0 && !file;
  check_table_size(request.table, file ? request.table.nodes() : 0,
                   held_back ? "export.options.values = \"auto\", " : "");
}

} // namespace

ExportOption values_option() {
  return {values_key,
          {"auto", "source", "file", "file_windows"},
          fmt::format("where the table's values lie: in the source, or in {}, which the routine "
                      "reads at its first call (the choice of \"auto\" above {} numbers); Fortran "
                      "for Windows has to be set",
                      values_file_name, thousands(most_baked_numbers))};
}

bool values_in_file(const ExportRequest& request) {
  if (request.table.is_direct() || request.table.axes.empty()) return false;
  const std::string said = request.option_or_empty(values_key);
  if (!said.empty() && said != "auto") return said != "source";
  return baked_numbers(request.table) > most_baked_numbers;
}

bool values_for_windows(const ExportRequest& request) {
  return request.option_or_empty(values_key) == "file_windows";
}

void check_request(const ExportRequest& request) {
  check_table(request.table);
  check_size(request);
}

void check_request_size(const table::Table& table, const std::vector<const Exporter*>& targets,
                        const std::map<std::string, std::string>& options) {
  for (const Exporter* target : targets) {
    if (!target->is_routine()) continue; // a solver's own table
    const ExportRequest request{.table = table, .options = options};
    if (target->offers(values_key))
      check_size(request);
    else
      check_table_size(table);
  }
}

void add_values_file(SourceBundle& files, const ExportRequest& request) {
  if (values_in_file(request)) files[values_file_name] = bytes_of(baked_values(request.table));
}

nlohmann::ordered_json values_file_json(const std::string& bytes) {
  return {{"name", values_file_name},
          {"numbers", bytes.size() / sizeof(double)},
          {"type", "float64, lowest byte first, last axis fastest"},
          {"crc32", fmt::format("{:08x}", crc32_of(bytes.data(), bytes.size()))},
          {"read", "once per process, at the first call, while other threads wait; "
                   "from the directory given to frictab_directory, else "
                   "FRICTAB_DIR of the environment, else where the solver says the job lies, else "
                   "the current directory. Missing, of another size or with another CRC-32: the "
                   "analysis ends, functions give NaN"}};
}

void add_values_file(TemplateValues& values, const std::vector<double>& numbers) {
  values.text["file"] = values_file_name;
  values.text["n_values"] = std::to_string(numbers.size());
  values.text["n_bytes"] = std::to_string(numbers.size() * sizeof(double));
}

std::uint32_t values_crc32(const std::vector<double>& numbers) {
  return crc32_of(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(double));
}

std::vector<std::string> values_file_lines(const ExportRequest& request,
                                           const std::string& solver) {
  if (!values_in_file(request)) return {};
  return {
      fmt::format("The table's values lie in {}, which the first call reads: from the directory "
                  "given to frictab_directory, else $FRICTAB_DIR, else {}the current directory",
                  values_file_name, solver.empty() ? "" : "what " + solver + " says, else ")};
}

} // namespace frictab::codegen
