// Operations on files that std::filesystem does not offer.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

namespace frictab::os {

// True if this process may do so; to run a directory is to reach its files.
bool may_write(const std::filesystem::path& path);
bool may_run(const std::filesystem::path& path);

// Flushes a file's content, or the entries of a directory, to disk; does nothing where the file
// system cannot. Throws std::system_error: cannot open or write `path`, and why.
void flush_to_disk(const std::filesystem::path& path);

// Makes a directory whose name is `beginning` and six characters that no other one has. Returns its
// path; sets `error` if it cannot be made.
std::filesystem::path make_unique_directory(const std::filesystem::path& beginning,
                                            std::error_code& error);

// Paths of what is in a directory, sorted; none if there is no such directory. Throws
// std::system_error if it cannot be listed.
std::vector<std::filesystem::path> entries_of(const std::filesystem::path& directory);

// Globs, where * ? [...] stand for no '/' and a backslash takes a sign's meaning away: the paths
// that match, in any order, and whether a name does. Throws std::system_error if a directory on the
// way cannot be listed.
std::vector<std::string> paths_like(const std::string& glob);
bool is_like(const std::string& name, const std::string& glob);

} // namespace frictab::os
