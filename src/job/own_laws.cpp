// Laws of a job's own: what their keys say together, and their formulas.
#include <algorithm>

#include <fmt/format.h>

#include "core/text.h"
#include "job/reader.h"

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

// A law's name becomes part of file names, and stands where names of the registry stand.
bool check_name(JobReader& reader, const models::LawText& text) {
  const std::string& name = text.name;
  const bool plain = name.size() <= 60 && std::all_of(name.begin(), name.end(), [](char c) {
                       return c == '_' || c == '-' || (c >= '0' && c <= '9') ||
                              (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
                     });
  const models::ModelName read = models::read_model_name(name, {});
  if (!plain)
    reader.fault(text.place, fmt::format("a law cannot be called '{}'", name),
                 "letters, digits, _ and -, at most 60");
  else if (name == "best" || name == "all" || read.base || read.traced || read.quantile)
    reader.fault(text.place, fmt::format("a law cannot be called '{}': that is taken", name),
                 "names of `frictab list models`, best, all, and endings _traced and _q05 mean "
                 "something else");
  else
    return true;
  return false;
}

} // namespace

void make_laws(JobReader& reader) {
  auto& models = reader.job.models;
  FaultList faults;
  for (models::LawText& text : models.texts) {
    const auto& names = reader.own_laws;
    if (std::count(names.begin(), names.end(), text.name) > 1)
      reader.fault(text.place, fmt::format("law '{}' stands in more than one place", text.name),
                   "in this job and a file of models.files, or in two of these");
    if (!check_name(reader, text)) continue;
    place_formulas(reader, text);
    models.laws.add(models::law_of_text(text, faults));
  }
  reader.faults.insert(reader.faults.end(), faults.all().begin(), faults.all().end());
}

} // namespace frictab::job
