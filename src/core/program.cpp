// Messages of programs that fail, and working directories.
#include "core/program.h"

#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>

#include "core/error.h"
#include "core/os/files.h"
#include "core/os/process.h"
#include "core/text.h"

namespace frictab {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t shown_at_each_end = 4000;

// A compiler may repeat one message a million times.
std::string beginning_and_end(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string text(2 * shown_at_each_end + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (text.size() <= 2 * shown_at_each_end) return text;
  in.clear();
  in.seekg(-static_cast<std::streamoff>(shown_at_each_end), std::ios::end);
  std::string end(shown_at_each_end, '\0');
  in.read(end.data(), static_cast<std::streamsize>(end.size()));
  std::error_code ignored;
  const auto size = static_cast<double>(fs::file_size(file, ignored));
  return text.substr(0, shown_at_each_end) + "\n[... " + human_bytes(size) + " in all ...]\n" + end;
}

} // namespace

bool have_program(const std::string& name) {
  if (name.empty()) return true;
  if (name.find('/') != std::string::npos) return os::may_run(name);
  return !os::on_path(name).empty();
}

void run_program(const std::vector<std::string>& command, const fs::path& log,
                 std::chrono::seconds patience) {
  const os::Ended ended = os::run_process(command, log, patience);
  if (ended == os::Ended::well) return;
  const std::string late =
      fmt::format("\ndid not end within {} s and was stopped", patience.count());
  throw std::runtime_error(join(command, " ") + (ended == os::Ended::too_late ? late : "") + "\n" +
                           beginning_and_end(log));
}

fs::path temporary_place() {
  const char* const said = std::getenv("TMPDIR");
  return said && *said ? said : "/tmp";
}

namespace {

// Removes twice, because other threads may still write to the tree during an interruption.
void remove_tree(const fs::path& path) noexcept {
  std::error_code ignored;
  for (int time = 0; time < 2; ++time)
    fs::remove_all(path, ignored);
}

} // namespace

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
