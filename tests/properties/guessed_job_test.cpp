// Folders as laboratories leave them, drawn at random: the job that is proposed for any of them is
// valid, and no file goes missing. Synthetic.
#include <filesystem>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/text.h"
#include "guess/guess.h"
#include "job/guessed_job.h"
#include "job/job.h"
#include "support/run_command.h"

namespace frictab::guessed_job_test {
namespace {

constexpr std::uint64_t folders = 100;

class Folder {
public:
  explicit Folder(std::uint64_t seed) : random_(seed) { write_recordings(); }

  const std::vector<std::string>& files() const { return files_; }
  std::string path(const std::string& file) const { return directory_.path(file); }
  void write(const std::string& file, const std::string& text) {
    directory_.write(file, text);
    files_.push_back(file);
  }

private:
  std::size_t draw(std::size_t below) { return random_() % below; }
  bool now_and_then(std::size_t once_in) { return draw(once_in) == 0; }

  std::string number(double value) {
    const std::string text = fmt::format("{:.3f}", value);
    return comma_ ? replace_all(text, ".", ",") : text;
  }

  // Names of columns, of which some stand for one quantity.
  std::vector<std::string> columns() {
    static const std::vector<std::string> all = {"Load (N)",      "Normal force [kN]",
                                                 "COF",           "Friction force (N)",
                                                 "Torque (N m)",  "Pressure bar",
                                                 "p_nom_MPa",     "Speed rpm",
                                                 "Speed (mm/s)",  "v_set_mm_s",
                                                 "Temp",          "Oil temp C",
                                                 "T_contact_C",   "Disc temperature",
                                                 "Humidity (%)",  "Distance (m)",
                                                 "run_id",        "No",
                                                 "CAREA",         "F_N_N",
                                                 "say \"so\" #1", "back\\slash",
                                                 "Kraft 'links'", "sigma_n_MPa",
                                                 "Tool temp"};
    std::vector<std::string> drawn;
    for (const std::string& name : all)
      if (now_and_then(3)) drawn.push_back(name);
    return drawn;
  }

  std::string row_of(const std::vector<std::string>& cells) {
    std::vector<std::string> quoted;
    for (const std::string& cell : cells)
      quoted.push_back(cell.find('"') == cell.npos && cell.find(delimiter_) == cell.npos
                           ? cell
                           : '"' + replace_all(cell, "\"", "\"\"") + '"');
    return join(quoted, std::string(1, delimiter_)) + "\n";
  }

  std::string table(std::vector<std::string> names, std::size_t rows, bool clock) {
    if (clock) names.insert(names.begin(), "Time (s)");
    std::string text = row_of(names);
    for (std::size_t i = 0; i < rows; ++i) {
      std::vector<std::string> cells;
      for (const std::string& name : names)
        cells.push_back(name == "run_id" ? fmt::format("R{}", i / 7)
                                         : number(0.1 * static_cast<double>(i + draw(5) + 1)));
      text += row_of(cells);
      if (in_parts_ && i + 1 == rows / 2) text += row_of(names);
    }
    return text;
  }

  void write_recordings() {
    static const std::vector<std::string> stems = {"run_", "T", "it's ", "10N_", "Probe \"a\" "};
    const std::string stem = stems[draw(stems.size())];
    const std::vector<std::string> shared = columns();
    const std::size_t tests = 1 + draw(4);
    std::string last;
    for (std::size_t test = 1; test <= tests; ++test) {
      comma_ = now_and_then(3);
      delimiter_ = comma_ || now_and_then(2) ? ';' : ',';
      in_parts_ = now_and_then(6);
      last = (now_and_then(3) ? "Rig 7\nRing dia (in): 1.4\nOil temp: 40 C\n\n" : "") +
             table(now_and_then(5) ? columns() : shared, 20 + draw(10), !now_and_then(6));
      write(fmt::format("{}{}.csv", stem, test), last);
    }
    in_parts_ = false;
    if (now_and_then(3)) write(fmt::format("{}{}_old.csv", stem, tests), last);
    if (now_and_then(2)) write_list("plan.csv", stem, tests);
    if (now_and_then(3)) write("results.csv", table(columns(), 3 + draw(9), false));
    if (now_and_then(3)) write("note.txt", "Zeroed on Monday only, 4 strokes, 100 mm.\n");
    if (now_and_then(4))
      write("cof.csv", "COF of all,,,\nDistance (m),S1,S2,S3\n0,.5,.4,.3\n5,.5,"
                       ".41,.32\n9,.5,.42,.31\n");
  }

  void write_list(const std::string& file, const std::string& stem, std::size_t tests) {
    comma_ = now_and_then(2);
    delimiter_ = ';';
    const std::vector<std::string> others = columns();
    std::vector<std::string> names = others;
    names.insert(names.begin(), "Run");
    std::string text = row_of(names);
    for (std::size_t test = 1; test <= tests; ++test) {
      std::vector<std::string> cells = {fmt::format("{}{}", stem, test)};
      for (std::size_t i = 0; i < others.size(); ++i)
        cells.push_back(number(0.5 * static_cast<double>(test + i)));
      text += row_of(cells);
    }
    write(file, text);
  }

  std::mt19937_64 random_;
  test::TemporaryDirectory directory_;
  std::vector<std::string> files_;
  char delimiter_ = ',';
  bool comma_ = false, in_parts_ = false;
};

TEST(GuessedJob, IsValidForAnyFolderAndLosesNoFile) {
  std::size_t proposed = 0, with_list = 0, with_left = 0;
  for (std::uint64_t seed = 1; seed <= folders; ++seed) {
    Folder folder(seed);
    std::vector<guess::File> guesses;
    std::size_t without_table = 0;
    for (const std::string& file : folder.files())
      try {
        for (guess::File& guess : guess::guess_file(folder.path(file), file))
          guesses.push_back(std::move(guess));
      } catch (const InputError&) {
        ++without_table;
      }
    if (guesses.empty()) continue;
    const guess::Campaign campaign = guess::sort_guesses(std::move(guesses));
    EXPECT_EQ(campaign.files.size() + campaign.tests.has_value() + campaign.left.size() +
                  without_table,
              folder.files().size())
        << "seed " << seed;
    std::vector<std::string> names;
    for (const guess::File& file : campaign.files)
      names.push_back(file.file);
    const job::GuessedJob guessed = job::guessed_job(campaign, guess::guess_names(names), names);
    EXPECT_EQ(guessed.left.size(), campaign.left.size());
    folder.write("job.toml", guessed.text);
    try {
      job::read_job(folder.path("job.toml"));
      ++proposed;
    } catch (const InputError& error) {
      ADD_FAILURE() << "seed " << seed << ": " << error.what() << "\n" << guessed.text;
    }
    with_list += campaign.tests.has_value();
    with_left += !campaign.left.empty();
  }
  EXPECT_GT(proposed, folders / 2);
  EXPECT_GT(with_list, folders / 10);
  EXPECT_GT(with_left, folders / 10);
}

} // namespace
} // namespace frictab::guessed_job_test
