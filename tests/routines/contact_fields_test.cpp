// Contour plots: what VUFIELD gives for the nodes that the friction routines have met.
#include <deque>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "support/calls/vfric.h"
#include "support/calls/vfriction.h"
#include "support/calls/vufield.h"
#include "support/generated.h"
#include "support/sample_tables.h"

namespace frictab::contact_fields_test {

using calls::VfricCall;
using calls::VfrictionCall;
using calls::VufieldCall;
using codegen::ExportRequest;
using codegen::Library;
using testing::HasSubstr;

namespace {

const std::map<std::string, std::string> shown = {{"contact_fields", "vufield"}};

template <class Real> class ContactFields : public test::NeedsGfortran {
protected:
  static const char* precision() { return sizeof(Real) == 4 ? "single" : "double"; }

  // A library of its own for each test: what it has seen is its state. It stays to the end, as in a
  // solver: what is unloaded could not give its memory back.
  const Library& library(const std::string& target,
                         const std::vector<std::string>& flags = test::strict) const {
    static auto& kept = *new std::deque<Library>;
    const codegen::Exporter& exporter = *codegen::find_exporter(target);
    const ExportRequest request{table_, "mm-t-s", {}, shown};
    for (codegen::BuildVariant variant : exporter.variants(request)) {
      if (variant.name != precision()) continue;
      test::add_flags(variant, flags);
      return kept.emplace_back(
          codegen::compile_library(exporter.generate(request), variant, work_.path()));
    }
    throw std::logic_error(target);
  }

  // In range at 1000 MPa and 50 mm/s; 100 MPa is below it.
  static void set(VfrictionCall<Real>& c, std::size_t k, int node, double pressure) {
    c.nodes[k] = node;
    c.normal[k] = static_cast<Real>(pressure);
    c.slip[3 * k] = 50 * c.time_increment;
    c.temperature[k] = c.temperature_main[k] = 100;
  }
  static VfrictionCall<Real> block(int points) {
    VfrictionCall<Real> c;
    c.states = 8;
    c.temperatures = true;
    c.time_increment = Real(0x1p-20);
    c.properties = {Real(2.5), 60, 480};
    c.resize(points);
    return c;
  }

  static VufieldCall<Real> fields(const Library& library, const std::vector<int>& nodes,
                                  int increment = 1, int step = 1) {
    VufieldCall<Real> f;
    f.nodes = nodes;
    f.increment = increment;
    f.step = step;
    f.run(Library::address(library.handle(), "vufield_"));
    return f;
  }

  const table::Table table_ = test::four_axis_table();
  const TemporaryDirectory work_;
};

using Precisions = testing::Types<float, double>;
class PrecisionName {
public:
  template <class Real> static std::string GetName(int) {
    return sizeof(Real) == 4 ? "single" : "double";
  }
};
TYPED_TEST_SUITE(ContactFields, Precisions, PrecisionName);

TYPED_TEST(ContactFields, AreTheCoefficientAndStressThatTheStateVariablesHold) {
  const Library& library = this->library("abaqus_vfriction");
  VfrictionCall<TypeParam> c = TestFixture::block(3);
  TestFixture::set(c, 0, 4711, 1000);
  TestFixture::set(c, 1, 2147483647, 2000);
  TestFixture::set(c, 2, 12, 0); // open
  c.run(Library::address(library.handle(), "vfriction_"));
  VufieldCall<TypeParam> f = TestFixture::fields(library, {2147483647, 12, 4711, 5});
  EXPECT_EQ(f.at(0, 0), c.state[8 + 7]);
  EXPECT_EQ(f.at(0, 1), c.state[8 + 6]);
  EXPECT_EQ(f.at(2, 0), c.state[7]);
  EXPECT_EQ(f.at(2, 1), c.state[6]);
  EXPECT_GT(f.at(2, 1), 50);
  for (const std::size_t untouched : {1, 3})
    for (const std::size_t number : {0, 1, 2})
      EXPECT_EQ(f.at(untouched, number), 0) << "node not in contact";
}

TYPED_TEST(ContactFields, AreZeroTwoIncrementsAfterContactButForTheCountOutside) {
  const Library& library = this->library("abaqus_vfriction");
  VfrictionCall<TypeParam> c = TestFixture::block(1);
  TestFixture::set(c, 0, 9, 100);
  for (c.increment = 1; c.increment <= 5; ++c.increment)
    c.run(Library::address(library.handle(), "vfriction_"));
  const auto shows = [&](int increment, int step) {
    VufieldCall<TypeParam> f = TestFixture::fields(library, {9}, increment, step);
    EXPECT_EQ(f.at(0, 2), 5) << "increments outside";
    return f.at(0, 0) > 0 && f.at(0, 1) > 0;
  };
  EXPECT_TRUE(shows(5, 1));
  EXPECT_TRUE(shows(6, 1)) << "VUFIELD may come first in an increment";
  EXPECT_FALSE(shows(7, 1));
  EXPECT_TRUE(shows(1, 2)) << "increments count from 1 in the next step";
  EXPECT_FALSE(shows(2, 2));
}

TYPED_TEST(ContactFields, AreThoseOfTheLargestStressOfSeveralContactsOfANode) {
  const Library& library = this->library("abaqus_vfriction");
  void* const routine = Library::address(library.handle(), "vfriction_");
  VfrictionCall<TypeParam> c = TestFixture::block(3);
  TestFixture::set(c, 0, 9, 600);
  TestFixture::set(c, 1, 9, 2500);
  TestFixture::set(c, 2, 9, 700);
  c.run(routine);
  VufieldCall<TypeParam> f = TestFixture::fields(library, {9});
  EXPECT_EQ(f.at(0, 0), c.state[8 + 7]);
  EXPECT_EQ(f.at(0, 1), c.state[8 + 6]);
  VfrictionCall<TypeParam> later = TestFixture::block(1);
  TestFixture::set(later, 0, 9, 600);
  later.increment = 2;
  later.run(routine);
  f = TestFixture::fields(library, {9}, 2);
  EXPECT_EQ(f.at(0, 1), later.state[6]) << "a new increment begins anew";
}

TYPED_TEST(ContactFields, StandAtBothNodesOfAnEdge) {
  const Library& library = this->library("abaqus_vfriction");
  VfrictionCall<TypeParam> c = TestFixture::block(0);
  c.edges = true;
  c.resize(1);
  TestFixture::set(c, 0, 20, 1000);
  c.nodes = {20, 30};
  c.run(Library::address(library.handle(), "vfriction_"));
  VufieldCall<TypeParam> f = TestFixture::fields(library, {20, 30});
  EXPECT_GT(f.at(0, 1), 50);
  EXPECT_EQ(f.at(0, 1), f.at(1, 1));
}

TYPED_TEST(ContactFields, MayBeAskedForOneByOneAndForShells) {
  const Library& library = this->library("abaqus_vfriction");
  VfrictionCall<TypeParam> c = TestFixture::block(1);
  TestFixture::set(c, 0, 3, 1000);
  c.run(Library::address(library.handle(), "vfriction_"));
  VufieldCall<TypeParam> one;
  one.nodes = {3};
  one.fields = 1;
  one.components = 5; // section points
  for (int number = 1; number <= 4; ++number) {
    one.field = number;
    one.values.clear();
    one.run(Library::address(library.handle(), "vufield_"));
    const TypeParam wanted[] = {c.state[7], c.state[6], 0, -7}; // a fourth one is another's
    for (std::size_t point = 0; point < 5; ++point)
      EXPECT_EQ(one.at(0, 0, point), wanted[number - 1]) << number;
  }
}

TYPED_TEST(ContactFields, OfContactPairsGoByTheNumberOfTheSecondaryNode) {
  const Library& library = this->library("abaqus_vfric");
  VfricCall<TypeParam> c;
  c.states = 8;
  c.temperatures = true;
  c.time_increment = TypeParam(0x1p-20);
  c.properties = {TypeParam(2.5), 60, 480};
  c.resize(2, 4);
  c.node = {4, 2};
  c.node_numbers = {100, 200, 300, 400};
  c.normal = {1000, 2000};
  c.slip[0] = c.slip[3] = 50 * c.time_increment;
  c.temperature = c.temperature_main = {100, 100};
  c.run(Library::address(library.handle(), "vfric_"));
  VufieldCall<TypeParam> f = TestFixture::fields(library, {100, 200, 300, 400});
  EXPECT_EQ(f.at(0, 1), 0);
  EXPECT_EQ(f.at(1, 1), c.state[8 + 6]);
  EXPECT_EQ(f.at(2, 1), 0);
  EXPECT_EQ(f.at(3, 1), c.state[3 * 8 + 6]);
  EXPECT_NE(f.at(1, 1), f.at(3, 1));
}

TYPED_TEST(ContactFields, KnowAHundredThousandNodesThatFourThreadsMeet) {
  // As users compile: the compiler's check for recursion takes a second thread for one.
  const Library& library = this->library("abaqus_vfriction", {});
  void* const routine = Library::address(library.handle(), "vfriction_");
  constexpr int per_thread = 25000, points = 100;
  const auto pressure = [](int node) { return 600 + node % 1999; };
  const auto number = [](int node) { return 7 * node + 1024; };
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      VfrictionCall<TypeParam> c = TestFixture::block(points);
      for (int first = t * per_thread; first < (t + 1) * per_thread; first += points) {
        for (int k = 0; k < points; ++k)
          TestFixture::set(c, static_cast<std::size_t>(k), number(first + k), pressure(first + k));
        c.run(routine);
      }
    });
  for (std::thread& thread : threads)
    thread.join();
  VfrictionCall<TypeParam> alone = TestFixture::block(1);
  for (int node = 0; node < 4 * per_thread; node += 37) {
    VufieldCall<TypeParam> f = TestFixture::fields(library, {number(node)});
    TestFixture::set(alone, 0, number(node), pressure(node));
    alone.increment = 9; // and does not disturb the others
    alone.run(routine);
    ASSERT_EQ(f.at(0, 1), alone.state[6]) << node;
  }
}

TEST(ContactFieldsText, StandOnceForSeveralLawsAndTwoRoutines) {
  const table::Table first = test::four_axis_table(), second = test::branching_table();
  std::string sources, vufield;
  for (const char* target : {"abaqus_vfric", "abaqus_vfriction"}) {
    const codegen::Exporter& exporter = *codegen::find_exporter(target);
    std::vector<ExportRequest> requests;
    for (const table::Table* table : {&first, &second})
      requests.push_back({*table, "mm-t-s", {}, shown});
    for (const auto& [path, text] : exporter.combine(requests, {"PUNCH", "DIE"}).files) {
      if (path == "frictab_vufield.f") vufield = text;
      if (path.ends_with(".f") && path != "frictab_vufield.f") sources += text;
    }
  }
  EXPECT_THAT(sources, testing::Not(HasSubstr("subroutine vufield")));
  EXPECT_THAT(sources, HasSubstr("call fvkeep(jSecUid(jConSecid(k)), kStep, kInc,"));
  EXPECT_THAT(vufield, HasSubstr("subroutine vufield"));
}

TEST(ContactFieldsText, SayWhatTheDeckNeedsAndThatTheSourcesAreOneFile) {
  const table::Table table = test::four_axis_table();
  const codegen::Exporter& exporter = *codegen::find_exporter("abaqus_vfric");
  const std::string recipe = exporter.generate({table, "m-kg-s", {}, shown}).at("recipe.json");
  EXPECT_THAT(recipe, HasSubstr("*Field, user, number=3\\n <nodes of the contact surfaces>\\n"));
  EXPECT_THAT(recipe, HasSubstr("user=<the sources as one file>.f"));
  EXPECT_THAT(exporter.generate({table, "m-kg-s", {}, shown}).at("frictab_vufield.f"),
              HasSubstr("the frictional shear stress (Pa)"));
}

TEST(ContactFieldsText, RefusesALawThatTakesOneOfTheFields) {
  const table::Table table = test::four_axis_table();
  const codegen::Exporter& exporter = *codegen::find_exporter("abaqus_vfric");
  const auto request = [&](const char* field) {
    return ExportRequest{table, "mm-t-s", {{"psi", field}}, shown};
  };
  EXPECT_NO_THROW(exporter.generate(request("field:4")));
  EXPECT_THAT(
      test::refusal([&] { exporter.generate(request("field:3")); }),
      testing::AllOf(HasSubstr("field variables 1 to 3, and the law takes psi from field 3"),
                     HasSubstr("[export.inputs] psi = \"field:6\"")));
}

} // namespace

} // namespace frictab::contact_fields_test
