// study.toml, key by key; then what its parts say together.
#include <algorithm>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "core/text.h"
#include "io/atomic_file.h"
#include "study/campaign_list.h"
#include "study/campaigns_csv.h"
#include "study/resolved_jobs.h"
#include "study/toml_values.h"
#include "study/twin_block.h"

namespace frictab::study {

namespace fs = std::filesystem;
using job::TomlNode;

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

constexpr std::size_t largest_file = 1 << 20; // as job files

// A block [[twin]] as it is written.
struct WrittenTwin {
  std::string name = "twin", text;
  Seeds seeds;
  twin::TwinOptions options;
  WrittenCampaign shared; // its set and factors hold for every seed
};

struct WrittenStudy {
  std::string job, list;
  std::string directory = "study";
  LastStage stage = LastStage::trace;
  std::vector<WrittenCampaign> campaigns;
  std::vector<WrittenTwin> twins;
  Place job_place, list_place;
};

class StudyReader {
public:
  StudyReader(std::string file, const StudyOverrides& overrides)
      : file_(std::move(file)), folder_(fs::path(file_).parent_path()), overrides_(overrides) {}

  Study read(std::string_view text) {
    read_file_keys(job::parse_toml(text, file_));
    add_list();
    std::optional<ResolvedJobs> jobs = read_jobs();
    if (jobs) {
      for (const WrittenCampaign& one : written_.campaigns)
        add_campaign(one, *jobs);
      for (const WrittenTwin& twin : written_.twins)
        add_twin(twin, *jobs);
      check_together();
    }
    faults_.throw_if_any();
    study_.jobs = jobs->take();
    return std::move(study_);
  }

private:
  // ---- what is written ----

  void read_file_keys(const TomlNode& root) {
    const Keys keys = {
        {"job",
         [&](const TomlNode& node) {
           written_.job = text_of(node, "job", faults_);
           written_.job_place = node.place;
         }},
        {"directory",
         [&](const TomlNode& node) { written_.directory = text_of(node, "directory", faults_); }},
        {"stage", [&](const TomlNode& node) { read_stage(node); }},
        {"campaigns",
         [&](const TomlNode& node) {
           written_.list = text_of(node, "campaigns", faults_);
           written_.list_place = node.place;
         }},
        {"campaign",
         [&](const TomlNode& node) {
           for (const TomlNode* table : tables_of(node, "campaign", faults_))
             read_campaign(*table);
         }},
        {"twin", [&](const TomlNode& node) {
           for (const TomlNode* table : tables_of(node, "twin", faults_))
             read_twin(*table);
         }}};
    read_keys(root, "at the top of the file", keys, faults_);
    if (!root_has(root, "job"))
      faults_.add({file_, 0, 0}, "there is no job",
                  "write job = \"job.toml\": what all campaigns share");
  }

  static bool root_has(const TomlNode& root, std::string_view key) {
    return std::any_of(root.items.begin(), root.items.end(),
                       [&](const TomlNode& item) { return item.key == key; });
  }

  void read_stage(const TomlNode& node) {
    const std::string name = text_of(node, "stage", faults_);
    if (const auto stage = stage_named(name))
      written_.stage = *stage;
    else if (!name.empty())
      faults_.add(node.place, fmt::format("there is no stage '{}'", name),
                  std::string("known: ") + stage_words);
  }

  void add_shared_keys(Keys& keys, WrittenCampaign& one, std::string& name,
                       const std::string& table) {
    keys["name"] = [&, table](const TomlNode& node) {
      name = text_of(node, table + ".name", faults_);
    };
    keys["set"] = [&, table](const TomlNode& node) {
      one.set = texts_of(node, table + ".set", faults_);
    };
    keys["factors"] = [&](const TomlNode& node) { read_factors(node, one); };
  }

  void read_campaign(const TomlNode& table) {
    WrittenCampaign one;
    one.place = table.place;
    Keys keys;
    add_shared_keys(keys, one, one.name, "campaign");
    keys["files"] = [&](const TomlNode& node) {
      one.files = texts_of(node, "campaign.files", faults_);
    };
    keys["validation"] = [&](const TomlNode& node) {
      one.validation = texts_of(node, "campaign.validation", faults_);
    };
    read_keys(table, "in [[campaign]]", keys, faults_);
    written_.campaigns.push_back(std::move(one));
  }

  void read_factors(const TomlNode& node, WrittenCampaign& one) {
    if (node.type != TomlNode::Type::table) {
      faults_.add(node.place, "factors must be a table, not " + job::describe(node),
                  "write factors = { lubricant = \"...\", batch = \"7\" }");
      return;
    }
    for (const TomlNode& factor : node.items)
      if (factor.type == TomlNode::Type::text)
        one.factors.emplace_back(factor.key, factor.text);
      else if (factor.type == TomlNode::Type::whole || factor.type == TomlNode::Type::number)
        one.factors.emplace_back(factor.key, job::canonical_text(factor));
      else
        faults_.add(factor.place, fmt::format("factor {} must be a text or a number, not {}",
                                              factor.key, job::describe(factor)));
  }

  void read_twin(const TomlNode& table) {
    WrittenTwin twin;
    twin.shared.place = table.place;
    bool has_seed = false;
    Keys keys;
    add_shared_keys(keys, twin.shared, twin.name, "twin");
    keys["seed"] = [&](const TomlNode& node) {
      twin.seeds = seeds_of(node, faults_);
      has_seed = true;
    };
    add_twin_keys(keys, twin.options, faults_);
    read_keys(table, "in [[twin]]", keys, faults_);
    finish_twin(table, twin.options, faults_);
    if (!has_seed) faults_.add(table.place, "[[twin]] has no seed", "write seed = \"1..1000\"");
    TomlNode words = table;
    std::erase_if(words.items, [](const TomlNode& item) {
      return item.key == "name" || item.key == "seed" || item.key == "set" || item.key == "factors";
    });
    twin.text = job::canonical_text(words);
    written_.twins.push_back(std::move(twin));
  }

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

  // ---- what it amounts to ----

  std::string beside_study(const std::string& name) const {
    return (folder_ / name).lexically_normal().string();
  }

  std::optional<ResolvedJobs> read_jobs() {
    study_.file = file_;
    study_.stage = overrides_.stage.value_or(written_.stage);
    study_.directory =
        overrides_.directory.empty() ? beside_study(written_.directory) : overrides_.directory;
    if (written_.job.empty()) return std::nullopt;
    try {
      return ResolvedJobs(beside_study(written_.job), overrides_.set);
    } catch (const InputError& error) {
      for (const Fault& fault : error.faults())
        faults_.add(fault.place, fault.what, fault.hint);
      return std::nullopt;
    }
  }

  // Files of a campaign are named relative to the study, those of a job relative to the job.
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
    const auto at = std::find(study_.factors.begin(), study_.factors.end(), name);
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
                    "reports tell them apart by name");
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
    throw InputError(
        {file, 0, 0},
        fmt::format("is no study file: it has {}", human_bytes(static_cast<double>(text.size()))),
        "many campaigns stand in a table of their own: campaigns = \"list.csv\"");
  return StudyReader(file, overrides).read(text);
}

Study read_study(const std::string& file, const StudyOverrides& overrides) {
  return parse_study(io::read_file(file), file, overrides);
}

} // namespace frictab::study
