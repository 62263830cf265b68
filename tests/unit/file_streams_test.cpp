// Files are read to their end or refused, and what was written is what the disk gives back.
#include "io/file_streams.h"

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <sys/stat.h>

#include "core/error.h"
#include "core/hash.h"
#include "support/run_command.h"

namespace frictab::file_streams_test {
namespace {

namespace fs = std::filesystem;
using io::InputFile;
using testing::HasSubstr;

class FileStreams : public testing::Test {
protected:
  std::string refusal(const std::string& path, std::uint64_t most = InputFile::any_size) const {
    try {
      InputFile in(path, "named.csv", most);
      std::string all(std::istreambuf_iterator<char>(in), {});
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  }

  test::TemporaryDirectory directory;
};

TEST_F(FileStreams, GiveBackWhatWasWrittenInPiecesOfAnySize) {
  std::string text;
  for (int i = 0; text.size() < 300'000; ++i)
    text += std::to_string(i) + (i % 7 == 0 ? "\n" : ",");
  const std::string path = directory.path("a.csv");
  io::OutputFile out(path);
  for (std::size_t at = 0, piece = 1; at < text.size(); at += piece, piece = piece * 3 % 100'003)
    out << text.substr(at, piece);
  out.finish();
  EXPECT_EQ(io::read_file(path), text);
  EXPECT_EQ(io::hash_of_file(path, path), hash_of(text));
  EXPECT_EQ(io::first_bytes(path, 10), text.substr(0, 10));
  InputFile in(path, path);
  std::string lines, line;
  while (std::getline(in, line))
    lines += line + (in.eof() ? "" : "\n");
  EXPECT_EQ(lines, text);
}

TEST_F(FileStreams, DifferWhereOneByteDoes) {
  io::write_file(directory.path("a"), std::string(3'000'000, 'a'));
  io::write_file(directory.path("b"), std::string(2'999'999, 'a') + 'b');
  io::write_file(directory.path("c"), std::string(2'999'999, 'a'));
  EXPECT_TRUE(io::are_equal(directory.path("a"), directory.path("a")));
  EXPECT_FALSE(io::are_equal(directory.path("a"), directory.path("b")));
  EXPECT_FALSE(io::are_equal(directory.path("a"), directory.path("c")));
  EXPECT_FALSE(io::are_equal(directory.path("c"), directory.path("a")));
}

TEST_F(FileStreams, RefuseWhatIsNoFileWithoutWaiting) {
  ASSERT_EQ(::mkfifo(directory.path("pipe").c_str(), 0600), 0);
  EXPECT_THAT(refusal(directory.path("pipe")),
              HasSubstr("named.csv: error: is a pipe or a device, a file is needed"));
  EXPECT_THAT(refusal("/dev/zero"), HasSubstr("is a pipe or a device"));
  EXPECT_THAT(refusal(directory.path(".")), HasSubstr("is a directory, a file is needed"));
  EXPECT_THAT(refusal(directory.path("none")), HasSubstr("no such file"));
  fs::create_symlink("loop", directory.path("loop"));
  EXPECT_THAT(refusal(directory.path("loop")), HasSubstr("Too many levels of symbolic links"));
  EXPECT_EQ(io::first_bytes(directory.path("pipe"), 4), "");
}

TEST_F(FileStreams, RefuseAFileAboveItsLimitBeforeReadingIt) {
  const std::string path = directory.path("sparse");
  io::write_file(path, "");
  fs::resize_file(path, std::uintmax_t{1} << 40);
  EXPECT_THAT(refusal(path, 1000), HasSubstr("is larger than 1"));
  EXPECT_THROW(io::read_file(path), InputError);
}

// A file of /proc says that it is empty.
TEST_F(FileStreams, RefuseAFileThatGrowsBeyondItsLimit) {
  EXPECT_THAT(refusal("/proc/self/maps", 100), HasSubstr("is larger than 100"));
  EXPECT_GT(io::read_file("/proc/self/maps").size(), 100u);
}

TEST_F(FileStreams, SayWhyAFileCannotBeWritten) {
  try {
    io::write_file("/dev/full", "text");
    FAIL() << "nothing was written";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "cannot write /dev/full: No space left on device");
  }
}

} // namespace
} // namespace frictab::file_streams_test
