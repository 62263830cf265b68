// frictab help [COMMAND|TOPIC]: same as `frictab COMMAND --help`; for a topic, same as `explain`.
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/command.h"
#include "cli/print.h"
#include "cli/printed_explanation.h"
#include "cli/topics.h"
#include "core/error.h"
#include "core/text.h"

namespace frictab::cli::help_command {

int run(const CLI::App& root, const std::vector<std::string>& words) {
  if (words.size() == 1)
    if (const auto topic = explain_topic(words.front())) {
      print_explanation(*topic);
      return 0;
    }
  const CLI::App* at = &root;
  std::string above; // path before its name
  for (const std::string& word : words) {
    std::vector<std::string> names;
    const CLI::App* next = nullptr;
    for (const CLI::App* sub : at->get_subcommands({})) {
      names.push_back(sub->get_name());
      if (sub->get_name() == word) next = sub;
    }
    if (at == &root) names.insert(names.end(), topic_names().begin(), topic_names().end());
    if (!next)
      throw InputError({}, fmt::format("there is no help on '{}'", join(words, " ")),
                       names.empty() ? "frictab help" : suggest(word, names));
    above += (above.empty() ? "" : " ") + at->get_name();
    at = next;
  }
  // App::help() would print help for the subcommand that was called, which for the root is this
  // one.
  print_out("{}",
            at->get_formatter()->make_help(at, (above.empty() ? "" : above + " ") + at->get_name(),
                                           CLI::AppFormatMode::All));
  return 0;
}

std::function<int()> declare(CLI::App& app, const CommonOptions&) {
  const auto words = std::make_shared<std::vector<std::string>>();
  app.add_option("COMMAND", *words, "A command, or a topic: " + join(topic_names(), ", "))
      ->type_name("COMMAND");
  return [words, &app] { return run(*app.get_parent(), *words); };
}

const Registered<Command> registered{[] {
  return Command{"help",
                 82,
                 "Options of a command, with examples; or a topic",
                 declare,
                 0,
                 {{"frictab help run", "as frictab run --help"},
                  {"frictab help table slice", "of a command below another"},
                  {"frictab help exit-codes", "a topic"}}};
}};

} // namespace frictab::cli::help_command
