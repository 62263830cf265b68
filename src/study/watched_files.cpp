// Reads again only what was written in between.
#include "study/watched_files.h"

#include <stdexcept>

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "io/file_streams.h"

namespace frictab::study {

[[noreturn]] static void fail(const std::vector<std::string>& changed) {
  throw std::runtime_error(fmt::format("{} changed while the study ran, and a result would be of "
                                       "other data than its key says: run the study again",
                                       join(changed, ", ")));
}

std::uint64_t WatchedFiles::add(const std::filesystem::path& path, const std::string& named) {
  io::InputFile file(path, named); // takes the state first: what is written from here on is noticed
  all_.push_back({path, named, io::hash_of_file(file), file.state()});
  return all_.back().hash;
}

bool WatchedFiles::Watched::is_untouched() const {
  try {
    return io::InputFile(path, named).state() == state;
  } catch (const InputError&) { // removed
    return false;
  }
}

void WatchedFiles::check_bytes() {
  std::vector<std::string> changed;
  WatchedFiles now;
  for (const Watched& one : all_)
    try {
      if (one.is_untouched())
        now.all_.push_back(one);
      else if (now.add(one.path, one.named) != one.hash)
        changed.push_back(one.named);
    } catch (const InputError&) {
      changed.push_back(one.named);
    }
  if (!changed.empty()) fail(changed);
  all_ = std::move(now.all_);
}

void WatchedFiles::check_untouched() const {
  std::vector<std::string> changed;
  for (const Watched& one : all_)
    if (!one.is_untouched()) changed.push_back(one.named);
  if (!changed.empty()) fail(changed);
}

} // namespace frictab::study
