// MATLAB files of version 7.3, which are HDF5: a variable is a dataset with the attribute
// MATLAB_class, or a group of fields; cells and struct arrays are references to "/#refs#".
#include <algorithm>

#include <fmt/format.h>

#include "core/text.h"
#include "io/hdf5_guard.h"
#include "io/hdf5_handle.h"
#include "io/mat_value.h"

namespace frictab::io::mat73 {

using namespace hdf5;

namespace {

using Kind = MatValue::Kind;

std::string text_attribute(hid_t object, const char* name) {
  if (H5Aexists(object, name) <= 0) return "";
  const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  if (!attribute.ok()) return "";
  const Handle type(H5Aget_type(attribute), H5Tclose), space(H5Aget_space(attribute), H5Sclose);
  if (H5Tget_class(type) != H5T_STRING || H5Sget_simple_extent_npoints(space) != 1) return "";
  constexpr std::size_t longest = 1024;
  std::string text;
  if (H5Tis_variable_str(type) > 0) {
    char* raw = nullptr;
    if (H5Aread(attribute, type, &raw) >= 0 && raw) text = raw;
    H5free_memory(raw);
    return text;
  }
  if (H5Tget_size(type) > longest) return "";
  text.resize(H5Tget_size(type));
  if (H5Aread(attribute, type, text.data()) < 0) return "";
  text.erase(std::find(text.begin(), text.end(), '\0'), text.end());
  return text;
}

class Reader {
public:
  explicit Reader(const std::filesystem::path& file)
      : file_(H5Fopen(file.string().c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose),
        file_bytes_(std::filesystem::file_size(file)) {
    if (!file_.ok()) throw MatFault("HDF5, the form of version 7.3, cannot open it");
    try {
      check_in_itself(file_);
    } catch (const Elsewhere& found) {
      throw MatFault(found.what);
    }
  }

  std::vector<MatValue> variables() {
    std::vector<MatValue> all;
    for (const std::string& name : members(file_))
      if (!name.starts_with("#")) all.push_back(member(file_, name, 0)); // #refs#, #subsystem#
    return all;
  }

private:
  static std::vector<std::string> members(hid_t group) {
    std::vector<std::string> names;
    const auto visit = [](hid_t, const char* name, const H5L_info_t*, void* into) -> herr_t {
      static_cast<std::vector<std::string>*>(into)->push_back(name);
      return 0;
    };
    if (H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, visit, &names) < 0)
      throw MatFault("its list of variables cannot be read");
    return names;
  }

  MatValue member(hid_t in, const std::string& name, int depth) {
    const Handle object(H5Oopen(in, name.c_str(), H5P_DEFAULT), H5Oclose);
    if (!object.ok()) throw MatFault("the variable '" + name + "' cannot be opened");
    MatValue out = value(object, depth);
    out.name = to_utf8(name);
    return out;
  }

  MatValue value(hid_t object, int depth) {
    MatValue out;
    if (++values_ > file_bytes_) throw MatFault("its references never end");
    if (depth > deepest_nesting)
      out.other = too_deep;
    else if (H5Iget_type(object) == H5I_GROUP)
      read_group(object, depth, out);
    else if (H5Iget_type(object) == H5I_DATASET)
      read_dataset(object, depth, out);
    else
      out.other = "neither a dataset nor a group";
    return out;
  }

  // A struct; the fields of a struct array are references without a class.
  void read_group(hid_t group, int depth, MatValue& out) {
    if (H5Aexists(group, "MATLAB_sparse") > 0) {
      out.other = "a sparse matrix";
      return;
    }
    out.kind = Kind::structs;
    std::vector<MatValue> fields;
    bool all_lists = true;
    for (const std::string& name : members(group)) {
      fields.push_back(member(group, name, depth + 1));
      all_lists = all_lists && is_field_of_array(group, name);
    }
    if (!all_lists || fields.empty()) {
      out.structs.push_back(std::move(fields));
      return;
    }
    const std::size_t count = fields.front().elements.size();
    for (const MatValue& field : fields)
      if (field.elements.size() != count)
        throw MatFault("the fields of a struct array differ in length");
    out.structs.resize(count);
    for (MatValue& field : fields)
      for (std::size_t i = 0; i < count; ++i) {
        field.elements[i].name = field.name;
        out.structs[i].push_back(std::move(field.elements[i]));
      }
  }

  static bool is_field_of_array(hid_t group, const std::string& name) {
    const Handle object(H5Oopen(group, name.c_str(), H5P_DEFAULT), H5Oclose);
    if (H5Iget_type(object) != H5I_DATASET || !text_attribute(object, "MATLAB_class").empty())
      return false;
    const Handle type(H5Dget_type(object), H5Tclose);
    return H5Tget_class(type) == H5T_REFERENCE;
  }

  void read_dataset(hid_t set, int depth, MatValue& out) {
    const Handle type(H5Dget_type(set), H5Tclose);
    const H5T_class_t kind = H5Tget_class(type);
    const std::string name = text_attribute(set, "MATLAB_class");
    out.dims = dims_of(set);
    const std::size_t count = count_of(out.dims, file_bytes_);
    const bool is_empty = H5Aexists(set, "MATLAB_empty") > 0;
    const bool is_number = kind == H5T_INTEGER || kind == H5T_FLOAT || kind == H5T_ENUM;
    if (H5Aexists(set, "MATLAB_object_decode") > 0 && name != "function_handle")
      out.other = is_an_object;
    else if (name == "function_handle")
      out.other = "a function handle";
    else if (is_empty)
      read_empty(name, out);
    else if (kind == H5T_REFERENCE)
      read_references(set, count, depth, out);
    else if (kind == H5T_STRING)
      read_strings(set, type, count, out);
    else if (kind == H5T_COMPOUND)
      out.other = "complex numbers";
    else if (is_number && name == "char")
      read_characters(set, count, out);
    else if (is_number)
      read_numbers(set, count, out);
    else
      out.other = "values of class " + (name.empty() ? "that is not known" : name);
  }

  // MATLAB counts axes in the opposite order.
  static std::vector<std::size_t> dims_of(hid_t set) {
    const Handle space(H5Dget_space(set), H5Sclose);
    const int rank = H5Sget_simple_extent_ndims(space);
    if (rank < 0) throw MatFault("the size of a variable cannot be read");
    std::vector<hsize_t> dims(static_cast<std::size_t>(rank));
    if (rank > 0) H5Sget_simple_extent_dims(space, dims.data(), nullptr);
    if (H5Sget_simple_extent_type(space) == H5S_NULL) dims.assign(1, 0);
    std::vector<std::size_t> out(dims.rbegin(), dims.rend());
    while (out.size() < 2)
      out.push_back(1);
    return out;
  }

  static void read_empty(const std::string& name, MatValue& out) {
    out.kind = name == "char" ? Kind::texts : name == "cell" ? Kind::cells : Kind::numbers;
    if (name == "char") out.texts = {""};
    out.dims = {0, 0};
  }

  void read_references(hid_t set, std::size_t count, int depth, MatValue& out) {
    out.kind = Kind::cells;
    std::vector<hobj_ref_t> references(count);
    const Handle type(H5Dget_type(set), H5Tclose);
    if (H5Tequal(type, H5T_STD_REF_OBJ) <= 0) {
      out.kind = Kind::other;
      out.other = "references to parts of variables";
      return;
    }
    if (count > 0 &&
        H5Dread(set, H5T_STD_REF_OBJ, H5S_ALL, H5S_ALL, H5P_DEFAULT, references.data()) < 0)
      throw MatFault("the references of a cell array cannot be read");
    for (const hobj_ref_t& reference : references) {
      const Handle object(H5Rdereference2(set, H5P_DEFAULT, H5R_OBJECT, &reference), H5Oclose);
      if (!object.ok()) throw MatFault("a cell refers to nothing");
      out.elements.push_back(value(object, depth + 1));
    }
  }

  static void read_strings(hid_t set, hid_t type, std::size_t count, MatValue& out) {
    out.kind = Kind::texts;
    const MatFault bad("a text cannot be read");
    if (H5Tis_variable_str(type) > 0) {
      std::vector<char*> raw(count, nullptr);
      if (count > 0 && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, raw.data()) < 0) throw bad;
      for (char* text : raw) {
        out.texts.push_back(to_utf8(text ? text : ""));
        H5free_memory(text);
      }
      return;
    }
    constexpr std::size_t longest = std::size_t{1} << 20;
    const std::size_t width = H5Tget_size(type);
    if (width == 0 || width > longest) throw bad;
    std::string packed(width * count, '\0');
    if (count > 0 && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, packed.data()) < 0)
      throw bad;
    for (std::size_t i = 0; i < count; ++i) {
      const std::string text = packed.substr(i * width, width);
      out.texts.push_back(to_utf8(text.substr(0, text.find('\0'))));
    }
  }

  static void read_characters(hid_t set, std::size_t count, MatValue& out) {
    out.kind = Kind::texts;
    std::vector<std::uint16_t> units(count);
    if (count > 0 &&
        H5Dread(set, H5T_NATIVE_UINT16, H5S_ALL, H5S_ALL, H5P_DEFAULT, units.data()) < 0)
      throw MatFault("a text cannot be read");
    out.texts = rows_of_text(out.dims, {units.begin(), units.end()});
  }

  static void read_numbers(hid_t set, std::size_t count, MatValue& out) {
    out.kind = Kind::numbers;
    const Handle type(H5Dget_type(set), H5Tclose);
    if (H5Tget_class(type) == H5T_ENUM) { // numpy's booleans
      std::vector<signed char> truths(count);
      if (H5Tget_size(type) != 1 ||
          (count > 0 && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, truths.data()) < 0))
        throw MatFault("logical values cannot be read");
      out.numbers.assign(truths.begin(), truths.end());
      return;
    }
    out.numbers.resize(count);
    if (count > 0 &&
        H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, out.numbers.data()) < 0)
      throw MatFault("the values of a variable cannot be read");
  }

  Handle file_;
  std::uint64_t file_bytes_;
  std::uint64_t values_ = 0; // so far
};

} // namespace

} // namespace frictab::io::mat73

namespace frictab::io {

std::vector<MatValue> read_mat73(const std::filesystem::path& file) {
  hdf5::silence();
  hdf5::guard_library();
  std::vector<MatValue> variables = mat73::Reader(file).variables();
  if (hdf5::has_failed_read()) throw MatFault("the disk fails");
  return variables;
}

} // namespace frictab::io
