// Values in a file beside the source: the same stresses, read once whoever calls first, and never a
// stress from a file that is missing, damaged or another table's.
#include <atomic>
#include <cmath>
#include <fstream>
#include <thread>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codegen/baked_table.h"
#include "codegen/values_file.h"
#include "core/error.h"
#include "support/generated.h"
#include "support/json.h"
#include "support/run_command.h"
#include "support/sample_tables.h"

namespace frictab::values_file_test {

using codegen::BuildVariant;
using codegen::Exporter;
using codegen::ExportRequest;
using codegen::find_exporter;
using codegen::SourceBundle;
using codegen::values_file_name;
using table::Table;

namespace {

using testing::HasSubstr;

std::vector<const Exporter*> with_values_option() {
  std::vector<const Exporter*> out;
  for (const Exporter& exporter : codegen::all_exporters())
    if (exporter.offers(codegen::values_option().name)) out.push_back(&exporter);
  return out;
}

ExportRequest request_of(const Exporter& exporter, const Table& table, const std::string& values) {
  return {
      table, "mm-t-s", test::sample_inputs(exporter), {{codegen::values_option().name, values}}};
}

// Tables with axes: the others have no values to put away.
std::vector<test::NamedTable> samples() {
  std::vector<test::NamedTable> out;
  for (const test::NamedTable& sample : test::sample_tables())
    if (!sample.table.axes.empty() && !sample.table.is_direct()) out.push_back(sample);
  return out;
}

TEST(ValuesFile, EveryRoutineOfEverySolverReadsItButLua) {
  std::vector<std::string> others;
  for (const Exporter& exporter : codegen::all_exporters())
    if (exporter.is_routine() && !exporter.offers(codegen::values_option().name))
      others.push_back(exporter.name);
  EXPECT_EQ(others, (std::vector<std::string>{"qform_lua"}));
}

class LongValuesFileOf : public testing::TestWithParam<const Exporter*> {
protected:
  const Exporter& exporter() const { return *GetParam(); }
  // Rows driven through a routine whose file is `bytes` (nullptr: there is none).
  std::vector<double> driven(const ExportRequest& request, const BuildVariant& variant,
                             const test::States& states, const std::string* bytes) const {
    SourceBundle bundle = exporter().generate(request);
    bundle.erase(values_file_name);
    if (bytes) bundle[values_file_name] = *bytes;
    std::vector<double> tau(states.rows(), -1);
    codegen::CompiledTarget(exporter(), request, bundle, variant)
        .drive(states.rows(), states.columns(), tau);
    return tau;
  }
};

// What reads the file is one text in C and one in Fortran: all samples through both, one through
// every solver's routine.
bool is_the_text(const Exporter& exporter) {
  return exporter.name == "c" || exporter.name == "abaqus_vfric";
}

TEST_P(LongValuesFileOf, GivesTheBitsThatTheSourceGives) {
  for (const test::NamedTable& sample : samples()) {
    SCOPED_TRACE(sample.name);
    if (!is_the_text(exporter()) && sample.name != "four_axes") continue;
    const ExportRequest source = request_of(exporter(), sample.table, "source");
    const ExportRequest file = request_of(exporter(), sample.table, "file");
    const test::States states(sample.table, 3000, 23);
    for (const BuildVariant& variant : exporter().variants(source)) {
      if (!have_program(variant.program())) GTEST_SKIP() << variant.program() << " is missing";
      std::vector<double> expected(states.rows(), -1), tau(states.rows(), -1);
      codegen::CompiledTarget(exporter(), source, exporter().generate(source), variant)
          .drive(states.rows(), states.columns(), expected);
      for (const BuildVariant& own : exporter().variants(file))
        if (own.name == variant.name)
          codegen::CompiledTarget(exporter(), file, exporter().generate(file), own)
              .drive(states.rows(), states.columns(), tau);
      ASSERT_EQ(tau.size(), expected.size());
      for (std::size_t i = 0; i < tau.size(); ++i)
        ASSERT_TRUE(tau[i] == expected[i] || (std::isnan(tau[i]) && std::isnan(expected[i])))
            << variant.name << " row " << i;
    }
  }
}

TEST_P(LongValuesFileOf, GivesNoStressFromAFileThatIsMissingCutLongerDamagedOrAnothers) {
  const Table table = test::four_axis_table();
  const ExportRequest request = request_of(exporter(), table, "file");
  const SourceBundle bundle = exporter().generate(request);
  const std::string good = bundle.at(values_file_name);
  std::string cut = good, longer = good + good.substr(0, 8), damaged = good, others = good;
  cut.pop_back();
  damaged[good.size() / 2] = static_cast<char>(damaged[good.size() / 2] ^ 1);
  std::swap_ranges(others.begin(), others.begin() + 8, others.begin() + 8);
  test::States states(table, 50, 29, 0);
  const BuildVariant variant = exporter().variants(request)[0];
  if (!have_program(variant.program())) GTEST_SKIP() << variant.program() << " is missing";
  for (const double tau : driven(request, variant, states, &good))
    EXPECT_TRUE(std::isfinite(tau));
  std::vector<const std::string*> files = {nullptr, &damaged};
  if (is_the_text(exporter())) files.insert(files.end(), {&cut, &longer, &others});
  for (const std::string* bytes : files)
    for (const double tau : driven(request, variant, states, bytes))
      ASSERT_FALSE(tau > 0) << (bytes ? bytes->size() : 0) << " bytes";
}

TEST_P(LongValuesFileOf, IsListedByTheRecipeWithItsChecksum) {
  const Table table = test::four_axis_table();
  const SourceBundle bundle = exporter().generate(request_of(exporter(), table, "file"));
  const auto recipe = test::parse_json(bundle.at("recipe.json"));
  EXPECT_THAT(recipe["files"].get<std::vector<std::string>>(),
              testing::Contains(std::string(values_file_name)));
  const nlohmann::ordered_json& file = recipe["values_file"];
  EXPECT_EQ(file["name"], values_file_name);
  EXPECT_EQ(file["numbers"], table.nodes());
  const std::vector<double> values = codegen::baked_values(table);
  EXPECT_EQ(file["crc32"], fmt::format("{:08x}", codegen::values_crc32(values)));
  EXPECT_EQ(bundle.at(values_file_name).size(), sizeof(double) * values.size());
}

INSTANTIATE_TEST_SUITE_P(Targets, LongValuesFileOf, testing::ValuesIn(with_values_option()),
                         [](const testing::TestParamInfo<const Exporter*>& given) {
                           return given.param->name;
                         });

// One axis of n evenly spaced nodes, tau_R = psi.
Table long_table(int nodes) {
  Table table = test::one_axis_table();
  table.axes[0].nodes.clear();
  table.value.clear();
  for (int i = 0; i < nodes; ++i)
    table.axes[0].nodes.push_back(1 + i), table.value.push_back(1 + i);
  return table;
}

TEST(ValuesFile, IsMadeWhereTheSourceWouldHoldTooManyNumbersAndOnlyThere) {
  const Exporter& c = *find_exporter("c");
  const auto made = [&](const Table& table, const std::string& choice) {
    return c.generate(request_of(c, table, choice)).count(values_file_name) == 1;
  };
  const Table small = long_table(100), large = long_table(110000); // three numbers per node
  EXPECT_FALSE(made(small, "auto"));
  EXPECT_TRUE(made(large, "auto"));
  EXPECT_TRUE(made(small, "file"));
  EXPECT_FALSE(made(test::constant_table(), "file"));
  EXPECT_FALSE(made(test::direct_table(), "file"));
  EXPECT_THROW(c.generate(request_of(c, large, "source")), InputError);
}

TEST(ValuesFile, IsReadOnceByThreadsThatCallTogether) {
  const Table table = test::four_axis_table();
  const ExportRequest request = request_of(*find_exporter("c"), table, "file");
  for (const char* target : {"c", "fortran"}) {
    const Exporter& exporter = *find_exporter(target);
    const BuildVariant variant = exporter.variants(request)[0];
    if (!have_program(variant.program())) GTEST_SKIP() << variant.program() << " is missing";
    const test::States states(table, 200, 31);
    const std::vector<double> truth = test::expected(table, states);
    for (int round = 0; round < 20; ++round) {
      const TemporaryDirectory work;
      const SourceBundle bundle = exporter.generate(request);
      static std::map<std::string, std::filesystem::path> made; // compiled once, loaded anew
      const std::filesystem::path own = work.path() / "own.so";
      static const TemporaryDirectory kept;
      if (!made.count(target))
        made[target] = codegen::compile_library(bundle, variant, kept.path() / target);
      std::filesystem::copy_file(made[target], own);
      const codegen::Library library(own);
      codegen::pass_directory(library, kept.path() / target);
      std::atomic<int> waiting = 0, wrong = 0;
      std::vector<std::thread> threads;
      for (int t = 0; t < 8; ++t)
        threads.emplace_back([&] {
          std::vector<double> tau(states.rows());
          ++waiting;
          while (waiting < 8) {
          }
          exporter.batch(library.handle(), request, states.rows(), states.columns(), tau);
          if (test::worst_relative(tau, truth) > 1e-13) ++wrong;
        });
      for (std::thread& thread : threads)
        thread.join();
      ASSERT_EQ(wrong, 0) << target;
    }
  }
}

TEST(ValuesFile, MessagesNameTheFileAndWhatIsWrongWithIt) {
  const Table table = test::four_axis_table();
  if (!have_program("gcc") || !have_program("gfortran")) GTEST_SKIP() << "a compiler is missing";
  const test::TemporaryDirectory work;
  const auto write = [&](const SourceBundle& bundle) {
    for (const auto& [path, text] : bundle)
      std::ofstream(work.path(path), std::ios::binary) << text;
  };
  write(find_exporter("c")->generate(request_of(*find_exporter("c"), table, "file")));
  write(find_exporter("fortran")->generate(request_of(*find_exporter("fortran"), table, "file")));
  write({{"main.c", "#include <stdio.h>\n"
                    "#include \"frictab_tau_R.h\"\n"
                    "int main(void) {\n"
                    "  printf(\"%.6g\", frictab_tau_R(1000, 2, 50, 100, 0, 480));\n"
                    "  return 0;\n}\n"}});
  const auto run = [&](const std::string& command) {
    return test::run_command({"sh", "-c", command}, work.path());
  };
  const auto build = run("gcc main.c frictab_tau_R.c -o by_c -lm && gfortran -c frictab_tau_R.f90 "
                         "-o law.o && gcc main.c law.o -o by_fortran -lgfortran -lm");
  ASSERT_EQ(build.exit_code, 0) << build.err;
  const std::string found = run("./by_c").out;
  EXPECT_GT(std::stod(found), 0);
  EXPECT_EQ(run("./by_fortran").out, found);
  const auto fault = [&](const char* program) {
    const auto result = run(std::string("FRICTAB_DIR=elsewhere ./") + program);
    EXPECT_THAT(result.out, HasSubstr("nan")) << program;
    return result.err;
  };
  ASSERT_EQ(run("mkdir elsewhere").exit_code, 0);
  EXPECT_EQ(fault("by_c"), "friction table: elsewhere/frictab_values.bin: cannot be opened\n");
  EXPECT_EQ(fault("by_fortran"), "friction table: there is no elsewhere/frictab_values.bin\n");
  ASSERT_EQ(run("head -c 64 frictab_values.bin > elsewhere/frictab_values.bin").exit_code, 0);
  EXPECT_THAT(fault("by_c"), HasSubstr("has not the "));
  EXPECT_THAT(fault("by_fortran"), HasSubstr(" bytes are expected, not what is in elsewhere/"));
  ASSERT_EQ(run("tr '\\000' '\\001' < frictab_values.bin > elsewhere/frictab_values.bin").exit_code,
            0);
  EXPECT_THAT(fault("by_c"), HasSubstr("damaged, or made for another source (CRC-32)"));
  EXPECT_THAT(fault("by_fortran"), HasSubstr("for another routine (CRC-32): elsewhere/"));
}

} // namespace

} // namespace frictab::values_file_test
