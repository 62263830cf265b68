// frictab explain NAME: a law, an effect, a target, a quantity, the job file or one of its keys.
#include <algorithm>
#include <filesystem>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/explanation.h"
#include "cli/job_commands.h"
#include "cli/print.h"
#include "cli/printed_explanation.h"
#include "cli/topics.h"
#include "core/error.h"
#include "core/text.h"
#include "job/literature.h"

namespace frictab::cli::explain_command {

nlohmann::ordered_json json_of(const Explanation::Fields& fields) {
  auto out = nlohmann::ordered_json::object();
  for (const auto& [label, text] : fields)
    out[label] = text;
  return out;
}

void print_json(const Explanation& it) {
  nlohmann::ordered_json out{{"name", it.name}, {"kind", it.kind}, {"title", it.title}};
  out.update(json_of(it.fields));
  for (const Explanation::Item& item : it.items) {
    nlohmann::ordered_json entry{{"name", item.name}, {"meaning", item.text}};
    entry.update(json_of(item.fields));
    out[it.items_label].push_back(std::move(entry));
  }
  print_out("{}\n", out.dump(2));
}

// Explains a law of the named job, or of job.toml in this directory.
std::optional<Explanation> explain_own_law(const std::string& name, std::string job,
                                           const CommonOptions& common) {
  if (job.empty() && std::filesystem::exists("job.toml")) job = "job.toml";
  if (job.empty()) return std::nullopt;
  const job::Job read = read_job(job, common);
  const models::Law* law = read.models.laws.find(name);
  return law ? std::optional(explain_law(*law)) : std::nullopt;
}

// Prints a law of the literature in the form of a job, under a name of the user's own.
int print_toml(const std::string& name) {
  const std::string text = job::literature_text(name);
  if (text.empty())
    throw InputError({"--toml"}, fmt::format("'{}' is not a law of the literature", name),
                     "`frictab list models` names them");
  print_out("{}", text);
  return 0;
}

std::string what_has_a_name() {
  return "names: frictab list; frictab explain job for the keys of the job file; topics: " +
         join(topic_names(), ", ");
}

int run(const std::string& name, const std::string& job, bool toml, const CommonOptions& common) {
  if (name.empty()) throw InputError({}, "no NAME is given", what_has_a_name());
  if (toml) return print_toml(name);
  auto explanation = explain(name);
  if (!explanation || !job::literature_text(name).empty()) // a job's own law takes precedence
    if (auto own = explain_own_law(name, job, common)) explanation = std::move(own);
  if (!explanation) {
    const std::string near = nearest_name(name, explainable());
    throw InputError({}, fmt::format("nothing is called '{}'", name),
                     near.empty() ? what_has_a_name() : fmt::format("did you mean '{}'?", near));
  }
  common.json ? print_json(*explanation) : print_explanation(*explanation);
  return 0;
}

std::function<int()> declare(CLI::App& app, const CommonOptions& common) {
  auto name = std::make_shared<std::string>(), job = std::make_shared<std::string>();
  app.add_option(
         "NAME", *name,
         "A law, an effect, a target, a quantity, `job`, a key such as table.model, or a topic:\n"
         "table-layout, " +
             join(topic_names(), ", "))
      ->type_name("NAME");
  app.add_option("--job", *job,
                 "The job file that a law of your own stands in; job.toml of this directory")
      ->type_name("JOB");
  auto toml = std::make_shared<bool>(false);
  app.add_flag("--toml", *toml, "A law of the literature as text for a job file, to be changed");
  return [name, job, toml, &common] { return run(*name, *job, *toml, common); };
}

const Registered<Command> registered{[] {
  return Command{
      "explain",
      81,
      "Explain a law, an effect, a target, a quantity, a job key or a topic",
      declare,
      uses_json | uses_set,
      {{"frictab explain wanheim_bay", "formula, parameters, source"},
       {"frictab explain tolerance_MPa", "a key of the job, by its last part"},
       {"frictab explain exit-codes", "a topic; units, csv, rules, experiment are others"}}};
}};

} // namespace frictab::cli::explain_command
