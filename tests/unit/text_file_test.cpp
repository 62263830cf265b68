// A file that is no text is refused before it is read to its end.
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "core/error.h"
#include "io/text_file.h"
#include "support/run_command.h"

namespace frictab::text_file_test {
namespace {

using testing::HasSubstr;

std::string fault_of(const std::string& path, const io::TextLimits& limits = {}) {
  try {
    io::read_text_file(path, "data.csv", limits);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no fault";
}

std::size_t most_memory_KiB() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss);
}

class TextFile : public testing::Test {
protected:
  std::string sparse(const std::string& begin, std::uint64_t bytes) {
    const std::string path = directory.write("sparse.csv", begin);
    std::filesystem::resize_file(path, bytes);
    return path;
  }
  test::TemporaryDirectory directory;
};

TEST_F(TextFile, IsRefusedAtItsFirstZeroByteHoweverLargeItIs) {
  const std::size_t before = most_memory_KiB();
  EXPECT_THAT(fault_of(sparse("time_s,tau_R_MPa\n", std::uint64_t{6} << 30)),
              HasSubstr("data.csv: error: this is not a text file"));
  EXPECT_LT(most_memory_KiB() - before, 64u << 10);
}

TEST_F(TextFile, ThatHasNoEndIsRefused) {
  EXPECT_THAT(fault_of("/dev/zero"), HasSubstr("is a pipe or a device, a file is needed"));
}

TEST_F(TextFile, AboveItsLimitIsRefusedWithTheLimit) {
  const std::string path = directory.write("a.csv", std::string(3 << 20, '\n'));
  EXPECT_THAT(fault_of(path, {.bytes = 2 << 20}),
              HasSubstr("data.csv: error: is larger than 2.0 MiB"));
  EXPECT_EQ(io::read_text_file(path, "a.csv", {.bytes = 3 << 20}).size(), 3u << 20);
}

TEST_F(TextFile, WithALineBeyondItsLimitIsRefused) {
  const std::string path = directory.write("a.csv", "a,b\n" + std::string(4 << 20, '1'));
  EXPECT_THAT(fault_of(path, {.line_bytes = 2 << 20}),
              HasSubstr("data.csv: error: a line is longer than 2.0 MiB"));
  EXPECT_EQ(fault_of(path), "no fault");
}

TEST_F(TextFile, IsReadWholeWhateverItsSize) {
  for (const std::size_t size : {0, 1, (1 << 20) - 1, 1 << 20, (1 << 20) + 1}) {
    std::string text(size, 'x');
    for (std::size_t i = 0; i < size; i += 1000)
      text[i] = '\n';
    EXPECT_TRUE(io::read_text_file(directory.write("a.csv", text), "a.csv") == text) << size;
  }
}

TEST_F(TextFile, InUtf16HoldsZeroBytes) {
  const std::string text("\xFF\xFE"
                         "a\0\n\0",
                         6);
  EXPECT_EQ(io::read_text_file(directory.write("a.csv", text), "a.csv"), text);
}

TEST_F(TextFile, ThatIsNotThereIsNamedAsTheJobNamesIt) {
  EXPECT_THAT(fault_of(directory.path("none.csv")), HasSubstr("data.csv: error: no such file"));
}

} // namespace
} // namespace frictab::text_file_test
