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
  // Throws InputError at `place` if `text` is not a valid regular expression.
  Pattern(const std::string& text, const Place& place);

  const std::vector<std::string>& names() const { return names_; } // group names, sorted
  // Contents of the named groups at the first match anywhere in `subject`; nullopt without a match.
  // A group that did not take part is empty. Throws InputError if the search would take too long.
  std::optional<std::map<std::string, std::string>> search(const std::string& subject) const;

private:
  std::string text_;
  Place place_;
  std::shared_ptr<void> code_;
  std::vector<std::string> names_;
};

} // namespace frictab
