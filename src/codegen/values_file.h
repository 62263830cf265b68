// Large tables: the values lie in a file beside the source, which the routine reads once. For
// millions of numbers in a source a compiler needs minutes and gigabytes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "codegen/exporter.h"
#include "core/template.h"

namespace frictab::codegen {

// 8-byte IEEE 754 numbers, lowest byte first, in the order of the table (last axis fastest), no
// header: numpy.fromfile(name, "<f8"). The source knows how many, and their CRC-32.
inline constexpr const char* values_file_name = "frictab_values.bin";

// A routine holds them in memory, once per process: 381 MiB.
inline constexpr std::size_t most_filed_values = 50000000;

// The option of every target that can read the file: "auto" (where the source would hold more than
// most_baked_numbers), "source", "file", "file_windows": threads wait for the one that reads it by
// what their system has. (C asks its compiler which one that is.)
ExportOption values_option();
bool values_for_windows(const ExportRequest& request);

// Whether this request's values go to a file. Never those of the direct form, or of a table
// without axes, which has one.
bool values_in_file(const ExportRequest& request);

// check_table, and that source and memory hold what the request makes. Throws InputError.
void check_request(const ExportRequest& request);

// The last of these for targets and options of a job, of sizes alone: `table` may be a description.
void check_request_size(const table::Table& table, const std::vector<const Exporter*>& targets,
                        const std::map<std::string, std::string>& options);

// Adds the file to the bundle where the request makes one.
void add_values_file(SourceBundle& files, const ExportRequest& request);

// What a recipe says of the file of a bundle.
nlohmann::ordered_json values_file_json(const std::string& bytes);

// What the template of the code that reads the file needs: file, n_values, n_bytes.
void add_values_file(TemplateValues& values, const std::vector<double>& numbers);

// The CRC-32 of the numbers' bytes, as in zip and zlib.
std::uint32_t values_crc32(const std::vector<double>& numbers);

// A line for the head of a source; none where the source holds the values. `solver`: what tells
// where the job lies besides the environment, "vgetoutdir"; may be empty.
std::vector<std::string> values_file_lines(const ExportRequest& request, const std::string& solver);

} // namespace frictab::codegen
