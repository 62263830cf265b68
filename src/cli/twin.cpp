// frictab twin OUT: writes a synthetic sliding-compression campaign.
#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>

#include "cli/command.h"
#include "cli/print.h"
#include "core/error.h"
#include "data/write_dataset.h"
#include "io/atomic_file.h"
#include "twin/twin_summary.h"

namespace frictab::cli::twin_command {
struct Options {
  std::string directory;
  std::string format = "csv";
  std::string design;
  std::string scatter;
  std::vector<std::string> effects;
  twin::TwinOptions twin;
  bool oracle = false;
  bool no_bystanders = false;
};

// Rows of oracle stress, keyed by experiment and row (from 1).
data::Dataset oracle_data(const twin::Twin& twin, const twin::TwinPart& part) {
  data::Dataset data;
  data.experiments = part.data.experiments;
  data.first_row = part.data.first_row;
  data::Column row{"row", "", std::vector<double>(part.data.rows()), {}};
  for (std::size_t e = 0; e < data.experiments.size(); ++e)
    for (std::size_t i = data.first_row[e]; i < data.first_row[e + 1]; ++i)
      row.values[i] = static_cast<double>(i - data.first_row[e] + 1);
  data.columns = {std::move(row),
                  {"tau_oracle_MPa", "MPa", part.oracle_MPa, {}},
                  {"origin",
                   "",
                   std::vector<double>(part.data.rows(), 0.0),
                   {twin::twin_origin(twin.options)}}};
  return data;
}

void write_part(const Options& options, const twin::Twin& twin, const twin::TwinPart& part,
                const std::string& name, io::OutputFiles& files) {
  if (part.data.rows() == 0) return;
  const auto write = [&](const data::Dataset& data, const std::string& stem) {
    if (options.format == "csv")
      files.write(stem + ".csv", data::csv_text(data));
    else
      data::write_hdf5_columns(data, files.stage(stem + ".h5"));
  };
  write(part.data, name);
  if (options.oracle) write(oracle_data(twin, part), name + "_oracle");
}

void read_options(Options& options, const CommonOptions& common) {
  if (options.directory.empty()) options.directory = common.output;
  if (options.directory.empty())
    throw InputError({"twin"}, "no output directory is given", "frictab twin OUT");
  options.twin.seed = common.seed.value_or(twin::TwinOptions{}.seed);
  options.twin.bystanders = !options.no_bystanders;
  if (!options.design.empty())
    options.twin.design =
        twin::parse_design(options.design, twin::default_design(twin::twin_set(options.twin.set)));
  options.twin.scatter = twin::parse_scatter(options.scatter);
  FaultList faults;
  options.twin.effects.clear();
  for (const std::string& text : options.effects) {
    try {
      options.twin.effects.push_back(twin::parse_effect(text));
    } catch (const InputError& error) {
      faults.add(error);
    }
  }
  faults.throw_if_any();
}

int run(Options& options, const CommonOptions& common) {
  read_options(options, common);
  const twin::Twin twin = twin::make_twin(options.twin);
  const twin::TwinSummary summary = twin::summarise(twin);
  const std::string json = twin::twin_json(twin, summary);

  io::OutputFiles files(options.directory);
  write_part(options, twin, twin.training, "training", files);
  write_part(options, twin, twin.validation, "validation", files);
  files.write("twin.json", json);
  files.write("job.toml",
              twin::twin_job(twin, options.format == "csv" ? "csv" : "h5", options.oracle));
  commit(files, options.directory, common);

  const std::string text = common.json ? json : twin::twin_text(twin, summary, options.directory);
  print_out("{}", text);
  return 0;
}

std::function<int()> declare(CLI::App& app, const CommonOptions& common) {
  auto options = std::make_shared<Options>();
  app.add_option("OUT", options->directory, "directory to write to (or -o DIR)");
  app.add_option("--set-name", options->twin.set, "parameter set: D, W or B")
      ->capture_default_str();
  app.add_option("--format", options->format, "csv or hdf5")
      ->check(CLI::IsMember({"csv", "hdf5"}))
      ->capture_default_str();
  app.add_option("--design", options->design,
                 "levels and sizes: any of p=1725,1865,2005 psi=1,4.47,20 v=5,50,500 T=20,110,200 "
                 "replicates=1 points=550 validation=30, as in \"v=5,500;points=100\"");
  app.add_option("--effect", options->effects,
                 "plant an effect (repeatable): form=saturation,column=s_mm,strength=0.15,on=mu; "
                 "on = mu, m or tau; column may be a derived quantity or latent")
      ->allow_extra_args(false);
  app.add_option("--law", options->twin.law,
                 "the truth is this friction law, fitted to the twin's own physics, instead of "
                 "that physics (frictab list models)")
      ->type_name("LAW");
  app.add_option("--profile", options->twin.profile,
                 "contact normal stress over the stroke: constant, or varied (by test constant, "
                 "rising, falling or a pulse, 0.3 to 1 of its level)")
      ->capture_default_str();
  app.add_option("--noise-scale", options->twin.noise_scale, "0 (none) to 5, 1 = the set's")
      ->capture_default_str();
  app.add_option("--noise", options->twin.noise, "normal, t4 or heteroscedastic")
      ->capture_default_str();
  app.add_option(
      "--scatter", options->scatter,
      "noise instead of the set's, relative: \"test=0.04,slow=0.035,rho=0.95,white=0.012\", any "
      "subset; rho: of the slow part, from row to row");
  app.add_option("--hide", options->twin.hide, "leave a column out of the files (repeatable)")
      ->allow_extra_args(false);
  app.add_flag("--no-bystanders", options->no_bystanders, "write canonical columns only");
  app.add_flag("--more-bystanders", options->twin.more_bystanders,
               "six more: film2_um (follows film_um, acts on nothing), vib, lab_T_C, dwell_s, "
               "direction, batch");
  app.add_flag("--oracle", options->oracle,
               "write the noise-free stress to *_oracle files too; job.toml names them");
  return [options, &common] { return run(*options, common); };
}

Command make() {
  return {"twin",
          20,
          "Write a synthetic tribometer campaign with a known truth",
          declare,
          uses_output | uses_force | uses_threads | uses_json | uses_seed,
          {{"frictab twin campaign", "81 tests to train on, 30 to validate, and a job"},
           {"frictab twin small --design \"p=1725,2005;psi=1,20;v=5,500;T=20;points=10\"",
            "fewer and shorter tests"},
           {"frictab twin humid --effect form=power,column=humidity_pct,strength=0.1,on=mu",
            "with an effect planted"}}};
}

const Registered<Command> registered{make};

} // namespace frictab::cli::twin_command
