// Campaigns held as blocks: what a block keeps of its rows, files read in pieces, rows asked for
// once more.
#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "data/condense.h"
#include "data/derived.h"
#include "data/load_condensed.h"
#include "data/overview.h"
#include "data/plausibility.h"
#include "data/write_dataset.h"
#include "io/csv.h"
#include "io/hdf5.h"
#include "support/run_command.h"
#include "unit/load_case.h"

namespace frictab::condense_test {
namespace {

using data::Dataset;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAreArray;

Dataset rows_of_one(std::vector<double> pressure, std::vector<double> tau) {
  Dataset data;
  data.experiments = {"A"};
  data.first_row = {0, tau.size()};
  data.columns = {{"sigma_n_MPa", "MPa", std::move(pressure), {}},
                  {"tau_R_MPa", "MPa", std::move(tau), {}}};
  return data;
}

std::vector<double> held(const Dataset& data, const std::string& name) {
  const auto values = data.values(name);
  return {values.begin(), values.end()};
}

// SYNTHETIC: one test whose pressure and stress grow, with a saw on top.
Dataset many_rows_of_one(std::size_t rows) {
  std::vector<double> pressure, tau;
  for (std::size_t i = 0; i < rows; ++i) {
    pressure.push_back(100 + static_cast<double>(i));
    tau.push_back(10 + 0.1 * static_cast<double>(i) + static_cast<double>(i % 7));
  }
  return rows_of_one(pressure, tau);
}

// First row of each block, and the end.
std::vector<std::size_t> starts(const Dataset& blocks) {
  std::vector<std::size_t> first{0};
  for (const double rows : blocks.condensed->rows)
    first.push_back(first.back() + static_cast<std::size_t>(rows));
  return first;
}

TEST(Condense, ABlockIsItsMeanItsRowsAndItsSquares) {
  const Dataset rows = many_rows_of_one(1000), blocks = data::condense(rows, 20, nullptr);
  const auto first = starts(blocks);
  ASSERT_EQ(first.back(), 1000u);
  for (std::size_t b = 0; b + 1 < first.size(); ++b) {
    double sum = 0, square = 0;
    for (std::size_t i = first[b]; i < first[b + 1]; ++i) {
      sum += rows.values("tau_R_MPa")[i];
      square += rows.values("tau_R_MPa")[i] * rows.values("tau_R_MPa")[i];
    }
    const double n = blocks.condensed->rows[b];
    EXPECT_LE(n, 50);
    EXPECT_NEAR(blocks.values("tau_R_MPa")[b], sum / n, 1e-12);
    EXPECT_NEAR(blocks.condensed->within_MPa2[b], square - sum * sum / n, 1e-8);
  }
  EXPECT_EQ(blocks.source_rows(), 1000u);
}

TEST(Condense, BlocksAreShortWhereATestBegins) {
  const auto first = starts(data::condense(many_rows_of_one(10'000), 100, nullptr));
  for (std::size_t b = 0; b + 1 < first.size(); ++b)
    EXPECT_LE(first[b + 1] - first[b], std::max<std::size_t>(1, first[b] / 8)) << first[b];
  EXPECT_LT(first.size(), 180u);
}

TEST(Condense, SpansAndMeansOfRatiosAreOfAllRows) {
  const Dataset rows = many_rows_of_one(1000), blocks = data::condense(rows, 20, nullptr);
  EXPECT_EQ(data::source_range(blocks, "tau_R_MPa", blocks.values("tau_R_MPa")),
            data::source_range(rows, "tau_R_MPa", rows.values("tau_R_MPa")));
  EXPECT_NEAR(data::overview(blocks)[0].mean_mu, data::overview(rows)[0].mean_mu, 1e-15);
}

TEST(Condense, ABlockEndsWhereTheLoadBeginsOrATextChanges) {
  Dataset rows = many_rows_of_one(200);
  std::fill_n(rows.columns[0].values.begin(), 101, 0.0);
  std::vector<double> oil(200, 0);
  std::fill(oil.begin() + 151, oil.end(), 1.0);
  rows.columns.push_back({"oil", "", oil, {"A", "B"}});
  const Dataset blocks = data::condense(rows, 2, nullptr);
  EXPECT_THAT(starts(blocks), testing::IsSupersetOf({101u, 151u}));
  EXPECT_EQ(held(blocks, "oil").back(), 1);
  for (const double pressure : held(blocks, "sigma_n_MPa"))
    EXPECT_TRUE(pressure == 0 || pressure > 200) << pressure;
}

TEST(Condense, CellsWithoutAValueAreNotInTheMean) {
  Dataset rows = many_rows_of_one(200);
  std::vector<double> humidity(200, std::nan(""));
  for (std::size_t i = 0; i < 100; i += 2)
    humidity[i] = 40;
  rows.columns.push_back({"humidity", "", humidity, {}});
  const std::vector<double> means = held(data::condense(rows, 2, nullptr), "humidity");
  EXPECT_EQ(means[means.size() / 2], 40);
  EXPECT_TRUE(std::isnan(means.back()));
}

TEST(Condense, HistoriesAreTakenRowByRow) {
  Dataset rows = many_rows_of_one(1000);
  std::reverse(rows.columns[0].values.begin(), rows.columns[0].values.end());
  const data::DerivedQuantity& mean = *data::find_derived("mean_sigma_n");
  const std::vector<double> by_row = data::derive(mean, rows, {});
  const Dataset blocks = data::condense(rows, 20, nullptr);
  const std::vector<double> of_blocks = data::derive(mean, blocks, {});
  const auto first = starts(blocks);
  for (std::size_t b = 0; b < of_blocks.size(); ++b) {
    const double n = blocks.condensed->rows[b];
    double sum = 0;
    for (std::size_t i = first[b]; i < first[b + 1]; ++i)
      sum += by_row[i];
    EXPECT_NEAR(of_blocks[b], sum / n, 1e-9);
  }
  EXPECT_EQ(blocks.condensed->experiments[0].spans.at("peak_sigma_n").second, 1099);
}

TEST(Condense, AnExperimentOfFewRowsKeepsThem) {
  const Dataset rows = rows_of_one({100, 110, 120}, {10, 11, 12});
  const Dataset blocks = data::condense(rows, 500, nullptr);
  EXPECT_EQ(held(blocks, "tau_R_MPa"), held(rows, "tau_R_MPa"));
}

// ---- pieces of a file ----

bool same_cells(const io::CsvTable& a, const io::CsvTable& b) {
  if (a.columns.size() != b.columns.size() || a.line != b.line || a.interval != b.interval)
    return false;
  for (std::size_t c = 0; c < a.columns.size(); ++c) {
    const io::CsvColumn &x = a.columns[c], &y = b.columns[c];
    if (x.name != y.name || x.unit != y.unit || x.texts.size() != y.texts.size()) return false;
    for (std::size_t t = 0; t < x.texts.size(); ++t)
      if (x.texts[t].row != y.texts[t].row || x.texts[t].text != y.texts[t].text ||
          x.texts[t].column != y.texts[t].column)
        return false;
    for (std::size_t i = 0; i < x.numbers.size(); ++i)
      if (x.numbers[i] != y.numbers[i] && !std::isnan(x.numbers[i] + y.numbers[i])) return false;
  }
  return true;
}

io::CsvTable in_pieces(const std::string& text, const io::CsvFormat& format, std::size_t bytes) {
  io::CsvPieces pieces(std::make_unique<std::istringstream>(text), "a.csv", format, bytes);
  EXPECT_EQ(pieces.whole_because(), "");
  FaultList faults;
  io::CsvTable all;
  for (auto next = pieces.next(faults); !next.empty(); next = pieces.next(faults))
    for (io::CsvTable& piece : next)
      if (all.columns.empty())
        all = std::move(piece);
      else
        io::append(all, std::move(piece));
  faults.throw_if_any();
  return all;
}

TEST(CsvPieces, AreTheFile) {
  const std::string text = "# rig 7\nexperiment;F_N;remark;\nname;N;;\n\n"
                           "007;1,5;\"two\nlines\";\r\n007;2,5;caf\xe9;\n;;;\n"
                           "8;3,25;\"a \"\"b\"\"\";\n8;x;;\n9;1;;7\n";
  io::CsvFormat format;
  format.decimal = ',';
  format.units_row = true;
  format.wanted = {"F_N", "experiment"};
  format.text_columns = {"experiment"};
  FaultList faults;
  const io::CsvTable whole = io::parse_csv(text, "a.csv", format, faults);
  ASSERT_TRUE(faults.empty());
  ASSERT_EQ(whole.rows(), 5u);
  for (std::size_t bytes = 1; bytes < text.size(); bytes += 3) {
    const io::CsvTable pieces = in_pieces(text, format, bytes);
    EXPECT_TRUE(same_cells(whole, pieces)) << bytes;
    EXPECT_EQ(whole.notes, pieces.notes) << bytes;
  }
}

TEST(CsvPieces, CountTextsBelowTheUnitsAsTheFileDoes) {
  const std::string text = "t,F_N\ns,N\nchannel a,channel b\nMX840,MX840\n0,1\n1,2\n2,3\n";
  io::CsvFormat format;
  format.units_row = true;
  FaultList faults;
  const io::CsvTable whole = io::parse_csv(text, "a.csv", format, faults);
  ASSERT_EQ(whole.rows(), 3u);
  const auto is_counted =
      testing::ElementsAre(testing::Field(&io::CsvCount::count, testing::Eq(2u)));
  EXPECT_THAT(whole.counts, is_counted);
  for (std::size_t bytes = 1; bytes < text.size(); bytes += 3)
    EXPECT_THAT(in_pieces(text, format, bytes).counts, is_counted) << bytes;
}

TEST(CsvPieces, FaultsStandInTheLinesOfTheFile) {
  std::string text = "a,b\n";
  for (int i = 0; i < 100; ++i)
    text += i == 77 ? "1,2,3\n" : "1,2\n";
  try {
    in_pieces(text, {}, 16);
    FAIL() << "a ragged line was taken";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("a.csv:79: error: 3 cells, the header has 2"));
  }
}

// ---- campaigns ----

class CondensedLoad : public test::LoadCase {
protected:
  void SetUp() override {
    LoadCase::SetUp();
    options.piece_bytes = 256; // a part of a test of 40 rows
  }
  // SYNTHETIC: tests of 40 rows.
  std::string tests(int count, const std::string& first = "") {
    std::string text = "experiment,time_s,sigma_n_MPa,v_rel_mm_s,film,tau_R_MPa\n";
    for (int test = 0; test < count; ++test)
      for (int row = 0; row < 40; ++row)
        text += fmt::format("{}t{},{},{},{},{},{}\n", first, test, 0.1 * row, 500 + 10 * test,
                            10 + test, row % 8 == 0 ? "" : "3", 40 + test + 0.1 * (row % 7));
    return text;
  }
  Dataset condensed(const std::vector<std::string>& files, std::size_t blocks = 10) {
    return data::load_condensed(files, options, blocks);
  }
  std::string condensed_fault(const std::string& text) {
    return condensed_fault_of(file("a.csv", text));
  }
  std::string condensed_fault_of(const std::string& name) {
    try {
      condensed({name});
    } catch (const InputError& error) {
      return error.what();
    }
    return "no fault";
  }
};

TEST_F(CondensedLoad, IsTheCondensedCampaign) {
  const std::string name = file("a.csv", tests(5));
  const Dataset rows = data::load_dataset({name}, options);
  const Dataset by_parts = condensed({name});
  const Dataset at_once = data::condense(rows, 10, nullptr);
  EXPECT_EQ(by_parts.hash, at_once.hash);
  EXPECT_THAT(by_parts.notes, UnorderedElementsAreArray(rows.notes));
  EXPECT_EQ(by_parts.sources, rows.sources);
  EXPECT_EQ(by_parts.source_rows(), rows.rows());
  for (std::size_t e = 0; e < rows.experiments.size(); ++e)
    EXPECT_EQ(data::overview(by_parts)[e].spans, data::overview(rows)[e].spans);
}

TEST_F(CondensedLoad, AnExperimentLargerThanAPieceStaysWhole) {
  const std::string name = file("a.csv", tests(3));
  options.piece_bytes = 100;
  const std::uint64_t small = condensed({name}).hash;
  options.piece_bytes = 1 << 20;
  EXPECT_EQ(condensed({name}).hash, small);
}

TEST_F(CondensedLoad, OfHdf5IsTheCondensedCampaign) {
  data::write_hdf5_columns(data::load_dataset({file("a.csv", tests(5))}, options),
                           directory_ / "a.h5");
  const Dataset rows = data::load_dataset({"a.h5"}, options);
  for (const std::size_t bytes : {1, 100, 1000, 1 << 20}) { // from a row at a time to all at once
    options.piece_bytes = bytes;
    const Dataset blocks = condensed({"a.h5"});
    EXPECT_EQ(blocks.hash, data::condense(rows, 10, nullptr).hash) << bytes;
    EXPECT_EQ(blocks.source_rows(), rows.rows());
  }
}

TEST_F(CondensedLoad, OfGroupsOfHdf5IsTheCondensedCampaign) {
  const auto write = [&](const char* of_the_last) {
    const std::string script = fmt::format(R"(
import h5py, numpy
with h5py.File("a.h5", "w") as f:
  f.create_group("a_without_rows")
  f.create_group("t1_without_rows")
  for test in range(4):
    g = f.create_group(f"t{{test}}")
    g["sigma_n_MPa"] = numpy.full(40, 500.0 + test)
    g["tau_R_MPa"] = 40 + numpy.arange(40) % 7
    g.attrs["oil"] = "a" if test % 2 else "b"
    g.attrs["film"] = 0.5 * test
  {}
)",
                                           of_the_last);
    const auto [code, out, err] = test::run_command({FRICTAB_PYTHON, "-c", script}, directory_);
    ASSERT_EQ(code, 0) << err;
  };
  write("pass");
  const Dataset rows = data::load_dataset({"a.h5"}, options);
  ASSERT_THAT(rows.experiments, ElementsAre("t0", "t1", "t2", "t3"));
  for (const std::size_t bytes : {1, 200, 1 << 20}) {
    options.piece_bytes = bytes;
    EXPECT_EQ(condensed({"a.h5"}).hash, data::condense(rows, 10, nullptr).hash) << bytes;
  }
  options.piece_bytes = 1;
  const auto fault_with = [&](const char* of_the_last) {
    write(of_the_last);
    return condensed_fault_of("a.h5");
  };
  EXPECT_THAT(fault_with("del g['tau_R_MPa']"),
              HasSubstr("a.h5: error: group 't3' has no tau_R_MPa, which others have"));
  EXPECT_THAT(fault_with("g['time_s'] = numpy.arange(40)"),
              HasSubstr("a.h5: error: column 'time_s' is not in all groups"));
  EXPECT_THAT(fault_with("g['time_s'] = numpy.arange(39)"),
              HasSubstr("a.h5: error: column 't3/time_s' has 39 rows, 't3/sigma_n_MPa' has 40"));
}

TEST_F(CondensedLoad, RowsOfHdf5ThatAreScatteredAreRefusedByTheirNumber) {
  const std::size_t rows[] = {3};
  io::Hdf5Writer out(directory_ / "a.h5");
  for (const char* name : {"sigma_n_MPa", "tau_R_MPa"})
    out.dataset(name, rows, std::vector<double>{3, 4, 5});
  out.dataset("experiment", std::vector<std::string>{"a", "b", "a"});
  out.close();
  options.piece_bytes = 1;
  EXPECT_THAT(condensed_fault_of("a.h5"),
              HasSubstr("a.h5: error: experiment 'a' comes again in row 3"));
}

TEST_F(CondensedLoad, SeveralFilesAreOneCampaign) {
  const std::vector<std::string> names = {file("a.csv", tests(2, "a")),
                                          file("b.csv", tests(3, "b"))};
  EXPECT_EQ(condensed(names).hash,
            data::condense(data::load_dataset(names, options), 10, nullptr).hash);
}

TEST_F(CondensedLoad, ScatteredRowsAreRefusedAtTheirLine) {
  const std::string text = tests(2); // 80 rows below the header
  EXPECT_THAT(condensed_fault(text + "t0,9,500,10,3,40\n"),
              HasSubstr("a.csv:82: error: experiment 't0' comes again, after rows of another one"));
  EXPECT_THAT(fault(text + "t0,9,500,10,3,40\n"), "no fault"); // rows that are held are gathered
}

TEST_F(CondensedLoad, RowsLeftOutAreCountedOverAllParts) {
  options.drop.push_back({"tau_R_MPa", 40.05, {}, {}});
  const std::string name = file("a.csv", tests(5));
  const Dataset rows = data::load_dataset({name}, options), blocks = condensed({name});
  ASSERT_EQ(blocks.dropped.size(), 1u);
  EXPECT_EQ(blocks.dropped[0].rows, rows.dropped[0].rows);
  EXPECT_EQ(blocks.source_rows(), rows.rows());
}

TEST_F(CondensedLoad, AnExperimentOfWhichNothingIsLeftIsNoFault) {
  options.drop.push_back({"sigma_n_MPa", 505, {}, {}}); // all of t0
  EXPECT_THAT(condensed({file("a.csv", tests(3))}).experiments, ElementsAre("t1", "t2"));
  options.drop[0].below = 1000;
  EXPECT_THAT(condensed_fault(tests(3)), HasSubstr("leave no row of this file"));
}

TEST_F(CondensedLoad, WhatIsImplausibleIsCountedOverAllParts) {
  std::string text = "experiment,sigma_n_MPa,tau_R_MPa\n";
  for (int test = 0; test < 4; ++test)
    for (int row = 0; row < 30; ++row)
      text += fmt::format("t{},500,{}\n", test, row < 5 + test ? 600 : 50);
  const std::string name = file("a.csv", text);
  const auto of_rows = data::find_implausible(data::load_dataset({name}, options));
  const auto of_blocks = data::find_implausible(condensed({name}));
  ASSERT_EQ(of_rows.size(), 1u);
  ASSERT_EQ(of_blocks.size(), 1u);
  EXPECT_EQ(of_blocks[0].check, of_rows[0].check);
  EXPECT_EQ(of_blocks[0].rows, 26u);
  EXPECT_EQ(of_blocks[0].of, of_rows[0].of);
}

TEST_F(CondensedLoad, EveryRowComesAgain) {
  const Dataset blocks = condensed({file("a.csv", tests(6))});
  const Dataset first = blocks.subset(std::vector<std::size_t>{0, 3});
  std::vector<std::vector<double>> seen(2);
  const Dataset* const asked[] = {&first};
  data::read_again(asked, [&](std::size_t, std::size_t e, const Dataset& rows) {
    seen[e] = held(rows, "tau_R_MPa");
  });
  ASSERT_EQ(seen[0].size(), 40u);
  ASSERT_EQ(seen[1].size(), 40u);
  EXPECT_THAT(seen[1][6], DoubleNear(43.6, 1e-9));
}

TEST_F(CondensedLoad, AFileThatChangedIsTold) {
  const Dataset blocks = condensed({file("a.csv", tests(3))});
  file("a.csv", tests(3) + "t2,9,520,12,3,40\n");
  const Dataset* const asked[] = {&blocks};
  try {
    data::read_again(asked, [](std::size_t, std::size_t, const Dataset&) {});
    FAIL() << "other rows were taken for the same";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("experiment 't2' had 40 rows when it was condensed"));
  }
}

TEST_F(CondensedLoad, OnlyLargeCampaignsAreCondensedUnasked) {
  options.training = {file("a.csv", tests(3))};
  EXPECT_EQ(data::blocks_to_condense(options), 0u);
  options.condense = {220};
  EXPECT_EQ(data::blocks_to_condense(options), 220u);
}

} // namespace
} // namespace frictab::condense_test
