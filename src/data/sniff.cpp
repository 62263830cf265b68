// By trying: the dialect in which most cells are numbers under names that are none.
#include "data/sniff.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "core/units.h"
#include "data/quantity.h"
#include "data/raw.h"
#include "io/hdf5.h"
#include "io/number.h"

namespace frictab::data {

namespace {

// ---- what columns are called ----

struct Names {
  const char* canonical;
  bool coefficient;
  std::vector<std::string> whole; // the name is one of these
  std::vector<std::string> part;  // or holds one of these
};

// Lower case, without units, blanks for signs.
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

// 3: the canonical name; 2: a whole name; 1: part of one; 0: no such column.
int likeness(const Names& names, const GuessedColumn& column) {
  if (column.name == names.canonical && !names.coefficient) return 3;
  const Quantity* quantity = find_quantity(names.canonical);
  const std::string wanted = names.coefficient || !quantity ? "1" : quantity->unit;
  if (quantity && !column.unit.empty() && !convert(column.unit, wanted)) return 0;
  if (quantity && column.text) return 0;
  const std::string name = plain(io::read_header_name(column.name).name);
  if (std::find(names.whole.begin(), names.whole.end(), name) != names.whole.end()) return 2;
  return std::any_of(names.part.begin(), names.part.end(),
                     [&](const std::string& part) { return name.find(part) != name.npos; });
}

// Each name of a quantity goes to the column most like it, the first one of equals.
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

// Cells that are numbers, less those that are in the way.
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
  if (format.units_row && 2 * units < std::max<std::size_t>(unit_cells, 1)) return -1;
  return sum;
}

class Dialects {
public:
  explicit Dialects(std::string_view text, const std::string& named, bool workbook)
      : text_(text), named_(named) {
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
    if (!(most_ > 0))
      throw InputError({named, 0, 0}, "no table of numbers under a line of names was found",
                       "frictab init DIR writes a job with every key, to be filled in by hand");
  }

  io::CsvFormat best;
  io::CsvTable table; // by the best

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
    } catch (const InputError&) { // not so
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

// A column that numbers the rows names no test.
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

bool GuessedFile::reads_like(const GuessedFile& other) const {
  const auto named = [](const GuessedFile& guess) {
    std::set<std::string> names;
    for (const GuessedColumn& column : guess.columns)
      if (!column.canonical.empty())
        names.insert(column.canonical + "=" + column.name + "/" + column.unit);
    return names;
  };
  return decimal == other.decimal && thousands == other.thousands && units_row == other.units_row &&
         intervals == other.intervals && named(*this) == named(other);
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
    guess.skip_rows = dialects.best.skip_rows;
    guess.units_row = dialects.best.units_row;
    guess.intervals = !table.interval.empty() && table.interval.back() > 0;
  }
  guess.columns = columns_of(table);
  check_experiment(guess, table);
  return guess;
}

// ---- names of files ----

namespace {

struct Token {
  std::string text, number, unit; // "20mm": 20, mm
};

Token token_of(const std::string& text) {
  std::size_t end = 0;
  while (end < text.size() && (std::isdigit(static_cast<unsigned char>(text[end])) ||
                               text[end] == '.' || text[end] == ','))
    ++end;
  const bool trailing = end > 0 && !std::isdigit(static_cast<unsigned char>(text[end - 1]));
  if (end == 0 || trailing) return {text, "", ""};
  const std::string behind = text.substr(end);
  const bool letters = std::all_of(behind.begin(), behind.end(), [](char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0;
  });
  return letters ? Token{text, text.substr(0, end), behind} : Token{text, "", ""};
}

struct CutName {
  std::vector<Token> tokens;
  std::string signs; // between them
};

CutName cut(const std::string& file) {
  CutName name;
  std::string token;
  for (const char c : std::filesystem::path(file).stem().string()) {
    if (c != '_' && c != '-' && c != ' ') {
      token += c;
      continue;
    }
    name.tokens.push_back(token_of(token));
    name.signs += c;
    token.clear();
  }
  name.tokens.push_back(token_of(token));
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

std::string list_of(const std::set<std::string>& values) {
  return join(std::vector<std::string>(values.begin(), values.end()), ", ");
}

// The tokens of all names at one place, as a part of the pattern.
class NamePlace {
public:
  NamePlace(const std::vector<CutName>& names, std::size_t number)
      : number_(number), first_(names.front().tokens[number]) {
    for (const CutName& name : names) {
      const Token& token = name.tokens[number];
      values.insert(token.text);
      units_.insert(token.unit);
      numbers_ = numbers_ && !token.number.empty();
    }
  }

  // `tests`: how many there are; `named`: whether another part names them.
  std::string pattern(std::size_t tests, bool named, GuessedNames& guess) const {
    if (values.size() == 1) return as_pattern(first_.text);
    if (values.size() == tests && tests > 2) {
      if (named) return "[^_ -]+";
      guess.parts.push_back({"experiment", list_of(values)});
      return "(?<experiment>[^_ -]+)";
    }
    const bool measured = numbers_ && units_.size() == 1 && !units_.begin()->empty();
    const std::string group = measured ? fmt::format("x{}_{}", number_ + 1, *units_.begin())
                                       : fmt::format("name{}", number_ + 1);
    guess.parts.push_back({group, list_of(values)});
    return measured ? fmt::format("(?<{}>[\\d.,]+){}", group, *units_.begin())
                    : fmt::format("(?<{}>[^_ -]*)", group);
  }

  std::set<std::string> values;

private:
  std::size_t number_;
  const Token& first_;
  std::set<std::string> units_;
  bool numbers_ = true;
};

bool names_test(const GuessedNames& guess) {
  return std::any_of(guess.parts.begin(), guess.parts.end(),
                     [](const NamePart& part) { return part.group == "experiment"; });
}

// Of names that are cut alike.
void guess_parts(const std::vector<CutName>& names, GuessedNames& guess) {
  const CutName& first = names.front();
  if (std::any_of(names.begin(), names.end(),
                  [&](const CutName& name) { return name.signs != first.signs; }))
    return;
  std::string pattern;
  for (std::size_t t = 0; t < first.tokens.size(); ++t) {
    if (t > 0) pattern += first.signs[t - 1];
    pattern += NamePlace(names, t).pattern(names.size(), names_test(guess), guess);
  }
  // A number that tells the tests apart and nothing else: the file's own name does as well.
  if (guess.parts.size() == 1 && names_test(guess)) guess.parts.clear();
  if (!guess.parts.empty()) guess.pattern = pattern;
}

} // namespace

GuessedNames guess_names(const std::vector<std::string>& files) {
  GuessedNames guess;
  if (files.size() < 2) return guess;
  std::vector<CutName> names;
  std::set<std::string> folders;
  for (const std::string& file : files) {
    names.push_back(cut(file));
    folders.insert(std::filesystem::path(file).parent_path().filename().string());
  }
  guess_parts(names, guess);
  if (folders.size() > 1 && folders.size() < files.size()) {
    guess.pattern = "(?<folder>[^/]+)/" + (guess.pattern.empty() ? "[^/]*$" : guess.pattern);
    guess.parts.insert(guess.parts.begin(), {"folder", list_of(folders)});
  }
  return guess;
}

} // namespace frictab::data
