// Writes a command's files into a staging directory beside the target and renames them at the end.
#include "io/atomic_file.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>
#include <unistd.h>

#include "core/error.h"

namespace frictab::io {

namespace fs = std::filesystem;

namespace {

const std::string staging_prefix = ".frictab-";

// Staging directories of runs that were killed.
void remove_abandoned(const fs::path& directory) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(directory, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind(staging_prefix, 0) != 0) continue;
    const long pid = std::atol(name.c_str() + staging_prefix.size());
    if (pid > 0 && ::kill(static_cast<pid_t>(pid), 0) != 0 && errno == ESRCH)
      fs::remove_all(entry.path(), ignored);
  }
}

} // namespace

OutputFiles::OutputFiles(fs::path directory)
    : directory_(std::move(directory)),
      staging_(directory_ / fmt::format("{}{}", staging_prefix, ::getpid())) {
  created_ = !fs::exists(directory_);
  remove_abandoned(directory_);
  std::error_code error;
  fs::create_directories(staging_, error);
  if (error)
    throw InputError({directory_.string(), 0, 0}, "cannot write here: " + error.message(),
                     "choose another directory with -o DIR");
}

OutputFiles::~OutputFiles() {
  std::error_code ignored;
  fs::remove_all(staging_, ignored);
  if (created_) fs::remove(directory_, ignored); // only where it is empty
}

void OutputFiles::write(const std::string& path, std::string_view content) {
  const fs::path file = stage(path);
  std::ofstream out(file, std::ios::binary);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  out.close();
  if (!out) throw std::runtime_error("cannot write " + (directory_ / path).string());
}

fs::path OutputFiles::stage(const std::string& path) {
  if (std::find(paths_.begin(), paths_.end(), path) == paths_.end()) paths_.push_back(path);
  fs::path file = staging_ / path;
  fs::create_directories(file.parent_path());
  return file;
}

void OutputFiles::adopt(const std::string& path, fs::path file) {
  paths_.push_back(path);
  adopted_[path] = std::move(file);
}

void OutputFiles::remove_old(const std::string& path) {
  old_.push_back(path);
}

void OutputFiles::commit() {
  for (const std::string& path : paths_) {
    const fs::path target = directory_ / path;
    fs::create_directories(target.parent_path());
    const auto adopted = adopted_.find(path);
    fs::rename(adopted == adopted_.end() ? staging_ / path : adopted->second, target);
  }
  for (const std::string& path : old_) {
    if (std::find(paths_.begin(), paths_.end(), path) != paths_.end()) continue;
    std::error_code ignored; // a directory that is not empty stays
    fs::path at = path;
    for (fs::remove(directory_ / at, ignored); at.has_parent_path();) {
      at = at.parent_path();
      fs::remove(directory_ / at, ignored);
    }
  }
  fs::remove_all(staging_);
  adopted_.clear();
  created_ = false;
}

bool OutputFiles::would_change() const {
  return std::any_of(paths_.begin(), paths_.end(), [&](const std::string& path) {
    const fs::path target = directory_ / path;
    return fs::exists(target) && read_file(target) != read_file(staging_ / path);
  });
}

std::vector<std::string> OutputFiles::paths() const {
  std::vector<std::string> sorted = paths_;
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

std::string read_file(const fs::path& file) {
  std::error_code error;
  if (fs::is_directory(file, error))
    throw InputError({file.string(), 0, 0}, "is a directory, a file is needed");
  std::ifstream in(file, std::ios::binary);
  if (!in)
    throw InputError({file.string(), 0, 0}, "cannot be read",
                     fs::exists(file, error) ? "check its permissions" : "there is no such file");
  std::string text; // in large pieces: character by character is ten times slower
  std::size_t size = 0;
  do {
    text.resize(std::max<std::size_t>(
        2 * size, fs::is_regular_file(file, error) ? fs::file_size(file, error) + 1 : 65536));
    in.read(text.data() + size, static_cast<std::streamsize>(text.size() - size));
    size += static_cast<std::size_t>(in.gcount());
  } while (in);
  text.resize(size);
  return text;
}

} // namespace frictab::io
