// Names of things that have one.
#pragma once

#include <string>
#include <vector>

namespace frictab {

template <class Things> std::vector<std::string> all_names(const Things& things) {
  std::vector<std::string> names;
  for (const auto& thing : things)
    names.push_back(thing.name);
  return names;
}

} // namespace frictab
