// Adds the prefix to names that would collide in one program.
#include "codegen/prefix.h"

#include <algorithm>
#include <array>
#include <cctype>

#include <fmt/format.h>

#include "core/text.h"

namespace frictab::codegen {

namespace {

constexpr const char* usual_prefix = "frictab";
constexpr const char* prefix_name = "prefix";
// Longest prefix: names add up to 21 characters; Fortran allows 63 per name, and 132 per line.
constexpr std::size_t longest_prefix = 24;

// Beginnings of names, including the linked names of module units that read a values file.
constexpr std::array prefixed_names = {
    "frictab_tau_R",  "frictab_outside", "frictab_count_outside", "frictab_directory",
    "frictab_values", "frictab_law",     "frictab_read_values",   "frictab_once"};

std::string prefix_fault(const std::string& text) {
  const auto fits = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  const bool ascii = std::all_of(text.begin(), text.end(), [](char c) { return c > 0; });
  if (!text.empty() && text.size() <= longest_prefix && ascii && !std::isdigit(text[0]) &&
      text[0] != '_' && std::all_of(text.begin(), text.end(), fits))
    return "";
  return fmt::format("must be a name of at most {} letters, digits and underscores that starts "
                     "with a letter",
                     longest_prefix);
}

std::string renamed(std::string text, const std::string& prefix) {
  for (const char* const name : prefixed_names)
    text = replace_all(text, name, prefix + (name + std::string_view(usual_prefix).size()));
  std::string guard = prefix;
  std::transform(guard.begin(), guard.end(), guard.begin(),
                 [](unsigned char c) { return std::toupper(c); });
  text = replace_all(text, "FRICTAB_TAU_R_", guard + "_TAU_R_"); // include guards of the headers
  return replace_all(text, "/ftdone/", "/" + prefix + "_ftdone/");
}

} // namespace

ExportOption prefix_option() {
  return {prefix_name,
          {usual_prefix},
          "what names start with, so that the sources of several laws go into one program: "
          "\"die_oil\" gives die_oil_tau_R, die_oil_tau_R.h, the module die_oil_law, and in "
          "routines of solvers die_oil_tau for fttau. The solver's own entry (vfric) keeps its "
          "name: two laws for the same entry need export --combine",
          prefix_fault};
}

bool has_prefix(const ExportRequest& request) {
  return request.law_stem.empty() && prefix(request) != usual_prefix;
}

ExportRequest without_prefix(ExportRequest request) {
  request.options.erase(prefix_name);
  return request;
}

std::string prefix(const ExportRequest& request) {
  if (!request.law_stem.empty()) return fmt::format("{}_{}", usual_prefix, request.law_stem);
  const std::string said = request.option_or_empty(prefix_name);
  return said.empty() ? usual_prefix : said;
}

std::string prefixed(const ExportRequest& request, std::string_view name) {
  return prefix(request) + std::string(name.substr(std::string_view(usual_prefix).size()));
}

SourceBundle with_prefix(const SourceBundle& bundle, const ExportRequest& request) {
  const std::string said = prefix(request);
  if (said == usual_prefix) return bundle;
  SourceBundle out;
  for (const auto& [path, text] : bundle)
    out[renamed(path, said)] = path.ends_with(".bin") ? text : renamed(text, said);
  return out;
}

} // namespace frictab::codegen
