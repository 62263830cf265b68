// The names of several things, as messages and lists of choices take them.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace frictab {

// Takes the name of a thing that has one; a text is its own name.
struct OwnName {
  template <class Thing> std::string operator()(const Thing& thing) const {
    if constexpr (requires { thing.name; })
      return std::string(thing.name);
    else
      return std::string(thing);
  }
};

// Returns the name of each, in their order: all_names(quantities(), &Quantity::name).
template <class Things, class Name = OwnName>
std::vector<std::string> all_names(Things&& things, Name name = {}) {
  std::vector<std::string> names;
  for (const auto& thing : things)
    names.emplace_back(std::invoke(name, thing));
  return names;
}

} // namespace frictab
