// Damaged job files: a job or a message, never anything else.
#include <gtest/gtest.h>

#include "core/random.h"
#include "job/schema.h"

namespace frictab::job_fuzz {
namespace {

const std::string_view pieces[] = {"[",
                                   "]",
                                   "{",
                                   "}",
                                   "\"",
                                   "'",
                                   "=",
                                   ".",
                                   ",",
                                   "\n",
                                   "#",
                                   "-",
                                   "nan",
                                   "inf",
                                   "1e999",
                                   "0",
                                   "99999999999999999999",
                                   "true",
                                   "1979-05-27",
                                   "\xff",
                                   "\xc3",
                                   std::string_view("\0", 1),
                                   "\\",
                                   "\"\"\"",
                                   "[[",
                                   "]]",
                                   "data",
                                   "columns",
                                   "*",
                                   "table.axes",
                                   "psi",
                                   "sigma_n_MPa",
                                   "[table]",
                                   "use = ",
                                   "[]",
                                   "{}",
                                   "[1, 2]",
                                   "\t",
                                   "\r\n",
                                   "\"\\u0000\"",
                                   "-0.0",
                                   "1_000",
                                   "0x7f"};

std::string all_keys() {
  std::string text = job::job_template(), out;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] != '#' || text[i + 1] == ' ' || (i > 0 && text[i - 1] != '\n')) out += text[i];
  const std::string laws = "files = \"laws/*.toml\""; // which are not there
  out.erase(out.find(laws), laws.size());
  return out;
}

void damage(std::string& text, Random& random) {
  const std::size_t at = random.below(text.size() + 1);
  const std::string_view piece = pieces[random.below(std::size(pieces))];
  switch (random.below(5)) {
  case 0:
    text.insert(at, piece);
    break;
  case 1:
    text.erase(at, random.below(12));
    break;
  case 2:
    text.replace(at, std::min<std::size_t>(random.below(8), text.size() - at), piece);
    break;
  case 3:
    text.insert(at, text.substr(random.below(text.size() + 1), random.below(60)));
    break;
  default:
    if (at < text.size()) text[at] = static_cast<char>(random.below(256));
  }
}

// Without its comments, so that damage hits keys and values.
std::string without_comments(const std::string& text) {
  std::string out;
  std::size_t start = 0;
  while (start < text.size()) {
    const std::size_t end = std::min(text.find('\n', start), text.size() - 1) + 1;
    if (text[start] != '#' && text[start] != '\n') out += text.substr(start, end - start);
    start = end;
  }
  return out;
}

TEST(JobFuzz, GivesAJobOrFaultsForTenThousandDamagedFiles) {
  const std::string good = without_comments(all_keys());
  ASSERT_NO_THROW(job::parse_job(good, "job.toml"));
  std::size_t jobs = 0, refused = 0;
  for (std::size_t i = 0; i < 10000; ++i) {
    Random random(20240607, i);
    std::string text = good;
    for (std::size_t n = 1 + random.below(3); n > 0; --n)
      damage(text, random);
    try {
      job::parse_job(text, "job.toml");
      ++jobs;
    } catch (const InputError& error) {
      ++refused;
      ASSERT_FALSE(error.faults().empty()) << "case " << i;
      for (const Fault& fault : error.faults())
        ASSERT_FALSE(fault.what.empty() || fault.place.file.empty()) << "case " << i;
    } catch (const std::exception& error) {
      FAIL() << "case " << i << ": " << error.what() << "\n" << text;
    }
  }
  EXPECT_GT(jobs, 100u); // the damage reaches past the syntax
  EXPECT_GT(refused, 1000u);
}

TEST(JobFuzz, GivesAJobOrFaultsForDamagedOverrides) {
  const std::string good = "[data]\ntraining = \"a.csv\"\n";
  for (std::size_t i = 0; i < 3000; ++i) {
    Random random(20240608, i);
    const job::KeyRule& rule = job::key_rules()[random.below(job::key_rules().size())];
    std::string assignment = rule.path + "=" + (rule.example.empty() ? "1" : rule.example);
    for (std::size_t n = 1 + random.below(3); n > 0; --n)
      damage(assignment, random);
    try {
      job::parse_job(good, "job.toml", {assignment});
    } catch (const InputError&) {
    } catch (const std::exception& error) {
      FAIL() << "case " << i << ": " << error.what() << "\n" << assignment;
    }
  }
}

} // namespace
} // namespace frictab::job_fuzz
