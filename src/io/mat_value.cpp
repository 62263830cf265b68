// Columns and groups of MATLAB variables.
#include "io/mat_value.h"

#include <algorithm>

#include <fmt/format.h>

namespace frictab::io::mat {

namespace {

using Kind = MatValue::Kind;

constexpr std::size_t most_matrix_columns = 1000;

void append_utf8(std::string& out, char32_t code) {
  const auto put = [&](char32_t byte) { out += static_cast<char>(byte); };
  if (code < 0x80) {
    put(code);
  } else if (code < 0x800) {
    put(0xc0 | (code >> 6));
    put(0x80 | (code & 0x3f));
  } else if (code < 0x10000) {
    put(0xe0 | (code >> 12));
    put(0x80 | ((code >> 6) & 0x3f));
    put(0x80 | (code & 0x3f));
  } else {
    put(0xf0 | (code >> 18));
    put(0x80 | ((code >> 12) & 0x3f));
    put(0x80 | ((code >> 6) & 0x3f));
    put(0x80 | (code & 0x3f));
  }
}

constexpr char32_t replacement = 0xfffd;

std::string utf8_of(const std::vector<char16_t>& units) {
  std::string out;
  for (std::size_t i = 0; i < units.size(); ++i) {
    const char32_t unit = units[i];
    if (unit < 0xd800 || unit > 0xdfff) {
      append_utf8(out, unit);
    } else if (unit < 0xdc00 && i + 1 < units.size() && units[i + 1] >= 0xdc00 &&
               units[i + 1] <= 0xdfff) {
      append_utf8(out, 0x10000 + ((unit - 0xd800) << 10) + (char32_t{units[++i]} - 0xdc00));
    } else {
      append_utf8(out, replacement);
    }
  }
  return out;
}

std::size_t product(const std::vector<std::size_t>& dims) {
  std::size_t count = 1;
  for (const std::size_t n : dims)
    count *= n;
  return count;
}

GroupMember other_member(const std::string& name, const std::string& what) {
  GroupMember member;
  member.name = name;
  member.shape = {0};
  member.other_type = what;
  return member;
}

// True for one struct, a struct array, or a cell of structs.
bool holds_structs(const MatValue& value) {
  if (value.kind == Kind::structs) return !value.structs.empty();
  return value.kind == Kind::cells && !value.elements.empty() &&
         std::all_of(value.elements.begin(), value.elements.end(), [](const MatValue& one) {
           return one.kind == Kind::structs && one.structs.size() == 1;
         });
}

bool is_column(const MatValue& value) {
  return (value.kind == Kind::numbers && value.numbers.size() > 1) ||
         (value.kind == Kind::texts && value.texts.size() > 1) ||
         (value.kind == Kind::cells && value.elements.size() > 1 && !holds_structs(value));
}

// True for a struct that only holds the structs of tests.
bool is_container(const std::vector<MatValue>& fields) {
  return std::none_of(fields.begin(), fields.end(), is_column) &&
         std::any_of(fields.begin(), fields.end(), holds_structs);
}

class Grouping {
public:
  ColumnGroups groups(std::vector<MatValue>&& variables) {
    all_.format = "MATLAB";
    all_.form = "a MATLAB file has one variable per column (n x 1 or 1 x n), or one struct of them "
                "per test";
    all_.one_group_is_file = true;
    all_.notes = take_names_and_units(variables);
    for (MatValue& variable : variables)
      if (holds_structs(variable))
        add_structs(variable.name, variable, 0);
      else
        add(all_.root, variable.name, variable);
    sort_by_name(all_);
    return std::move(all_);
  }

private:
  void add_structs(const std::string& name, MatValue& value, int depth) {
    if (value.kind == Kind::cells) {
      for (std::size_t i = 0; i < value.elements.size(); ++i)
        add_group(fmt::format("{}{{{}}}", name, i + 1), value.elements[i].structs.front(), depth);
      return;
    }
    const bool one = value.structs.size() == 1;
    for (std::size_t i = 0; i < value.structs.size(); ++i)
      add_group(one ? name : fmt::format("{}({})", name, i + 1), value.structs[i], depth);
  }

  void add_group(const std::string& name, std::vector<MatValue>& fields, int depth) {
    if (is_container(fields) && depth < deepest_nesting) {
      for (MatValue& field : fields)
        if (holds_structs(field))
          add_structs(name + "." + field.name, field, depth + 1);
        else
          add(all_.root, name + "." + field.name, field);
      return;
    }
    ColumnGroup group;
    group.name = name;
    for (MatValue& field : fields)
      add(group, field.name, field);
    all_.groups.push_back(std::move(group));
  }

  static void add(ColumnGroup& to, const std::string& name, MatValue& value) {
    if (value.kind == Kind::numbers)
      add_numbers(to, name, value);
    else if (value.kind == Kind::texts && !value.texts.empty())
      to.members.push_back(text_member(name, std::move(value.texts)));
    else if (value.kind == Kind::cells)
      add_cells(to, name, value);
    else if (value.kind == Kind::structs && value.structs.size() == 1)
      for (MatValue& field : value.structs.front())
        add(to, name + "." + field.name, field);
    else if (value.kind == Kind::structs && !value.structs.empty())
      to.members.push_back(other_member(name, "a struct array within a struct"));
    else
      to.members.push_back(
          other_member(name, value.kind == Kind::other ? value.other : "no value"));
  }

  static void add_numbers(ColumnGroup& to, const std::string& name, MatValue& value) {
    const std::size_t rows = value.dims.empty() ? 1 : value.dims.front(),
                      columns = rows > 0 ? value.numbers.size() / rows : 0;
    if (value.numbers.empty()) {
      to.members.push_back(other_member(name, "no value"));
    } else if (rows == 1 || columns == 1) {
      to.members.push_back(number_member(name, value.unit, std::move(value.numbers)));
    } else if (value.dims.size() > 2 || columns > most_matrix_columns) {
      to.members.push_back(
          other_member(name, fmt::format("{} values", fmt::join(value.dims, " x "))));
    } else {
      for (std::size_t c = 0; c < columns; ++c) {
        const auto first = value.numbers.begin() + static_cast<std::ptrdiff_t>(c * rows);
        to.members.push_back(number_member(fmt::format("{}(:,{})", name, c + 1), "",
                                           {first, first + static_cast<std::ptrdiff_t>(rows)}));
      }
    }
  }

  // Cells of one text each, or of one number each; empty ones are empty texts.
  static void add_cells(ColumnGroup& to, const std::string& name, MatValue& value) {
    std::vector<std::string> texts;
    std::vector<double> numbers;
    for (const MatValue& cell : value.elements) {
      const bool is_empty =
          (cell.kind == Kind::numbers && cell.numbers.empty()) ||
          (cell.kind == Kind::texts && (cell.texts.empty() || cell.texts.front().empty()));
      if (cell.kind == Kind::numbers && cell.numbers.size() == 1)
        numbers.push_back(cell.numbers.front());
      else if (is_empty)
        texts.emplace_back();
      else if (cell.kind == Kind::texts && cell.texts.size() == 1)
        texts.push_back(cell.texts.front());
    }
    if (value.elements.empty())
      to.members.push_back(other_member(name, "no value"));
    else if (texts.size() == value.elements.size())
      to.members.push_back(text_member(name, std::move(texts)));
    else if (numbers.size() == value.elements.size())
      to.members.push_back(number_member(name, "", std::move(numbers)));
    else
      to.members.push_back(other_member(name, "a cell array of other values than texts"));
  }

  ColumnGroups all_;
};

} // namespace

} // namespace frictab::io::mat

namespace frictab::io {

std::size_t count_of(const std::vector<std::size_t>& dims, std::uint64_t file_bytes) {
  constexpr std::uint64_t best_ratio = 1100; // of deflate
  const std::uint64_t limit = file_bytes * best_ratio + 1024;
  std::size_t count = 1;
  for (const std::size_t n : dims) {
    if (n != 0 && count > limit / n)
      throw MatFault("a variable has more values than the file can hold");
    count *= n;
  }
  return count;
}

std::vector<std::string> rows_of_text(const std::vector<std::size_t>& dims,
                                      const std::vector<char16_t>& characters) {
  const std::size_t rows = dims.empty() ? 0 : dims.front();
  if (rows == 0 || mat::product(dims) != characters.size())
    return characters.empty() ? std::vector<std::string>{""}
                              : std::vector<std::string>{mat::utf8_of(characters)};
  std::vector<std::string> texts;
  for (std::size_t r = 0; r < rows; ++r) {
    std::vector<char16_t> row;
    for (std::size_t i = r; i < characters.size(); i += rows)
      row.push_back(characters[i]);
    while (!row.empty() && (row.back() == u' ' || row.back() == 0))
      row.pop_back();
    texts.push_back(mat::utf8_of(row));
  }
  return texts;
}

ColumnGroups mat_groups(std::vector<MatValue>&& variables) {
  return mat::Grouping().groups(std::move(variables));
}

} // namespace frictab::io
