// Reads HDF5 files in a child process, because the library can crash on damaged ones.
#include "io/hdf5.h"

#include <algorithm>
#include <mutex>

#include "core/error.h"
#include "io/file_streams.h"
#include "io/hdf5_handle.h"
#include "io/hdf5_scan.h"

namespace frictab::io {

struct Hdf5Reader::Data {
  std::filesystem::path file;
  std::string named;
  std::uint64_t file_bytes = 0;
  Hdf5Contents contents;

  [[noreturn]] void fail(const std::string& what, const std::string& hint = "") const {
    throw InputError({named, 0, 0}, what, hint);
  }

  const Hdf5Dataset& dataset(const std::string& name) const {
    const auto found = contents.datasets.find(name);
    if (found == contents.datasets.end()) fail("there is no dataset '" + name + "'");
    return found->second;
  }

  // Attributes of a dataset or a group; nullptr if there is neither.
  const Hdf5Attributes* attributes(const std::string& object) const {
    const auto set = contents.datasets.find(object);
    if (set != contents.datasets.end()) return &set->second.attributes;
    const auto group = contents.groups.find(object);
    return group != contents.groups.end() ? &group->second : nullptr;
  }

  // Runs the library on the file in a child process.
  void ask(const std::function<void(os::ByteSink&)>& work,
           const std::function<bool(os::ByteSource&)>& take) const {
    // no other thread uses the library during the fork
    const std::lock_guard lock(hdf5::library());
    const os::ChildLimits limits = os::limits_to_read(file_bytes);
    const auto of_child = [&](os::ByteSink& out) {
      hdf5::library(true);
      work(out);
    };
    if (!os::run_isolated(limits, of_child, take))
      fail("is damaged: the HDF5 library crashes on it or comes to no end",
           "write it again from its source");
  }
};

Hdf5Reader::Hdf5Reader(const std::filesystem::path& file, std::string named)
    : data_(std::make_unique<Data>()) {
  data_->file = file;
  data_->named = std::move(named);
  data_->file_bytes = InputFile(file, data_->named).size();
  data_->ask(
      [&](os::ByteSink& out) { scan_hdf5(file, out); },
      [&](os::ByteSource& in) { return take_contents(in, data_->file_bytes, data_->contents); });
  if (!data_->contents.fault.empty()) data_->fail(data_->contents.fault, data_->contents.hint);
}

Hdf5Reader::Hdf5Reader(const Hdf5Contents& contents, std::string named)
    : data_(std::make_unique<Data>()) {
  data_->named = std::move(named);
  data_->contents = contents;
}

Hdf5Reader::~Hdf5Reader() = default;

std::vector<std::string> Hdf5Reader::datasets(const std::string& group) const {
  const std::string path = group == "/" ? "" : group + "/";
  std::vector<std::string> names;
  const auto& all = data_->contents.datasets;
  for (auto at = all.lower_bound(path); at != all.end() && at->first.starts_with(path); ++at)
    if (const std::string name = at->first.substr(path.size()); name.find('/') == name.npos)
      names.push_back(name);
  return names;
}

std::vector<std::string> Hdf5Reader::groups() const {
  std::vector<std::string> names;
  for (const auto& [name, attributes] : data_->contents.groups)
    if (name != "/") names.push_back(name);
  return names;
}

std::vector<Hdf5Other> Hdf5Reader::others(const std::string& group) const {
  const auto found = data_->contents.others.find(group);
  return found != data_->contents.others.end() ? found->second : std::vector<Hdf5Other>();
}

bool Hdf5Reader::has(const std::string& dataset) const {
  return data_->contents.datasets.count(dataset) > 0;
}

bool Hdf5Reader::is_text(const std::string& dataset) const {
  return data_->dataset(dataset).is_text;
}

std::string Hdf5Reader::other_type(const std::string& dataset) const {
  return data_->dataset(dataset).other_type;
}

std::string Hdf5Reader::fault(const std::string& dataset) const {
  return data_->dataset(dataset).fault;
}

std::vector<std::size_t> Hdf5Reader::shape(const std::string& dataset) const {
  return data_->dataset(dataset).shape;
}

std::vector<double> Hdf5Reader::values(const std::string& dataset) const {
  const Hdf5Dataset& set = data_->dataset(dataset);
  if (set.is_text) data_->fail("'" + dataset + "' is not numeric");
  if (set.in_memory) return set.values;
  std::vector<double> values;
  blocks(dataset, std::size_t{1} << 20, [&](std::size_t, std::span<const double> part) {
    values.insert(values.end(), part.begin(), part.end());
  });
  return values;
}

void Hdf5Reader::blocks(
    const std::string& dataset, std::size_t most,
    const std::function<void(std::size_t first, std::span<const double>)>& take) const {
  const Hdf5Dataset& set = data_->dataset(dataset);
  if (!set.fault.empty()) data_->fail(set.fault, set.hint);
  if (set.is_text) data_->fail("'" + dataset + "' is not numeric");
  if (set.in_memory) {
    for (std::size_t first = 0; first < set.values.size(); first += most)
      take(first, std::span(set.values).subspan(first, std::min(most, set.values.size() - first)));
    return;
  }
  std::string fault, hint;
  data_->ask(
      [&](os::ByteSink& out) { scan_values(data_->file, dataset, most, out); },
      [&](os::ByteSource& in) { return take_values(in, set.count(), most, take, fault, hint); });
  if (!fault.empty()) data_->fail(fault, hint);
}

std::vector<std::string> Hdf5Reader::texts(const std::string& dataset) const {
  const Hdf5Dataset& set = data_->dataset(dataset);
  if (!set.fault.empty()) data_->fail(set.fault, set.hint);
  if (!set.is_text) data_->fail("'" + dataset + "' cannot be read as text");
  if (set.in_memory) return set.texts;
  const Hdf5Slice all{dataset, 0, set.count()};
  return std::move(slices({&all, 1}).front().texts);
}

std::vector<Hdf5Values> Hdf5Reader::slices(std::span<const Hdf5Slice> wanted) const {
  std::vector<Hdf5Slice> not_held;
  for (const Hdf5Slice& slice : wanted) {
    const Hdf5Dataset& set = data_->dataset(slice.dataset);
    if (!set.fault.empty()) data_->fail(set.fault, set.hint);
    if (!set.in_memory) not_held.push_back(slice);
  }
  std::vector<Hdf5Values> read;
  std::string fault, hint;
  if (!not_held.empty())
    data_->ask([&](os::ByteSink& out) { scan_slices(data_->file, not_held, out); },
               [&](os::ByteSource& in) {
                 return take_slices(in, data_->file_bytes, not_held, read, fault, hint);
               });
  if (!fault.empty()) data_->fail(fault, hint);

  std::vector<Hdf5Values> all;
  auto next = read.begin();
  for (const Hdf5Slice& slice : wanted) {
    const Hdf5Dataset& set = data_->dataset(slice.dataset);
    if (!set.in_memory) {
      all.push_back(std::move(*next++));
      continue;
    }
    Hdf5Values& held = all.emplace_back();
    const auto from = static_cast<std::ptrdiff_t>(slice.first);
    const auto to = static_cast<std::ptrdiff_t>(slice.first + slice.count);
    if (set.is_text)
      held.texts.assign(set.texts.begin() + from, set.texts.begin() + to);
    else
      held.numbers.assign(set.values.begin() + from, set.values.begin() + to);
  }
  return all;
}

Hdf5Layout Hdf5Reader::layout(const std::string& dataset) const {
  return data_->dataset(dataset).layout;
}

std::vector<std::string> Hdf5Reader::attributes(const std::string& object) const {
  std::vector<std::string> names;
  if (const Hdf5Attributes* all = data_->attributes(object))
    for (const auto& [name, value] : *all)
      names.push_back(name);
  return names;
}

std::optional<std::string> Hdf5Reader::text_attribute(const std::string& object,
                                                      const std::string& name) const {
  const Hdf5Attributes* all = data_->attributes(object);
  if (!all || !all->count(name)) return std::nullopt;
  const auto* text = std::get_if<std::string>(&all->at(name));
  return text ? std::optional(*text) : std::nullopt;
}

std::optional<double> Hdf5Reader::number_attribute(const std::string& object,
                                                   const std::string& name) const {
  const Hdf5Attributes* all = data_->attributes(object);
  if (!all || !all->count(name)) return std::nullopt;
  const auto* number = std::get_if<double>(&all->at(name));
  return number ? std::optional(*number) : std::nullopt;
}

std::optional<std::string> Hdf5Reader::scale(const std::string& dataset, std::size_t axis) const {
  const Hdf5Dataset& set = data_->dataset(dataset);
  return axis < set.scales.size() ? set.scales[axis] : std::nullopt;
}

std::optional<std::size_t> length_of_column(std::span<const std::size_t> shape) {
  if (shape.empty()) return std::nullopt;
  std::size_t length = 1, long_axes = 0;
  for (const std::size_t n : shape)
    if (n != 1) {
      length = n;
      ++long_axes;
    }
  return long_axes > 1 ? std::nullopt : std::optional(length);
}

bool looks_like_hdf5(const std::filesystem::path& file) {
  constexpr std::string_view signature("\x89HDF\r\n\x1a\n", 8);
  constexpr std::uint64_t smallest_block = 512;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return false;
  InputFile in(file, file.string());
  char magic[signature.size()] = {};
  for (std::uint64_t at = 0; in.read_at(at, magic) == sizeof magic;
       at = std::max(2 * at, smallest_block))
    if (std::string_view(magic, sizeof magic) == signature) return true;
  return false;
}

} // namespace frictab::io
