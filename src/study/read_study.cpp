// Makes campaigns, each with its job, of the written study.
#include <algorithm>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "core/text.h"
#include "data/file_list.h"
#include "io/file_streams.h"
#include "study/campaign_list.h"
#include "study/campaigns_csv.h"
#include "study/keys.h"
#include "study/resolved_jobs.h"
#include "study/toml_values.h"
#include "study/written_study.h"

namespace frictab::study {

namespace fs = std::filesystem;

const char* stage_name(LastStage stage) {
  switch (stage) {
  case LastStage::calibrate:
    return "calibrate";
  case LastStage::trace:
    return "trace";
  case LastStage::run:
    break;
  }
  return "run";
}

std::optional<LastStage> stage_named(std::string_view name) {
  for (const LastStage stage : {LastStage::calibrate, LastStage::trace, LastStage::run})
    if (name == stage_name(stage)) return stage;
  return std::nullopt;
}

namespace {

constexpr std::size_t largest_file = 1 << 20; // same limit as for job files

std::string command_line_options(const StudyOverrides& overrides) {
  std::string text;
  if (!overrides.directory.empty()) text += " -o " + shell_word(overrides.directory);
  if (overrides.stage) text += fmt::format(" --stage {}", stage_name(*overrides.stage));
  for (const std::string& key : overrides.set)
    text += " --set " + shell_word(key);
  return text;
}

class StudyReader {
public:
  StudyReader(std::string file, const StudyOverrides& overrides)
      : file_(std::move(file)), folder_(fs::path(file_).parent_path()), overrides_(overrides) {}

  Study read(std::string_view text) {
    written_ = read_written(text, file_, faults_);
    add_list();
    std::optional<ResolvedJobs> jobs = read_jobs();
    if (jobs) {
      for (const WrittenCampaign& one : written_.campaigns)
        add_campaign(one, *jobs);
      for (const WrittenTwin& twin : written_.twins)
        add_twin(twin, *jobs);
      check_together();
      if (!faults_.empty()) report_missing_files(jobs->folder());
    }
    faults_.throw_if_any();
    study_.jobs = jobs->take();
    return std::move(study_);
  }

private:
  void add_list() {
    if (written_.list.empty()) return;
    try {
      for (WrittenCampaign& one : read_campaign_list(beside_study(written_.list)))
        written_.campaigns.push_back(std::move(one));
    } catch (const InputError& error) {
      for (const Fault& fault : error.faults())
        faults_.add(fault.place.file.empty() ? written_.list_place : fault.place, fault.what,
                    fault.hint);
    }
  }

  std::string beside_study(const std::string& name) const {
    return (folder_ / name).lexically_normal().string();
  }

  std::optional<ResolvedJobs> read_jobs() {
    study_.file = file_;
    study_.command_line_options = command_line_options(overrides_);
    study_.stage = overrides_.stage.value_or(written_.stage);
    study_.directory =
        overrides_.directory.empty() ? beside_study(written_.directory) : overrides_.directory;
    if (written_.job.empty()) return std::nullopt;
    try {
      return ResolvedJobs(beside_study(written_.job), overrides_.set);
    } catch (const InputError& error) {
      faults_.add(error);
      return std::nullopt;
    }
  }

  // Converts files of a campaign, named relative to the study, to names relative to the job.
  std::vector<std::string> beside_job(const std::vector<std::string>& files,
                                      const ResolvedJobs& jobs) const {
    if (folder_ == jobs.folder()) return files;
    std::vector<std::string> named;
    for (const std::string& file : files)
      named.push_back(
          fs::path(file).is_absolute()
              ? file
              : fs::path(beside_study(file)).lexically_proximate(jobs.folder()).string());
    return named;
  }

  Campaign campaign_of(const WrittenCampaign& one, ResolvedJobs& jobs) {
    Campaign campaign;
    campaign.name = one.name;
    campaign.place = one.place;
    campaign.job = jobs.find(one.set, one.place, faults_);
    for (const auto& [name, level] : one.factors) {
      const std::size_t at = factor_number(name, one.place);
      if (campaign.factors.size() <= at) campaign.factors.resize(at + 1);
      campaign.factors[at] = level;
    }
    return campaign;
  }

  std::size_t factor_number(const std::string& name, const Place& place) {
    const auto at = std::ranges::find(study_.factors, name);
    if (at != study_.factors.end()) return static_cast<std::size_t>(at - study_.factors.begin());
    if (is_campaigns_column(name))
      faults_.add(place, fmt::format("a factor cannot be called '{}'", name),
                  "campaigns.csv has a column of that name");
    study_.factors.push_back(name);
    return study_.factors.size() - 1;
  }

  void add_campaign(const WrittenCampaign& one, ResolvedJobs& jobs) {
    if (one.name.empty())
      faults_.add(one.place, "the campaign has no name",
                  "write name = \"...\": reports call it so");
    if (one.files.empty())
      faults_.add(one.place, fmt::format("campaign '{}' has no files", one.name),
                  "write files = \"data/*.csv\", relative to the study");
    Campaign campaign = campaign_of(one, jobs);
    campaign.training = beside_job(one.files, jobs);
    campaign.validation = beside_job(one.validation, jobs);
    study_.campaigns.push_back(std::move(campaign));
  }

  void add_twin(const WrittenTwin& twin, ResolvedJobs& jobs) {
    const std::size_t block = study_.twins.size();
    study_.twins.push_back({twin.options, twin.text});
    Campaign campaign = campaign_of(twin.shared, jobs);
    for (std::uint64_t seed = twin.seeds.first; seed <= twin.seeds.last; ++seed) {
      campaign.name = fmt::format("{}-{}", twin.name, seed);
      campaign.twin = TwinSeed{block, seed};
      study_.campaigns.push_back(campaign);
    }
  }

  // Reports missing files together with other faults, which stop the study before plan_of reads the
  // files for their keys.
  void report_missing_files(const std::string& folder) {
    for (const Campaign& one : study_.campaigns) {
      const std::string about = fmt::format("campaign '{}': ", one.name);
      std::vector<std::string> named = one.training;
      named.insert(named.end(), one.validation.begin(), one.validation.end());
      try {
        for (const std::string& file : data::find_files(named, folder, one.place))
          if (std::error_code ignored; !fs::exists(fs::path(folder) / file, ignored))
            add_at(one.place, no_such_file(file), faults_, about);
      } catch (const InputError& error) {
        add_at(one.place, error, faults_, about);
      }
    }
  }

  void check_together() {
    std::vector<Campaign>& all = study_.campaigns;
    if (all.empty() && faults_.empty())
      faults_.add({file_, 0, 0}, "there is no campaign",
                  "write [[campaign]] tables, campaigns = \"list.csv\" or [[twin]]");
    if (all.size() > most_campaigns)
      faults_.add({file_, 0, 0}, fmt::format("has {} campaigns; a study has at most {}",
                                             thousands(all.size()), thousands(most_campaigns)));
    std::set<std::string_view> names;
    for (Campaign& one : all) {
      one.factors.resize(study_.factors.size());
      if (!one.name.empty() && !names.insert(one.name).second)
        faults_.add(one.place, fmt::format("there are two campaigns called '{}'", one.name),
                    "reports distinguish them by name");
    }
  }

  std::string file_;
  fs::path folder_;
  const StudyOverrides& overrides_;
  FaultList faults_;
  WrittenStudy written_;
  Study study_;
};

} // namespace

Study parse_study(std::string_view text, const std::string& file, const StudyOverrides& overrides) {
  if (text.size() > largest_file)
    throw InputError({file, 0, 0},
                     fmt::format("is not a study file: it has {}",
                                 human_bytes(static_cast<double>(text.size()))),
                     "many campaigns stand in a table of their own: campaigns = \"list.csv\"");
  return StudyReader(file, overrides).read(text);
}

Study read_study(const std::string& file, const StudyOverrides& overrides) {
  return parse_study(io::read_file(file), file, overrides);
}

} // namespace frictab::study
