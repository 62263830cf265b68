// Guesses the dialect by trial: the one whose header is text and whose cells are mostly numbers.
#include "data/sniff.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <set>

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "core/units.h"
#include "data/checks.h"
#include "data/quantity.h"
#include "data/raw.h"
#include "io/hdf5.h"
#include "io/number.h"

namespace frictab::data {

namespace {

// ---- column names ----

struct Names {
  const char* canonical;
  bool coefficient;
  std::vector<std::string> whole; // complete names
  std::vector<std::string> part;  // parts of names
};

// Known names in lower case, without units, with blanks for other characters.
const std::vector<Names>& known_names() {
  static const std::vector<Names> all = {
      {"experiment",
       false,
       {"experiment", "test", "versuch", "versuch nr", "versuchsnummer", "versuchsnr", "run",
        "probe", "specimen", "sample", "test id", "test no", "test nr", "test name", "id"},
       {}},
      {"time_s", false, {"time", "zeit", "t", "elapsed", "sekunden"}, {"time", "zeit"}},
      {"F_N_N",
       false,
       {"f n", "fn", "fz", "load", "last", "fnormal"},
       {"normal force", "normalkraft", "normal load", "prüfkraft"}},
      {"F_R_N",
       false,
       {"f r", "fr", "ff", "fx", "ft", "friction", "reibung"},
       {"friction force", "frictional force", "reibkraft", "reibungskraft", "tangential"}},
      {"sigma_n_MPa",
       false,
       {"p", "pressure", "sigma n", "druck", "cpress", "pressung"},
       {"normal stress", "contact pressure", "normalspannung", "pressung", "kontaktdruck"}},
      {"tau_R_MPa",
       true,
       {"mu", "µ", "μ", "cof", "cf"},
       {"coefficient of friction", "friction coefficient", "friction coeff", "reibwert", "reibzahl",
        "reibungszahl", "reibungskoeffizient", "reibbeiwert"}},
      {"tau_R_MPa",
       false,
       {"tau", "tau r", "cshear", "friction stress"},
       {"shear stress", "schubspannung"}},
      {"v_rel_mm_s",
       false,
       {"v", "v rel", "vrel", "speed", "velocity"},
       {"speed", "velocity", "geschwindigkeit"}},
      {"s_mm",
       false,
       {"s", "distance", "weg", "slip", "path", "s d"},
       {"sliding distance", "sliding path", "gleitweg", "reibweg"}},
      {"T_tool_C", false, {"t tool", "t werkzeug"}, {"tool temp", "werkzeugtemp", "die temp"}},
      {"T_contact_C",
       false,
       {"t contact", "temperature", "temperatur", "temp"},
       {"contact temp", "kontakttemp"}},
      {"psi",
       false,
       {"psi"},
       {"surface expansion", "surface enlargement", "oberflächenvergr", "oberflaechenvergr"}},
      {"sigma_f_MPa",
       false,
       {"sigma f", "kf", "k f"},
       {"flow stress", "fließspannung", "fliessspannung", "fliessspg"}},
  };
  return all;
}

std::string plain(const std::string& name) {
  std::string out;
  for (const char c : lower_case(name))
    out += std::isalnum(static_cast<unsigned char>(c)) || (c & 0x80) ? c : ' ';
  while (!out.empty() && out.back() == ' ')
    out.pop_back();
  while (out.find("  ") != out.npos)
    out = replace_all(out, "  ", " ");
  return out;
}

// Names in the history output of Abaqus: contact forces ("CFN2: Normal force ...", CFSM) anywhere,
// and velocities and temperatures of a node ("V1 PI: PART-1-1 N: 1"). The other components of a
// vector stay separate columns.
std::string of_abaqus(const std::string& name) {
  const std::string word = name.substr(0, name.find(' '));
  const bool component =
      word.size() == 4 && (std::isdigit(static_cast<unsigned char>(word[3])) || word[3] == 'm');
  if (component && word.starts_with("cfn")) return "F_N_N";
  if (component && word.starts_with("cfs")) return "F_R_N";
  if (name.find(" pi ") == name.npos) return "";
  if (word == "temp" || word == "nt11") return "T_contact_C";
  const bool velocity =
      word.size() == 2 && word[0] == 'v' && std::isdigit(static_cast<unsigned char>(word[1]));
  return velocity ? "v_rel_mm_s" : "";
}

// 3: the canonical name; 2: a complete name; 1: part of one; 0: no such column.
int likeness(const Names& names, const GuessedColumn& column) {
  if (column.name == names.canonical && !names.coefficient) return 3;
  const Quantity* quantity = find_quantity(names.canonical);
  const std::string wanted = names.coefficient || !quantity ? "1" : quantity->unit;
  if (quantity && !column.unit.empty() && !convert(column.unit, wanted)) return 0;
  if (quantity && column.text) return 0;
  const std::string name = plain(io::read_header_name(column.name).name);
  if (std::find(names.whole.begin(), names.whole.end(), name) != names.whole.end()) return 2;
  if (!names.coefficient && of_abaqus(name) == names.canonical) return 2;
  return std::any_of(names.part.begin(), names.part.end(),
                     [&](const std::string& part) { return name.find(part) != name.npos; });
}

// Assigns each quantity to the column with the greatest likeness, the first one of equals.
void name_columns(std::vector<GuessedColumn>& columns) {
  for (int least = 3; least >= 1; --least)
    for (const Names& names : known_names()) {
      const auto taken = [&](const GuessedColumn& c) { return c.canonical == names.canonical; };
      if (std::any_of(columns.begin(), columns.end(), taken)) continue;
      for (GuessedColumn& column : columns)
        if (column.canonical.empty() && likeness(names, column) >= least) {
          column.canonical = names.canonical;
          column.coefficient = names.coefficient;
          break;
        }
    }
}

// ---- dialects ----

constexpr std::size_t head_bytes = 65536;

// Whole lines from the start of a file.
std::string head_of(std::string text) {
  if (text.size() <= head_bytes) return text;
  const bool wide = text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF");
  std::size_t end = text.find_last_of("\n\r", head_bytes);
  if (end == text.npos) return text;
  end += 1;
  if (wide) end += end % 2;
  text.resize(end);
  return text;
}

bool is_number_column(const io::CsvColumn& column) {
  std::size_t empty = 0;
  for (const io::CsvColumn::Text& cell : column.texts)
    empty += cell.text.empty();
  const std::size_t texts = column.texts.size() - empty, all = column.numbers.size();
  return all > empty && 10 * texts <= all - empty;
}

// Score of a dialect: numeric cells minus a penalty for text and faults.
double worth(const io::CsvTable& table, std::size_t faults, const io::CsvFormat& format) {
  double sum = -10.0 * static_cast<double>(faults);
  std::size_t units = 0, unit_cells = 0;
  for (const io::CsvColumn& column : table.columns) {
    double ignored = 0;
    const bool named = !column.name.empty() && !io::read_number(column.name, '.', ignored);
    const auto texts = static_cast<double>(column.texts.size());
    const auto rows = static_cast<double>(column.numbers.size());
    if (named && is_number_column(column)) sum += rows - 2 * texts;
    if (column.unit.empty()) continue;
    ++unit_cells;
    units +=
        convert(io::without_brackets(column.unit), io::without_brackets(column.unit)).has_value();
  }
  if (!format.units_row) return sum;
  if (2 * units < std::max<std::size_t>(unit_cells, 1)) return -1;
  // A units row that covers every column is preferred to a header that is equally good.
  constexpr double more_than_as_good = 0.5;
  return sum + more_than_as_good;
}

class Dialects {
public:
  explicit Dialects(std::string_view text, const std::string& named, bool workbook)
      : text_(text), named_(named) {
    if (text.find_first_not_of(" \t\r\n") == text.npos)
      throw InputError({named, 0, 0}, "the file is empty");
    constexpr std::size_t longest_preamble = 60;
    for (const char decimal : {'.', ','})
      for (const bool units_row : {false, true})
        for (std::size_t skip = 0; skip < longest_preamble; ++skip) {
          io::CsvFormat format;
          format.decimal = decimal;
          format.units_row = units_row;
          format.skip_rows = skip;
          if (workbook) format.delimiter = ',';
          if (!workbook || decimal == '.') attempt(format);
        }
    for (const char between : {'.', ',', '\'', ' '}) {
      io::CsvFormat format = best;
      format.thousands = between;
      if (between != best.decimal) attempt(format);
    }
    any_decimal = best.thousands == 0 && reads_as_well(best.decimal == '.' ? ',' : '.');
    if (!(most_ > 0))
      throw InputError({named, 0, 0}, "no table of numbers under a line of names was found",
                       "frictab init DIR writes a job with every key, to be filled in by hand");
  }

  io::CsvFormat best;
  io::CsvTable table;       // by the best dialect
  bool any_decimal = false; // only whole numbers, so either decimal sign works

private:
  void attempt(const io::CsvFormat& format) {
    try {
      FaultList faults;
      io::CsvTable tried = io::parse_csv(text_, named_, format, faults);
      const double value = worth(tried, faults.size(), format);
      if (value <= most_) return;
      most_ = value;
      best = format;
      table = std::move(tried);
    } catch (const InputError&) { // not this dialect
    }
  }

  bool reads_as_well(char decimal) const {
    io::CsvFormat format = best;
    format.decimal = decimal;
    try {
      FaultList faults;
      const io::CsvTable tried = io::parse_csv(text_, named_, format, faults);
      return worth(tried, faults.size(), format) >= most_;
    } catch (const InputError&) {
      return false;
    }
  }

  std::string_view text_;
  const std::string& named_;
  double most_ = 0;
};

std::string first_values(const io::CsvColumn& column) {
  std::vector<std::string> shown;
  std::size_t text = 0;
  for (std::size_t i = 0; i < std::min<std::size_t>(column.numbers.size(), 3); ++i) {
    const bool is_text = text < column.texts.size() && column.texts[text].row == i;
    shown.push_back(is_text ? column.texts[text++].text : fmt::format("{:.6g}", column.numbers[i]));
  }
  return join(shown, ", ");
}

std::vector<GuessedColumn> columns_of(const io::CsvTable& table) {
  std::vector<GuessedColumn> columns;
  for (const io::CsvColumn& raw : table.columns) {
    if (raw.name.empty()) continue;
    GuessedColumn column;
    column.name = raw.name;
    column.unit =
        raw.unit.empty() ? io::read_header_name(raw.name).unit : io::without_brackets(raw.unit);
    column.text = !is_number_column(raw);
    column.first_values = first_values(raw);
    columns.push_back(std::move(column));
  }
  name_columns(columns);
  return columns;
}

// True if the names identify the header line: then skip_rows, which differs from file to file, is
// not needed.
bool is_found_by_names(std::string_view text, const GuessedFile& guess, const io::CsvTable& table,
                       io::CsvFormat format) {
  format.skip_rows = 0;
  for (const Quantity& quantity : quantities())
    format.wanted.emplace_back(quantity.name);
  for (const GuessedColumn& column : guess.columns)
    if (!column.canonical.empty()) format.wanted.push_back(io::read_header_name(column.name).name);
  try {
    FaultList faults;
    return io::parse_csv(text, guess.file, format, faults).header_line == table.header_line;
  } catch (const InputError&) {
    return false;
  }
}

// Replaces each text by the number of its first row.
std::vector<double> levels_of(const io::CsvColumn& raw) {
  std::vector<double> levels = raw.numbers;
  std::map<std::string, double> known;
  for (const io::CsvColumn::Text& cell : raw.texts)
    levels[cell.row] = known.emplace(cell.text, static_cast<double>(cell.row)).first->second;
  return levels;
}

bool each_row_is_a_test(const GuessedFile& guess, const io::CsvTable& table) {
  if (guess.find("experiment") || guess.find("time_s")) return false;
  std::vector<std::vector<double>> settings;
  for (const GuessedColumn& column : guess.columns)
    for (const io::CsvColumn& raw : table.columns)
      if (raw.name == column.name && !column.coefficient && column.canonical != "tau_R_MPa" &&
          column.canonical != "F_R_N")
        settings.push_back(levels_of(raw));
  return rows_look_like_tests(settings, table.rows());
}

// Rejects a column that numbers the rows as the name of a test.
void check_experiment(GuessedFile& guess, const io::CsvTable& table) {
  for (GuessedColumn& column : guess.columns) {
    if (column.canonical != "experiment") continue;
    for (const io::CsvColumn& raw : table.columns)
      if (raw.name == column.name && raw.texts.empty() && guess.find("time_s") &&
          std::set<double>(raw.numbers.begin(), raw.numbers.end()).size() == raw.numbers.size())
        column.canonical.clear();
  }
}

} // namespace

const GuessedColumn* GuessedFile::find(const std::string& canonical) const {
  for (const GuessedColumn& column : columns)
    if (column.canonical == canonical) return &column;
  return nullptr;
}

bool GuessedFile::is_read_as(const GuessedFile& other) const {
  const auto named = [](const GuessedFile& guess) {
    std::set<std::string> names;
    for (const GuessedColumn& column : guess.columns)
      if (!column.canonical.empty())
        names.insert(column.canonical + "=" + column.name + "/" + column.unit);
    return names;
  };
  return (any_decimal || decimal == other.decimal) &&
         (thousands == 0 || thousands == other.thousands) && units_row == other.units_row &&
         intervals == other.intervals && rows == other.rows && skip_rows == other.skip_rows &&
         named(*this) == named(other);
}

GuessedFile guess_file(const std::string& path, const std::string& named) {
  GuessedFile guess;
  guess.file = named;
  io::CsvTable table;
  if (io::looks_like_hdf5(path)) {
    FaultList faults;
    table = read_raw(path, named, {}, faults);
  } else {
    const std::string text = head_of(raw_text(path, named, ""));
    Dialects dialects(text, named, is_workbook(path));
    table = std::move(dialects.table);
    guess.decimal = dialects.best.decimal;
    guess.thousands = dialects.best.thousands;
    guess.any_decimal = dialects.any_decimal;
    guess.units_row = dialects.best.units_row;
    guess.intervals = !table.interval.empty() && table.interval.back() > 0;
    guess.columns = columns_of(table);
    if (!is_found_by_names(text, guess, table, dialects.best))
      guess.skip_rows = dialects.best.skip_rows;
  }
  if (guess.columns.empty()) guess.columns = columns_of(table);
  check_experiment(guess, table);
  guess.rows = each_row_is_a_test(guess, table);
  return guess;
}

// ---- names of files ----

namespace {

struct Token {
  std::string number, unit; // "20mm": 20, mm; both empty for a text
};

Token token_of(const std::string& text) {
  std::size_t end = 0;
  while (end < text.size() && (std::isdigit(static_cast<unsigned char>(text[end])) ||
                               text[end] == '.' || text[end] == ','))
    ++end;
  const bool trailing = end > 0 && !std::isdigit(static_cast<unsigned char>(text[end - 1]));
  if (end == 0 || trailing) return {};
  const std::string behind = text.substr(end);
  const bool letters = std::all_of(behind.begin(), behind.end(), [](char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0;
  });
  return letters ? Token{text.substr(0, end), behind} : Token{};
}

struct CutName {
  std::vector<std::string> tokens;
  std::string signs; // separators between them
};

CutName cut(const std::string& file) {
  CutName name;
  std::string token;
  for (const char c : std::filesystem::path(file).stem().string()) {
    if (c != '_' && c != '-' && c != ' ') {
      token += c;
      continue;
    }
    name.tokens.push_back(token);
    name.signs += c;
    token.clear();
  }
  name.tokens.push_back(token);
  return name;
}

std::string as_pattern(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += std::string_view(".^$*+?()[{|\\").find(c) == std::string_view::npos
               ? std::string(1, c)
               : std::string("\\") + c;
  return out;
}

// Sorts numbers by size, texts alphabetically; limited to one line.
std::string list_of(const std::set<std::string>& values) {
  std::vector<std::string> list(values.begin(), values.end());
  const auto number = [](const std::string& text) {
    double value = 0;
    return io::read_number(text, '.', value) || io::read_number(text, ',', value) ? value : 0;
  };
  std::stable_sort(list.begin(), list.end(), [&](const std::string& a, const std::string& b) {
    return number(a) < number(b);
  });
  constexpr std::size_t shown = 8;
  if (list.size() > shown) {
    list.resize(shown);
    list.emplace_back("...");
  }
  return join(list, ", ");
}

// The texts at one position of all names.
class NamePlace {
public:
  explicit NamePlace(const std::vector<std::string>& texts) : first_(texts.front()) {
    for (const std::string& text : texts) {
      const Token token = token_of(text);
      values_.insert(text);
      numbers_.insert(token.number);
      units_.insert(token.unit);
    }
  }

  bool differs() const { return values_.size() > 1; }
  bool has_empty() const { return values_.count("") > 0; }
  // True for the number of a condition with its unit, as 20mm.
  bool is_measured() const {
    return numbers_.count("") == 0 && units_.size() == 1 && !units_.begin()->empty();
  }
  bool names_test(std::size_t tests) const {
    return values_.size() == tests && tests > 2 && !is_measured();
  }
  std::string same() const { return as_pattern(first_); }

  // A named group of `letters`; for measured parts the unit is added to the name.
  std::string group(std::string name, const std::string& letters, GuessedNames& guess) const {
    if (is_measured()) name += "_" + *units_.begin();
    guess.parts.push_back({name, list_of(is_measured() ? numbers_ : values_)});
    return is_measured() ? fmt::format("(?<{}>[\\d.,]+){}", name, *units_.begin())
                         : fmt::format("(?<{}>{})", name, letters);
  }

private:
  const std::string& first_;
  std::set<std::string> values_, numbers_, units_;
};

bool names_test(const GuessedNames& guess) {
  return std::any_of(guess.parts.begin(), guess.parts.end(),
                     [](const NamePart& part) { return part.group == "experiment"; });
}

// Pattern for one position of the files' own names, the `number`th from 1.
std::string part_of_name(const NamePlace& place, std::size_t number, std::size_t tests,
                         GuessedNames& guess) {
  const char* const letters = "[^_ /-]+";
  if (!place.differs()) return place.same();
  if (place.names_test(tests))
    return names_test(guess) ? letters : place.group("experiment", letters, guess);
  return place.group(fmt::format("{}{}", place.is_measured() ? "x" : "name", number), letters,
                     guess);
}

// Pattern of names with the same parts; empty for others.
std::string guess_parts(const std::vector<CutName>& names, GuessedNames& guess) {
  const CutName& first = names.front();
  if (std::any_of(names.begin(), names.end(),
                  [&](const CutName& name) { return name.signs != first.signs; }))
    return "";
  GuessedNames found;
  std::string pattern;
  for (std::size_t t = 0; t < first.tokens.size(); ++t) {
    std::vector<std::string> texts;
    for (const CutName& name : names)
      texts.push_back(name.tokens[t]);
    const NamePlace place(texts);
    if (place.has_empty() && place.differs()) return "";
    if (t > 0) pattern += as_pattern(first.signs.substr(t - 1, 1));
    pattern += part_of_name(place, t + 1, names.size(), found);
  }
  // A pattern that only distinguishes the tests is not needed: the file's own name does the same.
  if (found.parts.empty() || (found.parts.size() == 1 && names_test(found))) return "";
  guess.parts.insert(guess.parts.end(), found.parts.begin(), found.parts.end());
  return pattern;
}

// Pattern of the folders from the first one that differs, each followed by a /; empty if they give
// no information: all equal, at different depths, or one per file.
std::string guess_folders(const std::vector<std::string>& files, GuessedNames& guess) {
  std::vector<std::vector<std::string>> folders;
  std::set<std::string> all;
  for (const std::string& file : files) {
    const std::filesystem::path folder = std::filesystem::path(file).parent_path();
    all.insert(folder.string());
    folders.emplace_back();
    for (const auto& part : folder)
      folders.back().push_back(part.string());
    if (folders.back().size() != folders.front().size()) return "";
  }
  if (all.size() == files.size()) return "";
  std::string pattern;
  for (std::size_t level = 0; level < folders.front().size(); ++level) {
    std::vector<std::string> texts;
    for (const auto& folder : folders)
      texts.push_back(folder[level]);
    const NamePlace place(texts);
    const std::string number = guess.parts.empty() ? "" : std::to_string(guess.parts.size() + 1);
    if (place.differs())
      pattern += place.group("folder" + number, "[^/]+", guess) + "/";
    else if (!pattern.empty())
      pattern += place.same() + "/";
  }
  return pattern;
}

// The files' common extension, or any.
std::string end_of_names(const std::vector<std::string>& files) {
  std::set<std::string> extensions;
  for (const std::string& file : files)
    extensions.insert(std::filesystem::path(file).extension().string());
  return (extensions.size() == 1 ? as_pattern(*extensions.begin()) : "(\\.[^./]*)?") + "$";
}

} // namespace

GuessedNames guess_names(const std::vector<std::string>& files) {
  GuessedNames guess;
  if (files.size() < 2) return guess;
  std::vector<CutName> names;
  for (const std::string& file : files)
    names.push_back(cut(file));
  const std::string folders = guess_folders(files, guess);
  const std::string parts = guess_parts(names, guess);
  if (!parts.empty())
    guess.pattern = folders + parts + end_of_names(files);
  else if (!folders.empty())
    guess.pattern = folders + "[^/]*$";
  return guess;
}

} // namespace frictab::data
