// frictab predict: a calibrated law evaluated on rows of data, as CSV.
#include <memory>

#include <CLI/CLI.hpp>

#include "cli/job_commands.h"
#include "cli/print.h"
#include "cli/table_command.h"
#include "core/error.h"
#include "core/text.h"
#include "run/predict.h"

namespace frictab::cli::predict_command {

struct Options {
  std::string law;
  std::string data;
  std::string model;
};

run::LawToPredict law_of(const Options& options, const CommonOptions& common) {
  if (!options.law.ends_with(".json"))
    return run::law_of_job(job::read_job(options.law, common.set), options.model);
  if (!options.model.empty())
    throw InputError({}, "--model NAME is for a job", options.law + " is one law already");
  return run::law_of_model_file(options.law);
}

// A single argument is DATA; the job is then that of this folder.
Options with_job(Options options) {
  if (!options.data.empty()) return options;
  if (options.law.ends_with(".json") || options.law.ends_with(".toml"))
    throw InputError({}, "no DATA is given: the rows to predict", "frictab predict JOB DATA");
  options.data = options.law;
  options.law = job_file("");
  return options;
}

int predict(const Options& options, const CommonOptions& common) {
  if (common.json && common.output.empty())
    throw InputError({}, "--json prints the summary where the rows would go",
                     "name a file for the rows: -o FILE.csv");
  const run::Prediction prediction = run::predict(law_of(options, common), options.data);
  write_result(common, [&](std::ostream& out) { run::write_prediction(prediction, out); });
  if (common.json)
    show(run::prediction_json(prediction));
  else if (!common.quiet)
    print_error("{}", printable(run::prediction_text(prediction)));
  return 0;
}

std::function<int()> declare(CLI::App& app, const CommonOptions& common) {
  const auto options = std::make_shared<Options>();
  app.add_option("JOB|MODEL", options->law,
                 "A job that was calibrated: its mapping reads DATA; or models/NAME.json: then "
                 "DATA has canonical columns")
      ->required();
  app.add_option(
      "DATA", options->data,
      "Rows to predict (CSV or HDF5); no stress is needed. DATA alone: of job.toml in this folder");
  app.add_option("--model", options->model, "Law of the job, instead of the first of table.model")
      ->type_name("LAW");
  output_is_a_file(app);
  return [options, &common] { return predict(with_job(*options), common); };
}

const Registered<Command> registered{[] {
  return Command{
      "predict",
      9,
      "tau_R of a calibrated law for rows of data, with its band",
      declare,
      uses_output | uses_force | uses_threads | uses_quiet | uses_json | uses_set,
      {{"frictab predict job.toml data/validation.csv -o predicted.csv", "by the job's first law"},
       {"frictab predict out/models/coulomb.json data/validation.csv", "by one law, to stdout"}}};
}};

} // namespace frictab::cli::predict_command
