// HDF5 files read by the library itself, which can crash or hang on damaged ones; meant for a child
// process (io/isolated.h) that returns plain data.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/os/isolated.h"
#include "io/hdf5.h"

namespace frictab::io {

using Hdf5Attributes = std::map<std::string, std::variant<std::string, double>>;

struct Hdf5Dataset {
  Hdf5Attributes attributes;
  std::vector<std::size_t> shape;
  std::vector<std::optional<std::string>> scales; // per axis
  Hdf5Layout layout;
  bool is_text = false;
  std::string other_type; // description of any type other than numbers and texts; else empty
  bool in_memory = false; // its values; else read on request
  std::vector<double> values;
  std::vector<std::string> texts;
  std::string fault, hint; // reason why neither can be read; else empty

  std::size_t count() const; // number of values according to the shape
};

struct Hdf5Contents {
  std::map<std::string, Hdf5Dataset> datasets; // by path from the root
  // Attributes of "/" and of the root's groups, by name.
  std::map<std::string, Hdf5Attributes> groups;
  std::map<std::string, std::vector<Hdf5Other>> others; // by the same names
  std::string fault, hint;                              // reason why the file cannot be read
};

// Writers that run in the child.
void scan_hdf5(const std::filesystem::path& file, os::ByteSink& out);
// Writes the values of one dataset, at most `most` at a time.
void scan_values(const std::filesystem::path& file, const std::string& dataset, std::size_t most,
                 os::ByteSink& out);
void scan_slices(const std::filesystem::path& file, std::span<const Hdf5Slice> wanted,
                 os::ByteSink& out);

// Readers that run in the parent. They return false if the bytes cannot come from a scan of a file
// of `file_bytes`.
bool take_contents(os::ByteSource& in, std::uint64_t file_bytes, Hdf5Contents& contents);
// Calls take(first, values) for the output of scan_values; if that is an error, sets `fault` and
// `hint`.
bool take_values(os::ByteSource& in, std::size_t count, std::size_t most,
                 const std::function<void(std::size_t, std::span<const double>)>& take,
                 std::string& fault, std::string& hint);
// Reads the output of scan_slices for slices within datasets of `file_bytes`.
bool take_slices(os::ByteSource& in, std::uint64_t file_bytes, std::span<const Hdf5Slice> wanted,
                 std::vector<Hdf5Values>& slices, std::string& fault, std::string& hint);

} // namespace frictab::io
