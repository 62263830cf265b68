// Names every file of the results that were found damaged.
#include "study/check_study.h"

#include <filesystem>

#include <fmt/format.h>

#include "study/keys.h"
#include "study/result_store.h"

namespace frictab::study {

namespace {

namespace fs = std::filesystem;

// A damaged record of a failure is one line, without a folder.
std::vector<std::string> lines_of(const std::string& directory, std::uint64_t key,
                                  const std::string& damage) {
  const std::string named = fmt::format("{}/{}", results_folder, key_text(key));
  if (!fs::exists(result_directory(directory, key)))
    return {fmt::format("{}/{}.json: {}", failures_folder, key_text(key), damage)};
  std::vector<std::string> lines = differences_of_result(directory, key);
  for (std::string& line : lines)
    line = named + "/" + line;
  return lines;
}

} // namespace

std::vector<std::string> check_study(const Plan& plan, const Found& found) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < plan.keys.size(); ++i)
    if (found.state(plan.keys[i]) == State::damaged)
      for (const std::string& line :
           lines_of(plan.study.directory, plan.keys[i], found.damaged.at(plan.keys[i])))
        lines.push_back(fmt::format("campaign {}: {}", plan.study.campaigns[i].name, line));
  return lines;
}

} // namespace frictab::study
