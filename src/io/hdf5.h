// HDF5 files behind two small classes (C API inside). HDF5's own error printing is off; what fails
// is said by exceptions with the file's name.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace frictab {

// Throws std::runtime_error where the disk or the library refuses. No times are stored: the same
// content gives the same bytes.
class Hdf5Writer {
public:
  explicit Hdf5Writer(const std::filesystem::path& file);
  ~Hdf5Writer();
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  // Row-major doubles; an empty shape is a scalar. compress: deflate level 0..9, in chunks, with
  // Fletcher32 checksums.
  void dataset(const std::string& name, std::span<const std::size_t> shape,
               std::span<const double> values, int compress = 0);
  void dataset(const std::string& name, std::span<const std::string> values); // 1-D, UTF-8
  // object: a dataset's name, or "/" for the root.
  void attribute(const std::string& object, const std::string& name, const std::string& text);
  void attribute(const std::string& object, const std::string& name, double value);
  void attribute(const std::string& object, const std::string& name,
                 std::span<const double> values);
  // Makes `scale` a dimension scale (netCDF-4 coordinate) and ties it to one axis of `dataset`.
  void dimension_scale(const std::string& dataset, std::size_t axis, const std::string& scale);
  void close(); // flushes; throws where that fails

private:
  struct Data;
  std::unique_ptr<Data> data_;
};

// Throws InputError where the file is no HDF5 file, is truncated, or lacks what is asked for.
class Hdf5Reader {
public:
  // `named` is how messages call the file.
  Hdf5Reader(const std::filesystem::path& file, std::string named);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  std::vector<std::string> datasets() const; // of the root group, sorted by name
  bool has(const std::string& dataset) const;
  bool is_text(const std::string& dataset) const;
  std::vector<std::size_t> shape(const std::string& dataset) const;
  std::vector<double> values(const std::string& dataset) const;     // any numeric type
  std::vector<std::string> texts(const std::string& dataset) const; // fixed or variable length
  // Names of all attributes of an object ("/" = root) that hold one text or one number.
  std::vector<std::string> attributes(const std::string& object) const;
  std::optional<std::string> text_attribute(const std::string& object,
                                            const std::string& name) const;
  std::optional<double> number_attribute(const std::string& object, const std::string& name) const;
  // Name of the dimension scale of one axis; nullopt where there is none.
  std::optional<std::string> scale(const std::string& dataset, std::size_t axis) const;

private:
  struct Data;
  struct Unchecked {};
  Hdf5Reader(const std::filesystem::path& file, std::string named, Unchecked);
  static void read_all(const std::filesystem::path& file);
  static bool survives_reading(const std::filesystem::path& file);
  std::unique_ptr<Data> data_;
};

// True where the file starts like HDF5.
bool looks_like_hdf5(const std::filesystem::path& file);

} // namespace frictab
