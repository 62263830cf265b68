// verify as a gate: whatever is handed on and differs from what was made fails, whatever is missing
// is named and not made, and every failure leaves a JUnit file.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/program.h"
#include "core/text.h"
#include "support/json.h"
#include "support/small_campaign.h"

namespace frictab::verify_gate_test {
namespace {

namespace fs = std::filesystem;
using test::CommandResult;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// Prints OBJECT<tab>NAME of every attribute that is one text or one number.
constexpr const char* list_attributes = "import h5py, sys\n"
                                        "f = h5py.File(sys.argv[1])\n"
                                        "for name in ['/', *f]:\n"
                                        "    for key, value in f[name].attrs.items():\n"
                                        "        print(name, key, sep='\\t')\n";
constexpr const char* change_attribute =
    "import h5py, sys\n"
    "with h5py.File(sys.argv[1], 'r+') as f:\n"
    "    a = f[sys.argv[2]].attrs\n"
    "    old = a.get(sys.argv[3], '')\n"
    "    text = isinstance(old, (str, bytes))\n"
    "    if sys.argv[4] == 'delete': del a[sys.argv[3]]\n"
    "    elif sys.argv[4] != '': a[sys.argv[3]] = eval(sys.argv[4])\n"
    "    elif text: a[sys.argv[3]] = (old.decode() if isinstance(old, bytes) else old) + 'x'\n"
    "    else: a[sys.argv[3]] = float(old[0] if old.shape else old) * 1.001 + 1e-6\n";

class VerifyGate : public test::SmallCampaign {
protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(SmallCampaign::SetUp());
    write_job(job());
    const CommandResult made = frictab({"export", "job.toml", "-q"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    fs::copy(directory.path("out"), directory.path("made"), fs::copy_options::recursive);
  }
  virtual std::string job() const {
    return "[models]\nuse = [\"coulomb\", \"levanov\"]\n[table]\nmodel = \"levanov\"\n"
           "[export]\ntargets = [\"abaqus_table\"]\n[verify]\nsamples = 2000\n";
  }
  void restore() const {
    fs::remove_all(directory.path("out"));
    fs::copy(directory.path("made"), directory.path("out"), fs::copy_options::recursive);
  }
  void replace(const std::string& file, const std::string& from, const std::string& to) const {
    const std::string text = directory.read(file);
    ASSERT_THAT(text, HasSubstr(from)) << file;
    directory.write(file, replace_all(text, from, to));
  }
  // An empty value: another text, or a number a thousandth larger.
  void change(const std::string& object, const std::string& name,
              const std::string& value = "") const {
    const CommandResult result =
        test::run_command({FRICTAB_PYTHON, "-c", change_attribute,
                           directory.path("out/tables/levanov.h5"), object, name, value});
    ASSERT_EQ(result.exit_code, 0) << object << " " << name << result.err;
  }
  CommandResult verify(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"verify", "job.toml", "--junit", "junit.xml"};
    words.insert(words.end(), more.begin(), more.end());
    return frictab(words);
  }
  // Verifies, expects a failed case that names the difference, and puts everything back.
  void expect_failure(const std::string& message) const {
    const CommandResult result = verify();
    EXPECT_EQ(result.exit_code, 1) << message << result.out << result.err;
    EXPECT_THAT(result.out, HasSubstr(message));
    EXPECT_THAT(result.out, HasSubstr("`frictab run job.toml` makes it again"));
    for (const char* file : {"junit.xml", "out/verify.xml"})
      EXPECT_THAT(unescaped(directory.read(file)),
                  AllOf(HasSubstr(message), HasSubstr("<failure message=")))
          << file;
    EXPECT_FALSE(test::parse_json(directory.read("out/verify.json")).at("passed").get<bool>());
    restore();
  }
  void expect_error(const std::string& message, const CommandResult& result) const {
    EXPECT_EQ(result.exit_code, 2) << result.out << result.err;
    EXPECT_THAT(result.err, HasSubstr(message));
    const std::string first = message.substr(0, message.find('\n'));
    EXPECT_THAT(
        unescaped(directory.read("junit.xml")),
        AllOf(HasSubstr("<error message="), HasSubstr(replace_all(first, ": error: ", ": "))));
  }
  static std::string unescaped(std::string xml) {
    for (const auto& [from, to] :
         {std::pair{"&quot;", "\""}, {"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}})
      xml = replace_all(xml, from, to);
    return xml;
  }
};

TEST_F(VerifyGate, NamesTheAttributeOfATableThatWasEdited) {
  ASSERT_EQ(verify().exit_code, 0);
  EXPECT_THAT(directory.read("junit.xml"),
              AllOf(Not(HasSubstr("<failure")), Not(HasSubstr("<error"))));
  change("sigma_n_MPa", "outside_low", "'clamp'");
  expect_failure("out/tables/levanov.h5: outside_low of sigma_n_MPa is 'clamp', made as 'law'");
  change("value", "units", "'Pa'");
  expect_failure("out/tables/levanov.h5: units of value is 'Pa', made as 'MPa'");
  change("/", "proven_drift_MPa", "1e-7");
  expect_failure("out/tables/levanov.h5: proven_drift_MPa is 1e-07, made as 0.");
  change("/", "refinement", "'2 nodes: 0 MPa'");
  expect_failure("out/tables/levanov.h5: refinement is '2 nodes: 0 MPa', made as '");
  change("sigma_f_MPa", "outside_high", "'error'");
  expect_failure("out/tables/levanov.h5: outside_high of sigma_f_MPa is 'error', made without it");
}

TEST_F(VerifyGate, NamesTheParameterOfAModelThatWasChanged) {
  const auto model = test::parse_json(directory.read("out/models/levanov.json"));
  const double value = model.at("parameters")[0].at("value");
  replace("out/models/levanov.json", nlohmann::json(value).dump(),
          nlohmann::json(1.02 * value).dump());
  expect_failure("parameters[0].value is '" + nlohmann::json(1.02 * value).dump() + "', made as '" +
                 nlohmann::json(value).dump() + "'");
}

TEST_F(VerifyGate, NamesTheLineOfADeckAndOfARecipe) {
  const std::string table = directory.read("out/export/abaqus_table/frictab_friction.inp");
  const std::size_t number = table.find("0.", table.find("*FRICTION"));
  ASSERT_NE(number, table.npos);
  std::string edited = table;
  edited.replace(number, 2, "1.");
  directory.write("out/export/abaqus_table/frictab_friction.inp", edited);
  expect_failure("out/export/abaqus_table/frictab_friction.inp:");
  const auto recipe = test::parse_json(directory.read("out/export/abaqus_table/recipe.json"));
  const std::string deck = recipe.at("input_deck");
  replace("out/export/abaqus_table/recipe.json",
          "*Surface Interaction, name=", "*Surface Interaction, name=X");
  expect_failure("line 1 of input_deck is '*Surface Interaction, name=X");
}

TEST_F(VerifyGate, CommentsVersionsAndLayoutAreNotesOnly) {
  directory.write("out/models/levanov.json", directory.read("out/models/levanov.json") + "\n");
  replace("out/export/abaqus_table/recipe.json", "\"tool_version\": \"",
          "\"tool_version\": \"0.0.");
  const CommandResult result = verify();
  EXPECT_EQ(result.exit_code, 0) << result.out;
  EXPECT_THAT(result.out, AllOf(HasSubstr("note: out/models/levanov.json: is laid out otherwise"),
                                HasSubstr("recipe.json:5: tool_version is '0.0.")));
  EXPECT_THAT(directory.read("junit.xml"), HasSubstr("<system-out>"));
}

TEST_F(VerifyGate, NamesWhatIsMissingAndMakesNothing) {
  fs::remove(directory.path("out/tables/levanov.h5"));
  expect_error("out/tables: error: is missing, and `frictab verify` makes nothing\n"
               "  hint: `frictab tabulate job.toml` makes it, `frictab run` everything\n",
               verify());
  EXPECT_FALSE(fs::exists(directory.path("out/tables/levanov.h5")));
  restore();
  fs::remove_all(directory.path("out/export/abaqus_table"));
  expect_error("out/export/abaqus_table: error: there are no generated sources\n"
               "  hint: `frictab export job.toml` makes them\n",
               verify());
  restore();
  fs::remove(directory.path("out/models/coulomb.json"));
  expect_error("out/models/coulomb.json: error: no such file\n"
               "  hint: `frictab run job.toml` makes it\n",
               verify());
  EXPECT_THAT(directory.read("out/verify.xml"), HasSubstr("<error message="));
  restore();
  expect_error("out/tables/coulomb.h5: error: ",
               verify({"--set", "table.model=[\"levanov\", \"coulomb\"]"}));
  fs::remove_all(directory.path("out"));
  expect_error("out/calibration.json: error: is missing, and `frictab verify` makes nothing\n",
               verify());
  EXPECT_FALSE(fs::exists(directory.path("out/calibration.json")));
  EXPECT_THAT(frictab({"verify", "job.toml", "--dry-run"}).out,
              HasSubstr("refuse  calibrate (missing, and `verify` makes nothing"));
}

TEST_F(VerifyGate, EveryFaultIsAnErrorInJUnit) {
  ASSERT_EQ(verify({"-q"}).exit_code, 0);
  const std::string before = directory.read("out/verify.json");
  directory.write("out/tables/levanov.h5", directory.read("out/tables/levanov.h5").substr(0, 3000));
  expect_error("out/tables/levanov.h5: error: cannot be opened as HDF5", verify());
  EXPECT_EQ(directory.read("out/verify.json"), before) << "of the last verification that ended";
  EXPECT_THAT(directory.read("out/verify.xml"), HasSubstr("<error message="));
  fs::copy(directory.path("made/tables/levanov.h5"), directory.path("out/tables/levanov.h5"),
           fs::copy_options::overwrite_existing);
  EXPECT_THAT(
      frictab({"status", "job.toml"}).out,
      HasSubstr("verify     stale: the last `verify` met the fault that verify.xml names\n"));
  restore();
  expect_error("out/tables: error: is stale: [table] of the job has changed since",
               verify({"--set", "table.tolerance_MPa=0.1"}));
  directory.write("out/calibration.json", directory.read("out/calibration.json") + " ");
  expect_error("out/calibration.json: error: was changed since `frictab calibrate` wrote it",
               verify());
  restore();
  directory.write("out/export/abaqus_table/recipe.json", "{");
  expect_error("out/export/abaqus_table/recipe.json:", verify());
  restore();
  expect_error("unknown key 'tolerence_MPa' in [table]",
               verify({"--set", "table.tolerence_MPa=1"}));
  expect_error("--table and --model belong together",
               frictab({"verify", "--table", "out/tables/levanov.h5", "--junit", "junit.xml"}));
  expect_error("no.json: error: no such file",
               frictab({"verify", "--table", "out/tables/levanov.h5", "--model", "no.json",
                        "--junit", "junit.xml"}));
  directory.write("data/training.csv", "experiment\n");
  expect_error("data/training.csv", verify());
}

TEST_F(VerifyGate, LeavesAFileCalledLikeItsOwnToItsOwner) {
  fs::remove(directory.path("out/verify.xml"));
  directory.write("out/verify.xml", "<mine/>");
  fs::remove(directory.path("out/models/coulomb.json"));
  EXPECT_EQ(verify().exit_code, 2);
  EXPECT_EQ(directory.read("out/verify.xml"), "<mine/>");
}

TEST_F(VerifyGate, ATableAloneIsComparedWithItsModelAndItsClaims) {
  const auto alone = [&] {
    return frictab({"verify", "--table", "out/tables/levanov.h5", "--model",
                    "out/models/levanov.json", "--junit", "junit.xml"});
  };
  EXPECT_EQ(alone().exit_code, 0) << alone().out;
  const auto expect = [&](const std::string& message) {
    const CommandResult result = alone();
    EXPECT_EQ(result.exit_code, 1) << message << result.out;
    EXPECT_THAT(result.out, HasSubstr(message));
    EXPECT_THAT(unescaped(directory.read("junit.xml")), HasSubstr(message));
    restore();
  };
  change("/", "proven_drift_MPa", "1e-7");
  expect("proven_drift_MPa is 1e-07, and 0.");
  change("/", "worst_case_MPa", "1e-3");
  expect("worst_case_MPa is 0.001, and the drift at its worst_case_at is 0.");
  change("value", "units", "'Pa'");
  expect("units of value is 'Pa', made as 'MPa'");
  change("sigma_n_MPa", "long_name", "'speed'");
  expect("long_name of sigma_n_MPa is 'speed', made as '");
  change("sigma_n_MPa", "outside_low", "'clamp'");
  expect("extension of value is '");
  change("/", "tolerance_MPa", "0.6"); // which no model knows
  expect("out/tables/levanov.h5: was changed since it was written, says stages.json");
}

using LongVerifyGate = VerifyGate;

// What no reader takes: HDF5's own links between datasets and scales.
bool is_exempt(const std::string& name) {
  return name == "DIMENSION_LIST" || name == "REFERENCE_LIST";
}

TEST_F(LongVerifyGate, EveryAttributeOfATableThatIsChangedOrLostFails) {
  std::istringstream lines(test::run_command({FRICTAB_PYTHON, "-c", list_attributes,
                                              directory.path("out/tables/levanov.h5")})
                               .out);
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line);) {
    const std::string object = line.substr(0, line.find('\t')),
                      name = line.substr(line.find('\t') + 1);
    if (is_exempt(name)) continue;
    ++count;
    for (const char* how : {"", "delete"}) {
      ASSERT_NO_FATAL_FAILURE(change(object, name, how));
      const CommandResult result = verify({"-q"});
      EXPECT_THAT(result.exit_code, testing::AnyOf(1, 2))
          << object << " " << name << " " << how << result.out;
      EXPECT_THAT(directory.read("junit.xml"),
                  testing::AnyOf(HasSubstr("<failure "), HasSubstr("<error ")))
          << object << " " << name;
      restore();
    }
  }
  EXPECT_GT(count, 50U);
}

TEST_F(LongVerifyGate, EveryKeyOfARecipeThatIsChangedFails) {
  const std::string file = "out/export/abaqus_table/recipe.json";
  const auto recipe = test::parse_json(directory.read(file));
  const auto flat = recipe.flatten();
  EXPECT_GT(flat.size(), 30U);
  for (const auto& [pointer, value] : flat.items()) {
    if (pointer == "/tool_version") continue; // results of another version are a note
    auto edited = recipe;
    auto& one = edited[nlohmann::ordered_json::json_pointer(pointer)];
    if (value.is_string())
      one = value.get<std::string>() + "x";
    else if (value.is_number())
      one = value.get<double>() * 1.001 + 1;
    else
      one = "x";
    directory.write(file, edited.dump(2) + "\n");
    const CommandResult result = verify({"-q"});
    EXPECT_THAT(result.exit_code, testing::AnyOf(1, 2)) << pointer << result.out;
    EXPECT_THAT(directory.read("junit.xml"),
                testing::AnyOf(HasSubstr("<failure "), HasSubstr("<error ")))
        << pointer;
  }
}

class VerifyGateOfRoutines : public VerifyGate {
protected:
  void SetUp() override {
    if (!have_program("gfortran") || !have_program("gcc")) GTEST_SKIP() << "no compilers";
    VerifyGate::SetUp();
  }
  std::string job() const override {
    return replace_all(VerifyGate::job(), "\"abaqus_table\"", "\"c\", \"abaqus_vfric\"");
  }
};

TEST_F(VerifyGateOfRoutines, NamesDeckLineCompileCommandAndStatement) {
  replace("out/export/abaqus_vfric/recipe.json", "depvar=8", "depvar=1");
  expect_failure("line 2 of input_deck is '*Friction, user, depvar=1, properties=1', made as "
                 "'*Friction, user, depvar=8, properties=1'");
  replace("out/export/abaqus_vfric/recipe.json", "gfortran -c -O2", "gfortran -c -O3");
  expect_failure("compile[2] is 'gfortran -c -O3 ");
  replace("out/export/c/frictab_tau_R.c", "return b != b", "return b == b");
  expect_failure("out/export/c/frictab_tau_R.c:");
}

TEST_F(VerifyGateOfRoutines, ACommentIsANoteWithItsLine) {
  replace("out/export/abaqus_vfric/frictab_vfric.f", "C     Law: levanov",
          "C     Law: levanov, reviewed");
  const CommandResult result = verify();
  EXPECT_EQ(result.exit_code, 0) << result.out;
  EXPECT_THAT(result.out,
              HasSubstr("note: out/export/abaqus_vfric/frictab_vfric.f:5: only comments "
                        "and blanks differ from what is generated"));
}

TEST_F(VerifyGateOfRoutines, OneThatDoesNotCompileHasFailedAndTheOthersAreMeasured) {
  replace("out/export/c/frictab_tau_R.c", "return b != b", "retrun b != b");
  const CommandResult result = verify();
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("ROUTINE BROKEN"), HasSubstr("unknown type name"),
                                HasSubstr("abaqus_vfric/single")));
  EXPECT_THAT(
      unescaped(directory.read("junit.xml")),
      AllOf(HasSubstr("name=\"c/c99\">\n      <failure message=\"cannot be compiled or called: "),
            HasSubstr("unknown type name")));
  const auto record = test::parse_json(directory.read("out/verify.json")).at("records")[1];
  EXPECT_EQ(record.at("subject"), "c/c99");
  EXPECT_TRUE(record.at("broken").get<bool>());
  EXPECT_THAT(record.at("why_not").get<std::string>(), Not(HasSubstr("/frictab-")));
}

TEST_F(VerifyGateOfRoutines, OneThatEndsTheProgramDoesNotPass) {
  for (const auto& [statement, code] : {std::pair{"exit(0);", 3}, {"__builtin_trap();", 132}}) {
    replace("out/export/c/frictab_tau_R.c", "return b != b",
            "extern void exit(int); " + std::string(statement) + " return b != b");
    const CommandResult result = verify();
    EXPECT_EQ(result.exit_code, code) << result.out;
    EXPECT_THAT(directory.read("junit.xml"), HasSubstr("the verification has not ended"));
    restore();
  }
}

} // namespace
} // namespace frictab::verify_gate_test
