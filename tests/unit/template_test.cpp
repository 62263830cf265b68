// The renderer: what it writes, and that template and values must fit each other exactly.
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/template.h"

namespace frictab::template_test {

namespace {

TemplateValues text(std::map<std::string, std::string> names) {
  TemplateValues values;
  values.text = std::move(names);
  return values;
}

std::string message(std::string_view source, const TemplateValues& values) {
  try {
    return "no error: " + render(source, "t.c", values);
  } catch (const std::logic_error& error) {
    return error.what();
  }
}

using testing::HasSubstr;

TEST(Template, InsertsTextAsItIs) {
  EXPECT_EQ(render("a @{x} b@{x}\n", "t", text({{"x", "@{y}"}})), "a @{y} b@{y}\n");
}

TEST(Template, WritesOneAtForTwo) {
  EXPECT_EQ(render("me@@home @@{x}\n", "t", {}), "me@home @{x}\n");
  EXPECT_EQ(render("@@for ever\n", "t", {}), "@for ever\n");
}

TEST(Template, SetsEveryLineOfATextIn) {
  EXPECT_EQ(render("  @{x}\n", "t", text({{"x", "a\nb\n\nc"}})), "  a\n  b\n\n  c\n");
  EXPECT_EQ(render("- @{x}\n", "t", text({{"x", "a\nb"}})), "- a\nb\n");
}

TEST(Template, DropsALineThatIsNothingButAnEmptyText) {
  EXPECT_EQ(render("a\n  @{x}\nb @{x}\n@{y}\n", "t", text({{"x", ""}, {"y", "c"}})), "a\nb \nc\n");
}

TEST(Template, RepeatsALoopPerItemAndDropsDirectiveLines) {
  TemplateValues values = text({{"all", "!"}});
  values.lists["rows"] = {text({{"n", "1"}}), text({{"n", "2"}})};
  EXPECT_EQ(render("<\n  @for r in rows\n@{r.n}@{all}\n  @end\n>\n", "t", values),
            "<\n1!\n2!\n>\n");
}

TEST(Template, RepeatsALineWithAListPerItem) {
  TemplateValues row, values = text({{"mark", "!"}});
  row.lists["cells"] = items({"a", "", "b"});
  values.lists["rows"] = {row};
  EXPECT_EQ(
      render("<\n@for r in rows\n- @{r.cells...}@{mark}\n  @{r.cells...}\n@end\n>", "t", values),
      "<\n- a!\n- !\n- b!\n  a\n  b\n>");
  EXPECT_THAT(message("a @{rows...}\n", values), HasSubstr("there is no text 'each.text'"));
  EXPECT_THAT(message("a @{row...}\n", values),
              HasSubstr("t.c:1:3: error: there is no list 'row'"));
}

TEST(Template, NestsLoopsAndChoicesOfItems) {
  TemplateValues inner = text({{"v", "x"}}), row, values;
  row.flags["big"] = true;
  row.lists["cells"] = {inner, inner};
  values.lists["rows"] = {row, row};
  values.lists["rows"][1].flags["big"] = false;
  EXPECT_EQ(
      render("@for r in rows\n@if r.big\n@for c in r.cells\n@{c.v}\n@end\n@else\n-\n@end\n@end\n",
             "t", values),
      "x\nx\n-\n");
}

TEST(Template, AcceptsAnEmptyListWhoseItemsNobodyKnows) {
  TemplateValues values;
  values.lists["rows"] = {};
  EXPECT_EQ(render("a\n@for r in rows\n@{r.n}\n@end\nb", "t", values), "a\nb");
}

TEST(Template, AllowsSeveralLoopsToUseOneListTogether) {
  TemplateValues values;
  values.lists["rows"] = {text({{"a", "1"}, {"b", "2"}})};
  EXPECT_EQ(render("@for r in rows\n@{r.a}\n@end\n@for q in rows\n@{q.b}\n@end\n", "t", values),
            "1\n2\n");
}

TEST(Template, NamesPlaceAndNearestNameOfAnUnknownOne) {
  const std::string what = message("a\nb @{vlaue}\n@{value}", text({{"value", "1"}}));
  EXPECT_THAT(what, HasSubstr("t.c:2:3: error: there is no text 'vlaue'"));
  EXPECT_THAT(what, HasSubstr("did you mean 'value'?"));
}

TEST(Template, AsksNoValueOfABranchThatIsNotTaken) {
  TemplateValues values;
  values.flags["on"] = false;
  EXPECT_EQ(render("@if on\n@{x}\n@for r in rows\n@{r.n}\n@end\n@else\noff\n@end\n", "t", values),
            "off\n");
  values.flags["on"] = true;
  EXPECT_THAT(message("@if on\n@{x}\n@end\n", values),
              HasSubstr("t.c:2:1: error: there is no text"));
}

TEST(Template, CountsAValueAsUsedThatOnlyABranchNotTakenNames) {
  TemplateValues values = text({{"x", "1"}});
  values.flags["on"] = false;
  EXPECT_EQ(render("@if on\n@{x}\n@end\n", "t", values), "");
}

TEST(Template, InsertsNamesIntoOneLineAndLeavesTheOthersUnused) {
  EXPECT_EQ(insert_names("x(@{index}) = press@{convert}",
                         {{"index", "2"}, {"convert", "/1.0D6"}, {"field", "7"}}),
            "x(2) = press/1.0D6");
  EXPECT_THROW(insert_names("@{nowhere}", {}), std::logic_error);
}

TEST(Template, TellsValuesThatAreNeverUsed) {
  EXPECT_THAT(message("a", text({{"x", ""}})), HasSubstr("t.c:1:1: error: the value 'x' is never"));
  TemplateValues values;
  values.lists["rows"] = {text({{"n", ""}, {"m", ""}})};
  EXPECT_THAT(message("a\n@for r in rows\n@{r.n}\n@end\n", values),
              HasSubstr("t.c:2:1: error: the value 'm' is never used"));
}

TEST(Template, MayLeaveUnusedWhatIsOffered) {
  TemplateValues values = text({{"x", ""}, {"y", ""}});
  values.offered = {"x"};
  EXPECT_THAT(message("a", values),
              testing::AllOf(HasSubstr("'y'"), testing::Not(HasSubstr("'x'"))));
}

TEST(Template, TellsAnItemThatLacksWhatItsNeighbourHas) {
  TemplateValues values;
  values.lists["rows"] = {text({{"n", ""}}), {}};
  EXPECT_THAT(message("@for r in rows\n@{r.n}\n@end\n", values), HasSubstr("no text 'r.n'"));
}

TEST(Template, TellsANameOfTheWrongKind) {
  EXPECT_THAT(message("@if x\n@end\n", text({{"x", ""}})), HasSubstr("no flag 'x'"));
  EXPECT_THAT(message("@for r in x\n@end\n", text({{"x", ""}})), HasSubstr("no list 'x'"));
}

TEST(Template, TellsOpenAndLooseBlocks) {
  TemplateValues values;
  values.flags["on"] = true;
  EXPECT_THAT(message("\n @if on\n", values),
              HasSubstr("t.c:2:2: error: this block is never closed"));
  EXPECT_THAT(message("@end\n", {}), HasSubstr("t.c:1:1: error: @end without a block"));
  EXPECT_THAT(message("@else\n", {}), HasSubstr("@else without an @if"));
  EXPECT_THAT(message("@if on\n@else\n@else\n@end\n", values), HasSubstr("t.c:3:1"));
}

TEST(Template, TellsBadSyntax) {
  EXPECT_THAT(message("a @ b", {}), HasSubstr("t.c:1:3: error: a lone '@'"));
  EXPECT_THAT(message("@{x", {}), HasSubstr("lone"));
  EXPECT_THAT(message("@{1x}", {}), HasSubstr("'1x' is not a name"));
  EXPECT_THAT(message("@{}", {}), HasSubstr("is not a name"));
  EXPECT_THAT(message("@for x on y\n", {}), HasSubstr("not a directive"));
  EXPECT_THAT(message("@while x\n", {}), HasSubstr("'@while' is not a directive"));
  EXPECT_THAT(message("@{r.n}", {}), HasSubstr("'r' is not a loop variable here"));
}

TEST(Template, ReportsAllFaultsInOneGo) {
  const std::string what = message("@{a}\n@{b}\n", text({{"c", ""}}));
  EXPECT_THAT(what, testing::AllOf(HasSubstr("'a'"), HasSubstr("'b'"), HasSubstr("'c'")));
}

TEST(Template, RefusesALoopVariableTwice) {
  TemplateValues values;
  values.lists["rows"] = {{}};
  EXPECT_THAT(message("@for r in rows\n@for r in rows\n@end\n@end\n", values),
              HasSubstr("already a loop variable"));
}

TEST(Template, FindsEmbeddedFilesAndThrowsForOthers) {
  EXPECT_THAT(std::string(embedded_template("frictab_kernel.h")), HasSubstr("ft_linear_##N"));
  EXPECT_THAT(std::string(embedded_template("c/frictab_tau_R.c")), HasSubstr("@{kernel}"));
  EXPECT_THROW(embedded_template("c/none"), std::logic_error);
}

TEST(Template, IncludesTheLinesOfOthers) {
  EXPECT_THAT(std::string(embedded_template("c/frictab_piece.c")), HasSubstr("@include c/"));
  EXPECT_THROW(render_template("c/frictab_piece.c", {}), std::logic_error);
  EXPECT_EQ(without_last_break("a\n\n"), "a\n");
}

} // namespace

} // namespace frictab::template_test
