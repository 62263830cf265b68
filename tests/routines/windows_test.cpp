// Generated sources under Windows, where most Abaqus desks are: built by Debian's MinGW-w64 from
// files with CRLF in a directory with a blank, and run under Wine where that is installed.
#include <algorithm>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codegen/compile.h"
#include "codegen/exporter.h"
#include "codegen/values_file.h"
#include "support/generated.h"
#include "support/run_command.h"
#include "support/sample_tables.h"

namespace frictab::windows_test {

using codegen::BuildVariant;
using codegen::Exporter;
using codegen::ExportRequest;
using codegen::SourceBundle;

namespace {

namespace fs = std::filesystem;

const std::string cross = "x86_64-w64-mingw32-";
const std::string wine = "/usr/lib/wine/wine64"; // Debian's package puts it on no PATH

std::string with_crlf(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += c == '\n' ? std::string("\r\n") : std::string(1, c);
  return out;
}

SourceBundle with_crlf(const SourceBundle& files) {
  SourceBundle out;
  for (const auto& [name, text] : files)
    out[name] = name == codegen::values_file_name ? text : with_crlf(text);
  return out;
}

// The same command for the cross compiler; what the Linux linker alone understands by its other
// name.
BuildVariant for_windows(BuildVariant variant) {
  variant.command.front() = cross + variant.command.front();
  std::replace(variant.command.begin(), variant.command.end(), std::string("-Wl,-z,muldefs"),
               std::string("-Wl,--allow-multiple-definition"));
  variant.extra = with_crlf(variant.extra);
  return variant;
}

class LongWindows : public testing::TestWithParam<std::string> {
protected:
  void SetUp() override {
    if (!have_program(cross + "gfortran") || !have_program(cross + "gcc"))
      GTEST_SKIP() << "Debian's gfortran- and gcc-mingw-w64-x86-64-win32 are not installed";
  }
};

TEST_P(LongWindows, RoutineAndDriverOfEveryTargetAreBuiltFromFilesWithCrlfInADirectoryWithABlank) {
  const Exporter& exporter = *codegen::find_exporter(GetParam());
  const TemporaryDirectory work;
  const table::Table axes = test::four_axis_table(), histories = test::further_histories_table();
  for (const auto& [table, values] :
       {std::pair{&axes, "file_windows"}, std::pair{&histories, "source"}}) {
    const ExportRequest request{*table,
                                "mm-t-s",
                                test::sample_inputs(exporter),
                                {{codegen::values_option().name, values},
                                 {"outside_summary", "at_exit_windows"},
                                 {"contact_fields", "vufield_windows"}}};
    for (const BuildVariant& variant : exporter.variants(request)) {
      SCOPED_TRACE(std::string(values) + " " + variant.name);
      EXPECT_NO_THROW(codegen::compile_library(with_crlf(exporter.generate(request)),
                                               for_windows(variant),
                                               work.path() / ("a blank " + variant.name) / values));
    }
  }
}

std::vector<std::string> compiled_targets() {
  std::vector<std::string> names;
  for (const Exporter& exporter : codegen::all_exporters())
    if (exporter.is_routine() && exporter.name != "qform_lua") names.push_back(exporter.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Targets, LongWindows, testing::ValuesIn(compiled_targets()));

// Reads columns of the six arguments from rows.bin and writes tau_R of each row to tau.bin.
const char* const program = R"(#include <stdio.h>
#include <stdlib.h>
#include "frictab_tau_R.h"
int main(int count, char** words) {
  const size_t n = (size_t)atol(words[count - 1]);
  double *x = malloc(6 * n * sizeof(double)), *tau = malloc(n * sizeof(double));
  FILE* file = fopen("rows.bin", "rb");
  size_t i;
  if (!file || fread(x, sizeof(double), 6 * n, file) != 6 * n) return 2;
  fclose(file);
  for (i = 0; i < n; ++i)
    tau[i] = frictab_tau_R(x[i], x[n + i], x[2 * n + i], x[3 * n + i], x[4 * n + i], x[5 * n + i]);
  file = fopen("tau.bin", "wb");
  return !(file && fwrite(tau, sizeof(double), n, file) == n && fclose(file) == 0);
}
)";

void write_bytes(const fs::path& file, const void* bytes, std::size_t size) {
  std::ofstream(file, std::ios::binary)
      .write(static_cast<const char*>(bytes), static_cast<std::streamsize>(size));
}

// tau_R of these states from a program for Windows that holds this target's functions.
std::vector<double> run_under_wine(const std::string& target, const std::string& source,
                                   const ExportRequest& request,
                                   const std::vector<std::vector<double>>& columns,
                                   const TemporaryDirectory& prefix) {
  const TemporaryDirectory work;
  SourceBundle files = codegen::find_exporter(target)->generate(request);
  files["frictab_tau_R.h"] =
      codegen::find_exporter("c")->generate(request).at("frictab_tau_R.h"); // the same for both
  files["main.c"] = program;
  for (const auto& [name, text] : with_crlf(files))
    write_bytes(work.path() / name, text.data(), text.size());
  std::vector<double> rows, tau(columns.front().size());
  for (const auto& column : columns)
    rows.insert(rows.end(), column.begin(), column.end());
  write_bytes(work.path() / "rows.bin", rows.data(), rows.size() * sizeof(double));
  const std::string directory = work.path().string();
  const auto build = [&](const std::string& compiler, const std::vector<std::string>& words) {
    std::vector<std::string> command = {cross + compiler, "-O2", "-ffp-contract=off"};
    command.insert(command.end(), words.begin(), words.end());
    const auto made = test::run_command(command, directory);
    EXPECT_EQ(made.exit_code, 0) << made.err;
  };
  build("gcc", {"-c", "main.c"});
  build(source.ends_with(".c") ? "gcc" : "gfortran",
        {source, "main.o", "-static", "-o", "main.exe"});
  const auto ran = test::run_command({wine, "main.exe", std::to_string(tau.size())}, directory,
                                     {"WINEPREFIX=" + prefix.path().string(), "WINEDEBUG=-all"});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  std::ifstream(work.path() / "tau.bin", std::ios::binary)
      .read(reinterpret_cast<char*>(tau.data()),
            static_cast<std::streamsize>(tau.size() * sizeof(double)));
  return tau;
}

TEST(SlowWine, FunctionsGiveTheStressesOfFrictabAlsoWithTheirValuesInAFile) {
  if (!have_program(wine) || !have_program(cross + "gfortran"))
    GTEST_SKIP() << "Debian's wine64 and MinGW-w64 are not installed";
  const TemporaryDirectory prefix; // what Wine keeps, made by the first run
  const table::Table table = test::four_axis_table();
  const test::States states(table, 2000, 31);
  const std::vector<double> truth = test::expected(table, states);
  std::vector<std::vector<double>> columns;
  const std::vector<std::string> inputs = table.inputs();
  for (const char* name :
       {"sigma_n_MPa", "psi", "v_rel_mm_s", "T_contact_C", "s_mm", "sigma_f_MPa"}) {
    const auto at = std::find(inputs.begin(), inputs.end(), name) - inputs.begin();
    columns.emplace_back(states.rows(), 0.0);
    if (static_cast<std::size_t>(at) < inputs.size())
      std::copy_n(states.columns()[static_cast<std::size_t>(at)], states.rows(),
                  columns.back().begin());
  }
  for (const char* values : {"source", "file_windows"}) {
    const ExportRequest request{table, "mm-t-s", {}, {{codegen::values_option().name, values}}};
    for (const auto& [target, source] :
         {std::pair{"c", "frictab_tau_R.c"}, {"fortran", "frictab_tau_R.f90"}})
      EXPECT_LE(
          test::worst_relative(run_under_wine(target, source, request, columns, prefix), truth),
          1e-13)
          << target << " " << values;
  }
}

} // namespace

} // namespace frictab::windows_test
