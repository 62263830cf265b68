// Reads one value of a job file: type, bounds and allowed names, with a message that names the key.
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <sstream>

#include <fmt/format.h>

#include "core/text.h"
#include "job/literature.h"
#include "job/reader.h"
#include "models/law.h"

namespace frictab::job {

namespace {

using Type = TomlNode::Type;

struct ValueReader {
  JobReader& reader;
  const KeyRule& rule;
  const std::string& path;

  std::string about() const {
    const std::string normal = default_text(rule);
    return normal.empty() ? rule.meaning : rule.meaning + "; default " + normal;
  }

  std::string type_hint(const TomlNode& node) const {
    const bool wants_number = rule.type == KeyType::whole || rule.type == KeyType::number ||
                              rule.type == KeyType::automatic;
    const bool wants_text = rule.type == KeyType::text || rule.type == KeyType::texts;
    if (node.type == Type::text && rule.type == KeyType::flag) return "write true or false";
    if (node.type == Type::text && wants_number &&
        node.text.find_first_not_of("+-.,0123456789eE") == node.text.npos)
      return rule.type == KeyType::whole ? "write the number without quotes"
                                         : "write the number without quotes, with a decimal point";
    if (wants_text && (node.type == Type::whole || node.type == Type::number))
      return "a text stands in quotes";
    return about();
  }

  std::nullopt_t refuse(const TomlNode& node) const {
    reader.fault(node.place,
                 fmt::format("{} must be {}, not {}", path, expected(rule), describe(node)),
                 type_hint(node));
    return std::nullopt;
  }

  bool inside(double value) const {
    const ValueBounds& b = rule.bounds;
    return std::isfinite(value) && (b.open_lower ? value > b.lower : value >= b.lower) &&
           (b.open_upper ? value < b.upper : value <= b.upper);
  }

  std::optional<double> number(const TomlNode& node) const {
    if (node.type == Type::whole) return static_cast<double>(node.whole);
    if (node.type == Type::number) return node.number;
    return std::nullopt;
  }

  // Returns the text in the schema's spelling.
  std::optional<std::string> text(const TomlNode& node) const {
    if (node.type != Type::text) return refuse(node);
    if (node.text.find('\0') != node.text.npos) { // the system would cut the path off there
      reader.fault(node.place, path + " holds a NUL character (\\u0000)", "leave it out");
      return std::nullopt;
    }
    if (!rule.allowed.names) {
      if (!node.text.empty()) return node.text;
      reader.fault(node.place, path + " must not be an empty text", about());
      return std::nullopt;
    }
    std::vector<std::string> names = rule.allowed.names();
    if (rule.allowed.laws)
      names.insert(names.end(), reader.own_laws.begin(), reader.own_laws.end());
    const auto same = [&](const std::string& name) {
      return rule.allowed.any_case
                 ? std::equal(name.begin(), name.end(), node.text.begin(), node.text.end(),
                              [](char a, char b) { return std::tolower(a) == std::tolower(b); })
                 : name == node.text;
    };
    const auto found = std::ranges::find_if(names, same);
    if (found != names.end()) return *found;
    if (rule.allowed.traced && is_traced_law(node.text)) return node.text;
    if (rule.allowed.noun.empty()) {
      const std::string near = nearest_name(node.text, names);
      const std::string hint = near.empty() || node.text.size() < 2
                                   ? about()
                                   : fmt::format("did you mean {}?", toml_quoted(near));
      reader.fault(node.place,
                   fmt::format("{} must be {}, not {}", path, expected(rule), describe(node)),
                   hint);
    } else {
      reader.fault(
          node.place,
          fmt::format("unknown {} {} in {}", rule.allowed.noun, in_quotes(node.text), path),
          node.text.find(',') == node.text.npos ? suggest(node.text, names)
                                                : "several are a list: " + as_list(node.text));
    }
    return std::nullopt;
  }

  // Converts "a,b" of a command line to the form of a job: ["a", "b"].
  static std::string as_list(const std::string& text) {
    std::istringstream names(text);
    std::string list;
    for (std::string name; std::getline(names, name, ',');)
      list += (list.empty() ? "" : ", ") +
              toml_quoted(name.substr(std::min(name.find_first_not_of(' '), name.size())));
    return "[" + list + "]";
  }

  bool is_traced_law(const std::string& text) const {
    const models::ModelName name = models::read_model_name(text, literature());
    if (!name.traced || name.quantile) return false;
    return name.base || std::ranges::any_of(reader.own_laws, [&](const std::string& law) {
             return text == models::traced_name(law);
           });
  }

  std::optional<std::vector<std::string>> texts(const TomlNode& node) const {
    std::vector<std::string> out;
    if (node.type == Type::text) {
      if (auto one = text(node)) return std::vector<std::string>{*one};
      return std::nullopt;
    }
    if (node.type != Type::array) return refuse(node);
    // An empty list is allowed only for keys where "none" is a choice: to keep, ignore or write
    // nothing.
    if (node.items.empty() && path != "data.bystanders" && path != "data.allow_implausible" &&
        path != "trace.ignore" && path != "export.targets") {
      reader.fault(node.place, path + " is an empty list",
                   "leave the key out for: " +
                       (rule.absent.empty() ? default_text(rule) : rule.absent));
      return std::nullopt;
    }
    bool good = true;
    std::set<std::string> seen;
    // Lists of a few fixed words may repeat them: their position in the list has a meaning.
    const bool may_repeat = rule.allowed.names && rule.allowed.noun.empty();
    for (const TomlNode& item : node.items) {
      const auto one = text(item);
      good = good && one;
      if (!one) continue;
      out.push_back(*one);
      if (!seen.insert(*one).second && !may_repeat) {
        reader.fault(item.place, fmt::format("{} is named twice in {}", in_quotes(*one), path),
                     "name it once");
        good = false;
      }
    }
    return good ? std::optional(out) : std::nullopt;
  }

  std::optional<KeyValue> numbers(const TomlNode& node) const {
    const bool list = node.type == Type::array && !node.items.empty();
    std::vector<double> out;
    for (const TomlNode& item : list ? node.items : std::vector<TomlNode>{node}) {
      const auto value = number(item);
      if (!value || !inside(*value)) return refuse(item);
      if (std::ranges::find(out, *value) != out.end()) {
        reader.fault(item.place, fmt::format("{} holds {} twice", path, *value), "name it once");
        return std::nullopt;
      }
      out.push_back(*value);
    }
    return out;
  }

  std::optional<KeyValue> range(const TomlNode& node) const {
    if (node.type != Type::array || node.items.size() != 2) return refuse(node);
    const auto low = number(node.items[0]), high = number(node.items[1]);
    if (!low || !high || !std::isfinite(*low) || !std::isfinite(*high)) return refuse(node);
    if (*low < *high) return std::pair(*low, *high);
    reader.fault(node.place, fmt::format("{} must rise, not go from {} to {}", path, *low, *high),
                 *low > *high ? fmt::format("write [{}, {}]", *high, *low)
                              : "an axis needs two different ends; a constant quantity needs none");
    return std::nullopt;
  }

  std::optional<KeyValue> convert(const TomlNode& node) const {
    switch (rule.type) {
    case KeyType::text:
      if (auto value = text(node)) return *value;
      return std::nullopt;
    case KeyType::column:
      if (node.type == Type::whole && inside(static_cast<double>(node.whole)))
        return static_cast<std::uint64_t>(node.whole);
      if (node.type != Type::text && node.type != Type::array) return refuse(node);
      [[fallthrough]];
    case KeyType::texts:
      if (auto value = texts(node)) return *value;
      return std::nullopt;
    case KeyType::whole:
      if (node.type != Type::whole || !inside(static_cast<double>(node.whole))) return refuse(node);
      return static_cast<std::uint64_t>(node.whole);
    case KeyType::number: {
      const auto value = number(node);
      if (!value || !inside(*value)) return refuse(node);
      return *value;
    }
    case KeyType::automatic: {
      if (node.type == Type::text && node.text == "auto") return node.text;
      const auto value = number(node);
      if (!value || !inside(*value)) return refuse(node);
      return *value;
    }
    case KeyType::numbers:
      return numbers(node);
    case KeyType::range:
      return range(node);
    case KeyType::flag:
      if (node.type != Type::flag) return refuse(node);
      return node.flag;
    }
    return std::nullopt;
  }
};

} // namespace

namespace {

void remember_files(Job& job, const std::string& path, const TomlNode& node) {
  for (const TomlNode& item : node.type == Type::array ? node.items : std::vector{node})
    job.file_places[{path, item.text}] = item.place;
}

} // namespace

void read_value(JobReader& reader, const KeyRule& rule, const std::string& path,
                const std::string& name, const TomlNode& node) {
  reader.places[path] = node.place;
  auto value = ValueReader{reader, rule, path}.convert(node);
  if (!value) return;
  if (rule.problem) {
    const Problem problem = rule.problem(name, *value);
    if (!problem.what.empty()) {
      reader.fault(node.place, path + " " + problem.what, problem.hint);
      return;
    }
  }
  if (rule.names_files) remember_files(reader.job, path, node);
  rule.store(reader.job, name, std::move(*value));
}

} // namespace frictab::job
