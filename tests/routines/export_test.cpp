// Exporters as a whole: what is refused, what the recipe says, that strict compilers are content.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "models/law.h"
#include "support/generated.h"
#include "support/json.h"
#include "support/law_parameter.h"
#include "support/sample_data.h"
#include "support/sample_tables.h"
#include "table/build.h"
#include "table/direct.h"

namespace frictab::export_test {

using codegen::all_exporters;
using codegen::BuildVariant;
using codegen::Exporter;
using codegen::ExportRequest;
using codegen::find_exporter;
using table::Table;

namespace {

using testing::HasSubstr;

std::string refusal(const ExportRequest& request, const std::string& target = "abaqus_vfric") {
  return test::refusal([&] { find_exporter(target)->generate(request); });
}

nlohmann::ordered_json recipe(const std::string& target, const ExportRequest& request) {
  return test::parse_json(find_exporter(target)->generate(request).at("recipe.json"));
}

// What ifort and ifx take as well: nothing beyond the standard but the solver's own includes.
TEST(LongExport, FixedFormSourcesAreFortran2008) {
  if (!have_program("gfortran")) GTEST_SKIP() << "gfortran is not installed";
  const TemporaryDirectory work;
  const std::vector<Table> tables = {test::four_axis_table(), test::spline_table(),
                                     test::further_histories_table(), test::direct_network()};
  for (const Exporter& exporter : all_exporters())
    for (const Table& table : tables) {
      ExportRequest request{table, "mm-t-s", test::sample_inputs(exporter)};
      if (exporter.is_routine() && !table.is_direct()) request.options["values"] = "file";
      codegen::SourceBundle files = exporter.generate(request);
      for (const char* include : {"vaba_param.inc", "aba_param.inc"})
        files[include] = "      implicit double precision (a-h,o-z)\n"
                         "      parameter (j_sys_Dimension=2)\n";
      for (const auto& [name, text] : files) {
        if (!name.ends_with(".f")) continue;
        SCOPED_TRACE(exporter.name + " " + table.model + " " + name);
        BuildVariant build;
        build.command = {"gfortran", "-std=f2008",    "-fsyntax-only", "-ffixed-line-length-72",
                         "-I@{dir}", "@{dir}/" + name};
        EXPECT_NO_THROW(codegen::compile_library(files, build, work.path()));
      }
    }
}

class LongSourcesOf : public testing::TestWithParam<std::string> {};

TEST_P(LongSourcesOf, EveryFormulaCompileWithoutAWarningInCAndFortranInBothForms) {
  const models::Model model = test::plausible_model(*models::find_law(GetParam()));
  const models::AssembledLaw law(model);
  const Table table =
      table::build_table(law, table::state_ranges(law, test::sample_data(model), {}), {});
  const Table direct = table::direct_form(law, table);
  for (const Table* form : {&table, &direct}) {
    const ExportRequest request{*form, "mm-t-s", {}};
    const std::string key = GetParam() + (form == &direct ? " direct" : "") + " warnings";
    if (have_program("gcc")) {
      EXPECT_NO_THROW(test::compiled(key, *find_exporter("c"), request, "c99",
                                     {"-Wall", "-Wextra", "-pedantic", "-Werror"}));
    }
    for (const char* target : {"abaqus_vfric", "abaqus_fric"}) // without derivatives, and with
      if (have_program("gfortran")) {
        EXPECT_NO_THROW(
            test::compiled(key, *find_exporter(target), request, "double", test::no_warnings));
      }
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, LongSourcesOf, testing::ValuesIn(test::laws_by_formula()),
                         test::law_test_name);

TEST(Export, ReportsEveryFaultOfTheJobsInputsInOneGo) {
  const Table table = test::four_axis_table();
  const std::string what = refusal({table,
                                    "mm-t-s",
                                    {{"sigma_n_MPa", "property"},
                                     {"psi", "constant:abc"},
                                     {"T_contact_C", "state"},
                                     {"sigma_f_MPa", "constant:-5"},
                                     {"v_rel_mm_z", "property"}}});
  EXPECT_THAT(what, HasSubstr("export.inputs.sigma_n_MPa: error: the solver gives this state"));
  EXPECT_THAT(what, HasSubstr("'abc' is not a number"));
  EXPECT_THAT(what, HasSubstr("'state' is not a source of a state"));
  EXPECT_THAT(what, HasSubstr("-5 is below the smallest possible sigma_f_MPa"));
  EXPECT_THAT(what, HasSubstr("did you mean 'v_rel_mm_s'?"));
}

TEST(Export, RefusesAConstantBeyondAnAxisUnlessTheLawGoesOnThere) {
  Table table = test::four_axis_table();
  const ExportRequest request{table, "mm-t-s", {{"psi", "constant:25"}}};
  EXPECT_EQ(refusal(request),
            "export.inputs.psi: error: 25 lies beyond the table's 1 .. 20\n"
            "  hint: a value inside, a wider range, or [table.axes.psi] outside = \"law\"");
  Table follows = test::sides_table(); // by the law below 500 MPa and above 200 degC
  EXPECT_EQ(refusal({follows, "mm-t-s", {{"T_contact_C", "constant:250"}}}), "accepted");
}

TEST(Export, RefusesFieldNumbersThatAreNone) {
  const Table table = test::four_axis_table();
  for (const std::string choice : {"field:0", "field:", "field:-1", "field:1.5", "field:99999"})
    EXPECT_THAT(refusal({table, "mm-t-s", {{"psi", choice}}}),
                HasSubstr("names no field variable"));
}

TEST(Export, RefusesTablesThatCannotBecomeCode) {
  for (const Exporter& exporter : all_exporters()) {
    Table table = test::one_axis_table();
    table.value[1] = std::nan("");
    table.axes[0].nodes[2] = table.axes[0].nodes[1];
    const std::string what = refusal({table, "mm-t-s", {}}, exporter.name);
    EXPECT_THAT(what,
                testing::AllOf(HasSubstr("not finite"), HasSubstr("axis 'psi' do not ascend")));
    table = test::one_axis_table();
    table.value.pop_back();
    EXPECT_THAT(refusal({table, "mm-t-s", {}}, exporter.name), HasSubstr("4 values for 5 nodes"));
  }
}

TEST(Export, RefusesTablesNoCompilerTakesAndNamesTheRemedy) {
  Table table = test::one_axis_table();
  table.axes[0].nodes.clear();
  for (int i = 0; i < 200000; ++i)
    table.axes[0].nodes.push_back(1 + i);
  table.value.assign(200000, 1.0);
  for (const Exporter& exporter : all_exporters()) { // a file would still leave nodes and widths
    if (!exporter.is_routine()) continue;
    const char* numbers = exporter.name == "qform_lua" ? "600,000" : "400,000";
    EXPECT_THAT(
        refusal({table, "mm-t-s", {}}, exporter.name),
        testing::AllOf(HasSubstr(std::string("needs ") + numbers + " numbers in the source"),
                       HasSubstr("table.interpolation = \"cubic\"")));
  }
}

TEST(Export, NamesOfParametersClashWithNothingInARoutine) {
  Table table = test::four_axis_table();
  for (const char* name : {"x", "MU", "Mu", "tau", "TAU_R", "u", "i", "bits", "ftmin", "exp", "t1",
                           "double", "end", "SIGMA_N_MPA", "tau_coulomb", "dtau_dpsi"}) {
    table.constants[name] = 1;
    table.combine = table.combine * expr::Expr::symbol(name);
  }
  for (const char* target : {"c", "fortran"}) {
    const Exporter& exporter = *find_exporter(target);
    const ExportRequest request{table, "m-kg-s", {}};
    const BuildVariant variant = exporter.variants(request)[0];
    if (!have_program(variant.program())) GTEST_SKIP() << variant.program() << " is missing";
    EXPECT_LE(test::worst_driven(exporter, request, variant.name, {"-Wall", "-Wextra", "-Werror"}),
              1e-13)
        << target;
  }
}

TEST(Export, NamesAndTextsFromOutsideStayInsideComments) {
  if (!have_program("gfortran")) GTEST_SKIP() << "gfortran is not installed";
  Table table = test::one_axis_table();
  table.model = "a */ int x; /*\n      stop 'x'";
  table.record.data_origin = std::string(300, 'w') + "\r\n*/\xff";
  const ExportRequest request{table, "mm-t-s", {}};
  EXPECT_NO_THROW(test::compiled("hostile", *find_exporter("c"), request, "c99", {"-Werror"}));
  EXPECT_NO_THROW(test::compiled("hostile", *find_exporter("abaqus_vfric"), request, "double"));
}

TEST(Export, RecipeTellsHowTheInputDeckCallsTheRoutine) {
  const Table table = test::four_axis_table();
  const nlohmann::ordered_json out = recipe("abaqus_vfric", {table, "m-kg-s", {}});
  EXPECT_EQ(out["entry"], "vfric");
  EXPECT_THAT(
      std::string(out["input_deck"]),
      HasSubstr("*Friction, user, depvar=8, properties=3\n <surface expansion ratio A1/A0>, "
                "<contact temperature, degC>, <flow stress of the workpiece, Pa>\n"));
  EXPECT_EQ(out["properties"][2]["unit"], "Pa");
  EXPECT_EQ(out["state_variables"].size(), 8u);
  EXPECT_EQ(out["state_variables"][1]["unit"], "Pa*m");
  EXPECT_THAT(std::string(out["signature_source"]),
              testing::AllOf(HasSubstr("verified:"), HasSubstr("Recalled")));
  EXPECT_THAT(std::string(out["data_origin"]), HasSubstr("synthetic"));
  EXPECT_EQ(out["table"]["axes"][0]["range"][1], 2750.0);
  EXPECT_EQ(out["table"]["worst_case_MPa"], 0.31);
}

TEST(Export, InputDeckHasTheLinesOfTheFieldsTheLawTakes) {
  const Table table = test::four_axis_table();
  for (const char* target : {"abaqus_vfric", "abaqus_vfriction", "abaqus_vfric_coef", "abaqus_fric",
                             "abaqus_fric_coef"}) {
    const nlohmann::ordered_json out = recipe(target, {table, "mm-t-s", {{"psi", "field:2"}}});
    EXPECT_THAT(
        std::string(out["input_deck"]),
        HasSubstr("*Initial Conditions, type=FIELD, variable=2\n"
                  " <nodes of both surfaces>, <surface expansion ratio A1/A0, at the start>\n"
                  "** and in the step:\n"
                  "*Field, variable=2\n"
                  " <nodes of both surfaces>, <surface expansion ratio A1/A0>\n"))
        << target;
    EXPECT_EQ(std::string(recipe(target, {table, "mm-t-s", {}})["input_deck"]).find("*Field"),
              std::string::npos);
  }
}

TEST(Export, RecipeLeavesOutPropertiesTheLawDoesNotNeed) {
  const Table table = test::constant_table();
  const nlohmann::ordered_json out = recipe("abaqus_vfric", {table, "mm-t-s", {}});
  EXPECT_THAT(std::string(out["input_deck"]), HasSubstr("*Friction, user, depvar=8\n*Contact"));
  EXPECT_TRUE(out["properties"].empty());
}

TEST(Export, RecipeListsTheCArgumentsInContractOrderAndTracedOnesBehind) {
  const Table table = test::traced_table();
  std::vector<std::string> names;
  const nlohmann::ordered_json out = recipe("c", {table, "mm-t-s", {}});
  for (const auto& argument : out["arguments"])
    names.push_back(argument["quantity"]);
  EXPECT_THAT(names, testing::ElementsAre("sigma_n_MPa", "psi", "v_rel_mm_s", "T_contact_C", "s_mm",
                                          "sigma_f_MPa", "humidity %, room"));
}

TEST(LongExport, SameRequestGivesTheSameBytes) {
  for (const test::NamedTable& sample : test::sample_tables())
    for (const Exporter& exporter : all_exporters())
      EXPECT_EQ(exporter.generate(test::SampleRequest(exporter, sample.table, "mm-t-s").get()),
                exporter.generate(test::SampleRequest(exporter, sample.table, "mm-t-s").get()));
}

TEST(Export, EveryTargetDescribesItself) {
  ASSERT_GE(all_exporters().size(), 2u);
  for (const Exporter& exporter : all_exporters()) {
    EXPECT_FALSE(exporter.title.empty());
    EXPECT_FALSE(exporter.notes.empty());
    EXPECT_THAT(exporter.signature_source,
                testing::AnyOf(HasSubstr("verified:"), HasSubstr("recalled:")));
    EXPECT_EQ(find_exporter(exporter.name), &exporter);
  }
  EXPECT_EQ(find_exporter("none"), nullptr);
}

TEST(Compile, GivesTheCompilersWordsWhereItFails) {
  if (!have_program("gcc")) GTEST_SKIP() << "gcc is not installed";
  const TemporaryDirectory work;
  const BuildVariant build{"x", {"gcc", "-shared", "-o", "@{out}", "@{dir}/a.c"}, {}, 0};
  try {
    codegen::compile_library({{"a.c", "int f(void) { return missing; }\n"}}, build, work.path());
    FAIL() << "compiled";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("gcc"), HasSubstr("missing")));
  }
}

TEST(Compile, UsesNoShell) {
  const TemporaryDirectory work;
  const BuildVariant build{"x", {"echo", "$(touch hacked)", ";", "touch hacked"}, {}, 0};
  codegen::compile_library({}, build, work.path());
  EXPECT_FALSE(std::filesystem::exists("hacked"));
}

TEST(Compile, TellsAMissingProgram) {
  EXPECT_FALSE(have_program("no-such-compiler-here"));
  EXPECT_TRUE(have_program("sh"));
  const TemporaryDirectory work;
  const BuildVariant build{"x", {"no-such-compiler-here"}, {}, 0};
  EXPECT_THROW(codegen::compile_library({}, build, work.path()), std::runtime_error);
  EXPECT_THROW(codegen::Library("/nowhere/lib.so"), std::runtime_error);
}

} // namespace

} // namespace frictab::export_test
