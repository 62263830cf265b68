// Prints labels in a column and texts broken at blanks.
#include "cli/printed_explanation.h"

#include <algorithm>

#include "cli/print.h"
#include "core/wrapped.h"

namespace frictab::cli {

static void print_fields(const Explanation::Fields& fields, std::size_t indent) {
  std::size_t width = 0;
  for (const auto& [label, text] : fields)
    width = std::max(width, label.size());
  for (const auto& [label, text] : fields)
    if (!text.empty())
      print_out("{:{}}{:<{}}  {}\n", "", indent, label + ":", width + 1,
                wrapped(text, page_width, indent + width + 3));
}

void print_explanation(const Explanation& it) {
  print_out("{} ({})\n  {}\n", it.name, it.kind, wrapped(it.title, page_width, 2));
  print_fields(it.fields, 2);
  if (!it.items.empty()) print_out("  {}:\n", it.items_label);
  for (const Explanation::Item& item : it.items) {
    print_out("    {}\n      {}\n", item.name, wrapped(item.text, page_width, 6));
    print_fields(item.fields, 6);
  }
}

} // namespace frictab::cli
