// Files that a stage reads back from the one before it: what is taken is written as a file that is
// taken again and says the same.
#include "calibrate/calibration_file.h"
#include "codegen/recipe.h"
#include "effects/extended_law.h"
#include "fuzz/target.h"
#include "fuzz/temporary_file.h"
#include "job/job.h"
#include "run/stage.h"
#include "run/stage_record.h"
#include "trace/trace_file.h"
#include "verify/verify.h"

namespace frictab::fuzz::stage_files_target {
namespace {

template <class Read, class Write>
void check_written_again(std::string_view text, const Read& read, const Write& write) {
  const std::string first = write(read(std::string(text)));
  try {
    promise(write(read(first)) == first, "what is read back says the same");
  } catch (const InputError& error) {
    throw std::logic_error(std::string("not kept: what is written can be read: ") + error.what());
  }
}

void read_model(std::string_view text) {
  check_written_again(
      text, [](const std::string& from) { return calibrate::parse_model_fit(from, "model.json"); },
      [](const calibrate::ModelFit& fit) { return calibrate::model_json(fit, {}); });
}

void read_calibration(std::string_view text) {
  check_written_again(
      text,
      [](const std::string& from) {
        return calibrate::parse_calibration(from, "calibration.json");
      },
      [](const calibrate::Calibration& made) { return calibrate::calibration_json(made); });
}

void read_trace(std::string_view text) {
  check_written_again(
      text,
      [](const std::string& from) {
        auto traces = trace::parse_traces(from, "trace.json");
        for (const trace::Trace& one : traces)
          for (const trace::TracedEffect& effect : one.effects) {
            effects::effect_text(effect.placed);
            effects::factor_program(effect.placed);
          }
        return traces;
      },
      [](const std::vector<trace::Trace>& made) { return trace::trace_json(made, false); });
}

void read_verification(std::string_view text) {
  check_written_again(
      text, [](const std::string& from) { return verify::parse_verification(from, "verify.json"); },
      [](const verify::Verification& made) { return verify::verification_json(made); });
}

void read_stages(std::string_view text) {
  static const TemporaryFile file("stages.json");
  static const job::Job job = job::parse_job("[data]\ntraining = \"a.csv\"\n", "job.toml");
  check_written_again(
      text,
      [](const std::string& from) {
        file.write(from);
        return run::StageRecord(job, file.directory());
      },
      [](const run::StageRecord& made) {
        for (const run::Stage& stage : run::all_stages())
          made.stale(stage.name, "0");
        return made.json();
      });
}

void read_recipe(std::string_view text) {
  for (const auto& name : codegen::files_of_recipe(std::string(text), "recipe.json"))
    promise(std::filesystem::path(name).is_relative() &&
                std::string(name).find("..") == std::string::npos,
            "a recipe's files lie beside it");
}

const Registered<Target> model([] { return Target{"model", read_model}; });
const Registered<Target> calibration([] { return Target{"calibration", read_calibration}; });
const Registered<Target> trace([] { return Target{"trace", read_trace}; });
const Registered<Target> verification([] { return Target{"verify", read_verification}; });
const Registered<Target> stages([] { return Target{"stages", read_stages}; });
const Registered<Target> recipe([] { return Target{"recipe", read_recipe}; });

} // namespace
} // namespace frictab::fuzz::stage_files_target
