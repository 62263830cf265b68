// What a job file means: values, defaults, places, overrides, paths.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "job/schema.h"
#include "support/run_command.h"

namespace frictab::job_test {

using job::Job;
using job::key_rules;
using job::KeyRule;
using job::parse_job;

namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string minimal = "[data]\ntraining = \"training.csv\"\n";

// Every key without a name in its path, as the schema shows it.
std::string shown(const Job& job) {
  std::string out;
  for (const KeyRule& rule : key_rules())
    if (rule.show) out += rule.path + " = " + rule.show(job) + "\n";
  return out;
}

std::vector<Fault> faults_of(const std::string& text, const std::vector<std::string>& set = {}) {
  try {
    parse_job(text, "job.toml", set);
  } catch (const InputError& error) {
    return error.faults();
  }
  return {};
}

TEST(Job, HasTheDefaultsOfTheHeaderWhereOnlyTrainingIsGiven) {
  Job expected;
  expected.data.training = {"training.csv"};
  const Job job = parse_job(minimal, "job.toml");
  EXPECT_EQ(shown(job), shown(expected));
  EXPECT_TRUE(job.data.columns.empty() && job.data.constants.empty() && job.data.drop.empty());
  EXPECT_TRUE(job.table.axes.empty() && job.exports.inputs.empty());
}

// The contract's example, but for what this version has not.
const char* const contract_example = R"([data]
training   = "training.csv"        # CSV or HDF5; relative to the job file; a list is concatenated
validation = "validation.csv"      # absent: a stated share of EXPERIMENTS is held out
delimiter = ","                    # rigs write tabs, decimal commas and preambles
decimal   = "."
skip_rows = 0
units_row = false
drop = { tau_R_MPa = { below = 0.1 } }
[data.columns]
sigma_n_MPa = { column = "Normal stress", unit = "Pa" }
tau_R_MPa = { column = "Friction", times = "sigma_n_MPa" }
[data.constants]
sigma_f_MPa = 480.0
[models]
use = ["coulomb", "orowan"]
shear_yield = "mises"
[calibration]
loss = "L2"
seed = 1
[table]
model = "best"
tolerance_MPa = 0.5
interpolation = "linear"
range = "table1"
[table.axes.v_rel_mm_s]
range = [5, 500]
nodes = 17
spacing = "log"
[export]
targets = ["c", "abaqus_vfric"]
[export.abaqus_vfric.inputs]
psi = "constant:2.5"
[verify]
max_drift_MPa = 0.5
[trace]
models = ["best"]
alpha  = 0.02
ignore = ["room_C"]
[output]
directory = "out"
)";

TEST(Job, AcceptsEveryKeyOfTheContract) {
  const Job job = parse_job(contract_example, "jobs/job.toml");
  EXPECT_THAT(job.data.training, ElementsAre("training.csv"));
  EXPECT_THAT(job.data.validation, ElementsAre("validation.csv"));
  EXPECT_EQ(job.data.delimiter, ',');
  ASSERT_EQ(job.data.drop.size(), 1u);
  EXPECT_EQ(job.data.drop[0].column, "tau_R_MPa");
  EXPECT_EQ(job.data.drop[0].below, 0.1);
  EXPECT_FALSE(job.data.drop[0].above);
  EXPECT_EQ(job.data.drop[0].place.line, 8u);
  const data::ColumnSource& stress = job.data.columns.at("sigma_n_MPa");
  EXPECT_THAT(stress.names, ElementsAre("Normal stress"));
  EXPECT_EQ(stress.unit, "Pa");
  EXPECT_EQ(stress.place.line, 10u);
  EXPECT_EQ(job.data.columns.at("tau_R_MPa").times, "sigma_n_MPa");
  EXPECT_EQ(job.data.constants.at("sigma_f_MPa"), 480.0);
  EXPECT_THAT(job.models.use, ElementsAre("coulomb", "orowan"));
  EXPECT_EQ(job.table.range, "table1");
  const table::AxisOptions& axis = job.table.axes.at("v_rel_mm_s");
  EXPECT_EQ(axis.range, std::pair(5.0, 500.0));
  EXPECT_EQ(axis.nodes, 17u);
  EXPECT_EQ(axis.spacing, "log");
  EXPECT_TRUE(job.exports.inputs_for("c").empty());
  EXPECT_EQ(job.exports.inputs_for("abaqus_vfric").at("psi"), "constant:2.5");
  EXPECT_EQ(job.verify.max_drift_MPa, 0.5);
  EXPECT_THAT(job.trace.ignore, ElementsAre("room_C"));
}

TEST(Job, LeavesTheToleranceToTheLawsErrorOrTakesANumber) {
  EXPECT_FALSE(parse_job(minimal, "job.toml").table.tolerance_MPa);
  const auto with = [](const std::string& value) {
    return parse_job(minimal + "[table]\ntolerance_MPa = " + value + "\n", "job.toml");
  };
  EXPECT_FALSE(with("\"auto\"").table.tolerance_MPa);
  EXPECT_EQ(with("0.02").table.tolerance_MPa, 0.02);
  EXPECT_EQ(with("2").table.tolerance_MPa, 2);
}

TEST(Job, TabulatesWhatIsRecommendedAloneAndInAList) {
  const auto model = [](const std::string& value) {
    return parse_job(minimal + "[table]\nmodel = " + value + "\n", "job.toml").table;
  };
  EXPECT_THAT(model("\"recommended\"").model, ElementsAre("recommended"));
  EXPECT_FALSE(model("\"recommended\"").names_laws()) << "which one is for the ranking to say";
  EXPECT_THAT(model("[\"best\", \"recommended\", \"shaw\"]").model,
              ElementsAre("best", "recommended", "shaw"));
}

TEST(Job, ReadsEveryFurtherKey) {
  const Job job = parse_job(R"([data]
training = ["a.csv", "b.h5"]
oracle = "truth.csv"
holdout = 0.2
delimiter = "tab"
decimal = ","
skip_footer = 2
units_row = true
bystanders = []
drop.psi.above = 12
drop.valid = ["FALSE", "nok"]
[data.columns]
experiment = "Versuch"
psi = { column = 3 }
s_mm = { column = ["Weg", "path"] }
T_tool_C = { }
v_rel_mm_s = { column = "x", slope_rows = 7 }
sigma_n_MPa = { column = "F", unit = "kN", area_mm2 = 78.5 }
[models]
use = "all"
shear_limit = false
[calibration]
loss = "HUBER"
huber_delta_MPa = 5
bootstrap = 0
condition_on_mm = 1.5
[table]
model = ["shaw", "coulomb"]
[export]
targets = "all"
units = "m-kg-s"
temperature = "K"
[export.inputs]
psi = "constant:1.5"
T_contact_C = "field:2"
s_mm = "property"
[verify]
samples = 1000
[trace]
repeatability = 0.03
)",
                            "job.toml");
  EXPECT_THAT(job.data.training, ElementsAre("a.csv", "b.h5"));
  EXPECT_THAT(job.data.oracle, ElementsAre("truth.csv"));
  EXPECT_EQ(job.data.oracle_place.line, 3u);
  EXPECT_EQ(job.data.holdout, 0.2);
  EXPECT_EQ(job.data.delimiter, '\t');
  EXPECT_EQ(job.data.decimal, ',');
  EXPECT_EQ(job.data.skip_footer, 2u);
  EXPECT_TRUE(job.data.units_row);
  ASSERT_TRUE(job.data.bystanders);
  EXPECT_TRUE(job.data.bystanders->empty());
  EXPECT_EQ(job.data.drop.at(0).above, 12.0);
  EXPECT_EQ(job.data.drop.at(1).column, "valid");
  EXPECT_THAT(job.data.drop.at(1).texts, ElementsAre("FALSE", "nok"));
  EXPECT_THAT(job.data.columns.at("experiment").names, ElementsAre("Versuch"));
  EXPECT_EQ(job.data.columns.at("psi").number, 3u);
  EXPECT_THAT(job.data.columns.at("s_mm").names, ElementsAre("Weg", "path"));
  EXPECT_THAT(job.data.columns.at("T_tool_C").names, ElementsAre("T_tool_C"));
  EXPECT_EQ(job.data.columns.at("v_rel_mm_s").slope_rows, 7u);
  EXPECT_EQ(job.data.columns.at("sigma_n_MPa").area_mm2, 78.5);
  EXPECT_TRUE(job.models.use.empty());
  EXPECT_FALSE(job.models.shear_limit);
  EXPECT_EQ(job.calibration.loss, calibrate::Loss::huber);
  EXPECT_EQ(job.calibration.huber_delta_MPa, 5.0);
  EXPECT_EQ(job.calibration.bootstrap, 0u);
  EXPECT_EQ(job.calibration.condition_on_mm, 1.5);
  EXPECT_THAT(job.table.model, ElementsAre("shaw", "coulomb"));
  EXPECT_THAT(job.exports.targets, ElementsAre("all"));
  EXPECT_EQ(job.exports.units, "m-kg-s");
  EXPECT_EQ(job.exports.solver_units().text(), "m-kg-s, K");
  EXPECT_EQ(job.exports.inputs.at("T_contact_C"), "field:2");
  EXPECT_EQ(job.verify.samples, 1000u);
  EXPECT_EQ(job.trace.repeatability, 0.03);
}

TEST(Job, ReportsAllFaultsInTheOrderOfTheFile) {
  const auto faults = faults_of("[table]\ntolerance_MPa = -1\nnodez = 3\n[data]\nskip_rows = "
                                "\"x\"\ncolunms = 1\n[calibration]\nloss = \"L7\"\n");
  ASSERT_EQ(faults.size(), 6u);
  const std::vector<std::pair<std::size_t, std::size_t>> places{{2, 17}, {3, 1}, {4, 1},
                                                                {5, 13}, {6, 1}, {8, 8}};
  for (std::size_t i = 0; i < faults.size(); ++i) {
    EXPECT_EQ(faults[i].place.file, "job.toml");
    EXPECT_EQ(std::pair(faults[i].place.line, faults[i].place.column), places[i]) << faults[i].what;
    EXPECT_FALSE(faults[i].hint.empty()) << faults[i].what;
  }
  EXPECT_EQ(faults[2].what, "data.training is missing");
}

TEST(Job, ShowsTwentyFaultsAndCountsTheRest) {
  std::string text = minimal;
  for (int i = 0; i < 27; ++i)
    text += "wrong_" + std::to_string(i) + " = 1\n";
  try {
    parse_job(text, "job.toml");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().size(), 27u);
    const std::string what = error.what();
    EXPECT_THAT(what, HasSubstr("job.toml:22:1: error: unknown key 'wrong_19' in [data]"));
    EXPECT_THAT(what, testing::Not(HasSubstr("wrong_20")));
    EXPECT_THAT(what, HasSubstr("... and 7 more faults"));
  }
}

TEST(Job, TakesOverridesAfterTheFile) {
  const Job job = parse_job(minimal + "[table]\ntolerance_MPa = 3\n", "job.toml",
                            {"table.tolerance_MPa=0.1", "table.model=orowan",
                             "models.use=[\"orowan\", \"coulomb\"]", "calibration.loss = l1",
                             "data.columns.psi.column=Surface ratio", "data.validation='v.csv'",
                             "table.axes.psi={range=[1, 20]}", "table.axes.psi.nodes=9"});
  EXPECT_EQ(job.table.tolerance_MPa, 0.1);
  EXPECT_THAT(job.table.model, ElementsAre("orowan"));
  EXPECT_THAT(job.models.use, ElementsAre("orowan", "coulomb"));
  EXPECT_EQ(job.calibration.loss, calibrate::Loss::l1);
  EXPECT_THAT(job.data.columns.at("psi").names, ElementsAre("Surface ratio"));
  EXPECT_THAT(job.data.validation, ElementsAre("v.csv"));
  EXPECT_EQ(job.table.axes.at("psi").range, std::pair(1.0, 20.0));
  EXPECT_EQ(job.table.axes.at("psi").nodes, 9u);
}

TEST(Job, MendsTheFileByAnOverride) {
  EXPECT_NO_THROW(parse_job("[data]\n", "job.toml", {"data.training=a.csv"}));
  EXPECT_NO_THROW(parse_job(minimal + "[models]\nuse=\"nosuch\"", "job.toml", {"models.use=all"}));
}

TEST(Job, NamesEachFaultyOverrideByItsNumber) {
  const auto faults =
      faults_of("[data]\ntraining = 1\n", {"x", "table.model=best", "table.tolerence_MPa=1"});
  ASSERT_EQ(faults.size(), 3u);
  EXPECT_EQ(format_place(faults[0].place), "job.toml:2:12");
  EXPECT_EQ(format_place(faults[1].place), "--set 1");
  EXPECT_EQ(format_place(faults[2].place), "--set 3");
}

TEST(Job, StartsRelativePathsAtTheJobFile) {
  const Job job = parse_job(minimal + "[output]\ndirectory = \"./results/\"\n", "a/b/job.toml");
  EXPECT_EQ(job.data.base, "a/b");
  EXPECT_EQ(job.directory, "a/b/results/");
  EXPECT_EQ(parse_job(minimal, "job.toml").directory, "out");
  EXPECT_EQ(parse_job(minimal, "job.toml", {"output.directory=/x/y"}).directory, "/x/y");
}

TEST(Job, SaysWhereASectionStandsForLaterMessages) {
  const Job job = parse_job("[models]\n[data]\ntraining = \"a\"\n[table]\n", "job.toml");
  EXPECT_EQ(format_place(job.data.place), "job.toml:3:12");
  EXPECT_EQ(format_place(job.models.place), "job.toml:1:1");
  EXPECT_EQ(format_place(job.table.place), "job.toml:4:1");
  EXPECT_EQ(format_place(job.exports.place), "job.toml");
}

TEST(Job, RefusesWhatIsNoJobFile) {
  const test::TemporaryDirectory directory;
  const auto message = [](const std::string& file) -> std::string {
    try {
      job::read_job(file);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message(directory.path()),
            directory.path() + ": error: is a directory, a file is needed");
  EXPECT_EQ(message(directory.path("none.toml")),
            directory.path("none.toml") + ": error: no such file");
  EXPECT_THAT(message(directory.write("empty.toml", " \n")), HasSubstr("the job file is empty"));
  EXPECT_THAT(message(directory.write("data.csv", std::string(2 << 20, '1'))),
              HasSubstr("is not a job file: it has 2.0 MiB"));
  EXPECT_THAT(message(directory.write("latin1.toml", "# \xe4\n" + minimal)),
              HasSubstr("save the file as UTF-8 text"));
  EXPECT_EQ(message(directory.write("good.toml", "\xef\xbb\xbf" + minimal)), "accepted");
}

TEST(Job, SurvivesKeysNestedTooDeep) {
  std::string deep = "a";
  for (int i = 0; i < 100000; ++i)
    deep += ".a";
  EXPECT_EQ(faults_of(deep + " = 1").at(0).what, "more than 1000 dots in one line");
  const std::string allowed = deep.substr(0, 2001);
  EXPECT_EQ(faults_of(minimal + "[" + allowed + "]\n" + allowed + " = 1").size(), 1u);
}

TEST(JobTemplate, IsAJobWithEveryDefault) {
  Job expected;
  expected.data.training = {"training.csv"};
  EXPECT_EQ(shown(parse_job(job::job_template(), "job.toml")), shown(expected));
}

// Lines that start with # and no blank are keys.
std::string uncommented(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool line_start = i == 0 || text[i - 1] == '\n';
    if (line_start && text[i] == '#' && text[i + 1] != ' ') continue;
    out += text[i];
  }
  return out;
}

TEST(JobTemplate, StaysAJobWithEveryKeyUncommented) {
  const test::TemporaryDirectory directory;
  directory.write("laws/a.toml", "[other]\nformula = \"mu*sigma_n_MPa\"\n"
                                 "parameters = { mu = { range = [0, 1] } }\n");
  const Job job = parse_job(uncommented(job::job_template()), directory.path("job.toml"));
  EXPECT_THAT(job.models.laws.names(), testing::IsSupersetOf({"my_law", "other"}));
  EXPECT_THAT(job.data.validation, ElementsAre("validation.csv"));
  EXPECT_EQ(job.data.columns.size(), 3u);
  EXPECT_EQ(job.table.axes.at("v_rel_mm_s").nodes, 17u);
  EXPECT_EQ(job.trace.repeatability, 0.03);
}

TEST(JobTemplate, NamesEveryKey) {
  const std::string text = job::job_template();
  for (const KeyRule& rule : key_rules()) {
    if (rule.path.ends_with("*")) continue;
    const std::string leaf = rule.path.substr(rule.path.rfind('.') + 1);
    const bool named = text.find("#" + leaf + " = ") != text.npos ||
                       text.find("\n" + leaf + " = ") != text.npos ||
                       text.find("# " + leaf + ": ") != text.npos;
    EXPECT_TRUE(named) << rule.path;
  }
}

// The schema itself: what messages and explanations rest on.
TEST(JobSchema, GivesEveryKeyAMeaningAndADefaultOrWhatItsAbsenceMeans) {
  for (const KeyRule& rule : key_rules()) {
    EXPECT_FALSE(rule.meaning.empty()) << rule.path;
    EXPECT_FALSE(job::expected(rule).empty()) << rule.path;
    const bool has_default = !job::default_text(rule).empty();
    EXPECT_NE(has_default, !rule.absent.empty()) << rule.path;
    EXPECT_NE(has_default, !rule.example.empty()) << rule.path;
    EXPECT_TRUE(job::find_section(rule.path.substr(0, rule.path.rfind('.')))) << rule.path;
  }
}

// Each default written out is the default.
TEST(JobSchema, ReadsBackEveryDefaultItShows) {
  const std::string normal = shown(parse_job(minimal, "job.toml"));
  for (const KeyRule& rule : key_rules()) {
    const std::string text = job::default_text(rule);
    if (text.empty()) continue;
    EXPECT_EQ(shown(parse_job(minimal, "job.toml", {rule.path + "=" + text})), normal) << rule.path;
  }
}

} // namespace
} // namespace frictab::job_test
