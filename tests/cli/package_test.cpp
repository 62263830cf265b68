// What `cmake --install` and cpack leave, used from where they leave it.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/hardened.h"
#include "support/run_command.h"

namespace frictab::package_test {
namespace {

namespace fs = std::filesystem;
using test::CommandResult;
using test::run_command;
using testing::ContainsRegex;
using testing::HasSubstr;

const fs::path build = fs::path(test::program()).parent_path();

bool has(const std::string& program) {
  return run_command({"sh", "-c", "command -v " + program}).exit_code == 0;
}

// `root`/usr of a package, or a prefix.
void expect_whole(const fs::path& usr) {
  const test::TemporaryDirectory elsewhere;
  const std::string program = (usr / "bin/frictab").string();
  const CommandResult twin = run_command(
      {program, "twin", "data", "--design", "p=1725,2005;psi=1,20;v=5,500;T=20;points=10"},
      elsewhere.path());
  ASSERT_EQ(twin.exit_code, 0) << twin.err;
  const CommandResult run = run_command(
      {program, "run", "data/job.toml", "--set", "models.use=coulomb", "--set", "export.targets=c"},
      elsewhere.path());
  EXPECT_EQ(run.exit_code, 0) << run.err; // templates are within it
  for (const char* file :
       {"share/man/man1/frictab.1.gz", "share/man/man1/frictab-table-slice.1.gz",
        "share/bash-completion/completions/frictab", "share/zsh/vendor-completions/_frictab",
        "share/fish/vendor_completions.d/frictab.fish", "share/frictab/job.schema.json",
        "share/doc/frictab/copyright", "share/doc/frictab/docs/start.md",
        "share/doc/frictab/examples/04_ci_pipeline/verify.sh",
        "lib/python3/dist-packages/frictab/campaign.py",
        "lib/python3/dist-packages/frictab/py.typed"})
    EXPECT_TRUE(fs::exists(usr / file)) << file;
  EXPECT_FALSE(fs::exists(usr / "share/doc/frictab/examples/01_synthetic_campaign/data"));
  EXPECT_FALSE(fs::exists(usr / "lib/python3/dist-packages/frictab/__pycache__"));
}

// One test: both write the manual pages into the build directory.
TEST(LongPackage, InstalledOrUnpackedIsAWholeProgramThatNamesItsLibraries) {
  const test::TemporaryDirectory prefix;
  const CommandResult installed = run_command(
      {"cmake", "--install", build.string(), "--prefix", prefix.path("usr"), "--strip"});
  ASSERT_EQ(installed.exit_code, 0) << installed.err;
  expect_whole(prefix.path("usr"));
  if (has("readelf")) {
    EXPECT_THAT(test::protections_missing_in(prefix.path("usr/bin/frictab")), testing::IsEmpty());
  }
  for (const char* program : {"cpack", "dpkg-deb", "dpkg-shlibdeps"})
    if (!has(program)) GTEST_SKIP() << program << " is not installed";
  const test::TemporaryDirectory directory;
  const CommandResult packed =
      run_command({"cpack", "--config", (build / "CPackConfig.cmake").string(), "-G", "DEB", "-B",
                   directory.path("packages")});
  ASSERT_EQ(packed.exit_code, 0) << packed.out << packed.err;
  std::string package;
  for (const auto& entry : fs::directory_iterator(directory.path("packages")))
    if (entry.path().extension() == ".deb") package = entry.path().string();
  ASSERT_NE(package, "");
  ASSERT_EQ(run_command({"dpkg-deb", "-x", package, directory.path("root")}).exit_code, 0);
  expect_whole(directory.path("root/usr"));
  const std::string depends = run_command({"dpkg-deb", "-f", package, "Depends"}).out;
  for (const char* library : {"libhdf5", "libfmt9", "libnlopt", "libudunits2", "libc6"})
    EXPECT_THAT(depends, HasSubstr(library));
  EXPECT_THAT(run_command({"dpkg-deb", "-f", package, "Package", "Version"}).out,
              ContainsRegex("Package: frictab\nVersion: 0\\.2\\.0"));
  EXPECT_EQ(run_command({"dpkg-deb", "-f", package, "Maintainer"}).out, "The frictab authors\n");
}

TEST(SlowSourceArchive, HasWhatABuildNeedsAndNothingMade) {
  const test::TemporaryDirectory directory;
  const CommandResult packed =
      run_command({"cpack", "--config", (build / "CPackSourceConfig.cmake").string(), "-B",
                   directory.path("")});
  ASSERT_EQ(packed.exit_code, 0) << packed.out << packed.err;
  const std::string listed =
      run_command({"tar", "tzf", directory.path("frictab-" FRICTAB_VERSION ".tar.gz")}).out;
  for (const char* file : {"CMakeLists.txt", "src/main.cpp", "templates/laws/coulomb.toml",
                           "exporters/c/exporter.cpp", "apt-packages.txt", "LICENSE"})
    EXPECT_THAT(listed, HasSubstr(std::string("frictab-" FRICTAB_VERSION "/") + file + "\n"));
  EXPECT_EQ(listed.find("/build/"), std::string::npos);
  EXPECT_EQ(listed.find("/.git/"), std::string::npos);
}

// conda-build and Spack are not here.
TEST(Packaging, RecipesHaveTheVersionOfTheProject) {
  const auto text = [](const char* file) {
    return run_command({"cat", std::string(FRICTAB_SOURCE_DIR "/") + file}).out;
  };
  EXPECT_THAT(text("packaging/conda/meta.yaml"),
              HasSubstr("set version = \"" FRICTAB_VERSION "\""));
  EXPECT_THAT(text("packaging/spack/package.py"), HasSubstr("version(\"" FRICTAB_VERSION "\")"));
  EXPECT_THAT(text("CITATION.cff"), HasSubstr("\nversion: " FRICTAB_VERSION "\n"));
}

// The Dockerfile is not run here: no test has a daemon. Its steps are those of .ci/build.
TEST(Dockerfile, BuildsWithTheListedPackagesAndThePresetOfTheDocumentation) {
  const test::TemporaryDirectory directory;
  const CommandResult listed = run_command(
      {"sh", "-c", "sed '/^# tests/,$d; /^#/d' " FRICTAB_SOURCE_DIR "/apt-packages.txt"});
  EXPECT_THAT(listed.out, HasSubstr("libhdf5-dev\n"));
  EXPECT_EQ(listed.out.find("libgtest-dev"), std::string::npos);
  EXPECT_EQ(listed.out.find('#'), std::string::npos);
  const CommandResult text = run_command({"cat", FRICTAB_SOURCE_DIR "/Dockerfile"});
  EXPECT_THAT(text.out, HasSubstr("sed '/^# tests/,$d; /^#/d' /frictab/apt-packages.txt"));
  EXPECT_THAT(text.out, ContainsRegex("\nFROM debian:12@sha256:[0-9a-f]+ AS build\n"));
}

} // namespace
} // namespace frictab::package_test
