// Parses a template into a tree, which the renderer walks.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace frictab {

// A name or item.name, with its place for messages.
struct TemplateName {
  std::string scope; // loop variable, or empty
  std::string name;
  Place place;
  std::string text() const { return scope.empty() ? name : scope + "." + name; }
};

struct TemplateNode {
  enum class Kind { text, insert, loop, choice } kind = Kind::text;
  // Text of a text node; for an insert at the start of a line, the blanks before it.
  std::string text;
  bool whole_line = false;             // an insert that fills its line
  TemplateName name;                   // name of an insert, list of a loop, or flag of a choice
  std::string variable;                // variable of a loop
  std::vector<TemplateNode> body;      // body of a loop; branch of a choice if the flag is set
  std::vector<TemplateNode> otherwise; // branch of a choice if it is not
};

// Parses a template; adds every fault of syntax to `faults` and returns the parts that were
// understood.
std::vector<TemplateNode> parse_template(std::string_view text, std::string_view file,
                                         FaultList& faults);

} // namespace frictab
