// Waits for the lock, and names its owner.
#include "io/directory_lock.h"

#include <chrono>
#include <ctime>
#include <thread>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "core/error.h"
#include "core/os/machine.h"

namespace frictab::io {

namespace {

constexpr std::chrono::seconds patience{5};
constexpr std::chrono::milliseconds pause{50};

std::string me() {
  return fmt::format("process {} on {} since {:%Y-%m-%d %H:%M:%S}", os::process_id(),
                     os::host_name(), fmt::localtime(std::time(nullptr)));
}

// First line of the text that the lock's owner wrote.
std::string holder(const os::LockFile& file) {
  std::string line = file.text();
  line = line.substr(0, line.find('\n'));
  for (char& c : line)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
  return line.empty() ? "another process" : line;
}

} // namespace

void cannot_write_here(const std::filesystem::path& directory, const std::string& why) {
  throw InputError({directory.string(), 0, 0}, "cannot write here: " + why,
                   "choose another directory with -o DIR");
}

// False if no lock is available.
bool DirectoryLock::lock(const std::filesystem::path& directory, Wish wish) {
  using Answer = os::LockFile::Answer;
  const auto end = std::chrono::steady_clock::now() + patience;
  while (true) {
    std::error_code error;
    const Answer answer = file_.try_to_lock(error);
    if (error && wish == Wish::must) cannot_write_here(directory, error.message());
    if (answer != Answer::taken || wish == Wish::if_free) return answer == Answer::locked;
    if (std::chrono::steady_clock::now() > end)
      throw InputError({directory.string(), 0, 0},
                       "another frictab is writing here: " + holder(file_),
                       "wait until it has finished, or choose another directory with -o DIR");
    std::this_thread::sleep_for(pause);
  }
}

DirectoryLock::DirectoryLock(const std::filesystem::path& directory, Wish wish)
    : file_(directory / ".frictab.lock"), locked_(lock(directory, wish)) {
  if (!locked_) return;
  when_interrupted_.emplace([file = directory / ".frictab.lock"] {
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
  });
  file_.write(me() + "\n");
}

} // namespace frictab::io
