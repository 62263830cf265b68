// Every routine, driven over increments: stick, slip, reversal, loss of contact, beyond each end of
// the range, iterations and cutbacks, nodes in any order. All that it returns and remembers is what
// the account of its target says, and the account notices a routine that remembers something else.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codegen/compile.h"
#include "core/text.h"
#include "support/generated.h"
#include "support/sample_tables.h"
#include "support/solver_scale.h"

namespace frictab::driven_path_test {

using codegen::Exporter;
using codegen::ExportRequest;
using codegen::find_exporter;
using codegen::PathFigure;
using codegen::PathResult;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

namespace {

// Those that differ from their definitions.
std::vector<std::string> wrong(const PathResult& path) {
  std::vector<std::string> out;
  for (const PathFigure& figure : path.figures)
    if (figure.of_allowed > 1)
      out.push_back(fmt::format("{}: {:.3g} off, {:.3g} of what is allowed", figure.quantity,
                                figure.largest_error, figure.of_allowed));
  return out;
}

struct Driven {
  std::vector<std::string> wrong;
  std::size_t increments = 0, compared = 0;
};

Driven drive(const Exporter& exporter, const ExportRequest& request,
             const codegen::SourceBundle& bundle, codegen::BuildVariant variant,
             std::size_t increments = 240) {
  test::add_flags(variant, test::no_warnings);
  test::add_flags(variant, {"-fcheck=all"});
  variant.command.push_back("-O0"); // numbers are the same without contraction
  const codegen::CompiledTarget routine(exporter, request, bundle, variant);
  const auto path = routine.drive_path({.seed = 7, .increments = increments});
  if (!path) return {{"not driven"}};
  Driven out = {wrong(*path), path->increments};
  for (const PathFigure& figure : path->figures)
    out.compared += figure.compared;
  return out;
}

struct Case {
  std::string target;
  std::map<std::string, std::string> options = {};
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const Exporter& exporter : codegen::all_exporters()) {
    if (!exporter.is_routine() || exporter.name == "toy") continue;
    all.push_back({exporter.name});
  }
  all.push_back({"abaqus_vfric", {{"speed_scale", "property"}}});
  all.push_back({"abaqus_vfric_coef", {{"speed_scale", "property"}}});
  all.push_back({"lsdyna_usrfrc", {{"speed_scale", "property"}}});
  all.push_back({"abaqus_vfriction", {{"contact_fields", "vufield"}}});
  all.push_back({"abaqus_fric", {{"abaqus_coefficient", "start_of_increment"}}});
  all.push_back({"abaqus_fric_coef", {{"abaqus_coefficient", "start_of_increment"}}});
  all.push_back({"abaqus_fric_coef", {{"abaqus_release", "2020"}}});
  all.push_back({"marc_ufric", {{"marc_friction", "shear"}, {"marc_dimension", "3d"}}});
  all.push_back({"deform_usrbcc", {{"deform_friction", "shear"}}});
  all.push_back({"deform_usrbcc", {{"deform_friction", "constant"}}});
  return all;
}

std::string name_of(const testing::TestParamInfo<Case>& info) {
  std::string name = info.param.target;
  for (const auto& [option, value] : info.param.options)
    name += "_" + replace_all(value, "_", "");
  return name;
}

bool is_driven(const Exporter& exporter) {
  return exporter.name != "c" && exporter.name != "fortran" && exporter.name != "qform_lua";
}

} // namespace

class LongDrivenPath : public testing::TestWithParam<Case> {};

TEST_P(LongDrivenPath, ReturnsAndRemembersWhatItsDefinitionSays) {
  const Exporter& exporter = *find_exporter(GetParam().target);
  if (!is_driven(exporter)) GTEST_SKIP() << "returns the law alone and remembers nothing";
  const bool plain = GetParam().options.empty();
  for (const test::SolverScale& scale : test::every_system()) {
    const bool usual = scale.name == codegen::SolverUnits().text();
    for (const test::NamedTable& sample : test::sample_tables()) {
      if (!usual && !plain) continue; // units are the same text for each option
      if ((!usual || !plain) && !test::has_every_kind_of_argument(sample)) continue;
      const codegen::SolverUnits& units = scale.units;
      test::SampleRequest sampled(exporter, sample.table, units);
      ExportRequest request = sampled.get();
      request.options = GetParam().options;
      SCOPED_TRACE(sample.name + " " + units.text());
      const codegen::SourceBundle bundle = exporter.generate(request);
      for (const codegen::BuildVariant& variant : exporter.variants(request)) {
        if (!have_program(variant.program())) GTEST_SKIP() << variant.program() << " is missing";
        const Driven driven = drive(exporter, request, bundle, variant);
        EXPECT_THAT(driven.wrong, IsEmpty()) << variant.name;
        EXPECT_GE(driven.increments, 200u);
        EXPECT_GE(driven.compared, 1000u);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, LongDrivenPath, testing::ValuesIn(cases()), name_of);

namespace {

// What is put wrong in a routine, and the number that then differs.
struct Edit {
  std::string target, from, to, named;
};

std::string edit_name(const testing::TestParamInfo<Edit>& edit) {
  return fmt::format("{}_{}", edit.param.target, edit.index);
}

class SlowEditedRoutine : public testing::TestWithParam<Edit> {};

} // namespace

TEST_P(SlowEditedRoutine, IsNoticedOverIncrements) {
  if (!have_program("gfortran")) GTEST_SKIP() << "gfortran is not installed";
  const Edit& edit = GetParam();
  const Exporter& exporter = *find_exporter(edit.target);
  const table::Table table = test::history_table();
  const test::SampleRequest sampled(exporter, table, "mm-t-s");
  const ExportRequest request = sampled.get();
  codegen::SourceBundle bundle = exporter.generate(request);
  bool edited = false;
  for (auto& [file, text] : bundle) {
    const std::size_t at = text.find(edit.from);
    if (at == std::string::npos) continue;
    text.replace(at, edit.from.size(), edit.to);
    edited = true;
  }
  ASSERT_TRUE(edited) << edit.from;
  const codegen::BuildVariant variant = exporter.variants(request).front();
  EXPECT_THAT(drive(exporter, request, bundle, variant).wrong, Contains(HasSubstr(edit.named)));
}

INSTANTIATE_TEST_SUITE_P(
    All, SlowEditedRoutine,
    testing::Values(
        Edit{"abaqus_vfric", "both + part + slip", "both + part + 0.5D0*slip", "STATEV(1) slip"},
        Edit{"abaqus_vfric", "work = 0.5D0*(before", "work = (before", "STATEV(2) friction work"},
        Edit{"abaqus_vfric", "if (ftout(x)) beyond = 1.0D0", "if (ftout(x)) beyond = 0.0D0",
             "STATEV(4) increments outside"},
        Edit{"abaqus_vfriction", "real(press, kind", "real(0.9D0*press, kind", "STATE(3) peak"},
        Edit{"lsdyna_usrfrc", "scale = frc(1,lsv(ii))", "scale = frc(2,lsv(ii))", "force"},
        Edit{"abaqus_fric", "sfd = flim*ds", "sfd = 0.5D0*flim*ds", "SFD"},
        Edit{"abaqus_fric_coef", "max(s - s0(5), zero)", "s", "friction work"},
        Edit{"deform_usrbcc", "abs(presr(1))*slip", "abs(presr(2))*slip", "USRNOD(2)"}),
    edit_name);

} // namespace frictab::driven_path_test
