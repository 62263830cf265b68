// Which files a job names, and how each of them is read: globs and folders become names, and
// [[data.files]] says what is special about some of them.
#pragma once

#include <string>
#include <vector>

#include "data/options.h"

namespace frictab::data {

// The files behind names, globs (* ? [...]) and folders, relative to `base`, each once, those of a
// glob or folder by name. A name that is none of them stays, and is told when it is read. Throws
// InputError at `place` where a glob or folder holds no file.
std::vector<std::string> find_files(const std::vector<std::string>& named, const std::string& base,
                                    const Place& place);

// One file and how it is read.
struct FilePlan {
  std::string file;    // as named
  std::string label;   // its experiment's, where no column says more
  DataOptions options; // with what the first rule that matches it says instead
};

struct FilePlans {
  std::vector<FilePlan> files;
  std::vector<std::string> notes; // what each rule changed
};

// Labels are the files' names without folder and extension; with their folder where two are alike,
// with all folders where these are as well. Named groups of `from_name` become columns: of numbers
// where every file's is one. Throws InputError where a name does not fit the pattern of its rule.
FilePlans plan_files(const std::vector<std::string>& files, const DataOptions& options);

// Throws InputError where a rule is the first match of none of these files.
void check_rules(const std::vector<std::string>& files, const DataOptions& options);

} // namespace frictab::data
