// TDMS files of LabVIEW, DIAdem and DAQmx. Source of the format: NI, "TDMS File Format Internal
// Structure" (ni.com, document 5696), and its DAQmx raw data indices.
#pragma once

#include <filesystem>
#include <string>

#include "io/column_groups.h"

namespace frictab::io {

// True if the file starts with the signature of a TDMS file or of its index.
bool looks_like_tdms(const std::filesystem::path& file);

// Reads the whole file: a channel is a member of its group, with its `unit_string` as the unit;
// properties of the file and of groups are single values. Integers, floating-point numbers,
// booleans, texts; time stamps as seconds since the first one of the channel. DAQmx raw data and
// NI_Scale properties of types Linear and Polynomial are converted to physical values; other scales
// and types make a channel that is not read (`other_type`). If the channels of a group share
// wf_start_offset and wf_increment and none is a time, a member `time` (s) is added. Of an
// incomplete last segment, as a crash leaves it, whole chunks are read, and a note counts the lost
// bytes. Throws InputError with the offset of the fault for damaged files.
ColumnGroups read_tdms(const std::filesystem::path& file, const std::string& named);

} // namespace frictab::io
