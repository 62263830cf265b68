// Tables that are sampled to disk in chunks: the bytes of the one in memory, however interrupted.
#include <cmath>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/parallel.h"
#include "support/run_command.h"
#include "support/sample_data.h"
#include "table/chunk_list.h"
#include "table/drift.h"
#include "table/stream.h"
#include "table/table_file.h"

namespace frictab::stream_test {

using models::AssembledLaw;
using table::read_table;
using table::state_ranges;
using table::StreamedTable;
using table::Table;
using table::TableOptions;

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// 3,840,000 nodes: four chunks, the last one not full.
TableOptions large_grid() {
  TableOptions options;
  const std::pair<const char*, std::size_t> nodes[] = {
      {"sigma_n_MPa", 40}, {"psi", 30}, {"v_rel_mm_s", 40}, {"T_contact_C", 80}};
  for (const auto& [name, count] : nodes)
    options.axes[name].nodes = count;
  options.interpolation = table::Interpolation::linear;
  options.memory_limit_MiB = 16;
  options.place = {"job.toml", 4, 1};
  return options;
}

struct Case {
  models::Model model = test::plausible_model(*models::find_law("log_coulomb"));
  data::Dataset data = test::sample_data(model);
  TableOptions options = large_grid();
  std::vector<table::StateRange> ranges = state_ranges(AssembledLaw(model), data, options);
};

class StreamedTableFile : public testing::Test {
protected:
  StreamedTable stream(const Case& c) {
    return table::stream_table(AssembledLaw(c.model), c.ranges, c.options, file());
  }
  // As the pipeline does: the complete file under its name.
  Table complete(const Case& c, const StreamedTable& streamed) {
    fs::rename(table::finish_stream(streamed.table, c.options.hdf5, file()), file());
    return read_table(file(), 1 << 20);
  }
  fs::path file() const { return directory.path("t/log_coulomb.h5"); }
  fs::path work(const char* ending) const {
    return directory.path(std::string("t/.log_coulomb.h5") + ending);
  }
  std::vector<double> values_of(const Table& table) {
    std::vector<double> values(table.nodes());
    table.stored->read(0, values);
    return values;
  }
  // The list as a kill leaves it: the first `lines` chunks, and half a line.
  void cut_list(std::size_t lines) {
    std::ifstream in(work(".chunks"));
    std::string text, line;
    for (std::size_t i = 0; i < 1 + lines && std::getline(in, line); ++i)
      text += line + "\n";
    std::ofstream(work(".chunks")) << text << "000000000";
  }
  test::TemporaryDirectory directory;
};

using SlowStreamedTableFile = StreamedTableFile;

// Some of them beyond the axes.
table::States states_of(const Case& c, const Table& table, std::size_t samples) {
  table::States states = table::probe_points(c.ranges, table.axes, samples);
  for (std::vector<double>& column : states)
    for (std::size_t i = 0; i < column.size(); i += 7)
      column[i] *= 1.5;
  return states;
}

TEST_F(StreamedTableFile, HoldsTheBytesOfTheTableInMemory) {
  const Case c;
  ASSERT_TRUE(table::is_streamed(AssembledLaw(c.model), c.ranges, c.options));
  const Table inside = table::build_table(AssembledLaw(c.model), c.ranges, c.options);
  const StreamedTable streamed = stream(c);
  EXPECT_EQ(streamed.chunks, 4U);
  EXPECT_EQ(streamed.kept, 0U);
  const Table outside = complete(c, streamed);
  ASSERT_TRUE(outside.stored);
  EXPECT_EQ(outside.nodes(), inside.nodes());
  EXPECT_EQ(values_of(outside), inside.value);
  EXPECT_EQ(expr::to_text(outside.combine), expr::to_text(inside.combine));
  EXPECT_EQ(read_table(file()).value, inside.value); // small enough for memory by default
}

TEST_F(StreamedTableFile, AnswersWithTheSameBitsAsTheTableInMemory) {
  const Case c;
  const Table inside = table::build_table(AssembledLaw(c.model), c.ranges, c.options);
  const StreamedTable streamed = stream(c);
  const table::TableFunction one(inside), two(streamed.table);
  const table::States points = states_of(c, inside, 3000);
  for (std::size_t i = 0; i < points.front().size(); ++i) {
    std::vector<double> state, slope_one(c.ranges.size()), slope_two(c.ranges.size());
    for (std::size_t d = 0; d < points.size(); ++d)
      state.push_back(points[d][i]);
    unsigned outside_one = 0, outside_two = 0;
    ASSERT_EQ(one(state, &outside_one), two(state, &outside_two)) << i;
    ASSERT_EQ(outside_one, outside_two) << i;
    ASSERT_EQ(one.gradient(state, slope_one), two.gradient(state, slope_two)) << i;
    ASSERT_EQ(slope_one, slope_two) << i;
  }
}

// Few states are read one by one, many of them in the order of their cells.
TEST_F(StreamedTableFile, AnswersManyRowsWithTheSameBitsAsTheTableInMemory) {
  const Case c;
  const Table inside = table::build_table(AssembledLaw(c.model), c.ranges, c.options);
  const StreamedTable streamed = stream(c);
  const table::TableFunction one(inside), two(streamed.table);
  for (const std::size_t samples : {100UL, 200000UL}) {
    table::States states = states_of(c, inside, samples);
    states[1][samples / 2] = std::nan("");
    std::vector<const double*> columns;
    for (const std::vector<double>& column : states)
      columns.push_back(column.data());
    const std::size_t rows = states[0].size();
    std::vector<double> tau_one(rows), tau_two(rows);
    std::vector<unsigned> bits_one(rows), bits_two(rows);
    one.evaluate(rows, columns, tau_one, bits_one);
    two.evaluate(rows, columns, tau_two, bits_two);
    EXPECT_EQ(bits_one, bits_two);
    for (std::size_t i = 0; i < rows; ++i)
      ASSERT_TRUE(tau_one[i] == tau_two[i] || (std::isnan(tau_one[i]) && std::isnan(tau_two[i])))
          << i;
  }
}

TEST_F(SlowStreamedTableFile, IsTheSameFileOnAnyNumberOfThreadsAndHoweverInterrupted) {
  const Case c;
  set_threads(1);
  complete(c, stream(c));
  const std::string whole = directory.read("t/log_coulomb.h5");
  set_threads(2);
  stream(c);
  cut_list(2);
  const StreamedTable resumed = stream(c);
  set_threads(0);
  EXPECT_EQ(resumed.kept, 2U);
  complete(c, resumed);
  EXPECT_TRUE(directory.read("t/log_coulomb.h5") == whole);
}

TEST_F(StreamedTableFile, ChunkWhoseBytesChangedIsSampledAgain) {
  const Case c;
  const std::vector<double> right = values_of(stream(c).table);
  {
    std::fstream out(work(".partial"), std::ios::in | std::ios::out | std::ios::binary);
    out.seekp((1 << 20) + (1 << 23) + 12345); // within the second chunk
    out.put('x');
  }
  const StreamedTable again = stream(c);
  EXPECT_EQ(again.kept, 3U);
  EXPECT_EQ(values_of(again.table), right);
}

TEST_F(StreamedTableFile, AnotherJobStartsAnew) {
  Case c;
  stream(c);
  EXPECT_EQ(stream(c).kept, 4U);
  Case parameters = c;
  parameters.model.parameters[0] *= 1.01;
  EXPECT_EQ(stream(parameters).kept, 0U);
  Case grid = c;
  grid.options.axes["psi"].range = {1, 18};
  grid.ranges = state_ranges(AssembledLaw(grid.model), grid.data, grid.options);
  EXPECT_EQ(stream(grid).kept, 0U);
  Case law = c;
  law.model = test::plausible_model(*models::find_law("exp_coulomb"));
  for (const char* name : {"sigma_n_MPa", "T_contact_C"})
    law.options.axes[name].nodes = 2000;
  law.ranges = state_ranges(AssembledLaw(law.model), law.data, law.options);
  EXPECT_EQ(stream(law).kept, 0U);
}

TEST_F(StreamedTableFile, IsPackedInChunksWithChecksumsWhereAsked) {
  Case c;
  c.options.hdf5 = {50000, 1, true};
  const StreamedTable streamed = stream(c);
  const Table packed = complete(c, streamed); // unpacked again: larger than asked to hold
  EXPECT_EQ(values_of(packed), values_of(streamed.table));
  const auto layout = table::read_description(file()).layout;
  EXPECT_EQ(layout.chunk, (std::vector<std::size_t>{1, 15, 40, 80}));
  EXPECT_EQ(layout.filters, (std::vector<std::string>{"shuffle", "deflate 1", "fletcher32"}));
  EXPECT_LT(layout.stored_bytes, 8 * packed.nodes());
  std::size_t files = 0; // the unpacked copy has no name
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(directory.path("t")))
    ++files;
  EXPECT_EQ(files, 3U); // table, work file, list
}

TEST_F(StreamedTableFile, CubicTableIsRefusedWithItsSize) {
  Case c;
  c.options.interpolation = table::Interpolation::cubic;
  try {
    table::is_streamed(AssembledLaw(c.model), c.ranges, c.options);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("job.toml:4:1: error: a cubic table of 3,840,000 nodes (29.3 MiB) is "
                          "larger than table.memory_limit_MiB = 16"));
  }
}

TEST_F(StreamedTableFile, GridOfTheToleranceIsNotStreamed) {
  Case c;
  c.options.axes["psi"].nodes.reset();
  EXPECT_FALSE(table::is_streamed(AssembledLaw(c.model), c.ranges, c.options));
  EXPECT_FALSE(table::fixed_axes(AssembledLaw(c.model), c.ranges, c.options));
}

TEST_F(StreamedTableFile, TableLargerThanTheDiskIsRefusedBeforeAnythingIsWritten) {
  Case c;
  for (auto& [name, axis] : c.options.axes)
    axis.nodes = 10000;
  try {
    stream(c);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("error: the table of log_coulomb (10,000,000,000,000,000 "
                                        "nodes: sigma_n_MPa 10000, psi 10000, v_rel_mm_s 10000, "
                                        "T_contact_C 10000) needs 74505806.0 GiB on disk, "));
  }
  EXPECT_FALSE(fs::exists(directory.path("t")));
}

TEST_F(StreamedTableFile, TwoProcessesDoNotWriteTheSameTable) {
  const Case c;
  fs::create_directories(directory.path("t"));
  const table::ChunkList other(work(".chunks"), "another job");
  try {
    stream(c);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(".chunks: error: another frictab is writing this table"));
  }
}

TEST_F(StreamedTableFile, ShardsInAnyOrderMakeTheTableOfOneProcess) {
  const Case c;
  const auto shard = [&](std::uint64_t number, std::uint64_t of) {
    return table::sample_shard(AssembledLaw(c.model), c.ranges, c.options, file(), {number, of});
  };
  const table::SampledShard second = shard(2, 3);
  EXPECT_EQ(second.chunks, 1u);
  EXPECT_EQ(shard(1, 3).chunks, 2u); // of four: the first and the last, which is not full
  EXPECT_EQ(shard(1, 3).kept, 2u) << "a shard that is run again";
  StreamedTable streamed = stream(c); // the third shard never came
  EXPECT_EQ(streamed.kept, 3u);
  EXPECT_EQ(values_of(complete(c, streamed)),
            table::build_table(AssembledLaw(c.model), c.ranges, c.options).value);
}

TEST_F(StreamedTableFile, ChunksOfAShardWhoseBytesAreNotTheListedOnesAreSampledAgain) {
  const Case c;
  for (const std::uint64_t number : {1, 2})
    table::sample_shard(AssembledLaw(c.model), c.ranges, c.options, file(), {number, 2});
  {
    std::fstream partial(work(".partial"), std::ios::in | std::ios::out | std::ios::binary);
    partial.seekp((1 << 20) + 12345);
    partial << "not what was sampled";
  }
  StreamedTable streamed = stream(c);
  EXPECT_EQ(streamed.kept, 3u);
  EXPECT_EQ(values_of(complete(c, streamed)),
            table::build_table(AssembledLaw(c.model), c.ranges, c.options).value);
}

TEST_F(StreamedTableFile, ShardsOfTwoJobsDoNotMeetInOneFile) {
  const Case c;
  fs::create_directories(directory.path("t"));
  const auto sample = [&] {
    return table::sample_shard(AssembledLaw(c.model), c.ranges, c.options, file(), {1, 2}).chunks;
  };
  {
    const table::ChunkList other(work(".chunks.2-of-2"), "another job");
    try {
      sample();
      FAIL();
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(".chunks.2-of-2: error: another frictab is writing this "
                                          "table, of another job\n  hint: "));
    }
  }
  EXPECT_EQ(sample(), 2u) << "the other one has ended";
}

TEST(StoredValues, FileThatIsCutShortIsAFaultThatNamesIt) {
  const test::TemporaryDirectory directory;
  const std::string file = directory.write("v", std::string(100, 'x'));
  const io::StoredValues values(file, "tables/t.h5", 8, 20);
  std::vector<double> out(20);
  try {
    values.read(0, out);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              "tables/t.h5: error: ends at byte 100, within its values\n"
              "  hint: it was cut short: write it again, or take a copy");
  }
}

// One value of the packed table changed by hand.
TEST(TableFile, DamagedChunkIsAFaultThatNamesTheFile) {
  const test::TemporaryDirectory directory;
  const models::Model model = test::plausible_model(*models::find_law("levanov"));
  TableOptions options;
  for (const char* name : {"sigma_n_MPa", "sigma_f_MPa"})
    options.axes[name].nodes = 60;
  const Table table = table::build_table(
      AssembledLaw(model), state_ranges(AssembledLaw(model), test::sample_data(model), options),
      options);
  for (const io::Hdf5Storage& storage :
       {io::Hdf5Storage{600, 0, true}, io::Hdf5Storage{600, 6, true}}) {
    const std::string file = directory.path("t.h5");
    table::write_table(table, file, storage);
    EXPECT_EQ(read_table(file).value, table.value);
    EXPECT_EQ(read_table(file, 0).nodes(), table.nodes()); // left on disk, unpacked
    std::string bytes = directory.read("t.h5");
    const auto* value = reinterpret_cast<const char*>(&table.value[1234]);
    const std::size_t at =
        storage.compress ? 2 * bytes.size() / 3 : bytes.find(std::string(value, sizeof(double)));
    ASSERT_LT(at, bytes.size());
    bytes[at] = static_cast<char>(bytes[at] ^ 1);
    directory.write("t.h5", bytes);
    for (const std::size_t in_memory : {table::most_bytes_in_memory, std::size_t{0}})
      try {
        read_table(file, in_memory);
        FAIL() << storage.compress << " " << in_memory;
      } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()),
                  file +
                      ": error: 'value' cannot be read: a chunk does not fit its checksum or its "
                      "compression\n  hint: the file is damaged: write it again, or take a copy");
      }
  }
}

} // namespace
} // namespace frictab::stream_test
