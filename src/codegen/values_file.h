// Large tables: the values are in a file next to the source, which the routine reads once. A
// compiler needs minutes and gigabytes for millions of numbers in a source.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "codegen/exporter.h"
#include "core/template.h"

namespace frictab::codegen {

// Name of the file: 8-byte IEEE 754 numbers, lowest byte first, in the order of the table (last
// axis fastest), without a header, as numpy.fromfile(name, "<f8") reads. The source has their count
// and CRC-32.
inline constexpr const char* values_file_name = "frictab_values.bin";

// Largest count of values. A routine has them in memory once per process: 381 MiB.
inline constexpr std::size_t most_filed_values = 50000000;

// Option of every target that can read the file: "auto" (a file if the source would have more than
// most_baked_numbers), "source", "file", "file_windows". The last two differ in the lock
// by which threads wait for the one that reads. (C asks its compiler for the system.)
ExportOption values_option();
bool values_for_windows(const ExportRequest& request);

// True if this request's values go to a file; never for the direct form, nor for a table without
// axes, which has a single value.
bool values_in_file(const ExportRequest& request);

// Runs check_table, and checks that source and memory can hold the result of the request. Throws
// InputError.
void check_request(const ExportRequest& request);

// Runs the second check for targets and options of a job, by sizes only: `table` may be a
// description.
void check_request_size(const table::Table& table, const std::vector<const Exporter*>& targets,
                        const std::map<std::string, std::string>& options);

// Adds the file to the bundle if the request makes one.
void add_values_file(SourceBundle& files, const ExportRequest& request);

// Describes the bundle's file for the recipe.
nlohmann::ordered_json values_file_json(const std::string& bytes);

// Adds the values for the template of the code that reads the file: file, n_values, n_bytes.
void add_values_file(TemplateValues& values, const std::vector<double>& numbers);

// Returns the CRC-32 of the numbers' bytes, as in zip and zlib.
std::uint32_t values_crc32(const std::vector<double>& numbers);

// Returns lines for the head of a source; none if the source has the values. `solver`: routine that
// gives the job's directory in addition to the environment, "vgetoutdir"; may be empty.
std::vector<std::string> values_file_lines(const ExportRequest& request, const std::string& solver);

} // namespace frictab::codegen
