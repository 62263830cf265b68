// Parts of datasets of an HDF5 file, those that are held with its description and those that are
// not.
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "core/error.h"
#include "io/hdf5.h"
#include "support/run_command.h"

namespace frictab::hdf5_slices_test {
namespace {

using io::Hdf5Values;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Hdf5Slices : public testing::Test {
protected:
  static constexpr std::size_t many = 2'200'000; // more than 16 MiB
  static constexpr std::size_t many_texts = 300'000;

  // Every third number and text counts up.
  void SetUp() override {
    io::Hdf5Writer out(name);
    std::vector<double> numbers(many);
    for (std::size_t i = 0; i < many; ++i)
      numbers[i] = static_cast<double>(i / 3);
    const std::size_t few = 5, all = many;
    out.dataset("small", {&few, 1}, std::span(numbers).first(few));
    out.dataset("large", {&all, 1}, numbers, {100'000, 1, true});
    std::vector<std::string> texts(many_texts);
    for (std::size_t i = 0; i < many_texts; ++i)
      texts[i] = fmt::format("t{}", i / 3);
    out.dataset("texts", texts);
    out.close();
  }

  test::TemporaryDirectory directory;
  const std::string name = directory.path("a.h5");
};

TEST_F(Hdf5Slices, AreTheValuesInTheOrderAskedFor) {
  const io::Hdf5Reader in(name, "a.h5");
  const std::vector<io::Hdf5Slice> wanted = {{"large", 1'199'999, 4}, {"texts", 299'998, 2},
                                             {"small", 2, 2},         {"large", many, 0},
                                             {"texts", 0, 2},         {"large", 0, many}};
  const std::vector<Hdf5Values> found = in.slices(wanted);
  ASSERT_EQ(found.size(), 6u);
  EXPECT_THAT(found[0].numbers, ElementsAre(399'999, 400'000, 400'000, 400'000));
  EXPECT_THAT(found[1].texts, ElementsAre("t99999", "t99999"));
  EXPECT_THAT(found[1].numbers, IsEmpty());
  EXPECT_THAT(found[2].numbers, ElementsAre(0, 1));
  EXPECT_THAT(found[3].numbers, IsEmpty());
  EXPECT_THAT(found[4].texts, ElementsAre("t0", "t0"));
  EXPECT_EQ(found[5].numbers, in.values("large"));
}

TEST_F(Hdf5Slices, OfAFileThatHasChangedAreRefused) {
  const io::Hdf5Reader in(name, "a.h5");
  io::Hdf5Writer out(name);
  const std::size_t few = 10;
  out.dataset("large", {&few, 1}, std::vector<double>(few));
  out.close();
  try {
    in.slices(std::vector<io::Hdf5Slice>{{"large", 5, 10}});
    FAIL() << "values beyond the end were read";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("a.h5: error: 'large' has another shape now"));
  }
}

TEST_F(Hdf5Slices, ManyTextsAreReadWhole) {
  const io::Hdf5Reader in(name, "a.h5");
  const std::vector<std::string> texts = in.texts("texts");
  ASSERT_EQ(texts.size(), many_texts);
  EXPECT_EQ(texts.back(), "t99999");
}

} // namespace
} // namespace frictab::hdf5_slices_test
