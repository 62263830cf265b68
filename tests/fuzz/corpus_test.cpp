// The fuzzer's seeds, and every input that once failed, in the ordinary tests.
#include <filesystem>

#include <gtest/gtest.h>

#include "fuzz/target.h"
#include "io/file_streams.h"

namespace frictab::corpus_test {
namespace {

namespace fs = std::filesystem;

fs::path corpus() {
  return fs::path(FRICTAB_SOURCE_DIR) / "tests" / "fuzz" / "corpus";
}

TEST(FuzzCorpus, EveryInputIsTakenOrRefusedWithItsPromisesKept) {
  for (const fuzz::Target& target : Registry<fuzz::Target>::instance().all()) {
    std::size_t taken = 0;
    for (const auto& entry : fs::directory_iterator(corpus() / target.name))
      EXPECT_NO_THROW(taken += fuzz::run(target, io::read_file(entry.path()))) << entry.path();
    EXPECT_GT(taken, 0u) << target.name
                         << ": no seed is taken, nothing behind the reader is reached";
  }
}

TEST(FuzzCorpus, EveryFolderIsOfATargetAndAllAreSmall) {
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(corpus())) {
    if (entry.is_regular_file())
      bytes += entry.file_size();
    else
      EXPECT_TRUE(Registry<fuzz::Target>::instance().find(entry.path().filename().string()))
          << entry.path();
  }
  EXPECT_LT(bytes, 200000u);
}

} // namespace
} // namespace frictab::corpus_test
