// Messages of programs that fail, and working directories.
#include "core/program.h"

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include <fmt/format.h>

#include "core/error.h"
#include "core/os/files.h"
#include "core/text.h"

namespace frictab {

namespace fs = std::filesystem;

namespace {

constexpr std::chrono::seconds usual_time{120};
constexpr double usual_GiB = 8;
constexpr double most_seconds = 1e9, most_GiB = 1e6; // more cannot be meant

double number_in(const char* variable, double usual, double most) {
  const char* const text = std::getenv(variable);
  if (!text || !*text) return usual;
  char* end = nullptr;
  const double value = std::strtod(text, &end);
  if (*end || !(value > 0 && value <= most))
    throw InputError({variable, 0, 0}, fmt::format("'{}' is not a number above 0", text),
                     fmt::format("unset it, which means {}, or set it to a number", usual));
  return value;
}

// A compiler may repeat one message a million times.
std::string shown(const os::ProcessResult& result) {
  if (result.bytes <= result.beginning.size() + result.end.size())
    return result.beginning + result.end;
  return result.beginning + "\n[... " + human_bytes(static_cast<double>(result.bytes)) +
         " in all ...]\n" + result.end;
}

// The reason why the program stopped, with its remedy; "" if that is not known. Only the program
// itself can know that it got no memory: compilers and interpreters then use one of these words.
std::string limit_met(const os::ProcessResult& result, const os::ProcessLimits& limits) {
  if (result.ended == os::Ended::too_late)
    return fmt::format("\ndid not end within {} s and was stopped; FRICTAB_COMPILE_SECONDS=N in "
                       "the environment allows N s",
                       limits.time.count());
  for (const char* word : {"memory", "bad_alloc"})
    if (result.beginning.find(word) != std::string::npos ||
        result.end.find(word) != std::string::npos)
      return fmt::format(
          "\nmay use {} of memory; FRICTAB_COMPILE_GIB=N in the environment allows N GiB",
          human_bytes(static_cast<double>(limits.memory_bytes)));
  return "";
}

} // namespace

os::ProcessLimits usual_limits() {
  const double seconds =
      number_in("FRICTAB_COMPILE_SECONDS", static_cast<double>(usual_time.count()), most_seconds);
  const double GiB = number_in("FRICTAB_COMPILE_GIB", usual_GiB, most_GiB);
  return {std::chrono::seconds(static_cast<long>(std::ceil(seconds))),
          static_cast<std::uint64_t>(GiB * 0x1p30)};
}

bool have_program(const std::string& name) {
  if (name.empty()) return true;
  if (name.find('/') != std::string::npos) return os::may_run(name);
  return !os::on_path(name).empty();
}

std::string run_program(const std::vector<std::string>& command, const fs::path& directory,
                        const os::ProcessLimits& limits) {
  const os::ProcessResult result = os::run_process(command, directory, limits);
  if (result.ended == os::Ended::well) return shown(result);
  throw std::runtime_error(join(command, " ") + limit_met(result, limits) + "\n" + shown(result));
}

fs::path temporary_place() {
  const char* const set = std::getenv("TMPDIR");
  return set && *set ? fs::absolute(set) : "/tmp";
}

// Removes twice, because other threads may still write to the tree during an interruption.
static void remove_tree(const fs::path& path) noexcept {
  std::error_code ignored;
  for (int time = 0; time < 2; ++time)
    fs::remove_all(path, ignored);
}

TemporaryDirectory::TemporaryDirectory() {
  const fs::path place = temporary_place();
  std::error_code error;
  path_ = os::make_unique_directory(place / "frictab-", error);
  if (error)
    throw InputError({"TMPDIR", 0, 0},
                     fmt::format("no temporary directory can be made in {}: {}", place.string(),
                                 error.message()),
                     "set TMPDIR to a directory that can be written; unset, it is /tmp");
  when_interrupted_.emplace([path = path_] { remove_tree(path); });
}

TemporaryDirectory::~TemporaryDirectory() {
  remove_tree(path_);
}

} // namespace frictab
