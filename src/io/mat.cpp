// Runs the readers of MATLAB files in a child process.
#include "io/mat.h"

#include <algorithm>
#include <array>
#include <mutex>

#include "core/error.h"
#include "core/text.h"
#include "io/file_streams.h"
#include "io/hdf5.h"
#include "io/hdf5_handle.h"
#include "io/mat_value.h"

namespace frictab::io::mat {

namespace {

constexpr std::size_t numbers_at_once = std::size_t{1} << 20;

// ---- as bytes ----

void put(os::ByteSink& out, const NumberOrText& value) {
  const auto* text = std::get_if<std::string>(&value);
  out.number(text != nullptr);
  if (text)
    out.text(*text);
  else
    out.doubles({&std::get<double>(value), 1});
}

void put(os::ByteSink& out, const GroupMember& member) {
  out.text(member.name);
  out.text(member.unit);
  out.number(member.shape.size());
  for (const std::size_t n : member.shape)
    out.number(n);
  out.number(member.is_text);
  out.text(member.other_type);
  out.number(member.single.has_value());
  if (member.single) put(out, *member.single);
  out.number(member.numbers.size());
  out.doubles(member.numbers);
  out.number(member.texts.size());
  for (const std::string& text : member.texts)
    out.text(text);
}

void put(os::ByteSink& out, const ColumnGroup& group) {
  out.text(group.name);
  out.number(group.members.size());
  for (const GroupMember& member : group.members)
    put(out, member);
}

// Parses the output of `put`; refuses sizes that a file of these bytes cannot contain.
class Taker {
public:
  Taker(os::ByteSource& in, std::uint64_t file_bytes)
      : in_(in), most_(std::min<std::uint64_t>(file_bytes, std::uint64_t{1} << 48) * 1100 + 65536) {
  }

  bool take(ColumnGroups& all, std::string& fault) {
    std::uint64_t groups = 0, notes = 0;
    if (!text(fault) || !text(all.format) || !text(all.form) || !count(notes)) return false;
    for (std::uint64_t i = 0; i < notes; ++i)
      if (!text(all.notes.emplace_back())) return false;
    if (!take(all.root) || !count(groups)) return false;
    for (std::uint64_t i = 0; i < groups; ++i)
      if (!take(all.groups.emplace_back())) return false;
    return true;
  }

private:
  bool text(std::string& text) { return in_.text(text, most_); }
  bool count(std::uint64_t& count) { return in_.number(count) && count <= most_; }
  bool truth(bool& value) {
    std::uint64_t number = 0;
    if (!in_.number(number)) return false;
    value = number == 1;
    return number <= 1;
  }

  bool take(ColumnGroup& group) {
    std::uint64_t members = 0;
    if (!text(group.name) || !count(members)) return false;
    for (std::uint64_t i = 0; i < members; ++i)
      if (!take(group.members.emplace_back())) return false;
    return true;
  }

  bool take(GroupMember& member) {
    std::uint64_t axes = 0;
    if (!text(member.name) || !text(member.unit) || !count(axes) || axes > 2) return false;
    for (std::uint64_t i = 0, n = 0; i < axes; ++i) {
      if (!count(n)) return false;
      member.shape.push_back(n);
    }
    bool has_single = false;
    if (!truth(member.is_text) || !text(member.other_type) || !truth(has_single)) return false;
    if (has_single && !take(member.single.emplace())) return false;
    return numbers(member) && texts(member) && is_sound(member);
  }

  bool take(NumberOrText& value) {
    bool is_text = false;
    if (!truth(is_text)) return false;
    if (is_text) return text(value.emplace<std::string>());
    return in_.doubles({&value.emplace<double>(), 1});
  }

  // Takes memory only as the numbers come.
  bool numbers(GroupMember& member) {
    std::uint64_t size = 0;
    if (!count(size)) return false;
    while (member.numbers.size() < size) {
      const std::size_t done = member.numbers.size();
      member.numbers.resize(done + std::min<std::uint64_t>(numbers_at_once, size - done));
      if (!in_.doubles(std::span(member.numbers).subspan(done))) return false;
    }
    return true;
  }

  bool texts(GroupMember& member) {
    std::uint64_t size = 0;
    if (!count(size)) return false;
    for (std::uint64_t i = 0; i < size; ++i)
      if (!text(member.texts.emplace_back())) return false;
    return true;
  }

  static bool is_sound(const GroupMember& member) {
    if (!member.other_type.empty() || member.shape.empty()) return true;
    const std::size_t values = member.is_text ? member.texts.size() : member.numbers.size();
    return member.shape == std::vector<std::size_t>{values, 1} &&
           member.single.has_value() == (values == 1);
  }

  os::ByteSource& in_;
  std::uint64_t most_;
};

// Versions 5 to 7, and 7.3.
bool has_mat_header(const std::filesystem::path& file) {
  constexpr std::size_t size = 128;
  const std::string head = first_bytes(file, size);
  return head.size() == size &&
         (head.ends_with("\x01IM") || head.ends_with("\x02IM") ||
          head.ends_with(std::string("\x01\0MI", 4)) || head.ends_with(std::string("\x02\0MI", 4)));
}

void read_in_child(const std::filesystem::path& file, bool is_hdf5, os::ByteSink& out) {
  try {
    put_groups(mat_groups(is_hdf5 ? read_mat73(file) : read_mat5(file)), "", out);
  } catch (const MatFault& error) {
    put_groups({}, error.what(), out);
  }
}

} // namespace

} // namespace frictab::io::mat

namespace frictab::io {

void put_groups(const ColumnGroups& all, const std::string& fault, os::ByteSink& out) {
  out.text(fault);
  out.text(all.format);
  out.text(all.form);
  out.number(all.notes.size());
  for (const std::string& note : all.notes)
    out.text(note);
  mat::put(out, all.root);
  out.number(all.groups.size());
  for (const ColumnGroup& group : all.groups)
    mat::put(out, group);
}

bool take_groups(os::ByteSource& in, std::uint64_t file_bytes, ColumnGroups& all,
                 std::string& fault) {
  return mat::Taker(in, file_bytes).take(all, fault);
}

bool looks_like_mat(const std::filesystem::path& file) {
  if (mat::has_mat_header(file)) return true;
  return lower_case(file.extension().string()) == ".mat" && !looks_like_hdf5(file);
}

ColumnGroups read_mat(const std::filesystem::path& file, const std::string& named) {
  const std::uint64_t bytes = InputFile(file, named).size();
  const bool is_hdf5 = looks_like_hdf5(file);
  ColumnGroups all;
  std::string fault;
  const os::ChildLimits limits = os::limits_to_read(bytes);
  // no other thread uses the HDF5 library during the fork
  const std::lock_guard lock(hdf5::library());
  const auto work = [&](os::ByteSink& out) {
    hdf5::library(true);
    mat::read_in_child(file, is_hdf5, out);
  };
  const auto take = [&](os::ByteSource& in) { return take_groups(in, bytes, all, fault); };
  const std::string hint = "save it again in MATLAB: save(..., '-v7'), or write CSV: writetable";
  if (!os::run_isolated(limits, work, take))
    throw InputError({named, 0, 0}, "is damaged: its library crashes on it or comes to no end",
                     hint);
  if (!fault.empty())
    throw InputError({named, 0, 0}, "cannot be read as a MATLAB file: " + fault, hint);
  all.one_group_is_file = true;
  return all;
}

} // namespace frictab::io
