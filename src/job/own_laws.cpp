// Laws of a job's own: checks across their keys, and their formulas.
#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "core/hash.h"
#include "core/text.h"
#include "data/file_list.h"
#include "job/reader.h"
#include "job/table_law.h"

namespace frictab::job {

namespace {

void place_formulas(const JobReader& reader, models::LawText& text) {
  const std::string path = "models." + text.name;
  for (const auto& [key, formula] :
       {std::pair("formula", &text.formula), std::pair("piece", &text.piece),
        std::pair("combine", &text.combine)})
    formula->place = reader.place_of(path + "." + key);
  for (auto& [name, formula] : text.where)
    formula.place = reader.place_of(path + ".where." + name);
}

// Checks the name: it becomes part of file names, and shares lists with names of the registry.
bool check_name(JobReader& reader, const models::LawText& text) {
  const std::string& name = text.name;
  const bool plain = name.size() <= 60 && std::ranges::all_of(name, [](char c) {
                       return c == '_' || c == '-' || (c >= '0' && c <= '9') ||
                              (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
                     });
  const models::ModelName read = models::read_model_name(name, {});
  if (!plain)
    reader.fault(text.place, fmt::format("a law cannot be called '{}'", name),
                 "letters, digits, _ and -, at most 60");
  else if (name == "best" || name == "recommended" || name == "all" || read.base || read.traced ||
           read.quantile)
    reader.fault(text.place, fmt::format("a law cannot be called '{}': that is taken", name),
                 "names of `frictab list models`, best, recommended, all, and endings _traced and "
                 "_q05 mean something else");
  else
    return true;
  return false;
}

bool has_formulas(const models::LawText& text) {
  return !text.formula.text.empty() || !text.piece.text.empty() || !text.combine.text.empty() ||
         !text.quantity.empty() || !text.where.empty() || !text.parameters.empty();
}

bool check_table_keys(JobReader& reader, const models::LawText& text) {
  const std::size_t before = reader.faults.size();
  const std::string path = "models." + text.name;
  if (text.table.empty()) {
    for (const auto& [key, given] : {std::pair("interpolation", !text.interpolation.empty()),
                                     std::pair("log_axes", !text.log_axes.empty())})
      if (given)
        reader.fault(reader.place_of(path + "." + key),
                     fmt::format("law {} has `{}` and no table", text.name, key),
                     "table = \"mu_of_p_v.csv\", or leave it out");
  } else {
    if (has_formulas(text))
      reader.fault(
          reader.place_of(path + ".table"),
          fmt::format("law {} has a table and a formula", text.name),
          "a table stands instead of formula, piece, combine, quantity, where and parameters");
    if (text.interpolation.empty())
      reader.fault(reader.place_of(path + ".table"),
                   fmt::format("law {} does not say how its table is interpolated", text.name),
                   "interpolation = \"linear\"");
  }
  return reader.faults.size() == before;
}

// Adds the law of a table file. Its contents count as part of the job, so that results are kept
// only while both are unchanged.
void add_table(JobReader& reader, const models::LawText& text, FaultList& faults) {
  const Place place = reader.place_of("models." + text.name + ".table");
  const auto base = std::filesystem::path(reader.job.file).parent_path();
  const std::size_t before = faults.size();
  data::check_is_there("models." + text.name + ".table", text.table, base.string(), place, faults);
  const auto table = faults.size() > before
                         ? std::nullopt
                         : read_law_table(text, (base / text.table).string(), place, faults);
  models::Law law;
  law.name = text.name; // keeps other checks from reporting that the law does not exist
  if (table) {
    law = models::law_of_table(*table);
    const models::Formula formula = law.build({});
    const std::string written = expr::to_text(formula.value);
    if (written.size() > expr::FormulaLimits::text)
      faults.add(place,
                 fmt::format("the formula of law {} has {} with its table in it", text.name,
                             human_bytes(static_cast<double>(written.size()))),
                 fmt::format("at most {}: fewer nodes, or shorter names of columns",
                             human_bytes(static_cast<double>(expr::FormulaLimits::text))));
    reader.job.sections["models"] +=
        fmt::format("{} = {:016x}\n", text.name, hash_of(written + expr::to_text(formula.combine)));
  }
  reader.job.models.laws.add(std::move(law));
}

} // namespace

void make_laws(JobReader& reader) {
  auto& models = reader.job.models;
  FaultList faults;
  for (models::LawText& text : models.texts) {
    const auto& names = reader.own_laws;
    if (std::ranges::count(names, text.name) > 1)
      reader.fault(text.place, fmt::format("law '{}' stands in more than one place", text.name),
                   "in this job and a file of models.files, or in two of these");
    if (!reader.of_program && !(check_name(reader, text) && check_table_keys(reader, text)))
      continue;
    if (!text.table.empty()) {
      add_table(reader, text, faults);
      continue;
    }
    place_formulas(reader, text);
    models.laws.add(models::law_of_text(text, faults));
  }
  reader.faults.insert(reader.faults.end(), faults.all().begin(), faults.all().end());
}

} // namespace frictab::job
