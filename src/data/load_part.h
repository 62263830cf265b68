// One file, or some experiments of it, as part of a campaign; and several parts combined.
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

// Data from elsewhere that are added to every file.
struct Beside {
  std::optional<TestTable> tests;
  std::optional<Dataset> second; // of data.join
};

// Reads data.tests and data.join; removes from the options the columns that the table of tests has.
Beside load_beside(Reading& options);

// Description of a file in the message for exhausted memory.
std::string reading_words(const FilePlan& plan);

// Reads a whole file: maps, cuts into experiments, computes, leaves out and checks. Faults are in
// Part::faults.
Part load_part(const FilePlan& plan, const Beside& beside);
// The same for rows that are not tests, without what is inferred about tests: signs, phases, eq. 1.
Part load_plain_part(const FilePlan& plan);
// Processes rows that are already read, `raw`: some experiments of the file.
Part load_part(io::CsvTable&& raw, const FilePlan& plan, const Beside& beside);

// Combines these files into a campaign.
Dataset load_all(const std::vector<std::string>& named, const Reading& options,
                 const std::function<Part(const FilePlan&)>& load);

// Completes a campaign with results that need all files: clocks, and tests of data.tests or
// data.join that no file has; computes the fingerprint. Throws InputError if data.join leaves no
// row.
void complete(Dataset& all, const ReadRequest& options, const Beside& beside);

// Throws the faults of each file by line; faults that several files share are reported for the
// first one.
void throw_faults(const std::vector<FaultList>& of_files);

} // namespace frictab::data
