// Writes a command's files into a staging directory inside the target and renames them at the end.
#include "io/atomic_file.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/os/files.h"
#include "io/file_streams.h"

namespace frictab::io {

namespace fs = std::filesystem;

namespace {

const std::string staging_prefix = ".frictab-", one_file_prefix = ".frictab-file-";
// Names inside a staging directory.
const std::string new_files = "new", old_files = "old", journal_name = "journal",
                  keep_name = "keep";

void rename_file(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (error)
    throw std::runtime_error(fmt::format("cannot write {}: {}", to.string(), error.message()));
  if (fs::exists(fs::symlink_status(from, error)))
    throw std::runtime_error("the disk has not moved a file to " + to.string());
}

// Requires a relative path inside the directory; no folder on its way may be a symbolic link.
void check_inside(const fs::path& directory, const std::string& path) {
  const fs::path given(path);
  bool inside = !path.empty() && given.is_relative();
  for (const fs::path& part : given)
    inside = inside && part != ".." && part != "." && !part.empty();
  const bool plain =
      std::none_of(path.begin(), path.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; });
  if (!inside || !plain)
    throw InputError({directory.string(), 0, 0}, "no file is written to such a name here: " + path,
                     "names of laws and targets have letters, digits, '_', '.' and '-'");
  fs::path at = directory;
  for (const fs::path& part : given.parent_path()) {
    at /= part;
    std::error_code ignored;
    if (fs::is_symlink(fs::symlink_status(at, ignored)))
      throw InputError({at.string(), 0, 0}, "is a symbolic link, and nothing is written through it",
                       "replace it by a directory, or choose another one with -o DIR");
  }
}

// ---- the renames of a commit ----

struct Rename {
  std::string from, to; // both relative to the directory
};

// The ordered steps of a commit; written as JSON it is the journal.
struct Journal {
  std::vector<Rename> renames;     // into place
  std::vector<std::string> remove; // files of an earlier run

  std::string text() const {
    nlohmann::json json = {{"renames", nlohmann::json::array()}, {"remove", remove}};
    for (const Rename& one : renames)
      json["renames"].push_back({one.from, one.to});
    return json.dump();
  }
};

std::optional<Journal> read_journal(const fs::path& file, const fs::path& directory) {
  if (!fs::exists(file)) return std::nullopt;
  const std::string text = read_file(file);
  try {
    const nlohmann::json json = nlohmann::json::parse(text);
    Journal journal;
    for (const nlohmann::json& one : json.at("renames"))
      journal.renames.push_back({one.at(0), one.at(1)});
    journal.remove = json.at("remove");
    for (const Rename& one : journal.renames) {
      check_inside(directory, one.from);
      check_inside(directory, one.to);
    }
    for (const std::string& path : journal.remove)
      check_inside(directory, path);
    return journal;
  } catch (const std::exception&) { // not written by a commit
    return std::nullopt;
  }
}

void write_journal(const fs::path& staging, const Journal& journal) {
  const fs::path draft = staging / (journal_name + ".draft");
  write_file(draft, journal.text());
  os::flush_to_disk(draft);
  rename_file(draft, staging / journal_name);
  os::flush_to_disk(staging);
}

// Keeps the existing file until the commit is complete.
void keep_old(const fs::path& target, const fs::path& backup) {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(target, error))) return;
  fs::create_directories(backup.parent_path());
  fs::create_hard_link(target, backup, error);
  if (error) fs::copy_file(target, backup); // file system without hard links
}

// Removes directories that became empty when this file was removed.
void remove_empty(const fs::path& directory, fs::path at) {
  std::error_code ignored;
  for (at = at.parent_path(); !at.empty(); at = at.parent_path())
    if (!fs::remove(directory / at, ignored)) return;
}

// Executes the renames of a journal, all or none.
class Commit {
public:
  Commit(const fs::path& directory, const fs::path& staging, const Journal& journal)
      : directory_(directory), old_(staging / old_files), journal_(journal) {}

  void run() {
    try {
      for (const Rename& one : journal_.renames) {
        keep_old(directory_ / one.to, old_ / one.to);
        rename_file(directory_ / one.from, directory_ / one.to);
        ++renamed_;
      }
      for (const std::string& path : journal_.remove) {
        if (fs::exists(fs::symlink_status(directory_ / path))) {
          fs::create_directories((old_ / path).parent_path());
          rename_file(directory_ / path, old_ / path);
        }
        ++removed_;
      }
    } catch (...) {
      take_back();
      taken_back_ = true;
      throw;
    }
  }
  bool taken_back() const { return taken_back_; }

  // Completes the commit of a process that died halfway.
  void finish() {
    for (const Rename& one : journal_.renames)
      if (fs::exists(directory_ / one.from)) {
        fs::create_directories((directory_ / one.to).parent_path());
        rename_file(directory_ / one.from, directory_ / one.to);
      }
    for (const std::string& path : journal_.remove)
      if (fs::exists(fs::symlink_status(directory_ / path))) fs::remove(directory_ / path);
  }

  void tidy() const {
    std::error_code ignored;
    for (const Rename& one : journal_.renames)
      if (fs::is_directory((directory_ / one.to).parent_path(), ignored))
        os::flush_to_disk((directory_ / one.to).parent_path());
    for (const std::string& path : journal_.remove)
      remove_empty(directory_, path);
  }

private:
  void take_back() {
    for (; removed_ > 0; --removed_)
      if (const fs::path path = journal_.remove[removed_ - 1]; fs::exists(old_ / path))
        rename_file(old_ / path, directory_ / path);
    for (; renamed_ > 0; --renamed_) {
      const Rename& one = journal_.renames[renamed_ - 1];
      rename_file(directory_ / one.to, directory_ / one.from);
      if (fs::exists(old_ / one.to)) rename_file(old_ / one.to, directory_ / one.to);
    }
  }

  const fs::path& directory_;
  fs::path old_;
  const Journal& journal_;
  std::size_t renamed_ = 0, removed_ = 0;
  bool taken_back_ = false;
};

// ---- leftovers of earlier processes ----

bool is_older_than_a_day(const fs::path& path) {
  std::error_code ignored;
  return fs::file_time_type::clock::now() - fs::last_write_time(path, ignored) >
         std::chrono::hours(24);
}

std::vector<fs::path> staging_directories(const fs::path& directory) {
  std::error_code ignored;
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(directory, ignored))
    if (const std::string name = entry.path().filename().string();
        name.starts_with(staging_prefix) && name != kept_name &&
        fs::is_directory(entry.symlink_status(ignored)))
      found.push_back(entry.path());
  return found;
}

// Moves the staged files of an unfinished run to .frictab-kept if the run called keep(), replacing
// its contents; otherwise removes them.
void keep_or_remove(const fs::path& directory, const fs::path& staging) noexcept {
  std::error_code error;
  if (fs::exists(staging / keep_name, error)) {
    const fs::path kept = directory / kept_name;
    fs::remove_all(kept, error);
    fs::rename(staging / new_files, kept, error);
  }
  fs::remove_all(staging, error);
}

// Handles staging directories of dead processes and finishes their commits. A lock proves that they
// are dead; without a lock, directories younger than a day are left untouched.
void clear_abandoned(const fs::path& directory, bool locked) {
  std::error_code ignored;
  for (const fs::path& staging : staging_directories(directory)) {
    const bool one_file = staging.filename().string().starts_with(one_file_prefix);
    if ((one_file || !locked) && !is_older_than_a_day(staging)) continue;
    if (const auto journal = read_journal(staging / journal_name, directory)) {
      Commit commit(directory, staging, *journal);
      commit.finish();
      commit.tidy();
      fs::remove(staging / keep_name, ignored);
      fs::remove_all(directory / kept_name, ignored);
    }
    fs::remove(staging / journal_name, ignored);
    keep_or_remove(directory, staging);
  }
}

fs::path make_staging(const fs::path& directory, const std::string& prefix) {
  std::error_code error;
  const fs::path made = os::make_unique_directory(directory / prefix, error);
  if (error) cannot_write_here(directory, error.message());
  return made;
}

} // namespace

OutputFiles::OutputFiles(fs::path directory, Claim claim) : directory_(std::move(directory)) {
  std::error_code error;
  created_ = !fs::exists(directory_, error);
  fs::create_directories(directory_, error);
  if (error) cannot_write_here(directory_, error.message());
  if (created_)
    directory_when_interrupted_.emplace([this] {
      std::error_code ignored;
      fs::remove(directory_, ignored); // fails unless it is empty
    });
  if (claim == Claim::directory) {
    lock_.emplace(directory_);
    clear_abandoned(directory_, lock_->is_locked());
  }
  staging_ = make_staging(directory_, claim == Claim::directory ? staging_prefix : one_file_prefix);
  when_interrupted_.emplace([this] {
    abandon();
    abandon(); // other threads may have written in the meantime
  });
}

OutputFiles::~OutputFiles() {
  when_interrupted_.reset();
  abandon();
  lock_.reset();
  std::error_code ignored;
  if (created_) fs::remove(directory_, ignored); // fails unless it is empty
}

// Removes staged files; after commit() there are none.
void OutputFiles::abandon() noexcept {
  std::error_code ignored;
  if (fs::exists(staging_ / journal_name, ignored)) return; // the next writer finishes it
  keep_or_remove(directory_, staging_);
}

void OutputFiles::keep(const std::string& name, std::string_view record) {
  stage(name);
  const fs::path file = staging_ / new_files / name, draft = file.string() + ".draft";
  write_file(draft, record);
  rename_file(draft, file);
  write_file(staging_ / keep_name, "");
}

void OutputFiles::take_kept(const std::string& path) {
  const fs::path kept = directory_ / kept_name / path, file = stage(path);
  std::error_code error;
  fs::create_hard_link(kept, file, error);
  if (error) fs::copy_file(kept, file, fs::copy_options::overwrite_existing);
}

void OutputFiles::write(const std::string& path, std::string_view content) {
  const fs::path file = stage(path);
  std::error_code ignored;
  fs::remove(file, ignored); // may be a hard link to a kept file
  write_file(file, content);
}

fs::path OutputFiles::stage(const std::string& path) {
  check_inside(directory_, path);
  if (std::find(paths_.begin(), paths_.end(), path) == paths_.end()) paths_.push_back(path);
  fs::path file = staging_ / new_files / path;
  fs::create_directories(file.parent_path());
  return file;
}

fs::path OutputFiles::staged(const std::string& path) const {
  return staging_ / new_files / path;
}

void OutputFiles::remove_old(const std::string& path) {
  check_inside(directory_, path);
  old_.push_back(path);
}

void OutputFiles::commit() {
  Journal journal;
  for (const std::string& path : paths_) {
    const fs::path from = staged(path);
    os::flush_to_disk(from);
    journal.renames.push_back({from.lexically_relative(directory_).string(), path});
    fs::create_directories((directory_ / path).parent_path());
    if (fs::is_directory(directory_ / path))
      throw InputError({(directory_ / path).string(), 0, 0}, "is a directory, a file comes there",
                       "choose another directory with -o DIR");
  }
  for (const std::string& path : old_)
    if (std::find(paths_.begin(), paths_.end(), path) == paths_.end())
      journal.remove.push_back(path);
  const os::Uninterrupted whole;
  Commit commit(directory_, staging_, journal);
  write_journal(staging_, journal);
  try {
    commit.run();
  } catch (...) {
    // else the next writer finishes it
    if (commit.taken_back()) fs::remove(staging_ / journal_name);
    throw;
  }
  commit.tidy();
  fs::remove(staging_ / journal_name);
  fs::remove_all(staging_);
  if (lock_) fs::remove_all(directory_ / kept_name);
  created_ = false;
}

bool OutputFiles::would_change() const {
  return std::any_of(paths_.begin(), paths_.end(), [&](const std::string& path) {
    const fs::path target = directory_ / path;
    return fs::exists(target) && !are_equal(target, staged(path));
  });
}

std::vector<std::string> OutputFiles::paths() const {
  std::vector<std::string> sorted = paths_;
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

void finish_interrupted(const fs::path& directory) {
  const std::vector<fs::path> found = staging_directories(directory);
  std::error_code ignored;
  if (std::none_of(found.begin(), found.end(), [&](const fs::path& staging) {
        return fs::exists(staging / journal_name, ignored);
      }))
    return;
  if (!os::may_write(directory))
    throw InputError({directory.string(), 0, 0},
                     "a command died while it put its results in place, and nothing can be written "
                     "here to finish that",
                     "let its owner run any frictab command on it, `frictab status JOB` say");
  const DirectoryLock lock(directory, DirectoryLock::Wish::if_free);
  if (lock.is_locked()) clear_abandoned(directory, true);
}

} // namespace frictab::io
