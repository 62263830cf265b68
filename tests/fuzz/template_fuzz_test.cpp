// Any text either renders or is refused with a place: no crash, no other error.
#include <gtest/gtest.h>

#include "codegen/template.h"
#include "core/error.h"
#include "core/random.h"

namespace frictab {

namespace {

TemplateValues values() {
  TemplateValues item, all;
  item.text["n"] = "1\n2";
  item.flags["f"] = true;
  all.text["x"] = "text";
  all.flags["f"] = false;
  all.lists["rows"] = {item, item};
  all.lists["none"] = {};
  return all;
}

const char* const pieces[] = {"@for r in rows\n",
                              "@for q in none\n",
                              "@if f\n",
                              "@if r.f\n",
                              "@else\n",
                              "@end\n",
                              "@{x}",
                              "@{r.n}",
                              "@{",
                              "}",
                              "@",
                              "@@",
                              "\n",
                              " ",
                              "@for",
                              "@if",
                              "text",
                              "@{q.n}",
                              "\r",
                              "@{.}",
                              "@{r.}",
                              "\xff"};

TEST(TemplateFuzz, EveryTextRendersOrIsRefusedWithAPlace) {
  Random random(20);
  std::size_t rendered = 0, refused = 0;
  for (int round = 0; round < 20000; ++round) {
    std::string text;
    for (std::size_t i = random.below(14); i > 0; --i)
      text += pieces[random.below(std::size(pieces))];
    if (round % 2)
      text +=
          "@{x}\n@if f\n@end\n@for w in rows\n@{w.n}\n@if w.f\n@end\n@end\n@for v in none\n@end\n";
    try {
      render(text, "fuzz", values());
      ++rendered;
    } catch (const InputError& error) {
      ++refused;
      ASSERT_FALSE(error.faults().empty());
      for (const Fault& fault : error.faults()) {
        ASSERT_EQ(fault.place.file, "fuzz");
        ASSERT_GT(fault.place.line, 0u) << text;
        ASSERT_GT(fault.place.column, 0u) << text;
      }
    }
  }
  EXPECT_GT(rendered, 100u);
  EXPECT_GT(refused, 1000u);
}

} // namespace

} // namespace frictab
