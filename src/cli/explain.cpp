// frictab explain NAME: a law, an effect, a target, a quantity, the job file or one of its keys.
#include <algorithm>
#include <filesystem>
#include <sstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/explanation.h"
#include "cli/job_commands.h"
#include "core/error.h"
#include "core/text.h"
#include "job/literature.h"

namespace frictab::cli::explain_command {

namespace {

using Fields = std::vector<std::pair<std::string, std::string>>;

// Text broken at blanks, later lines indented; lines of the text's own are kept.
std::string wrapped(const std::string& text, std::size_t indent) {
  constexpr std::size_t width = 96;
  std::istringstream paragraphs(text);
  std::string out, paragraph;
  const std::string margin = "\n" + std::string(indent, ' ');
  while (std::getline(paragraphs, paragraph)) {
    if (!out.empty()) out += margin;
    std::istringstream words(paragraph);
    std::size_t column = indent;
    for (std::string word; words >> word;) {
      const bool first = column == indent;
      if (!first && column + 1 + word.size() > width) {
        out += margin + word;
        column = indent + word.size();
      } else {
        out += first ? word : " " + word;
        column += word.size() + (first ? 0 : 1);
      }
    }
  }
  return out;
}

void print_fields(const Fields& fields, std::size_t indent) {
  std::size_t width = 0;
  for (const auto& [label, text] : fields)
    width = std::max(width, label.size());
  for (const auto& [label, text] : fields)
    if (!text.empty())
      fmt::print("{:{}}{:<{}}  {}\n", "", indent, label + ":", width + 1,
                 wrapped(text, indent + width + 3));
}

void print_text(const Explanation& it) {
  fmt::print("{} ({})\n  {}\n", it.name, it.kind, wrapped(it.title, 2));
  print_fields(it.fields, 2);
  if (!it.items.empty()) fmt::print("  {}:\n", it.items_label);
  for (const Explanation::Item& item : it.items) {
    fmt::print("    {}\n      {}\n", item.name, wrapped(item.text, 6));
    print_fields(item.fields, 6);
  }
}

nlohmann::ordered_json json_of(const Fields& fields) {
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
  fmt::print("{}\n", out.dump(2));
}

// A law of the job that is named, or of job.toml in this directory.
std::optional<Explanation> explain_own_law(const std::string& name, std::string job,
                                           const CommonOptions& common) {
  if (job.empty() && std::filesystem::exists("job.toml")) job = "job.toml";
  if (job.empty()) return std::nullopt;
  const job::Job read = read_job(job, common);
  const models::Law* law = read.models.laws.find(name);
  return law ? std::optional(explain_law(*law)) : std::nullopt;
}

// A law of the literature as a job may have it, under a name of the user's own.
int print_toml(const std::string& name) {
  const std::string text = job::literature_text(name);
  if (text.empty())
    throw InputError({"--toml"}, fmt::format("'{}' is no law of the literature", name),
                     "`frictab list models` names them");
  fmt::print("{}", text);
  return 0;
}

int run(const std::string& name, const std::string& job, bool toml, const CommonOptions& common) {
  if (toml) return print_toml(name);
  auto explanation = explain(name);
  if (!explanation || !job::literature_text(name).empty()) // a job's own goes before
    if (auto own = explain_own_law(name, job, common)) explanation = std::move(own);
  if (!explanation) {
    const std::string near = nearest_name(name, explainable());
    throw InputError({}, fmt::format("nothing is called '{}'", name),
                     near.empty() ? "names: frictab list models, list effects, list targets; "
                                    "frictab explain job for the keys of the job file"
                                  : fmt::format("did you mean '{}'?", near));
  }
  common.json ? print_json(*explanation) : print_text(*explanation);
  return 0;
}

std::function<int()> declare(CLI::App& app, const CommonOptions& common) {
  auto name = std::make_shared<std::string>(), job = std::make_shared<std::string>();
  app.add_option("NAME", *name,
                 "a law, an effect, a target, a quantity, `job`, a key such as table.model, or\n"
                 "`table-layout`")
      ->required();
  app.add_option("--job", *job,
                 "The job file that a law of your own stands in; job.toml of this directory")
      ->type_name("JOB");
  auto toml = std::make_shared<bool>(false);
  app.add_flag("--toml", *toml, "A law of the literature as text for a job file, to be changed");
  return [name, job, toml, &common] { return run(*name, *job, *toml, common); };
}

const Registered<Command> registered{[] {
  return Command{"explain", 81, "Explain a law, an effect, a target, a quantity or a job key",
                 declare};
}};

} // namespace

} // namespace frictab::cli::explain_command
