// Fills templates/fortran/frictab_combined.f and writes the recipe of several laws.
#include "codegen/combine.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "codegen/fixed_form.h"
#include "codegen/fortran_parts.h"
#include "codegen/number_text.h"
#include "codegen/prefix.h"
#include "codegen/read_me.h"
#include "codegen/recipe.h"
#include "core/error.h"
#include "core/text.h"
#include "core/version.h"
#include "io/json.h"

namespace frictab::codegen {

namespace {

using json = nlohmann::ordered_json;

// Longest name that fits its own line: '     &  ' and quotes, within 72 columns.
constexpr std::size_t longest_law_name = 50;

constexpr std::size_t laws_per_letter = 9;

// Unit that DEFORM's USRUPD calls, once for all laws.
constexpr const char* called_by_solver = "ftupd";

// ---- names ----

std::string fault_of(const std::string& name, const LawSelector& by) {
  const auto all = [&](auto fits) { return std::all_of(name.begin(), name.end(), fits); };
  if (by.number) {
    const bool digits = all([](unsigned char c) { return std::isdigit(c); });
    if (digits && !name.empty() && name[0] != '0' && name.size() <= 9) return "";
    return "is not a " + by.meaning;
  }
  const auto printed = [](unsigned char c) { return c >= 32 && c < 127 && c != '\''; };
  if (name.empty() || !all(printed) || name.front() == ' ' || name.back() == ' ')
    return "is not a " + by.meaning;
  if (name.size() > longest_law_name)
    return fmt::format("has {} characters; {} are allowed", name.size(), longest_law_name);
  return "";
}

void check_names(const std::vector<std::string>& names, const LawSelector& by) {
  FaultList faults;
  std::set<std::string> seen;
  for (const std::string& name : names) {
    const std::string fault = fault_of(name, by);
    if (!fault.empty())
      faults.add({}, fmt::format("'{}' {}", name, fault),
                 "--combine NAME=TABLE, as the deck has it");
    else if (!seen.insert(lower_case(name)).second)
      faults.add({}, fmt::format("two laws for '{}'", name),
                 "each name once; decks do not distinguish small letters from capitals");
  }
  faults.throw_if_any();
}

std::string upper_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return std::toupper(c); });
  return text;
}

// ---- other names for program units ----

bool is_comment(std::string_view line) {
  return !line.empty() && (line[0] == 'C' || line[0] == 'c' || line[0] == '*' || line[0] == '!');
}

// Replaces every word of a line that is not in quotes by `word(text)`.
template <class Word> std::string with_words(std::string_view line, const Word& word) {
  const auto part_of_word = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
  };
  const bool comment = is_comment(line);
  bool quoted = false;
  std::string out;
  for (std::size_t at = 0; at < line.size();) {
    std::size_t end = at;
    while (end < line.size() && part_of_word(line[end]))
      ++end;
    if (end > at && !quoted) {
      out += word(std::string(line.substr(at, end - at)));
    } else {
      end = std::max(end, at + 1);
      if (line[at] == '\'' && !comment) quoted = !quoted;
      out += line.substr(at, end - at);
    }
    at = end;
  }
  return out;
}

// Returns the words of statements, in small letters.
std::set<std::string> words_of_statements(const std::vector<std::string_view>& lines) {
  std::set<std::string> words;
  for (const std::string_view line : lines)
    if (!is_comment(line))
      with_words(line, [&](const std::string& word) {
        words.insert(lower_case(word));
        return word;
      });
  return words;
}

// Returns the names that a linker sees, of units and COMMON blocks, in small letters.
std::set<std::string> linked_names(const SourceBundle& sources) {
  std::set<std::string> names;
  for (const auto& [path, text] : sources) {
    if (!path.ends_with(".f")) continue;
    for (const std::string_view line : lines_of(text)) {
      const auto has = [&](const char* word) { return line.find(word) != line.npos; };
      if (has("subroutine ") || has("function ") || has("common /") || has("block data "))
        names.merge(words_of_statements({line}));
    }
  }
  std::erase_if(names, [](const std::string& word) {
    return word.size() < 3 || !word.starts_with("ft") || word == called_by_solver;
  });
  return names;
}

// Renames fttau -> f1tau, FTCONS -> F1CONS; returns other words unchanged.
std::string renamed(const std::string& word, const std::set<std::string>& names,
                    const std::string& stem) {
  if (!names.count(lower_case(word))) return word;
  return (word[0] == 'f' ? stem : upper_case(stem)) + word.substr(2);
}

// Checks that no name continues in the next line, because renaming could not find it.
void check_whole_words(const std::vector<std::string_view>& lines) {
  const auto in_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::string_view before = lines[i - 1], line = lines[i];
    const bool goes_on = !is_comment(line) && line.size() > 6 && line[5] != ' ';
    if (goes_on && !before.empty() && !is_comment(before) && in_word(before.back()) &&
        in_word(line[6]))
      throw std::logic_error("a name is cut between two lines: " + std::string(before));
  }
}

// True if the source, or one of its lines, has the head of this entry.
bool holds(std::string_view source, const std::string& entry) {
  return source.find("      subroutine " + entry) != source.npos;
}

constexpr std::size_t last_column = 72;

// Returns the place after the last blank, comma or bracket that fits and is not in quotes.
std::size_t place_of_cut(const std::string& line) {
  bool quoted = false;
  std::size_t last = 0;
  const std::size_t first = line.find_first_not_of(" &");
  for (std::size_t at = 0; at < last_column; ++at) {
    if (line[at] == '\'' && !is_comment(line)) quoted = !quoted;
    const bool between = line[at] == ' ' || line[at] == ',' || line[at] == '(';
    if (!quoted && at > first + 1 && between) last = at + 1;
  }
  if (last == 0) throw std::logic_error("cannot be cut at column 72: " + line);
  return last;
}

// Continues a line that ends beyond column 72 in further lines.
std::string within_columns(std::string line) {
  std::string out;
  const char* const begin = is_comment(line) ? "C       " : "     &  ";
  while (line.size() > last_column) {
    const std::size_t at = place_of_cut(line);
    out += line.substr(0, line.find_last_not_of(' ', at - 1) + 1) + "\n";
    line = begin + line.substr(at);
  }
  return out + line;
}

// Returns one law's source as one of several: its linked names and its entry get another stem, in
// statements and comments. Texts in quotes are unchanged. No entry: it keeps its name.
std::string with_stem(const std::string& source, const std::set<std::string>& names,
                      const std::string& entry, const std::string& stem) {
  const std::vector<std::string_view> lines = lines_of(source);
  check_whole_words(lines);
  const std::set<std::string> words = words_of_statements(lines);
  for (const std::string& name : names)
    if (words.count(renamed(name, names, stem)))
      throw std::logic_error("two meanings of " + renamed(name, names, stem));
  std::string out;
  for (const std::string_view line : lines) {
    const bool heads = !entry.empty() && holds(line, entry);
    out += within_columns(with_words(line,
                                     [&](const std::string& word) {
                                       return heads && word == entry ? stem + entry
                                                                     : renamed(word, names, stem);
                                     })) +
           "\n";
  }
  return out;
}

// ---- the entry ----

// Returns the names between the brackets of "subroutine vfric(...)".
std::string argument_names(const std::string& arguments) {
  std::string code;
  for (const std::string_view line : lines_of(arguments))
    if (!is_comment(line) && line.size() > 6) code += line.substr(6);
  const std::size_t open = code.find('('), close = code.find(')');
  std::string names;
  for (const char c : code.substr(open + 1, close - open - 1))
    if (c != ' ') names += c == ',' ? std::string(", ") : std::string(1, c);
  return names;
}

// Compares names in both cases, because decks are converted to capitals except for names in quotes.
std::string condition(const std::string& name, const LawSelector& by) {
  if (by.number) return fmt::format("{} .eq. {}", by.argument, name);
  const auto is = [&](const std::string& text) {
    return fmt::format("{} .eq.\n     &  '{}'", by.argument, text);
  };
  const std::string capitals = upper_case(name);
  return is(capitals) + (capitals == name ? "" : "\n     &  .or. " + is(name));
}

std::string about_law(const ExportRequest& law) {
  return fmt::format("{}: {}", law.law_name, law.table.model);
}

std::string comment_lines(const std::string& text) {
  std::string out;
  for (const TemplateValues& line : fortran::comments({text}))
    out += (out.empty() ? "C     " : "\nC     ") + line.text.at("text");
  return out;
}

// Returns the ftquit with which the entry ends the analysis if a contact has no law.
std::string own_quit(const Combination& c, const std::string& stem) {
  const std::set<std::string> names = linked_names({{"quit.f", c.quit}});
  return without_last_break(with_stem(c.quit, names, c.entry, stem));
}

std::string combined_source(const Combination& c, const std::vector<ExportRequest>& laws,
                            const std::vector<std::string>& sources) {
  TemplateValues values;
  values.text = {{"title", c.exporter.title},
                 {"version", tool_version()},
                 {"arguments", without_last_break(c.arguments)},
                 {"guard", without_last_break(c.by.guard)},
                 {"argument", c.by.argument},
                 {"stem", entry_stem(laws.front())},
                 {"quit", own_quit(c, entry_stem(laws.front()))}};
  values.flags["number"] = c.by.number;
  values.lists["about"] = fortran::comments(
      {fmt::format("{} ({}) says which; any other ends the analysis.", c.by.argument, c.by.meaning),
       "Each law follows as it is alone, its program units under letters of its own."});
  const std::string names = argument_names(c.arguments);
  for (std::size_t i = 0; i < laws.size(); ++i) {
    values.lists["laws"].push_back(
        {.text = {
             {"about", comment_lines(about_law(laws[i]))},
             {"condition", condition(laws[i].law_name, c.by)},
             {"call", fixed_form(fmt::format("  call {}{}({})", stem(laws[i]), c.entry, names))}}});
    values.lists["sources"].push_back(item(without_last_break(sources[i])));
  }
  return render_template("fortran/frictab_combined.f", values);
}

// ---- the recipe ----

std::string deck_of(std::string deck, const std::string& name, const LawSelector& by) {
  for (const auto& [from, to] : by.deck)
    for (std::size_t at = 0; (at = deck.find(from, at)) != std::string::npos;) {
      std::string text = to;
      text.replace(text.find('@'), 1, name);
      if (by.number && text.size() < from.size()) text.insert(0, from.size() - text.size(), ' ');
      deck.replace(at, from.size(), text);
      at += text.size();
    }
  return deck;
}

// Keys of a recipe that describe the law and not the routine.
const std::vector<std::string> of_law = {
    "model",           "form",         "data_origin", "values_file", "options",
    "dimension",       "arguments",    "result",      "acts_when",   "state_variables_by",
    "state_variables", "properties",   "constants",   "build",       "input_deck",
    "include",         "include_file", "table"};

json law_recipe(const json& alone, const ExportRequest& law, const Combination& c) {
  json out = {{"name", law.law_name}, {"entry", stem(law) + c.entry}};
  for (const std::string& key : of_law)
    if (alone.contains(key)) out[key] = alone[key];
  out["export"] = {{"inputs", law.inputs}, {"options", law.options}};
  out["input_deck"] = deck_of(out.at("input_deck"), law.law_name, c.by);
  if (out.contains("include"))
    for (const char* const lines : {"lines", "of_model"})
      out["include"][lines] = deck_of(out["include"][lines], law.law_name, c.by);
  return out;
}

json combined_recipe(const Combination& c, const std::vector<ExportRequest>& laws,
                     const std::vector<std::string>& recipes, const SourceBundle& files) {
  json out = io::parse_json(recipes.front(), "recipe.json");
  out["schema"] = combined_schema;
  for (const std::string& key : of_law)
    out.erase(key);
  out["files"] = recipe_files(files);
  out["told_apart_by"] = c.exporter.several_laws + "; any other ends the analysis";
  out["laws_note"] =
      "the deck needs the lines of all laws; keywords that are there once per model, "
      "as *Contact or *CONTROL_CONTACT, once, with the larger numbers";
  if (!c.by.user_file.empty()) out["user_file"] = c.by.user_file;
  out["laws"] = json::array();
  for (std::size_t i = 0; i < laws.size(); ++i)
    out["laws"].push_back(law_recipe(io::parse_json(recipes[i], "recipe.json"), laws[i], c));
  return out;
}

// Renames the units in a recipe as in its law's sources.
std::string recipe_with_stem(const std::string& recipe, const std::set<std::string>& names,
                             const std::string& stem) {
  return with_words("C" + recipe,
                    [&](const std::string& word) { return renamed(word, names, stem); })
      .substr(1);
}

// Checks a file other than the entry's. It is kept once for all laws, so it must not depend on one
// of them; ftnan is part of all laws.
void check_further(const std::string& path, const std::string& source,
                   const std::set<std::string>& names, const ExportRequest& law) {
  for (const std::string& word : words_of_statements(lines_of(source)))
    if (names.count(word) && word != "ftnan")
      throw InputError({},
                       fmt::format("{}: {} would keep histories of this law alone, and nothing "
                                   "says there which law a node meets",
                                   law.law_name, path),
                       "laws that take slip, friction work and peak pressure at most");
}

// Returns the files of a law as parts of the combined bundle.
SourceBundle one_of_several(const SourceBundle& alone, const ExportRequest& law,
                            const std::string& entry) {
  const std::string own = stem(law);
  const std::set<std::string> names = linked_names(alone);
  SourceBundle out;
  for (const auto& [path, text] : alone) {
    const bool source = path.ends_with(".f");
    if (source && !holds(text, entry)) check_further(path, text, names, law);
    out[path] = source ? with_stem(text, names, entry, own) : text;
  }
  out["recipe.json"] = recipe_with_stem(alone.at("recipe.json"), names, own);
  return with_prefix(out, law);
}

} // namespace

std::vector<ExportRequest> named_laws(std::vector<ExportRequest> laws,
                                      const std::vector<std::string>& names,
                                      const LawSelector& by) {
  const std::size_t most = laws_per_letter * by.letters.size();
  if (laws.empty() || laws.size() > most)
    throw InputError(
        {}, fmt::format("{} laws to combine; from 1 to {} go into one file", laws.size(), most));
  check_names(names, by);
  for (std::size_t i = 0; i < laws.size(); ++i) {
    laws[i].law_name = names[i];
    laws[i].law_stem = {by.letters[i / laws_per_letter],
                        static_cast<char>('1' + i % laws_per_letter)};
  }
  return laws;
}

std::string stem(const ExportRequest& request) {
  if (has_prefix(request)) return lower_case(prefix(request)) + "_";
  return request.law_stem.empty() ? "ft" : request.law_stem;
}

std::string entry_stem(const ExportRequest& request) {
  return request.law_stem.empty() ? stem(request) : request.law_stem.substr(0, 1) + "0";
}

SourceBundle under_prefix(const SourceBundle& bundle, const ExportRequest& request) {
  if (!has_prefix(request)) return bundle;
  const std::string own = stem(request);
  const std::set<std::string> names = linked_names(bundle);
  SourceBundle out = with_prefix(bundle, request);
  for (auto& [path, text] : out) {
    if (path.ends_with(".f")) {
      for (const std::string& word : words_of_statements(lines_of(text)))
        if (word.starts_with(own) && names.count("ft" + word.substr(own.size())))
          throw InputError(at_job_key("export.options", "prefix"),
                           fmt::format("{} is already a name in {}", word, path), "another prefix");
      text = with_stem(text, names, "", own);
    } else if (path == "recipe.json") {
      text = recipe_with_stem(text, names, own);
    }
  }
  return out;
}

SourceBundle combine(const Combination& c, const std::vector<ExportRequest>& laws,
                     const std::vector<SourceBundle>& bundles) {
  SourceBundle out;
  std::string file;
  std::vector<std::string> sources, recipes;
  for (std::size_t i = 0; i < laws.size(); ++i)
    for (const auto& [path, text] : one_of_several(bundles[i], laws[i], c.entry)) {
      if (path == "recipe.json") {
        recipes.push_back(text);
      } else if (path.ends_with(".f") && holds(text, stem(laws[i]) + c.entry)) {
        file = path;
        sources.push_back(text);
      } else {
        out.emplace(path, text);
      }
    }
  out[file] = combined_source(c, laws, sources);
  out["recipe.json"] = io::json_text(combined_recipe(c, laws, recipes, out));
  return explained(out, c.exporter);
}

} // namespace frictab::codegen
