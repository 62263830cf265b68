// Data files written into a folder of the test's own, and read from there.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.h"
#include "data/load.h"

namespace frictab::test {

class LoadCase : public testing::Test {
protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    directory_ =
        std::filesystem::path(testing::TempDir()) / (std::string("frictab_load_") + test->name());
    std::filesystem::remove_all(directory_);
    std::filesystem::create_directories(directory_);
    options.base = directory_.string();
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  std::string file(const std::string& name, const std::string& text) {
    std::filesystem::create_directories((directory_ / name).parent_path());
    std::ofstream(directory_ / name, std::ios::binary) << text;
    return name;
  }
  data::Dataset read(const std::string& text) {
    return data::load_dataset({file("a.csv", text)}, options);
  }
  std::string fault(const std::string& text) { return fault_of({file("a.csv", text)}); }
  std::string fault_of(const std::vector<std::string>& files) {
    try {
      data::load_dataset(files, options);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no fault";
  }
  std::vector<double> column(const data::Dataset& data, const std::string& name) {
    const auto values = data.values(name);
    return {values.begin(), values.end()};
  }

  data::ReadRequest options;
  std::filesystem::path directory_;
};

} // namespace frictab::test
