// Damaged model, calibration, verification and recipe files, and damaged formulas: a fault, never a
// crash. Seeded, so that a failure comes back.
#include <functional>

#include <gtest/gtest.h>

#include "calibrate/calibration_file.h"
#include "codegen/recipe.h"
#include "core/error.h"
#include "core/random.h"
#include "job/job.h"
#include "run/stage_record.h"
#include "support/run_command.h"
#include "support/sample_data.h"
#include "verify/verify.h"

namespace frictab::formats_fuzz_test {
namespace {

std::string damaged(std::string text, Random& random) {
  static const std::string pieces[] = {"{",  "}",      "[",       "]",    "\"",      ",",
                                       ":",  "null",   "-1e999",  "1e3",  "(",       ")",
                                       "**", "where(", "minimum", "\xff", "\\u0000", "0"};
  for (std::size_t i = 0; i < 1 + random.below(6) && !text.empty(); ++i) {
    const std::size_t at = random.below(text.size());
    switch (random.below(4)) {
    case 0:
      text.erase(at, 1 + random.below(20));
      break;
    case 1:
      text.insert(at, pieces[random.below(std::size(pieces))]);
      break;
    case 2:
      text[at] = static_cast<char>(random.below(256));
      break;
    default:
      text.resize(at);
    }
  }
  return text;
}

void fuzz(const std::string& valid, std::size_t cases,
          const std::function<void(const std::string&)>& read) {
  EXPECT_NO_THROW(read(valid));
  Random random(11);
  std::size_t refused = 0;
  for (std::size_t i = 0; i < cases; ++i) {
    try {
      read(damaged(valid, random));
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, cases / 10) << "the damage is too mild to test anything";
}

TEST(FormatsFuzz, DamagedRecordOfStagesIsAFault) {
  const test::TemporaryDirectory directory;
  const job::Job job = job::parse_job("[data]\ntraining = \"a.csv\"\n", "job.toml");
  run::StageRecord made(job, directory.path());
  made.record("calibrate", "0123456789abcdef");
  made.record("tabulate", "");
  fuzz(made.json(), 1000, [&](const std::string& text) {
    directory.write("stages.json", text);
    run::StageRecord read(job, directory.path());
    read.stale("tabulate", "");
  });
}

TEST(FormatsFuzz, DamagedJsonFilesAreFaults) {
  const data::Dataset data = test::sample_data(test::plausible_model(*models::find_law("orowan")));
  calibrate::CalibrationInput input{data, data, {}, {}};
  input.models.use = {"orowan", "coulomb_0.08"};
  const calibrate::Calibration calibration = calibrate::calibrate(input);
  fuzz(calibrate::calibration_json(calibration), 4000,
       [](const std::string& text) { calibrate::parse_calibration(text, "calibration.json"); });
  fuzz(calibrate::model_json(calibration.fits.front(), calibration), 4000,
       [](const std::string& text) { calibrate::parse_model(text, "model.json"); });
  verify::Verification verification{0.5, {}};
  verification.records.push_back({"orowan",
                                  "table",
                                  true,
                                  "",
                                  {},
                                  5,
                                  1,
                                  {{"psi", "above", "clamp", 20, 1, 3.5}},
                                  0.1,
                                  0,
                                  0,
                                  0.2,
                                  {{"psi", 2.0}},
                                  10,
                                  0,
                                  true});
  fuzz(verify::verification_json(verification), 4000,
       [](const std::string& text) { verify::parse_verification(text, "verify.json"); });
  fuzz(R"({"schema": "frictab/recipe/1", "files": ["a.c", "b.h", "recipe.json"]})", 4000,
       [](const std::string& text) { codegen::files_of_recipe(text, "recipe.json"); });
}

TEST(FormatsFuzz, ACountBelowZeroOrOfNoWholeNumberIsAFault) {
  verify::DriftRecord record;
  record.model = "orowan";
  record.subject = "table";
  record.ran = true;
  record.n_rows = 5;
  const std::string good = verify::verification_json({0.5, {record}}), count = "\"n_rows\": 5";
  ASSERT_NO_THROW(verify::parse_verification(good, "verify.json"));
  for (const char* none : {"-1", "2.5", "1e300", "null", "\"5\""}) {
    std::string bad = good;
    bad.replace(bad.find(count), count.size(), std::string("\"n_rows\": ") + none);
    EXPECT_THROW(verify::parse_verification(bad, "verify.json"), InputError) << none;
  }
}

TEST(FormatsFuzz, DamagedFormulasAreFaults) {
  const models::Law& law = *models::find_law("wanheim_bay");
  fuzz(expr::to_text(models::tau_formula(law, {})), 20000,
       [](const std::string& text) { expr::to_text(expr::parse_expr(text)); });
}

TEST(Recipe, FileNamesMayNotLeadOutOfTheDirectory) {
  for (const char* name : {"../x.c", "/etc/x", "a/../../b"})
    EXPECT_THROW(
        codegen::files_of_recipe(std::string("{\"files\": [\"") + name + "\"]}", "recipe.json"),
        InputError)
        << name;
}

} // namespace
} // namespace frictab::formats_fuzz_test
