// Compares JSON by keys, and sources by their lines without comments.
#include "verify/compare_text.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "codegen/number_text.h"
#include "core/text.h"
#include "io/json.h"
#include "verify/quoted.h"

namespace frictab::verify {

namespace {

using json = nlohmann::ordered_json;

constexpr std::size_t most_keys = 20; // shown of one file

using codegen::lines_of;
using Lines = std::vector<std::string_view>;
using Value = std::optional<std::string_view>; // of a key, or a line; empty: there is none

std::string shown(Value one, Value other) {
  return one ? quoted(*one, other.value_or("")) : "missing";
}

std::string made_as(Value is, Value wanted) {
  return fmt::format("is {}, made {}", shown(is, wanted),
                     wanted ? "as " + shown(wanted, is) : "without it");
}

Value line_at(const Lines& lines, std::size_t at) {
  return at < lines.size() ? Value(lines[at]) : Value();
}

// ---- JSON ----

class JsonComparison {
public:
  // `text` is the file's, which has to live as long.
  JsonComparison(const std::string& text, const std::string& file)
      : lines_(lines_of(text)), file_(file) {}

  // A null pointer: the key is missing.
  void compare(const json* is, const json* wanted, const std::string& path,
               const std::string& key) {
    if (is && wanted && *is == *wanted) return;
    if (is && wanted && is->is_object() && wanted->is_object()) {
      compare_members(*is, *wanted, path);
    } else if (is && wanted && is->is_array() && wanted->is_array() &&
               is->size() == wanted->size()) {
      for (std::size_t i = 0; i < wanted->size(); ++i)
        compare(&(*is)[i], &(*wanted)[i], fmt::format("{}[{}]", path, i), key);
    } else {
      const std::optional<std::string> one = text_of(is), other = text_of(wanted);
      compare_texts(one, other, path, is ? at_line(key, *is) : file_);
    }
  }

  std::vector<Finding> findings() { return std::move(findings_); }

private:
  void compare_members(const json& is, const json& wanted, const std::string& path) {
    const auto at = [](const json& object, const std::string& name) {
      const auto found = object.find(name);
      return found == object.end() ? nullptr : &*found;
    };
    const std::string before = path.empty() ? "" : path + ".";
    for (const auto& [name, value] : wanted.items())
      compare(at(is, name), &value, before + name, name);
    for (const auto& [name, value] : is.items())
      if (!wanted.contains(name)) compare(&value, nullptr, before + name, name);
  }

  static std::optional<std::string> text_of(const json* value) {
    if (!value) return std::nullopt;
    return value->is_string() ? value->get<std::string>() : value->dump();
  }

  // Names the first line that differs of a text of several lines, such as an input deck.
  void compare_texts(Value is, Value wanted, const std::string& path, const std::string& place) {
    const bool failed = path != "tool_version";
    const Lines one = lines_of(is.value_or("")), other = lines_of(wanted.value_or(""));
    if (!is || !wanted || other.size() < 2) {
      findings_.push_back({"", place, path, made_as(is, wanted), "", failed});
      return;
    }
    const auto at = static_cast<std::size_t>(
        std::mismatch(one.begin(), one.end(), other.begin(), other.end()).first - one.begin());
    findings_.push_back({"", place, fmt::format("line {} of {}", at + 1, path),
                         made_as(line_at(one, at), line_at(other, at)), "", failed});
  }

  // The file, with the line if exactly one holds this key and value, or this element of a list.
  std::string at_line(const std::string& key, const json& value) const {
    const std::string dump = value.dump(), member = json(key).dump() + ": " + dump;
    std::size_t found = 0, line = 0;
    for (std::size_t i = 0; i < lines_.size(); ++i)
      if (lines_[i].find(member) != std::string::npos ||
          (lines_[i].find_first_not_of(' ') != std::string::npos &&
           lines_[i].compare(lines_[i].find_first_not_of(' '), dump.size(), dump) == 0)) {
        ++found;
        line = i + 1;
      }
    return found == 1 ? fmt::format("{}:{}", file_, line) : file_;
  }

  Lines lines_;
  std::string file_;
  std::vector<Finding> findings_;
};

// ---- sources ----

struct Language {
  std::string at_start;    // characters that make a line a comment in its first column
  std::string to_the_end;  // begins a comment anywhere; empty: none
  std::string quotes;      // of texts, in which no comment begins
  bool is_c = false;       // blocks of comments, \" in texts, lines that go on after a backslash
  bool fixed_form = false; // what stands in column 6 goes on with the line before
};

Language language_of(const std::string& file) {
  const std::string ending = std::filesystem::path(file).extension().string();
  if (ending == ".f") return {"Cc*", "!", "'\"", false, true};
  if (ending == ".f90") return {"", "!", "'\""};
  if (ending == ".c" || ending == ".h") return {"", "//", "'\"", true};
  if (ending == ".lua") return {"", "--", "'\""};
  if (ending == ".mac") return {"", "!", "'"};
  if (ending == ".sh") return {"#", "", ""};
  if (ending == ".k") return {"$", "", ""};
  return {};
}

// Some comments are read: !DIR$, !$OMP, !GCC$, #! of a shell script, a C comment that goes on in
// the next line.
bool is_directive(std::string_view comment) {
  return comment.substr(0, 6).find('$') != std::string_view::npos || comment.starts_with("#!") ||
         comment.ends_with("\\");
}

struct CodeLine {
  std::size_t number; // from 1
  std::string text;
  bool operator==(const CodeLine& other) const { return text == other.text; }
};

// Returns the lines without comments, without blanks at their ends, and without empty lines.
class CodeReader {
public:
  explicit CodeReader(Language language) : language_(std::move(language)) {}

  std::vector<CodeLine> code(const std::string& text) {
    std::vector<CodeLine> out;
    const Lines lines = lines_of(text);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      std::string left = without_comments(lines[i]);
      left.resize(left.find_last_not_of(" \t\r") + 1);
      if (!left.empty()) out.push_back({i + 1, left});
    }
    return out;
  }

private:
  std::string without_comments(std::string_view line) {
    if (!line.empty() && language_.at_start.find(line[0]) != std::string::npos &&
        (language_.at_start == "$" || !is_directive(line)))
      return "";
    std::string left;
    char quote = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
      const std::string_view rest = line.substr(i);
      if (in_block_) {
        if (!rest.starts_with("*/")) continue;
        in_block_ = false;
        ++i;
        left += ' '; // as a compiler takes it
      } else if (quote != 0) {
        quote = line[i] == quote ? 0 : quote;
        left += line[i];
        if (language_.is_c && line[i] == '\\' && i + 1 < line.size()) left += line[++i];
      } else if (language_.is_c && rest.starts_with("/*")) {
        in_block_ = true;
        ++i;
      } else if (!language_.to_the_end.empty() && rest.starts_with(language_.to_the_end) &&
                 !is_directive(rest) && !(language_.fixed_form && i == 5)) {
        return left;
      } else {
        if (language_.quotes.find(line[i]) != std::string::npos) quote = line[i];
        left += line[i];
      }
    }
    return left;
  }

  Language language_;
  bool in_block_ = false;
};

} // namespace

std::vector<Finding> compare_json(const std::string& text, const std::string& wanted,
                                  const std::string& file) {
  if (text == wanted) return {};
  JsonComparison comparison(text, file);
  const json is = io::parse_json(text, file), made = io::parse_json(wanted, file);
  comparison.compare(&is, &made, "", "");
  std::vector<Finding> findings = comparison.findings();
  if (findings.empty())
    findings.push_back({"", file, "",
                        "is laid out otherwise than it was written; its values are "
                        "right",
                        "", false});
  if (findings.size() > most_keys) {
    const std::size_t more = findings.size() - most_keys;
    findings.resize(most_keys);
    findings.push_back({"", file, "", "differs in " + thousands(more) + " more keys", ""});
  }
  return findings;
}

std::vector<Finding> compare_source(const std::string& text, const std::string& wanted,
                                    const std::string& file) {
  if (text == wanted) return {};
  const std::vector<CodeLine> is = CodeReader(language_of(file)).code(text),
                              made = CodeReader(language_of(file)).code(wanted);
  const auto [here, there] = std::mismatch(is.begin(), is.end(), made.begin(), made.end());
  const bool comments = here == is.end() && there == made.end();
  if (comments) {
    const Lines one = lines_of(text), other = lines_of(wanted);
    const auto at = std::mismatch(one.begin(), one.end(), other.begin(), other.end()).first;
    return {{"", fmt::format("{}:{}", file, at - one.begin() + 1), "",
             "only comments and blanks differ from what is generated", "", false}};
  }
  const bool is_end = here == is.end(), made_end = there == made.end();
  return {{"", is_end ? file : fmt::format("{}:{}", file, here->number), "",
           made_as(is_end ? Value() : Value(here->text), made_end ? Value() : Value(there->text)),
           ""}};
}

std::vector<Finding> compare_bundle(const codegen::SourceBundle& is,
                                    const codegen::SourceBundle& wanted,
                                    const std::string& folder) {
  std::vector<Finding> findings;
  for (const auto& [name, text] : wanted) {
    const std::string file = folder + "/" + name;
    const auto own = is.find(name);
    std::vector<Finding> of_file;
    if (own == is.end())
      of_file = {{"", file, "", "is generated, but recipe.json does not list it", ""}};
    else if (std::filesystem::path(name).extension() == ".json")
      of_file = compare_json(own->second, text, file);
    else
      of_file = compare_source(own->second, text, file);
    findings.insert(findings.end(), of_file.begin(), of_file.end());
  }
  return findings;
}

} // namespace frictab::verify
