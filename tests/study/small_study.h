// Files of a SYNTHETIC study: small campaigns of which each takes some milliseconds.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/run_command.h"

namespace frictab::test {

inline constexpr const char* small_job = "[models]\nuse = [\"coulomb\", \"shear\"]\n"
                                         "[calibration]\nbootstrap = 100\n";

// study.toml of so many campaigns of the twin; the stage is calibrate.
inline std::string twin_study(int campaigns, const std::string& more = "") {
  return fmt::format("job = \"job.toml\"\nstage = \"calibrate\"\n[[twin]]\nseed = \"1..{}\"\n"
                     "design = \"p=1725,2005;psi=1,20;v=5,500;T=20;points=10;validation=4\"\n{}",
                     campaigns, more);
}

class SmallStudy : public testing::Test {
protected:
  void SetUp() override { directory.write("job.toml", small_job); }

  CommandResult frictab(const std::vector<std::string>& arguments) const {
    return run_frictab(arguments, directory.path());
  }
  // NAME/training.csv, 12 tests; the bytes depend on the seed.
  void write_data(const std::string& name, int seed) const {
    ASSERT_EQ(frictab({"twin", name, "--seed", std::to_string(seed), "--design",
                       "p=1725,2005;psi=1,20;v=5,500;T=20;points=10;validation=4"})
                  .exit_code,
              0);
  }
  // Three campaigns with files of their own, in folders a, b and c.
  void write_three() const {
    std::string text = "job = \"job.toml\"\nstage = \"calibrate\"\n";
    int seed = 0;
    for (const std::string name : {"a", "b", "c"}) {
      write_data(name, ++seed);
      text += fmt::format("[[campaign]]\nname = \"{0}\"\nfiles = \"{0}/training.csv\"\n"
                          "validation = \"{0}/validation.csv\"\n"
                          "factors = {{ lubricant = \"{1}\" }}\n",
                          name, seed < 3 ? "oil" : "soap");
    }
    directory.write("study.toml", text);
  }
  // What `diff -r` says of two folders; empty where they are the same.
  std::string difference(const std::string& a, const std::string& b) const {
    return run_command({"diff", "-r", a, b}, directory.path()).out;
  }
  // One digit at the end of a data file becomes another one.
  void change_a_digit(const std::string& file) const {
    std::string text = directory.read(file);
    const std::size_t digit = text.find_last_of("123456789");
    text[digit] = text[digit] == '9' ? '8' : '9';
    directory.write(file, text);
  }

  TemporaryDirectory directory;
};

} // namespace frictab::test
