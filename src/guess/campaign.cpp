// Sorts the files of a folder: recordings, the table of tests, and others.
#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "core/text.h"
#include "data/name_words.h"
#include "data/test_table.h"
#include "guess/columns.h"
#include "guess/guess.h"
#include "guess/layout.h"

namespace frictab::guess {

namespace {

bool is_measured(const File& guess) {
  return guess.find("tau_R_MPa") || guess.find("F_R_N");
}

} // namespace

std::size_t most_common(const std::vector<File>& files) {
  const auto rank = [&](const File& file) {
    return std::pair(std::count_if(files.begin(), files.end(),
                                   [&](const File& other) { return other.is_read_as(file); }),
                     (file.find("time_s") ? 1 : 0) + (is_measured(file) ? 1 : 0));
  };
  const auto most = std::max_element(
      files.begin(), files.end(), [&](const File& a, const File& b) { return rank(a) < rank(b); });
  return static_cast<std::size_t>(most - files.begin());
}

namespace {

// The tests that a file has: those that a column names, else itself.
std::vector<std::string> tests_of(const File& file) {
  const Column* const column = file.find("experiment");
  return column && !column->tests.empty() ? column->tests : std::vector{file.label()};
}

// Whether at least half of the tests of the other guesses are among the names.
bool names_tests(const std::vector<std::string>& names, std::size_t own,
                 const std::vector<File>& files) {
  std::set<std::string> known;
  for (const std::string& name : names)
    known.insert(data::test_key(name));
  std::size_t found = 0, all = 0;
  for (std::size_t i = 0; i < files.size(); ++i)
    for (const std::string& test : i == own ? std::vector<std::string>() : tests_of(files[i])) {
      found += known.count(data::test_key(test));
      ++all;
    }
  // only the first tests of one file of all tests are seen, perhaps one
  const Column* const column = files.size() == 2 ? files[1 - own].find("experiment") : nullptr;
  const std::size_t least = column && !column->tests.empty() ? 1 : 2;
  return found >= least && 2 * found >= all;
}

// Whether the labels of all others are the names in another form, each once.
bool are_numbered_alike(const std::vector<std::string>& names, std::size_t own,
                        const std::vector<File>& files) {
  std::map<long, std::string> known;
  for (const std::string& name : names)
    known.emplace(data::first_number(name), name);
  if (known.size() != names.size() || names.size() > 2 * (files.size() - 1)) return false;
  std::set<long> labels;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (i == own) continue;
    const std::string label = files[i].label();
    const auto found = known.find(data::first_number(label));
    if (found == known.end() || !data::is_same_test(label, found->second)) return false;
    labels.insert(found->first);
  }
  return labels.size() + 1 == files.size();
}

// The column whose cells are the names of the tests in the other files; nothing: there is none.
std::optional<std::size_t> names_of_tests_in(const std::vector<File>& files, std::size_t own) {
  for (std::size_t c = 0; c < files[own].columns.size(); ++c) {
    const Column& column = files[own].columns[c];
    // A column of numbers in a recording may count its rows.
    if (!column.text && column.canonical != "experiment" &&
        (files[own].find("time_s") || is_measured(files[own])))
      continue;
    if (!column.names.empty() &&
        (names_tests(column.names, own, files) ||
         (files.size() > 2 && are_numbered_alike(column.names, own, files))))
      return c;
  }
  return std::nullopt;
}

File as_table_of_tests(File table, std::size_t names) {
  for (Column& other : table.columns)
    if (other.canonical == "experiment") other.canonical.clear();
  table.columns[names].canonical = "experiment";
  return table;
}

// The table of tests among the files, or else among those that are left.
std::optional<File> take_table_of_tests(std::vector<File>& files, std::vector<File>& left) {
  for (std::size_t i = 0; i < files.size(); ++i)
    if (const auto names = names_of_tests_in(files, i)) {
      File table = as_table_of_tests(std::move(files[i]), *names);
      files.erase(files.begin() + static_cast<std::ptrdiff_t>(i));
      return table;
    }
  for (std::size_t i = 0; i < left.size(); ++i) {
    const bool in_parts = !files.empty() && files.front().intervals;
    files.push_back(left[i]);
    const auto names = names_of_tests_in(files, files.size() - 1);
    files.pop_back();
    if (!names || (in_parts && !left[i].columns[*names].text)) continue;
    File table = as_table_of_tests(std::move(left[i]), *names);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
    return table;
  }
  return std::nullopt;
}

// Takes the table whose names of tests are columns of another file: a column per test.
std::optional<File> find_names_of_columns(std::vector<File>& files, std::vector<File>& left) {
  constexpr std::size_t least = 3;
  for (std::vector<File>* const from : {&left, &files})
    for (std::size_t i = 0; i < from->size(); ++i)
      for (std::size_t c = 0; c < (*from)[i].columns.size(); ++c) {
        const std::set<std::string> known = set_of((*from)[i].columns[c].names);
        for (File& file : files) {
          std::vector<std::string> wide, digits;
          for (const Column& column : file.columns)
            if (!column.text && !column.above && column.canonical.empty() &&
                known.count(column.name) > 0)
              wide.push_back(column.name);
          if (wide.size() < least || 2 * wide.size() < known.size()) continue;
          const std::string letters = wide[0].substr(0, wide[0].find_first_of("0123456789"));
          const bool numbered = std::all_of(wide.begin(), wide.end(), [&](const auto& name) {
            return name.starts_with(letters) && name.size() > letters.size() &&
                   name.find_first_not_of("0123456789", letters.size()) == name.npos;
          });
          for (const std::string& name : wide)
            digits.push_back(as_pattern(name));
          file.wide_pattern = fmt::format(
              "^(?<experiment>{})$", numbered ? as_pattern(letters) + "\\d+" : join(digits, "|"));
          file.wide = std::move(wide);
          file.wide_known = true;
          file.rows = false;
          File table = as_table_of_tests(std::move((*from)[i]), c);
          from->erase(from->begin() + static_cast<std::ptrdiff_t>(i));
          return table;
        }
      }
  return std::nullopt;
}

// Whether a sheet is a summary: others of its workbook, read alike, have ten times its rows.
bool sums_up_others(const File& sheet, const std::vector<File>& all) {
  const auto is_longer = [&](const File& other) {
    return other.file == sheet.file && other.row_count >= 10 * sheet.row_count;
  };
  return sheet.row_count > 0 && std::any_of(all.begin(), all.end(), [&](const File& one) {
           return is_longer(one) && std::count_if(all.begin(), all.end(), [&](const File& other) {
                                      return is_longer(other) && other.is_read_as(one);
                                    }) > 1;
         });
}

// Whether a sheet is read like most sheets of its workbook, among those with friction if there are
// any.
bool is_like_most(const File& sheet, const std::vector<File>& all) {
  if (sums_up_others(sheet, all)) return false;
  const auto rivals = [&](const File& as) {
    return std::count_if(all.begin(), all.end(), [&](const File& other) {
      return other.file == as.file && is_measured(other) == is_measured(as) && other.is_read_as(as);
    });
  };
  return std::none_of(all.begin(), all.end(), [&](const File& other) {
    if (other.file != sheet.file || is_measured(other) < is_measured(sheet) ||
        sums_up_others(other, all))
      return false;
    return is_measured(other) > is_measured(sheet) || rivals(other) > rivals(sheet);
  });
}

// The choice of sheets for one workbook, given the names of its tables.
std::vector<std::string> choice_of(const std::vector<std::string>& read, std::size_t tables) {
  if (read.size() > 1 && read.size() == tables) return {"*"};
  return read;
}

// The part of a recording that most files have and this one has not; empty: it has all.
std::string lacks(const File& file, const File& most) {
  if (most.find("time_s") && !file.find("time_s")) return "column for time_s";
  if (is_measured(most) && !is_measured(file)) return "friction";
  const auto has_meaning = [](const Column& column) {
    return !column.canonical.empty() && column.canonical != "experiment";
  };
  return std::any_of(most.columns.begin(), most.columns.end(), has_meaning) &&
                 std::none_of(file.columns.begin(), file.columns.end(), has_meaning)
             ? "quantity"
             : "";
}

// Takes the files that lack a part of a recording.
std::vector<File> take_others(std::vector<File>& files) {
  const File most = files[most_common(files)];
  std::vector<File> kept, others;
  for (File& file : files)
    (file.sheet.empty() && !lacks(file, most).empty() ? others : kept).push_back(std::move(file));
  files = std::move(kept);
  return others;
}

// The name of a file without the words for its versions: "T2" of "T2_old" and "T2_v3".
std::string without_version(const std::string& label) {
  std::string out;
  for (std::size_t begin = 0; begin <= label.size();) {
    const std::size_t end = std::min(label.find_first_of("_-. ()", begin), label.size());
    const std::string word = lower_case(label.substr(begin, end - begin));
    const bool is_number =
        !word.empty() && word.find_first_not_of("0123456789", word[0] == 'v') == word.npos;
    const bool is_version =
        (is_number && (word[0] == 'v' || (begin > 0 && label[begin - 1] == '('))) ||
        data::has_word(word, {"alt", "old", "copy", "kopie", "neu", "new", "final", "backup", "bak",
                              "orig", "original", "raw", "korr", "corr", "corrected", "fixed"});
    if (!is_version && !word.empty()) out += " " + word;
    begin = end + 1;
  }
  return out.empty() ? label : out;
}

// Whether two files of a folder are versions of one: the same tests, and nearly the same rows.
bool are_versions(const File& a, const File& b) {
  constexpr double share = 0.8;
  constexpr std::size_t least = 5;
  const auto shared = [](const auto& one, const auto& other) {
    return static_cast<double>(
        std::count_if(one.begin(), one.end(), [&](const auto& x) { return other.count(x) > 0; }));
  };
  const auto tests = [](const File& file) {
    const Column* const column = file.find("experiment");
    return column && !column->tests.empty() ? set_of(column->tests)
                                            : std::set{without_version(file.label())};
  };
  const auto same = [&](const auto& one, const auto& other, double part) {
    return shared(one, other) >= part * static_cast<double>(std::min(one.size(), other.size()));
  };
  const auto folder = [](const File& file) {
    return std::filesystem::path(file.file).parent_path();
  };
  return folder(a) == folder(b) && std::min(a.rows_seen.size(), b.rows_seen.size()) >= least &&
         same(tests(a), tests(b), share) && same(a.rows_seen, b.rows_seen, share);
}

// Leaves the shorter one of two versions of a file, or the earlier name.
void leave_versions(std::vector<File>& files, std::vector<LeftFile>& left) {
  for (std::size_t i = 0; i < files.size();) {
    const auto newer = std::find_if(files.begin(), files.end(), [&](const File& other) {
      return &other != &files[i] && files[i].sheet.empty() && other.sheet.empty() &&
             std::pair(files[i].row_count, files[i].file) <
                 std::pair(other.row_count, other.file) &&
             are_versions(files[i], other);
    });
    if (newer == files.end()) {
      ++i;
      continue;
    }
    left.push_back(
        {files[i].file, "it has the tests and rows of " +
                            std::filesystem::path(newer->file).filename().string() +
                            " again; if it is the better one, name it in training instead"});
    files.erase(files.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

LeftFile left_file(const File& file, const File& most) {
  const std::string part = lacks(file, most);
  return {file.file, fmt::format("it has no {}, which most files have", part), true};
}

} // namespace

Campaign sort_guesses(std::vector<File> guesses) {
  Campaign campaign;
  for (File& guess : guesses)
    std::move(guess.passed.begin(), guess.passed.end(), std::back_inserter(campaign.passed));
  std::vector<File> others = take_others(guesses);
  leave_versions(guesses, campaign.left);
  campaign.tests = take_table_of_tests(guesses, others);
  if (!campaign.tests) campaign.tests = find_names_of_columns(guesses, others);
  for (const File& other : others)
    campaign.left.push_back(left_file(other, guesses[most_common(guesses)]));
  std::map<std::string, std::vector<std::string>> read; // by workbook
  std::map<std::string, std::size_t> tables;
  for (const File& guess : guesses) {
    const bool is_read = guess.sheet.empty() || is_like_most(guess, guesses);
    if (!guess.sheet.empty()) ++tables[guess.file];
    if (!guess.sheet.empty() && is_read) read[guess.file].push_back(guess.sheet);
    if (is_read)
      campaign.files.push_back(guess);
    else
      campaign.passed.push_back(guess.sheet);
  }
  if (campaign.files.size() == 1) campaign.files.front().phases = false; // else it were one test
  for (auto& [file, names] : read)
    names = choice_of(names, tables[file]);
  if (!read.empty() && std::all_of(read.begin(), read.end(), [&](const auto& one) {
        return one.second == read.begin()->second;
      }))
    campaign.sheets = read.begin()->second;
  return campaign;
}

} // namespace frictab::guess
