// Any text either renders or is refused with a place: no crash, no other error.
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/random.h"
#include "core/template.h"

namespace frictab::template_fuzz_test {

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
                              "@{none...}",
                              "...}",
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
    } catch (const std::logic_error& error) {
      ++refused;
      ASSERT_THAT(error.what(),
                  testing::MatchesRegex("fuzz:[1-9][0-9]*:[1-9][0-9]*: error: (.|\n)*"))
          << text;
    }
  }
  EXPECT_GT(rendered, 100u);
  EXPECT_GT(refused, 1000u);
}

} // namespace

} // namespace frictab::template_fuzz_test
