// Asks each library by the function or macro that it has for this.
#include "cli/library_versions.h"

#include <CLI/CLI.hpp>
#include <Eigen/Core>
#include <fmt/format.h>
#include <gsl/gsl_version.h>
#include <hdf5.h>
#include <matio.h>
#include <nanoflann.hpp>
#include <nlohmann/json.hpp>
#include <nlopt.h>
#include <pugixml.hpp>
#include <tbb/version.h>
#include <toml++/toml.h>
#include <xxhash.h>
#include <zip.h>
#include <zlib.h>

#define PCRE2_CODE_UNIT_WIDTH 8
#include <pcre2.h>

namespace frictab::cli {

namespace {

std::string dotted(long major, long minor, long patch) {
  return fmt::format("{}.{}.{}", major, minor, patch);
}

std::string hdf5_version() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return dotted(major, minor, release);
}

std::string loaded_nlopt_version() {
  int major = 0, minor = 0, bugfix = 0;
  ::nlopt_version(&major, &minor, &bugfix);
  return dotted(major, minor, bugfix);
}

std::string matio_version() {
  int major = 0, minor = 0, release = 0;
  Mat_GetLibraryVersion(&major, &minor, &release);
  return dotted(major, minor, release);
}

std::string pcre2_version() { // "10.42 2022-12-11"
  char text[64] = {};
  pcre2_config(PCRE2_CONFIG_VERSION, text);
  const std::string all = text;
  return all.substr(0, all.find(' '));
}

} // namespace

std::vector<std::pair<std::string, std::string>> library_versions() {
  return {
      {"HDF5", hdf5_version()},
      {"NLopt", loaded_nlopt_version()},
      {"Eigen", dotted(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"fmt", dotted(FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
      {"oneTBB", TBB_runtime_version()},
      {"zlib", zlibVersion()},
      {"libzip", zip_libzip_version()},
      {"matio", matio_version()},
      {"pugixml", fmt::format("{}.{}", PUGIXML_VERSION / 1000, PUGIXML_VERSION / 10 % 100)},
      {"GSL", gsl_version},
      {"PCRE2", pcre2_version()},
      {"JSON for Modern C++", dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
                                     NLOHMANN_JSON_VERSION_PATCH)},
      {"CLI11", CLI11_VERSION},
      {"toml++", dotted(TOML_LIB_MAJOR, TOML_LIB_MINOR, TOML_LIB_PATCH)},
      {"xxHash", dotted(XXH_VERSION_MAJOR, XXH_VERSION_MINOR, XXH_VERSION_RELEASE)},
      {"nanoflann", dotted(NANOFLANN_VERSION / 0x100, NANOFLANN_VERSION / 0x10 % 0x10,
                           NANOFLANN_VERSION % 0x10)},
  };
}

} // namespace frictab::cli
