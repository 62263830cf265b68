// The JSON Schema of the job file takes what the reader takes, and refuses what it refuses.
#include <filesystem>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <toml++/toml.h>

#include "core/error.h"
#include "io/file_streams.h"
#include "job/job.h"
#include "job/json_schema.h"
#include "job/schema.h"
#include "support/json_schema.h"

namespace frictab::job_schema_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string misfit(const std::string& toml) {
  static const json schema = json::parse(job::json_schema());
  std::ostringstream text;
  text << toml::json_formatter{toml::parse(toml)};
  return test::misfit(schema, json::parse(text.str()));
}

TEST(JobSchema, EveryExampleAndTheTemplateFit) {
  std::size_t jobs = 0;
  for (const auto& entry :
       fs::recursive_directory_iterator(fs::path(FRICTAB_SOURCE_DIR) / "examples"))
    if (entry.path().filename() == "job.toml") {
      EXPECT_EQ(misfit(io::read_file(entry.path())), "") << entry.path();
      ++jobs;
    }
  EXPECT_GE(jobs, 6U);
  EXPECT_EQ(misfit(job::job_template()), "");
}

// What a user can write in all places, each taken by the reader as well.
TEST(JobSchema, FormsThatTheReaderTakesFit) {
  const std::string data = "[data]\ntraining = \"a.csv\"\n";
  for (const std::string& more :
       {std::string("decimal = \",\"\n[data.columns]\npsi = \"expansion\"\ntau_R_MPa = { column = "
                    "\"F\", times = \"sigma_n_MPa\" }\nT_contact_C = 3\n"),
        std::string(
            "drop = { tau_R_MPa = { below = 0.1 } }\n[data.constants]\nsigma_f_MPa = 480\n"),
        std::string(
            "[[data.files]]\nmatch = \"a*\"\nlabels = { material = \"316SS\" }\n[data.join]\n"
            "files = \"b.csv\"\nby = \"time_s\"\noffset = \"auto\"\n"),
        std::string("[models]\nuse = [\"coulomb\", \"mine\"]\n[models.mine]\nformula = "
                    "\"mu*sigma_n_MPa\"\nparameters = { mu = { range = [0, 1] } }\n"),
        std::string("[table]\nmodel = [\"best\", \"shaw\"]\nquantile = [0.05, 0.5]\n"
                    "[table.axes.v_rel_mm_s]\nrange = [5, 500]\nnodes = 17\nspacing = \"log\"\n"),
        std::string("[export]\ntargets = \"all\"\n[export.inputs]\npsi = \"constant:2\"\n"
                    "[export.abaqus_vfric.inputs]\npsi = \"constant:3\"\n")}) {
    EXPECT_EQ(misfit(data + more), "") << more;
    EXPECT_NO_THROW(job::parse_job(data + more, "job.toml")) << more;
  }
}

TEST(JobSchema, FaultsThatTheReaderTellsDoNotFit) {
  const std::string data = "[data]\ntraining = \"a.csv\"\n";
  for (const auto& [text, where] : std::vector<std::pair<std::string, std::string>>{
           {"", "job lacks data"},
           {"[data]\n", "job/data lacks training"},
           {data + "skip_row = 1\n", "job/data/skip_row is not known"},
           {data + "skip_rows = -1\n", "job/data/skip_rows is out of bounds"},
           {data + "skip_rows = 1.5\n", "job/data/skip_rows is no integer"},
           {data + "missing = \"ignore\"\n", "job/data/missing is not allowed"},
           {data + "[data.columns]\nsigma = \"x\"\n", "job/data/columns/sigma is not known"},
           {data + "[table]\ntolerance_MPa = 0\n", "job/table/tolerance_MPa is out of bounds"},
           {data + "[table.axes.psi]\nrange = [1]\n", "job/table/axes/psi/range has 1 items"},
           {data + "[tabel]\n", "job/tabel is not known"},
           {data + "[verify]\nrequire_run = \"yes\"\n", "job/verify/require_run is no boolean"}}) {
    EXPECT_EQ(misfit(text), where);
    EXPECT_THROW(job::parse_job(text, "job.toml"), InputError) << text;
  }
}

TEST(JobSchema, KnowsEveryKeyAndSaysWhatItMeans) {
  const json schema = json::parse(job::json_schema());
  for (const job::KeyRule& rule : job::key_rules()) {
    const json& definition = schema.at("definitions").at(rule.path);
    EXPECT_THAT(definition.at("description").get<std::string>(), testing::StartsWith(rule.meaning));
  }
}

} // namespace
} // namespace frictab::job_schema_test
