// A template read into a tree: what the renderer walks.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace frictab {

// name or item.name, with its place for messages.
struct TemplateName {
  std::string scope; // loop variable, or empty
  std::string name;
  Place place;
  std::string text() const { return scope.empty() ? name : scope + "." + name; }
};

struct TemplateNode {
  enum class Kind { text, insert, loop, choice } kind = Kind::text;
  std::string text;                    // of a text; the blanks before an insert that starts a line
  bool whole_line = false;             // an insert that is all of its line
  TemplateName name;                   // of an insert; the list of a loop; the flag of a choice
  std::string variable;                // of a loop
  std::vector<TemplateNode> body;      // of a loop; the choice where the flag is set
  std::vector<TemplateNode> otherwise; // the choice where it is not
};

// Adds every fault of syntax to `faults`; what was understood is returned nevertheless.
std::vector<TemplateNode> parse_template(std::string_view text, std::string_view file,
                                         FaultList& faults);

} // namespace frictab
