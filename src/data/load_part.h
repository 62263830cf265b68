// One file, or some experiments of it, on the way to a campaign; and several as one.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "data/file_list.h"
#include "data/part.h"
#include "data/test_table.h"

namespace frictab::data {

// What is brought to every file from elsewhere.
struct Beside {
  std::optional<TestTable> tests;
  std::optional<Dataset> second; // of data.join
};

// Reads data.tests and data.join; takes out of the options what stands in the table of tests.
Beside load_beside(DataOptions& options);

// Where a file lies, and what a message calls it where its rows find no room.
std::filesystem::path path_of(const FilePlan& plan);
std::string reading_words(const FilePlan& plan);

// A whole file: mapped, cut into experiments, computed, left out and checked. What is wrong is in
// Part::faults.
Part load_part(const FilePlan& plan, const Beside& beside);
// The same of rows that are read already, `raw`: of some experiments of the file.
Part load_part(io::CsvTable&& raw, const FilePlan& plan, const Beside& beside);

// The campaign that these files make.
Dataset load_all(const std::vector<std::string>& named, const DataOptions& options,
                 const std::function<Part(const FilePlan&)>& load);

// Says what all files together leave: clocks, tests that stand beside the data and are in none of
// them; takes the fingerprint. Throws InputError where data.join leaves no row.
void complete(Dataset& all, const DataOptions& options, const Beside& beside);

// The faults of each file by line; those that several files have alike, of the first.
void throw_faults(const std::vector<FaultList>& of_files);

} // namespace frictab::data
