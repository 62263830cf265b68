// HDF5 files read by the library itself, which can crash or hang on damaged ones: for a child
// process (io/isolated.h), which hands over plain data.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "io/hdf5.h"
#include "io/isolated.h"

namespace frictab::io {

using Hdf5Attributes = std::map<std::string, std::variant<std::string, double>>;

struct Hdf5Dataset {
  Hdf5Attributes attributes;
  std::vector<std::size_t> shape;
  std::vector<std::optional<std::string>> scales; // per axis
  Hdf5Layout layout;
  bool is_text = false;
  std::string other_type; // not empty: neither numbers nor texts, but this
  bool held =
      false; // its values are here; else they are too many, and read where they are asked for
  std::vector<double> values;
  std::vector<std::string> texts;
  std::string fault, hint; // why neither can be read; empty: they can

  std::size_t count() const; // of values, as the shape says
};

struct Hdf5Contents {
  std::map<std::string, Hdf5Dataset> datasets;          // by path from the root
  std::map<std::string, Hdf5Attributes> groups;         // "/" and those of the root, by name
  std::map<std::string, std::vector<Hdf5Other>> others; // by the same names
  std::string fault, hint;                              // why the file cannot be read
};

// In the child.
void scan_hdf5(const std::filesystem::path& file, ByteSink& out);
// Values of one dataset, at most `most` at a time.
void scan_values(const std::filesystem::path& file, const std::string& dataset, std::size_t most,
                 ByteSink& out);
void scan_slices(const std::filesystem::path& file, std::span<const Hdf5Slice> wanted,
                 ByteSink& out);

// In the parent: false where this is not what a scan of a file of `file_bytes` writes.
bool take_contents(ByteSource& in, std::uint64_t file_bytes, Hdf5Contents& contents);
// Calls take(first, values) for what scan_values writes; `fault` and `hint` where that is one.
bool take_values(ByteSource& in, std::size_t count, std::size_t most,
                 const std::function<void(std::size_t, std::span<const double>)>& take,
                 std::string& fault, std::string& hint);
// What scan_slices writes of slices that lie within datasets of `file_bytes`.
bool take_slices(ByteSource& in, std::uint64_t file_bytes, std::span<const Hdf5Slice> wanted,
                 std::vector<Hdf5Values>& slices, std::string& fault, std::string& hint);

} // namespace frictab::io
