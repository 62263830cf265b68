// Defects of public friction routines for Abaqus/Explicit, one test per defect: ours do not have
// it. Where a compiler or the text itself shows a defect, the text is looked at as well.
#include <cmath>
#include <regex>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/calls/vfric.h"
#include "support/calls/vfric_coef.h"
#include "support/calls/vfriction.h"
#include "support/generated.h"
#include "support/sample_tables.h"

namespace frictab::known_defects_test {

using codegen::find_exporter;
using expr::Expr;
using table::Table;

namespace {

using calls::VfricCall;
using calls::VfricCoefCall;
using calls::VfrictionCall;
using testing::HasSubstr;
using testing::Not;

const std::vector<std::string> targets = {"abaqus_vfric", "abaqus_vfriction", "abaqus_vfric_coef"};

std::string source(const std::string& target, const Table& table) {
  const codegen::SourceBundle files = find_exporter(target)->generate({table, "mm-t-s", {}});
  return files.at("frictab_" + target.substr(7) + ".f");
}

// Statements alone.
std::string code(const std::string& target, const Table& table) {
  std::istringstream lines(source(target, table));
  std::string out;
  for (std::string line; std::getline(lines, line);)
    if (!line.empty() && line[0] != 'C') out += line + "\n";
  return out;
}

template <class Real>
void* routine(const std::string& target, const std::string& key, const Table& table,
              const std::vector<std::string>& flags = test::run_checks) {
  return codegen::Library::address(test::compiled("defects " + key, *find_exporter(target),
                                                  {table, "mm-t-s", {}},
                                                  sizeof(Real) == 4 ? "single" : "double", flags)
                                       ->handle(),
                                   target.substr(7) + "_");
}

// mu = 0.08 at 1000 MPa on an area of 1.
template <class Call> Call pressed(int points) {
  Call c;
  c.time_increment = 0.125f;
  if constexpr (requires { c.node; })
    c.resize(points, points);
  else
    c.resize(points);
  std::fill(c.normal.begin(), c.normal.end(), 1000.0f);
  return c;
}

class KnownDefects : public test::NeedsGfortran {
protected:
  const Table constant = test::constant_table();
};

// WZL's routines set the force to 0 wherever the slip is: nothing holds a point at rest.
TEST_F(KnownDefects, SlipZeroKeepsTheStickForce) {
  auto pair = pressed<VfricCall<double>>(1);
  pair.stick = {50};
  pair.run(routine<double>("abaqus_vfric", "constant", constant));
  EXPECT_EQ(pair.tangential[0], -50);
  auto general = pressed<VfrictionCall<double>>(1);
  general.stick = {50};
  general.run(routine<double>("abaqus_vfriction", "constant", constant));
  EXPECT_EQ(general.tangential[0], -50);
}

// The same ones: nothing before the first time increment either.
TEST_F(KnownDefects, TheFirstIncrementHasFriction) {
  auto c = pressed<VfrictionCall<double>>(1);
  c.time_increment = 0;
  c.run(routine<double>("abaqus_vfriction", "constant", constant));
  EXPECT_DOUBLE_EQ(c.tangential[0], -80);
}

// A bare min(mu N, stick force) pushes with any force where the penalty's stick force comes in
// negative; max(stick force, 0) lets a stuck node creep (stuck_node_test.cpp).
TEST_F(KnownDefects, ANegativeStickForceHoldsAsFarAsFrictionDoes) {
  auto c = pressed<VfrictionCall<double>>(1);
  c.stick = {-1e6};
  c.run(routine<double>("abaqus_vfriction", "constant", constant));
  EXPECT_DOUBLE_EQ(c.tangential[0], 80);
  c.stick = {-50};
  c.run(routine<double>("abaqus_vfriction", "constant", constant));
  EXPECT_EQ(c.tangential[0], 50);
}

// dSlipFric(3,k) and fTangential(2,k) lie beyond the arrays of plane and axisymmetric models; the
// routine is compiled with bounds checked, and what lies beside stays.
TEST_F(KnownDefects, TwoDimensionalContactIsNotReadAsThree) {
  auto pair = pressed<VfricCall<double>>(1);
  pair.directions = 2;
  pair.resize(3, 3);
  pair.normal = {1000, 2000, 3000};
  pair.slip = {1, 0, 2, 0, 4, 0};
  pair.run(routine<double>("abaqus_vfric", "constant", constant));
  EXPECT_THAT(pair.tangential,
              testing::Pointwise(testing::DoubleEq(), std::vector<double>{-80, -160, -240}));
  EXPECT_EQ(pair.state[3], 2);
  auto general = pressed<VfrictionCall<double>>(1);
  general.directions = 2;
  general.resize(2);
  general.normal = {1000, 2000};
  general.run(routine<double>("abaqus_vfriction", "constant", constant));
  EXPECT_THAT(general.tangential,
              testing::Pointwise(testing::DoubleEq(), std::vector<double>{-80, -160}));
}

// "m_exp" without a declaration is an integer: an exponent of -0.0844 became 0. Ours is held by a
// law whose exponents and constants begin with any letter.
TEST_F(KnownDefects, ExponentIsNotTruncatedToAnInteger) {
  Table table = constant;
  table.value = {1};
  table.constants = {{"c", 0.0623}, {"i_exp", -0.1542}, {"m_exp", -0.0844}, {"n_exp", 0.25}};
  const Expr p = Expr::symbol("sigma_n_MPa");
  table.combine = Expr::symbol("value") * Expr::symbol("c") * p *
                  pow(p / 1000, Expr::symbol("i_exp")) * pow(p / 100, Expr::symbol("m_exp")) *
                  pow(p / 10, Expr::symbol("n_exp"));
  auto c = pressed<VfricCall<double>>(1);
  c.normal = {1500};
  c.run(routine<double>("abaqus_vfric", "exponents", table));
  const double wanted =
      0.0623 * 1500 * std::pow(1.5, -0.1542) * std::pow(15.0, -0.0844) * std::pow(150.0, 0.25);
  EXPECT_NEAR(c.tangential[0], -wanted, 1e-12 * wanted);
}

// A misspelt variable (CRE1 for CPE1) is a new one, and 0: every unit declares its names, but for
// those that have the solver's include, which types them; there the compiler tells what is used
// without having been set.
TEST_F(KnownDefects, AMisspeltNameDoesNotCompile) {
  const std::regex unit(R"(\n      (?:[a-z ]+ )?(subroutine|function) +(\w+)[^\n]*\n)");
  for (const std::string& target : targets)
    for (const test::NamedTable& sample : test::sample_tables()) {
      const std::string text = "\n" + code(target, sample.table);
      std::size_t declared = 0, units = 0;
      for (std::sregex_iterator at(text.begin(), text.end(), unit), end; at != end; ++at) {
        const std::size_t from = static_cast<std::size_t>(at->position() + at->length());
        const std::string begin = text.substr(from - 1, 1500);
        const std::string before = begin.substr(0, begin.find("\n      end\n"));
        ++units;
        declared += before.find("\n      implicit none\n") != std::string::npos ||
                    before.find("\n      include '") != std::string::npos;
      }
      EXPECT_GT(units, 2u);
      EXPECT_EQ(declared, units) << target << " " << sample.name;
    }
  for (const std::string& target : targets)
    for (const std::string variant : {"double", "single"})
      EXPECT_NO_THROW(test::compiled("defects unused", *find_exporter(target),
                                     {test::branching_table(), "mm-t-s", {}}, variant,
                                     {"-Wall", "-Wextra", "-Wuninitialized", "-Werror",
                                      "-Wno-unused-dummy-argument", "-Wno-unused-parameter"}))
          << target;
}

// min(x, 1.d0) or f(0.5) is the wrong kind in one of the two executables: a call with another kind
// than the helper in the same file declares is told of, and so is what is narrowed in silence.
TEST_F(KnownDefects, NoLiteralIsPassedWhereThePrecisionIsTheSolvers) {
  for (const std::string& target : targets)
    for (const std::string variant : {"double", "single"})
      EXPECT_NO_THROW(test::compiled("defects kinds", *find_exporter(target),
                                     {test::four_axis_table(), "mm-t-s", {}}, variant,
                                     {"-Wconversion", "-Werror"}))
          << target << " " << variant;
}

// Local REALs lose digits in the double precision executable.
TEST_F(KnownDefects, DoublePrecisionIsNotLostOnTheWay) {
  Table table = constant;
  table.value = {0.0623123456789012};
  auto c = pressed<VfricCall<double>>(1);
  c.run(routine<double>("abaqus_vfric", "digits", table));
  EXPECT_DOUBLE_EQ(c.tangential[0], -62.3123456789012);
  for (const std::string& target : targets) {
    EXPECT_THAT(code(target, table), Not(HasSubstr("\n      real ")));
    EXPECT_THAT(code(target, table), Not(HasSubstr("real*4")));
  }
}

// CHARACTER*8 where the solver passes 80 makes every comparison of names fail.
TEST_F(KnownDefects, SurfaceNamesAre80Characters) {
  EXPECT_THAT(code("abaqus_vfric", constant),
              HasSubstr("character*80 surfInt, surfSec, surfMain\n"));
  for (const char* target : {"abaqus_vfriction", "abaqus_vfric_coef"})
    EXPECT_THAT(code(target, constant), HasSubstr("character*80 surfInt, surfSlv, surfMst\n"));
}

// Names of interactions in the source: a renamed interaction takes another branch in silence.
TEST_F(KnownDefects, TheInteractionsNameDecidesNothing) {
  auto first = pressed<VfrictionCall<double>>(1), second = first;
  second.interaction = "INTPROP-2";
  void* function = routine<double>("abaqus_vfriction", "constant", constant);
  first.run(function);
  second.run(function);
  EXPECT_EQ(first.tangential, second.tangential);
}

// COMMON and SAVE, written to by all threads, indexed by node with a fixed size.
TEST_F(KnownDefects, NoSharedStateBetweenThreads) {
  const std::regex shared(R"(\b(common|equivalence|block data)\b)", std::regex::icase);
  const std::regex saved(R"(\n      save ([^\n]*)\n)"), name(R"(\w+)");
  for (const std::string& target : targets)
    for (const test::NamedTable& sample : test::sample_tables()) {
      SCOPED_TRACE(target + " " + sample.name);
      const std::string text = code(target, sample.table);
      EXPECT_FALSE(std::regex_search(text, shared));
      // What is saved is a table: it has DATA, and nothing writes to it.
      for (std::sregex_iterator at(text.begin(), text.end(), saved), end; at != end; ++at) {
        const std::string names = (*at)[1];
        for (std::sregex_iterator n(names.begin(), names.end(), name); n != end; ++n) {
          EXPECT_TRUE(std::regex_search(text, std::regex("data \\(?" + n->str() + "\\b")))
              << n->str();
          EXPECT_FALSE(std::regex_search(
              text, std::regex("\n +(if \\(.*\\) )?" + n->str() + "(\\([^=\n]*\\))? = ")))
              << n->str();
        }
      }
    }
  void* function = routine<double>("abaqus_vfriction", "threads", constant, {"-O2"});
  std::vector<VfrictionCall<double>> calls(4, pressed<VfrictionCall<double>>(136));
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      std::fill(calls[t].normal.begin(), calls[t].normal.end(), 100.0 * double(t + 1));
      for (int i = 0; i < 500; ++i)
        calls[t].run(function);
    });
  for (std::thread& thread : threads)
    thread.join();
  for (std::size_t t = 0; t < 4; ++t)
    for (std::size_t k = 0; k < 136; ++k)
      EXPECT_DOUBLE_EQ(calls[t].tangential[2 * k], -8.0 * double(t + 1));
}

// READ, WRITE and PRINT in every call: slow, and one unit number for all threads.
TEST_F(KnownDefects, NothingIsReadOrWrittenInACall) {
  const std::regex io(R"(\b(read|write|print|open|inquire)\b *[(*'"])", std::regex::icase);
  for (const std::string& target : targets)
    for (const test::NamedTable& sample : test::sample_tables()) {
      std::string text = code(target, sample.table);
      // Into a text of its own, when the analysis ends.
      if (const auto at = text.find("write (text,"); at != std::string::npos) text.erase(at, 12);
      EXPECT_FALSE(std::regex_search(text, io)) << target << " " << sample.name;
    }
}

// areaSec and STATEV by contact number give every point another node's.
TEST_F(KnownDefects, AreaAndStateByNodeNumberNotByContact) {
  auto c = pressed<VfricCall<double>>(2);
  c.resize(2, 4);
  c.node = {4, 2};
  c.area = {99, 2, 99, 4};
  c.normal = {1000, 1000};
  c.slip = {1, 0, 0, 3, 0, 0};
  c.run(routine<double>("abaqus_vfric", "constant", constant));
  EXPECT_EQ(c.state[3 * 3 + 2], 250); // peak pressure of node 4
  EXPECT_EQ(c.state[3 * 1 + 2], 500);
  EXPECT_EQ(c.state[3 * 3], 1);
  EXPECT_EQ(c.state[3 * 1], 3);
  EXPECT_EQ(c.state[0], 0);
  EXPECT_EQ(c.state[3 * 2], 0);
}

// A window of contact numbers (460 .. 540) means other nodes as soon as the contact moves.
TEST_F(KnownDefects, EveryContactPointIsTreatedAlikeWhateverItsNumber) {
  auto c = pressed<VfricCall<double>>(1000);
  c.run(routine<double>("abaqus_vfric", "constant", constant));
  for (std::size_t k = 0; k < 1000; ++k)
    EXPECT_DOUBLE_EQ(c.tangential[2 * k], -80) << k;
}

// tempMst(k) beside an analytical rigid surface, which has one value.
TEST_F(KnownDefects, ARigidSurfaceHasOneTemperature) {
  Table table = test::four_axis_table();
  VfrictionCall<double> c;
  c.rigid = true;
  c.temperatures = true;
  c.time_increment = 1;
  c.properties = {2.5, 60, 480};
  c.resize(3);
  c.normal = {1000, 1000, 1000};
  c.temperature = {60, 60, 60};
  c.temperature_main = {140};
  c.slip[0] = c.slip[3] = c.slip[6] = 50;
  c.run(routine<double>("abaqus_vfriction", "rigid", table));
  const double state[] = {1000, 2.5, 50, 100, 480};
  const double wanted = table::TableFunction(table)(state);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(c.tangential[2 * k], -wanted, 1e-12 * wanted);
}

// An undefined derivative is whatever the array held before.
TEST_F(KnownDefects, FCoefDerivIsSet) {
  VfricCoefCall<double> c;
  c.resize(2);
  c.pressure = {1000, 0};
  std::fill(c.derivative.begin(), c.derivative.end(), std::nan(""));
  c.run(routine<double>("abaqus_vfric_coef", "constant", constant));
  EXPECT_EQ(c.derivative, std::vector<double>(6));
  EXPECT_DOUBLE_EQ(c.coefficient[0], 0.08);
  EXPECT_DOUBLE_EQ(c.coefficient[1], 0.08);
}

// DEPVAR smaller than what the routine writes to ends in a fault of memory.
TEST_F(KnownDefects, TooSmallADEPVARIsNoFault) {
  for (int states = 0; states < 6; ++states) {
    auto c = pressed<VfrictionCall<double>>(1);
    c.states = states;
    c.resize(2);
    c.normal = {1000, 1000};
    c.run(routine<double>("abaqus_vfriction", "constant", constant));
    EXPECT_DOUBLE_EQ(c.tangential[2], -80);
  }
}

// Values held at the lower ends alone: beyond the upper ones a power law goes on unseen.
TEST_F(KnownDefects, BothEndsOfEveryAxisAreHeldAndCounted) {
  const Table table = test::four_axis_table();
  VfrictionCall<double> c;
  c.temperatures = true;
  c.time_increment = 1;
  c.properties = {2.5, 60, 480};
  c.resize(2);
  c.normal = {1000, 1000};
  c.temperature = c.temperature_main = {-1000, 1000};
  c.slip[0] = c.slip[3] = 50;
  c.run(routine<double>("abaqus_vfriction", "rigid", table));
  for (std::size_t k = 0; k < 2; ++k) {
    const double state[] = {1000, 2.5, 50, k == 0 ? 20.0 : 200.0, 480};
    const double wanted = table::TableFunction(table)(state);
    EXPECT_NEAR(c.tangential[2 * k], -wanted, 1e-12 * wanted);
    EXPECT_EQ(c.state[6 * k + 3], 1);
  }
}

// Copies of the manual's page with a missing comma and a back-tick do not compile; lines beyond
// column 72 and tabs are cut or shifted without a word.
TEST_F(KnownDefects, FixedFormIsKeptToTheLetter) {
  for (const std::string& target : targets)
    for (const test::NamedTable& sample : test::sample_tables()) {
      const std::string text = source(target, sample.table);
      EXPECT_THAT(text, Not(HasSubstr("\t")));
      EXPECT_THAT(text, Not(HasSubstr("`")));
      std::istringstream lines(text);
      for (std::string line; std::getline(lines, line);)
        ASSERT_LE(line.size(), 72u) << target << ": " << line;
    }
}

// Argument lists that circulate with other names and lengths: these are counted.
TEST_F(KnownDefects, ArgumentListsHaveTheVerifiedLengths) {
  const std::map<std::string, std::ptrdiff_t> wanted = {
      {"abaqus_vfric", 42}, {"abaqus_vfriction", 39}, {"abaqus_vfric_coef", 16}};
  for (const auto& [target, count] : wanted) {
    const std::string text = code(target, constant);
    const std::size_t from = text.find("subroutine " + target.substr(7));
    ASSERT_NE(from, std::string::npos);
    const std::string list = text.substr(from, text.find(')', from) - from);
    EXPECT_EQ(std::count(list.begin(), list.end(), ',') + 1, count) << target;
  }
}

} // namespace

} // namespace frictab::known_defects_test
