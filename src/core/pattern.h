// Regular expressions with named groups, by PCRE2: "(?<material>\w+)_(?<radius_mm>\d+)mm".
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"

namespace frictab {

class Pattern {
public:
  // Throws InputError at `place` where `text` is no regular expression.
  Pattern(const std::string& text, const Place& place);

  const std::vector<std::string>& names() const { return names_; } // of the groups, sorted
  // What the named groups hold where the pattern first matches, anywhere in `subject`; nullopt
  // where it does not. A group that took no part is empty. Throws InputError where the search would
  // take too long.
  std::optional<std::map<std::string, std::string>> search(const std::string& subject) const;

private:
  std::string text_;
  Place place_;
  std::shared_ptr<void> code_;
  std::vector<std::string> names_;
};

} // namespace frictab
