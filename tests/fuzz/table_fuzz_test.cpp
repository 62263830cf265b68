// Damaged table files: whatever the bytes, reading gives a sound table or an InputError.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/random.h"
#include "io/file_streams.h"
#include "support/run_command.h"
#include "support/sample_tables.h"
#include "table/info.h"
#include "table/table_file.h"

namespace frictab::table_fuzz_test {
namespace {

enum Outcome : char { read_well = 'w', refused = 'r', unsound = 'u', other_error = 'o' };

// What read_table promises.
bool is_sound(const table::Table& table) {
  if (table.value.size() != table.nodes()) return false;
  const table::TableFunction function(table);
  std::vector<double> state;
  for (const std::string& name : function.inputs())
    state.push_back(table.range(name).value_or(std::pair{1.0, 2.0}).second);
  function(state);
  for (const double value : table.value)
    if (!std::isfinite(value)) return false;
  return true;
}

Outcome read(const std::string& file) {
  try {
    table::info_text(table::read_description(file), file);
    return is_sound(table::read_table(file)) ? read_well : unsound;
  } catch (const InputError& error) {
    return error.faults().empty() ? other_error : refused;
  } catch (const std::exception&) {
    return other_error;
  }
}

std::string damaged(std::string bytes, Random& random) {
  for (std::size_t k = 1 + random.below(12); k > 0; --k) {
    const std::size_t at = random.below(bytes.size());
    if (random.below(2) == 0)
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << random.below(8)));
    else
      bytes[at] = static_cast<char>(random.below(256));
  }
  if (random.below(6) == 0) bytes.resize(random.below(bytes.size()));
  return bytes;
}

// In a child process, so that a crash names its case and does not end the tests.
std::string outcomes_in_child(const std::vector<std::string>& cases, const std::string& file) {
  int ends[2] = {};
  if (pipe(ends) != 0) return "";
  const pid_t child = fork();
  if (child == 0) {
    alarm(240); // an endless loop is a fault too
    for (const std::string& bytes : cases) {
      std::ofstream(file, std::ios::binary) << bytes;
      const char outcome = read(file);
      if (::write(ends[1], &outcome, 1) != 1) _exit(1);
    }
    _exit(0);
  }
  close(ends[1]);
  std::string told;
  for (char outcome = 0; ::read(ends[0], &outcome, 1) == 1;)
    told += outcome;
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFSIGNALED(status)) ADD_FAILURE() << "signal " << WTERMSIG(status);
  return told;
}

// Few files of each kind: `.ci/fuzz 600 hdf5` tries many more.
TEST(TableFuzz, DamagedFileGivesASoundTableOrAnInputError) {
  const test::TemporaryDirectory directory;
  const std::string file = directory.path("t.h5");
  Random random(32);
  std::size_t well = 0, faults = 0;
  for (const test::NamedTable& sample : test::sample_tables())
    for (const io::Hdf5Storage& storage : {io::Hdf5Storage{}, io::Hdf5Storage{12, 3, true}}) {
      if (sample.table.is_direct()) continue; // is no file
      table::write_table(sample.table, file, storage);
      const std::string valid = io::read_file(file);
      std::vector<std::string> cases(8);
      for (std::string& bytes : cases)
        bytes = damaged(valid, random);
      const std::string told = outcomes_in_child(cases, file);
      ASSERT_EQ(told.size(), cases.size()) << sample.name << ": died in case " << told.size();
      for (std::size_t i = 0; i < told.size(); ++i) {
        ASSERT_TRUE(told[i] == read_well || told[i] == refused)
            << sample.name << " case " << i << ": " << told[i];
        ++(told[i] == read_well ? well : faults);
      }
    }
  EXPECT_GT(well, 10U); // the mutations reach both sides
  EXPECT_GT(faults, 50U);
}

} // namespace
} // namespace frictab::table_fuzz_test
