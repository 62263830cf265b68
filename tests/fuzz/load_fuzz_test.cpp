// Damaged data files: whatever the bytes, reading gives a Dataset or an InputError.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/random.h"
#include "data/load.h"
#include "data/quantity.h"
#include "guess/guess.h"
#include "io/file_streams.h"
#include "io/hdf5.h"
#include "job/guessed_job.h"

namespace frictab::load_fuzz_test {
namespace {

namespace fs = std::filesystem;

std::string mutated(std::string bytes, Random& random, std::size_t most) {
  static const std::string spice[] = {"\"", "\n",   "\r\n", ",",     "\t",   ";",    "nan", "-",
                                      "",   "\"\"", "e",    "1e999", "\xff", "\xc3", " ",   "inf"};
  for (std::size_t k = 1 + random.below(most); k > 0 && !bytes.empty(); --k) {
    const std::size_t at = random.below(bytes.size());
    switch (random.below(5)) {
    case 0:
      bytes[at] = static_cast<char>(random.below(256));
      break;
    case 1:
      bytes.insert(at, spice[random.below(std::size(spice))]);
      break;
    case 2:
      bytes.erase(at, 1 + random.below(8));
      break;
    case 3:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << random.below(8)));
      break;
    default:
      if (random.below(8) == 0) bytes.resize(at);
    }
  }
  return bytes;
}

// What a Dataset promises, so that a fault that slips through is seen.
bool is_sound(const data::Dataset& data) {
  if (data.rows() == 0 || data.first_row.size() != data.experiments.size() + 1) return false;
  for (const data::Column& column : data.columns) {
    if (column.values.size() != data.rows()) return false;
    const data::Quantity* quantity = data::find_quantity(column.name);
    for (const double value : column.values) {
      if (quantity && !(std::isfinite(value) && value >= quantity->lowest)) return false;
      if (!column.levels.empty() && !(value >= 0 && value < double(column.levels.size())))
        return false;
    }
  }
  return data.has("sigma_n_MPa") && data.has("tau_R_MPa");
}

enum Outcome { read_well, refused, unsound, other_error };

Outcome load(const std::string& file, const data::DataOptions& options) {
  try {
    return is_sound(data::load_dataset({file}, options)) ? read_well : unsound;
  } catch (const InputError& error) {
    return error.faults().empty() ? other_error : refused;
  } catch (const std::exception& error) {
    ADD_FAILURE() << error.what();
    return other_error;
  }
}

class LoadFuzz : public testing::Test {
protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    file_ = fs::path(testing::TempDir()) / (std::string("frictab_fuzz_") + test->name());
  }
  void TearDown() override { fs::remove(file_); }
  void write(const std::string& bytes) { std::ofstream(file_, std::ios::binary) << bytes; }
  // One byte per case, as far as the child came.
  std::string outcomes_in_child(const std::vector<std::string>& cases) {
    int ends[2] = {};
    if (pipe(ends) != 0) return "";
    const pid_t child = fork();
    if (child == 0) {
      alarm(120); // an endless loop is a fault too
      for (const std::string& bytes : cases) {
        write(bytes);
        const char outcome = static_cast<char>(load(file_.string(), {}));
        if (::write(ends[1], &outcome, 1) != 1) _exit(1);
      }
      _exit(0);
    }
    close(ends[1]);
    std::string told;
    for (char outcome = 0; ::read(ends[0], &outcome, 1) == 1;)
      told += outcome;
    close(ends[0]);
    waitpid(child, nullptr, 0);
    return told;
  }
  fs::path file_;
};

TEST_F(LoadFuzz, DamagedCsvGivesADatasetOrAnInputError) {
  const std::string comma = "experiment,time_s,sigma_n_MPa,v_rel_mm_s,tau_R_MPa,lot\n"
                            "a,0,1000,5,80,\"x,1\"\na,1,1001,6,81,y\nb,0,1200,7,90,y\n"
                            "b,1,1300,8,91,\"q \"\"z\"\"\"\n";
  const std::string tabs = "preamble\r\nsigma_n_MPa\tF_R_N\tF_N_N\tpsi\r\n[Pa]\t[N]\t[kN]\t[-]\r\n"
                           "1800,\t1,5\t3\t1,0\r\n1900,5\t1,7\t4\t1,25\r\nend of test\r\n";
  data::DataOptions german;
  german.decimal = ',';
  german.skip_rows = 1;
  german.skip_footer = 1;
  german.units_row = true;
  Random random(11);
  std::size_t outcomes[4] = {};
  for (int i = 0; i < 6000; ++i) {
    const bool is_comma = random.below(2) == 0;
    const std::string bytes = mutated(is_comma ? comma : tabs, random, 6);
    write(bytes);
    const Outcome outcome = load(file_.string(), is_comma ? data::DataOptions{} : german);
    ++outcomes[outcome];
    ASSERT_TRUE(outcome == read_well || outcome == refused) << "case " << i << ":\n" << bytes;
  }
  EXPECT_GT(outcomes[read_well], 100u); // the mutations reach both sides
  EXPECT_GT(outcomes[refused], 1000u);
}

// Runs in a child process: the HDF5 library itself may fall over a damaged file, and
// then the parent still tells which case it was. 240 files, for each is read by a process of its
// own (io/isolated.h), and to start one is what takes the time.
TEST_F(LoadFuzz, DamagedHdf5GivesADatasetOrAnInputError) {
  {
    const std::vector<double> values{1, 2, 3, 4};
    const std::size_t rows[] = {4};
    io::Hdf5Writer out(file_);
    for (const char* name : {"sigma_n_MPa", "tau_R_MPa", "v_rel_mm_s", "room_C"})
      out.dataset(name, rows, values,
                  name[0] == 'r' ? io::Hdf5Storage{0, 4, true} : io::Hdf5Storage{});
    out.attribute("sigma_n_MPa", "units", "MPa");
    out.dataset("experiment", std::vector<std::string>{"a", "a", "b", "b"});
    out.close();
  }
  const std::string valid = io::read_file(file_);
  Random random(12);
  std::size_t outcomes[4] = {};
  for (int batch = 0; batch < 20; ++batch) {
    std::vector<std::string> cases(12);
    for (std::string& bytes : cases)
      bytes = mutated(valid, random, 1 + static_cast<std::size_t>(batch));
    const std::string told = outcomes_in_child(cases);
    ASSERT_EQ(told.size(), cases.size())
        << "batch " << batch << ": the process died in case " << told.size();
    for (const char outcome : told) {
      ASSERT_TRUE(outcome == read_well || outcome == refused) << "batch " << batch;
      ++outcomes[static_cast<std::size_t>(outcome)];
    }
  }
  EXPECT_GT(outcomes[read_well], 5U);
  EXPECT_GT(outcomes[refused], 50U);
}

// Two files in one campaign: what stands beside the rows, one column per test, or tests side by
// side under their conditions.
TEST_F(LoadFuzz, DamagedFilesBesideTheRowsGiveADatasetOrAnInputError) {
  const std::string rows = "experiment,time_s,sigma_n_MPa,F_N_N,F_R_N\n"
                           "a,0,1000,10,1\na,1,1000,20,2\na,2,1000,15,1\na,3,1000,30,3\n"
                           "b,0,1000,10,1\nb,1,1000,30,2\nb,2,1000,15,1\nb,3,1000,20,3\n";
  const std::string tests = "experiment,batch,humidity_pct,T_tool_C\na,x,40,20\nb,y,41.5,21\n";
  const std::string simulation =
      "experiment,time_s,F_N_N,psi\na,0.5,15,1\na,1.5,17,1.5\na,2.5,22,2\n"
      "b,0.5,20,1\nb,1.5,22,1.2\nb,2.5,17,1.4\n";
  const std::string wide = "time_s,OA1_v5_a,OA2_v5_b,OA3_v50_c\n0,0.1,0.2,0.3\n1,0.11,,0.31\n";
  const std::string side = "Load: 5 N\nOil;A\n\nT1;;;T2;;\ntime_s;mu;;time_s;mu;\ns;-;;s;-;\n"
                           "0;0.1;;0;0.2;\n1;0.11;;1;0.21;\n2;0.12;;;;\n";
  const std::string beside = file_.string() + "_beside";
  Random random(17);
  std::size_t outcomes[4] = {};
  for (int i = 0; i < 6000; ++i) {
    data::DataOptions options;
    const std::size_t form = random.below(4);
    const std::string& valid = form == 0 ? tests : form == 1 ? simulation : form == 2 ? wide : side;
    std::string bytes = mutated(valid, random, 3);
    if (form == 0) options.tests = beside;
    if (form == 1) {
      options.join.files = {beside};
      if (random.below(2) == 0) options.join.offset.value = 0.25;
    }
    if (form == 2) {
      options.wide = R"(OA(?<oa_pct>\d+)_v(?<v_rel_mm_s>\d+)_(?<experiment>.*))";
      options.columns["tau_R_MPa"].names = {"value"};
      options.constants["sigma_n_MPa"] = 1;
      write(bytes);
    } else if (form == 3) {
      options.experiment = "columns";
      options.units_row = true;
      options.columns["F_N_N"].names = {"Load"};
      options.columns["sigma_n_MPa"].names = {"Load"};
      options.columns["sigma_n_MPa"].area_mm2 = 2;
      options.columns["tau_R_MPa"].names = {"mu"};
      options.columns["tau_R_MPa"].times = "sigma_n_MPa";
      options.above = {"Oil"};
      write(bytes);
    } else {
      write(rows);
      std::ofstream(beside, std::ios::binary) << bytes;
    }
    const Outcome outcome = load(file_.string(), options);
    ++outcomes[outcome];
    ASSERT_TRUE(outcome == read_well || outcome == refused) << "case " << i << ":\n" << bytes;
  }
  fs::remove(beside);
  EXPECT_GT(outcomes[read_well], 600u);
  EXPECT_GT(outcomes[refused], 600u);
}

// frictab init --from: a job, or a file that holds no table.
TEST_F(LoadFuzz, DamagedFilesAreGuessedOrRefused) {
  const std::string file = "Pruefbericht;;\r\nDatum;3.4.2021;\r\n\r\n"
                           "Zeit [s];Normalkraft [kN];Reibkraft [N];Weg [mm]\r\n"
                           "0,0;1,5;120,5;0,00\r\n0,1;1,6;121,0;0,05\r\n0,2;1.234,6;121,0;0,10\r\n";
  Random random(19);
  std::size_t guessed = 0, refusals = 0;
  for (int i = 0; i < 600; ++i) {
    const std::string bytes = mutated(file, random, 8);
    write(bytes);
    try {
      const guess::File guess = guess::guess_file(file_.string(), "file.csv").front();
      ASSERT_FALSE(guess.columns.empty()) << bytes;
      job::guessed_job({.files = {guess}, .tests = {}, .sheets = {}, .passed = {}}, {},
                       {"file.csv"});
      ++guessed;
    } catch (const InputError& error) {
      ASSERT_FALSE(error.faults().empty());
      ++refusals;
    }
  }
  EXPECT_GT(guessed, 100u);
  EXPECT_GT(refusals, 1u);
}

TEST_F(LoadFuzz, RandomBytesGiveAnInputError) {
  Random random(13);
  for (int i = 0; i < 1000; ++i) {
    std::string bytes(random.below(300), '\0');
    for (char& c : bytes)
      c = static_cast<char>(random.below(256));
    const bool as_hdf5 = random.below(8) == 0; // these start a process each
    if (as_hdf5) bytes.insert(0, std::string("\x89HDF\r\n\x1a\n", 8));
    write(bytes);
    ASSERT_EQ(load(file_.string(), {}), refused) << "case " << i;
  }
}

} // namespace
} // namespace frictab::load_fuzz_test
