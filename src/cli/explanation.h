// The explanation of a name by `explain`, as plain values.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "models/law.h"

namespace frictab::cli {

struct Explanation {
  std::string name;
  std::string kind;  // "friction law", "effect", "target", "quantity", "job key", "job keys",
                     // "job section", "file", "topic"
  std::string title; // one line
  using Fields = std::vector<std::pair<std::string, std::string>>; // label, text; in order
  Fields fields = {};
  struct Item {
    std::string name, text;
    Fields fields = {};
  };
  std::string items_label = {}; // "parameters", "keys"
  std::vector<Item> items = {};
};

// Explains a law, also a user's own.
Explanation explain_law(const models::Law& law);

// Explains a name; nullopt if it is unknown.
std::optional<Explanation> explain(const std::string& name);

// Every name that explain() knows.
std::vector<std::string> explainable();

} // namespace frictab::cli
