// Makes a table and a page of the results.
#include "study/report_study.h"

#include <algorithm>
#include <unordered_set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/progress.h"
#include "core/text.h"
#include "core/version.h"
#include "io/atomic_file.h"
#include "io/file_streams.h"
#include "io/json.h"
#include "study/campaigns_csv.h"
#include "study/page_sections.h"
#include "study/result_store.h"
#include "words/render.h"

namespace frictab::study {

namespace {

class Reading {
public:
  Reading(const Plan& plan, const Found& found, const Counts& counts, std::ostream& table)
      : plan_(plan), directory_(plan.study.directory), found_(found), table_(table) {
    tally_.counts = counts;
    write_header(table, plan.study);
  }

  void take(std::size_t i) {
    const Campaign& campaign = plan_.study.campaigns[i];
    const std::uint64_t key = plan_.keys[i];
    const State state = found_.state(key);
    if (state == State::missing) return write_row_without(table_, campaign, key, state, "");
    if (state == State::damaged) return take_damaged(i, found_.damaged.at(key));
    try {
      if (state == State::done) return take_result(i);
      take_failure(i, state, read_failure(directory_, key).message);
    } catch (const InputError& error) { // a damaged file does not affect the other campaigns
      --(state == State::done ? tally_.counts.done : tally_.counts.failed);
      ++tally_.counts.damaged;
      take_damaged(i, error.faults().front().what);
    }
  }

  Tally take_tally() { return std::move(tally_); }

private:
  void take_damaged(std::size_t i, const std::string& damage) {
    take_failure(
        i, State::damaged,
        fmt::format("its result is damaged: {}; `frictab study run` makes it again", damage));
  }

  void take_failure(std::size_t i, State state, const std::string& message) {
    write_row_without(table_, plan_.study.campaigns[i], plan_.keys[i], state, message);
    tally_.failed.push_back({i, message});
  }

  // Writes the rows; identical campaigns count once in the tally.
  void take_result(std::size_t i) {
    const std::uint64_t key = plan_.keys[i];
    CampaignResult result = read_result(directory_, key);
    write_rows(table_, plan_.study.campaigns[i], key, result);
    if (seen_.insert(key).second) tally_.add(i, std::move(result));
  }

  const Plan& plan_;
  const std::string& directory_;
  const Found& found_;
  std::ostream& table_;
  std::unordered_set<std::uint64_t> seen_;
  Tally tally_;
};

Tally read_results(const Plan& plan, const Found& found, const Counts& counts,
                   const std::filesystem::path& table) {
  io::OutputFile out(table);
  Reading reading(plan, found, counts, out);
  const Progress progress("reading results", plan.keys.size());
  for (std::size_t i = 0; i < plan.keys.size(); ++i) {
    reading.take(i);
    progress.tick();
  }
  out.finish();
  return reading.take_tally();
}

} // namespace

Tally report_study(const Plan& plan) {
  const Found found(plan.study.directory);
  const Counts counts = counts_of(plan, found);
  if (counts.done + counts.failed == 0)
    throw InputError(
        {}, "there is no result in " + plan.study.directory,
        "`frictab study run` computes them; where it has, give the -o, --stage and --set it had. A "
        "study that cannot be written to is reported from a copy of it");
  io::OutputFiles files(plan.study.directory);
  Tally tally = read_results(plan, found, counts, files.stage("campaigns.csv"));
  files.write("report.html", study_html(plan, tally));
  files.commit();
  return tally;
}

std::string report_text(const Plan& plan, const Tally& tally) {
  const Counts& counts = tally.counts;
  std::string text =
      fmt::format("{} campaigns: {}{}\n", thousands(plan.keys.size()), counts_text(counts),
                  tally.synthetic > 0 ? " - SYNTHETIC data among them" : "");
  text += words::as_text(laws_over_campaigns(tally));
  for (std::size_t i = 0; i < std::min(tally.failed.size(), most_listed); ++i)
    text += fmt::format("failed: {}: {}\n", plan.study.campaigns[tally.failed[i].campaign].name,
                        tally.failed[i].message);
  return text + fmt::format("{0}/campaigns.csv, {0}/report.html\n", plan.study.directory);
}

std::string report_json(const Plan& plan, const Tally& tally) {
  nlohmann::ordered_json json = {{"schema", "frictab/study-report/1"},
                                 {"tool_version", tool_version()},
                                 {"directory", plan.study.directory},
                                 {"campaigns", plan.keys.size()},
                                 {"done", tally.counts.done},
                                 {"failed", tally.counts.failed},
                                 {"missing", tally.counts.missing},
                                 {"damaged", tally.counts.damaged},
                                 {"synthetic", tally.synthetic},
                                 {"laws", nlohmann::ordered_json::array()},
                                 {"effects", nlohmann::ordered_json::array()}};
  for (const auto& [name, law] : tally.laws_by_success())
    json["laws"].push_back({{"law", name},
                            {"campaigns", law->campaigns},
                            {"best", law->best},
                            {"may_be_best", law->may_be_best}});
  for (const auto& [column, effect] : tally.effects)
    json["effects"].push_back({{"column", column},
                               {"found_in", effect.campaigns.size()},
                               {"of", tally.traced_campaigns.size()}});
  return io::json_text(json);
}

} // namespace frictab::study
