// Names and units that MATLAB files hold as values of their own: a struct, a list or texts of
// units, names of the columns of a matrix, and structs of one channel.
#include <algorithm>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "core/text.h"
#include "io/csv.h"
#include "io/mat_value.h"

namespace frictab::io::mat {

namespace {

using Kind = MatValue::Kind;
using Fields = std::vector<MatValue>;

// The name in small letters and digits: "channelnames" for "Channel_Names".
std::string plain(const std::string& name) {
  std::string out;
  for (const char c : lower_case(name))
    if (c != '_' && c != ' ') out += c;
  return out;
}

bool names_units(const std::string& name) {
  const std::string word = plain(name);
  return word.ends_with("unit") || word.ends_with("units") || word.ends_with("einheit") ||
         word.ends_with("einheiten");
}

bool names_names(const std::string& name) {
  const std::string word = plain(name);
  for (const char* const end : {"names", "labels", "channels", "columns", "variables", "header",
                                "headers", "signals", "channelname", "kanäle", "namen"})
    if (word.ends_with(end)) return true;
  return word == "name" || word == "label";
}

bool is_vector(const MatValue& value) {
  return value.kind == Kind::numbers && value.numbers.size() > 1 && value.dims.size() == 2 &&
         (value.dims[0] == 1 || value.dims[1] == 1);
}

bool is_matrix(const MatValue& value) {
  return value.kind == Kind::numbers && value.dims.size() == 2 && value.dims[0] > 1 &&
         value.dims[1] > 1;
}

bool is_struct(const MatValue& value) {
  return value.kind == Kind::structs && value.structs.size() == 1;
}

std::optional<std::string> text_in(const MatValue& value) {
  if (value.kind == Kind::texts && value.texts.size() == 1)
    return std::string(trimmed(value.texts.front()));
  if (value.kind == Kind::cells && value.elements.size() == 1)
    return text_in(value.elements.front());
  return std::nullopt;
}

// The texts of a cell array or a char matrix; empty if it has other values. An empty cell is an
// empty text.
std::vector<std::string> texts_in(const MatValue& value) {
  std::vector<std::string> texts;
  if (value.kind == Kind::texts)
    for (const std::string& text : value.texts)
      texts.emplace_back(trimmed(text));
  if (value.kind != Kind::cells) return texts;
  for (const MatValue& cell : value.elements)
    if (const auto text = text_in(cell))
      texts.push_back(*text);
    else if (cell.numbers.empty() && cell.kind == Kind::numbers)
      texts.emplace_back();
    else
      return {};
  return texts;
}

MatValue* find(Fields& fields, const std::string& name) {
  for (MatValue& field : fields)
    if (field.name == name) return &field;
  return nullptr;
}

bool may_have_unit(const MatValue& value) {
  return value.unit.empty() &&
         (is_vector(value) || (value.kind == Kind::numbers && value.numbers.size() == 1));
}

class Describer {
public:
  explicit Describer(std::vector<std::string>& notes) : notes_(notes) {}

  // `in_order`: the fields are in the order of the struct, which lists may refer to.
  void describe(Fields& fields, bool in_order, int depth) {
    if (depth > deepest_nesting) return;
    for (MatValue& field : fields) {
      for (MatValue& element : field.elements)
        for (Fields& own : element.structs)
          describe(own, element.in_order, depth + 1);
      for (Fields& own : field.structs)
        describe(own, field.in_order, depth + 1);
    }
    join_channels(fields);
    name_columns(fields);
    take_list(fields, in_order);
    take_structs(fields);
    take_texts(fields);
  }

private:
  void note(const std::string& text) {
    if (std::find(notes_.begin(), notes_.end(), text) == notes_.end()) notes_.push_back(text);
  }

  static void forget(Fields& fields, const std::string& name) {
    std::erase_if(fields, [&](const MatValue& field) { return field.name == name; });
  }

  static bool set_unit(MatValue& value, const std::string& unit) {
    if (!may_have_unit(value)) return false;
    value.unit = without_brackets(unit);
    return true;
  }

  // ---- a struct per channel: Fn.data, Fn.unit ----

  static MatValue* data_of(Fields& fields) {
    static const std::set<std::string> known = {"data",    "values", "value", "signal",
                                                "samples", "y",      "werte"};
    MatValue* found = nullptr;
    for (MatValue& field : fields) {
      if (field.kind == Kind::structs || is_matrix(field)) return nullptr;
      if (!is_vector(field)) continue;
      if (found || known.count(plain(field.name)) == 0) return nullptr;
      found = &field;
    }
    return found;
  }

  // The channel as a column of this name, or by its own field `name` where that is empty; nullopt
  // if the struct is another thing.
  static std::optional<MatValue> channel(Fields& fields, std::string name) {
    MatValue* const data = data_of(fields);
    if (!data) return std::nullopt;
    std::string unit;
    for (const MatValue& field : fields) {
      const auto text = text_in(field);
      if (text && names_units(field.name)) unit = *text;
      if (text && name.empty() && names_names(field.name)) name = *text;
    }
    if (name.empty()) return std::nullopt;
    MatValue column = std::move(*data);
    column.name = std::move(name);
    if (column.unit.empty()) column.unit = without_brackets(unit);
    return column;
  }

  // Structs of channels, in a list or one by one.
  static std::vector<Fields*> structs_in(MatValue& value) {
    std::vector<Fields*> all;
    if (value.kind == Kind::structs)
      for (Fields& own : value.structs)
        all.push_back(&own);
    else if (value.kind == Kind::cells)
      for (MatValue& element : value.elements)
        if (is_struct(element)) all.push_back(&element.structs.front());
    return all;
  }

  void join_channels(Fields& fields) {
    Fields out;
    for (MatValue& field : fields) {
      const std::vector<Fields*> structs = structs_in(field);
      const bool is_list = field.kind == Kind::cells || structs.size() > 1;
      Fields columns;
      for (Fields* const own : structs)
        if (data_of(*own))
          if (auto column = channel(*own, is_list ? "" : field.name))
            columns.push_back(std::move(*column));
      if (columns.empty() || columns.size() != structs.size()) {
        out.push_back(std::move(field));
        continue;
      }
      if (is_list) note(fmt::format("each struct of '{}' is a column", field.name));
      std::move(columns.begin(), columns.end(), std::back_inserter(out));
    }
    fields = std::move(out);
  }

  // ---- lists ----

  static const MatValue* list(const Fields& fields, bool (*is_named)(const std::string&)) {
    const MatValue* found = nullptr;
    for (const MatValue& field : fields)
      if (is_named(field.name) && texts_in(field).size() > 1) {
        if (found) return nullptr;
        found = &field;
      }
    return found;
  }

  static MatValue* only_matrix(Fields& fields, std::size_t columns) {
    MatValue* found = nullptr;
    for (MatValue& field : fields)
      if (is_matrix(field) && field.dims[1] == columns) {
        if (found) return nullptr;
        found = &field;
      }
    return found;
  }

  // Cuts a matrix into the columns that a list names.
  void name_columns(Fields& fields) {
    const MatValue* const names = list(fields, names_names);
    if (!names) return;
    const std::vector<std::string> texts = texts_in(*names);
    const std::set<std::string> different(texts.begin(), texts.end());
    MatValue* const matrix = only_matrix(fields, texts.size());
    if (!matrix || different.size() != texts.size() || different.count("") > 0) return;
    const MatValue* const units = list(fields, names_units);
    const std::vector<std::string> of_units = units ? texts_in(*units) : std::vector<std::string>();
    const std::size_t rows = matrix->dims[0];
    Fields columns;
    for (std::size_t c = 0; c < texts.size(); ++c) {
      MatValue column;
      column.name = texts[c];
      column.kind = Kind::numbers;
      column.dims = {rows, 1};
      const auto first = matrix->numbers.begin() + static_cast<std::ptrdiff_t>(c * rows);
      column.numbers.assign(first, first + static_cast<std::ptrdiff_t>(rows));
      if (of_units.size() == texts.size()) column.unit = without_brackets(of_units[c]);
      columns.push_back(std::move(column));
    }
    note(fmt::format("columns of '{}' have the names in '{}'", matrix->name, names->name));
    std::vector<std::string> taken = {matrix->name, names->name};
    if (of_units.size() == texts.size()) {
      note(fmt::format("units by '{}'", units->name));
      taken.push_back(units->name);
    }
    for (const std::string& name : taken)
      forget(fields, name);
    std::move(columns.begin(), columns.end(), std::back_inserter(fields));
  }

  // A list of units in the order of the fields, or of names in another list.
  void take_list(Fields& fields, bool in_order) {
    const MatValue* const units = list(fields, names_units);
    if (!units) return;
    const std::string name = units->name;
    const std::vector<std::string> texts = texts_in(*units);
    std::vector<MatValue*> columns;
    const MatValue* const names = list(fields, names_names);
    if (const std::vector<std::string> known =
            names ? texts_in(*names) : std::vector<std::string>();
        known.size() == texts.size()) {
      for (const std::string& one : known)
        if (MatValue* const column = find(fields, one)) columns.push_back(column);
    } else if (in_order) {
      for (MatValue& field : fields)
        if (is_vector(field)) columns.push_back(&field);
    }
    if (columns.size() != texts.size()) return;
    for (std::size_t i = 0; i < columns.size(); ++i)
      set_unit(*columns[i], texts[i]);
    note(fmt::format("units by '{}'", name));
    forget(fields, name);
  }

  // ---- a struct of texts, and texts ----

  // Sets the unit of the field with this name, here or in the structs of the fields.
  static bool set_unit_below(Fields& fields, const std::string& name, const std::string& unit) {
    bool found = false;
    if (MatValue* const own = find(fields, name)) found = set_unit(*own, unit);
    for (MatValue& field : fields)
      for (Fields* const below : structs_in(field))
        if (MatValue* const own = find(*below, name)) found = set_unit(*own, unit) || found;
    return found;
  }

  void take_structs(Fields& fields) {
    std::vector<std::string> taken;
    for (const MatValue& units : fields) {
      if (!names_units(units.name) || !is_struct(units)) continue;
      const Fields texts = units.structs.front(); // `fields` changes below
      const std::string name = units.name;
      std::size_t found = 0;
      for (const MatValue& one : texts)
        if (const auto text = text_in(one)) found += set_unit_below(fields, one.name, *text);
      if (found > 0) note(fmt::format("units by '{}'", name));
      if (found == texts.size()) taken.push_back(name);
    }
    for (const std::string& name : taken)
      forget(fields, name);
  }

  void take_texts(Fields& fields) {
    std::vector<std::string> taken;
    for (const MatValue& one : fields) {
      const auto text = text_in(one);
      if (!text || !names_units(one.name)) continue;
      const std::string own = plain(one.name);
      for (MatValue& field : fields)
        if (const std::string name = plain(field.name);
            may_have_unit(field) && (own == name + "unit" || own == name + "units" ||
                                     own == "unit" + name || own == name + "einheit")) {
          field.unit = without_brackets(*text);
          taken.push_back(one.name);
          break;
        }
    }
    if (!taken.empty()) note(fmt::format("units by {}", join(taken, ", ")));
    for (const std::string& name : taken)
      forget(fields, name);
  }

  std::vector<std::string>& notes_;
};

} // namespace

std::vector<std::string> take_names_and_units(std::vector<MatValue>& variables) {
  std::vector<std::string> notes;
  Describer(notes).describe(variables, false, 0);
  return notes;
}

} // namespace frictab::io::mat
