// Laws that are tables: what is read, what lies between the nodes, what is refused and where.
#include <algorithm>
#include <cmath>
#include <random>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "expr/program.h"
#include "job/table_law.h"
#include "support/run_command.h"
#include "table/table_file.h"

namespace frictab::law_table_test {
namespace {

using models::LawTable;

const std::vector<double> pressures{100, 250, 900}, speeds{1, 7, 50, 400}, temperatures{20, 180};

double mu_at(double p, double v, double T) {
  return 0.05 + 0.02 * std::sin(p * 0.7) + 0.01 * std::cos(v) + 1e-4 * T * std::fmod(v, 3);
}

// mu at the nodes of the three axes, a row each.
std::vector<std::string> full_rows() {
  std::vector<std::string> rows;
  for (const double T : temperatures)
    for (const double v : speeds)
      for (const double p : pressures)
        rows.push_back(fmt::format("{},{},{},{}\n", v, p, mu_at(p, v, T), T));
  return rows;
}

struct Read {
  std::optional<LawTable> table;
  std::string faults; // the file is called FILE
};

class LawTables : public testing::Test {
protected:
  Read read(const std::string& csv, const std::vector<std::string>& log_axes = {}) {
    directory.write("t.csv", csv);
    return read_file("t.csv", log_axes);
  }

  Read read_file(const std::string& name, const std::vector<std::string>& log_axes = {}) {
    models::LawText text;
    text.name = "paper";
    text.table = name;
    text.log_axes = log_axes;
    FaultList faults;
    Read out;
    const std::string path = directory.path(name);
    out.table = job::read_law_table(text, path, {"job.toml", 3, 9}, faults);
    if (!faults.empty()) out.faults = format_faults(faults.all());
    for (auto at = out.faults.find(path); at != std::string::npos; at = out.faults.find(path))
      out.faults.replace(at, path.size(), "FILE");
    return out;
  }

  Read read_shuffled() {
    std::vector<std::string> rows = full_rows();
    std::shuffle(rows.begin(), rows.end(), std::mt19937(5));
    std::string csv = "v_rel_mm_s,sigma_n_MPa,mu,T_contact_C\n";
    for (const std::string& row : rows)
      csv += row;
    return read(csv, {"v_rel_mm_s"});
  }

  test::TemporaryDirectory directory;
};

// One axis at a time, by the place in the cell.
struct Place1 {
  std::size_t node;
  double share;
};
Place1 place_of(const std::vector<double>& nodes, double x, bool log) {
  if (x <= nodes.front()) return {0, 0};
  if (x >= nodes.back()) return {nodes.size() - 2, 1};
  std::size_t i = 0;
  while (x > nodes[i + 1])
    ++i;
  const auto u = [&](double at) { return log ? std::log(at) : at; };
  return {i, (u(x) - u(nodes[i])) / (u(nodes[i + 1]) - u(nodes[i]))};
}

double between(double p, double v, double T) {
  const Place1 a = place_of(pressures, p, false), b = place_of(speeds, v, true),
               c = place_of(temperatures, T, false);
  double sum = 0;
  for (const std::size_t i : {0, 1})
    for (const std::size_t j : {0, 1})
      for (const std::size_t k : {0, 1})
        sum += (i ? a.share : 1 - a.share) * (j ? b.share : 1 - b.share) *
               (k ? c.share : 1 - c.share) *
               mu_at(pressures[a.node + i], speeds[b.node + j], temperatures[c.node + k]);
  return sum;
}

class Coefficient {
public:
  explicit Coefficient(const LawTable& table)
      : program_(models::law_of_table(table).build({}).value,
                 {"sigma_n_MPa", "v_rel_mm_s", "T_contact_C"}, {}) {}
  double operator()(double p, double v, double T) const {
    return program_(std::vector<double>{p, v, T}, std::vector<double>{});
  }

private:
  expr::Program program_;
};

TEST_F(LawTables, InAnyOrderOfRowsHaveTheirValuesAtNodes) {
  const Read found = read_shuffled();
  ASSERT_TRUE(found.table) << found.faults;
  const Coefficient mu(*found.table);
  for (const double T : temperatures)
    for (const double v : speeds)
      for (const double p : pressures)
        EXPECT_NEAR(mu(p, v, T), mu_at(p, v, T), 1e-15);
}

TEST_F(LawTables, AreLinearBetweenNodesAndHeldAtTheEnds) {
  const Read found = read_shuffled();
  ASSERT_TRUE(found.table) << found.faults;
  const Coefficient mu(*found.table);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> p(0, 1000), v(0.1, 500), T(-50, 250);
  for (int i = 0; i < 500; ++i) {
    const double at[] = {p(random), v(random), T(random)};
    EXPECT_NEAR(mu(at[0], at[1], at[2]), between(at[0], at[1], at[2]), 1e-15);
  }
  EXPECT_EQ(mu(900, 400, 180), mu(1e6, 1e6, 1e6));
  EXPECT_EQ(mu(100, 1, 20), mu(0, 0, -100)) << "a speed of 0 too, where ln v is not";
  EXPECT_NEAR(mu(900 * (1 - 1e-12), 30, 50), mu(900 * (1 + 1e-12), 30, 50), 1e-12);
}

TEST_F(LawTables, AreFormulasThatReadBackToTheSameBits) {
  const Read found = read_shuffled();
  const models::Law law = models::law_of_table(*found.table);
  const expr::Expr piece = law.build({}).value;
  const std::string text = expr::to_text(piece);
  EXPECT_EQ(expr::to_text(expr::parse_expr(text)), text);
  EXPECT_EQ(law.kinks.at("v_rel_mm_s"), speeds);
  EXPECT_TRUE(law.log_axes.at("v_rel_mm_s"));
  EXPECT_FALSE(law.log_axes.at("sigma_n_MPa"));
}

TEST_F(LawTables, TakeUnitsAsDataFilesDo) {
  const Read found = read("v_rel_mm_s [m/s],tau_R_MPa (Pa)\n0.001,2e6\n0.1,3e6\n");
  ASSERT_TRUE(found.table) << found.faults;
  EXPECT_EQ(found.table->quantity, models::PieceQuantity::tau_R);
  EXPECT_EQ(found.table->axes[0].nodes, (std::vector<double>{1, 100}));
  EXPECT_EQ(found.table->value, (std::vector<double>{2, 3}));
}

TEST_F(LawTables, TakeTheLargestSizeThatIsAllowed) {
  std::string csv = "v_rel_mm_s,psi,mu\n";
  for (int v = 0; v < 100; ++v)
    for (int psi = 0; psi < 50; ++psi)
      csv += fmt::format("{},{},{}\n", 1 + v * 3.3, 1 + psi / 7.0,
                         0.05 + std::fmod(v * psi * 0.1, 0.1));
  const Read found = read(csv, {"v_rel_mm_s"});
  ASSERT_TRUE(found.table) << found.faults;
  const std::string text = expr::to_text(models::law_of_table(*found.table).build({}).value);
  EXPECT_EQ(expr::to_text(expr::parse_expr(text)), text) << text.size();
}

TEST_F(LawTables, OfFrictabsOwnLayoutSayTheirAxesThemselves) {
  table::Table made;
  made.model = "made";
  made.axes = {
      {.name = "v_rel_mm_s", .unit = "mm/s", .long_name = "v", .log = true, .nodes = {1, 10, 100}}};
  made.value = {0.1, 0.05, 0.08};
  made.combine = expr::parse_expr("minimum(value*sigma_n_MPa, m*sigma_f_MPa)");
  made.constants = {{"m", 0.5}};
  table::write_table(made, directory.path("made.h5"));
  const Read found = read_file("made.h5");
  ASSERT_TRUE(found.table) << found.faults;
  EXPECT_EQ(found.table->value, made.value);
  EXPECT_TRUE(found.table->axes[0].log);
  EXPECT_EQ(expr::to_text(*found.table->combine), "minimum(value*sigma_n_MPa, 0.5*sigma_f_MPa)");
  EXPECT_THAT(read_file("made.h5", {"v_rel_mm_s"}).faults,
              testing::HasSubstr("the table says itself which axes are logarithmic"));
}

struct Refused {
  const char* csv;
  const char* said;
};

TEST_F(LawTables, AreRefusedWithThePlace) {
  const Refused cases[] = {
      {"v_rel_mm_s,psi\n1,2\n", "FILE:1: error: has no column mu or tau_R_MPa\n"
                                "  hint: a law that is a table has a column per axis and one of "
                                "these"},
      {"v_rel_mm_s,mu\n1,0.1\n2,abc\n3,0.2\n",
       "FILE:3:3: error: mu: 'abc' is not a number\n  hint: a number with a decimal point for "
       "every node"},
      {"v_rel_mm_s,mu\n1,0.1\n2,-0.1\n", "FILE:3: error: mu = -0.1 is below 0"},
      {"v_rel_mm_s,mu\n1,0.1\n2,0.1\n1,0.2\n",
       "FILE:4: error: the node v_rel_mm_s = 1 stands already in line 2\n"
       "  hint: one row for every node"},
      {"v_rel_mm_s,psi,mu\n1,1,0.1\n2,1,0.1\n1,2,0.2\n",
       "FILE:1: error: has no row for the node v_rel_mm_s = 2, psi = 2\n"
       "  hint: a row for every combination of the axes' values"},
      {"v_rel_mm_s,psi,mu\n1,1,0.1\n2,1,0.1\n",
       "FILE:1: error: psi has one value alone, 1\n"
       "  hint: an axis has at least two; leave the column out"},
      {"v_rel_mm_s [K],mu\n1,0.1\n2,0.1\n", "FILE:1: error: v_rel_mm_s cannot be in 'K'"},
      {"F_N_N,mu\n1,0.1\n2,0.1\n",
       "FILE:1: error: F_N_N is not a state of a contact and not an axis"},
      {"v_rel_mm_s,mu,tau_R_MPa\n1,0.1,1\n2,0.1,1\n",
       "FILE:1: error: has more than one column mu or tau_R_MPa"},
  };
  for (const Refused& c : cases) {
    const Read found = read(c.csv);
    EXPECT_FALSE(found.table) << c.csv;
    EXPECT_THAT(found.faults, testing::StartsWith(c.said)) << c.csv;
  }
  EXPECT_EQ(read("v_rel_mm_s,mu\n0,0.1\n2,0.1\n", {"v_rel_mm_s"}).faults,
            "job.toml:3:9: error: the axis v_rel_mm_s cannot be logarithmic: it starts at 0\n"
            "  hint: leave it out of log_axes, or begin above 0");
  EXPECT_EQ(read("v_rel_mm_s,mu\n1,0.1\n2,0.1\n", {"psi"}).faults,
            "job.toml:3:9: error: FILE has no axis 'psi'\n"
            "  hint: log_axes names some of: v_rel_mm_s");
}

TEST_F(LawTables, OfScatteredPointsOrTooManyNodesAreRefused) {
  std::string scattered = "v_rel_mm_s,psi,mu\n", large = "v_rel_mm_s,mu\n";
  for (int i = 1; i <= 100; ++i)
    scattered += fmt::format("{},{},0.1\n", i, 1 + i * 0.01);
  EXPECT_THAT(read(scattered).faults,
              testing::StartsWith(
                  "FILE:1: error: is not a full grid: 100 rows for 100 x 100 = 10000 nodes"));
  for (std::size_t i = 1; i <= models::most_law_nodes + 1; ++i)
    large += fmt::format("{},0.1\n", i);
  EXPECT_THAT(read(large).faults,
              testing::StartsWith("FILE:1: error: has 5001 = 5001 nodes\n"
                                  "  hint: a law that is a table has at most 5,000"));
}

} // namespace
} // namespace frictab::law_table_test
