// The files of a job and how each of them is read: globs and folders are expanded to names, and
// [[data.files]] gives the settings of some of them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "data/options.h"

namespace frictab::data {

// Expands names, globs (* ? [...]) and folders, relative to `base`, into files, each listed once;
// files of a glob or folder are sorted by name. A name that matches nothing is kept, and opening it
// reports the error. Throws InputError at `place` if a glob or folder contains no file.
std::vector<std::string> find_files(const std::vector<std::string>& named, const std::string& base,
                                    const Place& place);

// Adds a fault at `place`, or at the name where that is of no job file, for a file that is not
// there, with the nearest name in its folder, and for a glob or folder that holds no file. `key`:
// that of the job.
void check_is_there(const std::string& key, const std::string& name, const std::string& base,
                    const Place& place, FaultList& faults);

// One file, or one sheet of a workbook, and how it is read.
struct FilePlan {
  std::string file;  // as named
  std::string name;  // in messages and for from_name: the file, "tests.xlsx/T01" for a sheet
  std::string label; // label of its experiment unless a column gives one
  Reading options;   // with the overrides of the first rule that matches the file
};

std::filesystem::path path_of(const FilePlan& plan);

struct FilePlans {
  std::vector<FilePlan> files;
  std::vector<std::string> notes; // changes made by each rule
};

// A plan per file, and per sheet of a workbook that is read (data/workbooks.h), in the order of the
// files. Labels are the sheets' names, or the files' names without folder and extension; with their
// folder if two are equal, with all folders if these are equal too. Named groups of `from_name`
// become columns, numeric if the group is a number in every file. Throws InputError if a name does
// not match the pattern of its rule, and for a workbook that cannot be read.
FilePlans plan_files(const std::vector<std::string>& files, const Reading& options);

std::vector<std::string> names_of(const FilePlans& plans);

// Applies the dialect of the rule that matches the table of tests by its own name, without signs of
// a pattern, unless the file is among the data files too.
void take_dialect_of_tests(DataOptions& options);

// Throws InputError for a rule that is not the first match of any file, nor that of the table of
// tests.
void check_rules(const std::vector<std::string>& files, const DataOptions& options);

} // namespace frictab::data
