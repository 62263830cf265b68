// frictab trace JOB: effects that the calibrated law lacks.
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/job_commands.h"
#include "words/render.h"
#include "words/trace.h"

namespace frictab::cli::trace_command {

std::function<int()> declare(CLI::App& app, const CommonOptions& common) {
  struct Arguments {
    std::string file;
    bool power = false;
  };
  const auto arguments = std::make_shared<Arguments>();
  add_job(app, arguments->file);
  app.add_flag("--power", arguments->power,
               "Say how large an effect these experiments would have shown, column by column");
  return [arguments, &common] {
    return run_stage_command(arguments->file, common, "trace", [&](const run::Run& run) {
      if (arguments->power && !common.json)
        for (const trace::Trace& trace : run.traces)
          show("\n" + words::as_text(words::detectable_effects(trace)));
    });
  };
}

const Registered<Command> trace{[] {
  Command command;
  command.name = "trace";
  command.order = 7;
  command.title = "Search the residual for effects the law lacks, and add them";
  command.declare = declare;
  command.uses = stage_uses | uses_verbose;
  command.examples = {{"frictab trace job.toml", "trace.json; models with the effects"},
                      {"frictab trace job.toml --power", "and what these tests could have shown"}};
  return command;
}};

} // namespace frictab::cli::trace_command
