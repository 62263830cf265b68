// Programs that are run: what they say is shown in part, and they end.
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/program.h"
#include "core/text.h"

namespace frictab::program_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(RunProgram, ShowsBeginningAndEndOfAFloodOfWords) {
  const TemporaryDirectory directory;
  const auto flood = [&] {
    run_program({"sh", "-c", "echo first; yes middle | head -n 450000; echo last; exit 1"},
                directory.path());
  };
  try {
    flood();
    FAIL() << "it failed and nothing was thrown";
  } catch (const std::runtime_error& error) {
    const std::string text = error.what();
    EXPECT_LT(text.size(), 10000u);
    EXPECT_THAT(text, HasSubstr("\nfirst\nmiddle\n"));
    EXPECT_THAT(text, HasSubstr("[... 3.0 MiB in all ...]"));
    EXPECT_TRUE(text.ends_with("middle\nlast\n")) << text.substr(text.size() - 40);
  }
}

TEST(RunProgram, StopsWhatDoesNotEndAndWhatThatHasStarted) {
  const TemporaryDirectory directory;
  const std::string child = (directory.path() / "child").string();
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_THAT(
      [&] {
        run_program({"sh", "-c", "sleep 66 & echo $! > " + child + "; sleep 66"}, directory.path(),
                    {std::chrono::seconds(1), usual_limits().memory_bytes});
      },
      ThrowsMessage<std::runtime_error>(
          HasSubstr("\ndid not end within 1 s and was stopped; FRICTAB_COMPILE_SECONDS=N in the "
                    "environment allows N s\n")));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
  // A killed process that nobody has waited for is still there, as a zombie.
  run_program({"sh", "-c",
               "for i in 1 2 3 4 5 6 7 8 9; do state=$(cut -d' ' -f3 /proc/$(cat " + child +
                   ")/stat 2>/dev/null); case \"$state\" in ''|Z|X) exit 0;; esac; sleep 0.2; "
                   "done; exit 1"},
              directory.path());
}

// The limits are those of the child: this process goes on allocating and writing.
TEST(RunProgram, NamesTheMemoryThatAProgramDidNotGet) {
  const TemporaryDirectory directory;
  const os::ProcessLimits limits{std::chrono::seconds(60), std::uint64_t{64} << 20};
  const auto hold = [&](const char* megabytes) { // in memory: tail looks for the end of a line
    return run_program(
        {"sh", "-c", std::string("head -c ") + megabytes + "M /dev/zero | tail -n 1 | wc -c"},
        directory.path(), limits);
  };
  EXPECT_EQ(hold("20"), "20971520\n");
  EXPECT_THAT(
      [&] {
        run_program({"sh", "-c", "head -c 200M /dev/zero | tail -n 1 >/dev/null"}, directory.path(),
                    limits);
      },
      ThrowsMessage<std::runtime_error>(
          HasSubstr("\nmay use 64.0 MiB of memory; FRICTAB_COMPILE_GIB=N in the environment allows "
                    "N GiB\n")));
}

TEST(RunProgram, PutsNoFloodOfWordsOnTheDisk) {
  const TemporaryDirectory directory;
  const std::string words =
      run_program({"sh", "-c", "head -c 200M /dev/zero | tr '\\0' x"}, directory.path(),
                  {std::chrono::seconds(60), std::uint64_t{1} << 30});
  EXPECT_LT(words.size(), 10000u);
  EXPECT_THAT(words, HasSubstr("[... 200.0 MiB in all ...]"));
  EXPECT_TRUE(std::filesystem::is_empty(directory.path()));
}

TEST(RunProgram, SaysThatAProgramIsNotThere) {
  const TemporaryDirectory directory;
  EXPECT_THAT([&] { run_program({"no-such-compiler-here"}, directory.path()); },
              ThrowsMessage<std::runtime_error>(HasSubstr("cannot run no-such-compiler-here: ")));
  EXPECT_THAT([&] { run_program({"/no/such/compiler"}, directory.path()); },
              ThrowsMessage<std::runtime_error>(
                  HasSubstr("cannot run /no/such/compiler: No such file or directory")));
}

class Variable { // of the environment, for the time of a test
public:
  Variable(std::string name, const std::string& value) : name_(std::move(name)) {
    if (const char* const before = std::getenv(name_.c_str())) before_ = before;
    ::setenv(name_.c_str(), value.c_str(), 1);
  }
  ~Variable() {
    before_ ? ::setenv(name_.c_str(), before_->c_str(), 1) : ::unsetenv(name_.c_str());
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

private:
  std::string name_;
  std::optional<std::string> before_;
};

TEST(UsualLimits, AreThoseOfTheEnvironment) {
  EXPECT_EQ(usual_limits().time, std::chrono::seconds(120));
  EXPECT_EQ(usual_limits().memory_bytes, std::uint64_t{8} << 30);
  const Variable seconds("FRICTAB_COMPILE_SECONDS", "0.2"), GiB("FRICTAB_COMPILE_GIB", "0.5");
  EXPECT_EQ(usual_limits().time, std::chrono::seconds(1));
  EXPECT_EQ(usual_limits().memory_bytes, std::uint64_t{512} << 20);
  for (const char* wrong : {"0", "-1", "nan", "1e99", "ten", "5 s"}) {
    const Variable set("FRICTAB_COMPILE_SECONDS", wrong);
    EXPECT_THAT([] { usual_limits(); },
                ThrowsMessage<InputError>(
                    HasSubstr(std::string("FRICTAB_COMPILE_SECONDS: error: '") + wrong +
                              "' is not"
                              " a number above 0\n  hint: unset it, which means 120")))
        << wrong;
  }
}

// Where a program is looked for, and what its own programs and libraries are looked for in.
class ProgramsOnPath : public testing::Test {
protected:
  void SetUp() override {
    here_ = std::filesystem::current_path();
    for (const char* folder : {"here", "safe", "open", "here/below"})
      std::filesystem::create_directories(directory_.path() / folder);
    for (const char* folder : {"here", "safe", "open", "here/below"})
      plant(folder);
    std::filesystem::permissions(directory_.path() / "open", std::filesystem::perms::all);
    std::filesystem::current_path(directory_.path() / "here");
  }
  void TearDown() override { std::filesystem::current_path(here_); }

  void plant(const std::string& folder) const {
    const std::filesystem::path file = directory_.path() / folder / "planted";
    std::ofstream(file) << "#!/bin/sh\necho $0 $PATH\n";
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  }
  std::string in(const std::string& folder) const { return directory_.path() / folder; }

  TemporaryDirectory directory_;
  std::filesystem::path here_;
};

TEST_F(ProgramsOnPath, AreNotTakenFromTheWorkingDirectoryNorFromWhereEverybodyMayPutThem) {
  for (const std::string& unsafe :
       {std::string("."), std::string(""), std::string("below"), in("here"), in("here/."),
        in("safe/../here"), in("open"), in("none")}) {
    const Variable alone("PATH", unsafe);
    EXPECT_EQ(os::on_path("planted"), "") << unsafe;
    EXPECT_FALSE(have_program("planted")) << unsafe;
    const Variable path("PATH", unsafe + ":" + in("safe") + ":/usr/bin:/bin:" + unsafe);
    EXPECT_EQ(os::on_path("planted"), in("safe/planted")) << unsafe;
    EXPECT_EQ(run_program({"planted"}, directory_.path()),
              in("safe/planted") + " " + in("safe") + ":/usr/bin:/bin\n")
        << unsafe;
  }
}

TEST_F(ProgramsOnPath, LoadNothingByNamesRelativeToTheWorkingDirectory) {
  const auto of = [](const std::string& name, const std::string& value) -> std::string {
    const Variable set(name, value);
    for (const std::string& entry : os::environment_for_programs())
      if (entry.starts_with(name + "=")) return entry.substr(name.size() + 1);
    return "unset";
  };
  for (const char* name : {"LD_LIBRARY_PATH", "LD_RUN_PATH", "COMPILER_PATH", "LIBRARY_PATH",
                           "CPATH", "C_INCLUDE_PATH", "GCONV_PATH"}) {
    EXPECT_EQ(of(name, "/opt/a:/opt/b"), "/opt/a:/opt/b") << name;
    EXPECT_EQ(of(name, ":/opt/a::lib:./b:"), "/opt/a") << name;
    EXPECT_EQ(of(name, ""), "unset") << name;
    EXPECT_EQ(of(name, "."), "unset") << name;
  }
  EXPECT_EQ(of("GCC_EXEC_PREFIX", "lib/gcc/"), "unset");
  EXPECT_EQ(of("GCC_EXEC_PREFIX", "/opt/lib/gcc/"), "/opt/lib/gcc/");
  EXPECT_EQ(of("LD_LIBRARY_PATH", ";/opt/a;b"), "/opt/a");
  EXPECT_EQ(of("LD_PRELOAD", "./x.so libfakeroot.so /opt/y.so"), "libfakeroot.so:/opt/y.so");
  EXPECT_EQ(of("FRICTAB_ANYTHING", ":."), ":.");
}

TEST(Printable, KeepsLinesAndWordsAndShowsWhatMovesACursor) {
  EXPECT_EQ(printable("tau_R \xc2\xb7 \xce\xbc\n\tin MPa"), "tau_R \xc2\xb7 \xce\xbc\n\tin MPa");
  EXPECT_EQ(printable("a\x1b[2Jb\r\x7f"), "a\\x1b[2Jb\\x0d\\x7f");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\xc2\\x9b31m")
      << "the one-character CSI";
  EXPECT_EQ(printable("cut \xce"), "cut \\xce");
  EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
}

TEST(Utf8Start, CutsBetweenCharactersAndMovesOnInWhatIsNoUtf8) {
  EXPECT_EQ(utf8_start("\xce\xbc\xce\xbc", 3), "\xce\xbc");
  EXPECT_EQ(utf8_start("abc", 3), "abc");
  EXPECT_EQ(utf8_start("a\xe2\x82\xac", 3), "a");
  EXPECT_EQ(utf8_start(std::string(9, '\x80'), 5).size(), 5u);
}

} // namespace
} // namespace frictab::program_test
