// Computes the keys of campaigns.
#include "study/keys.h"

#include <algorithm>
#include <charconv>
#include <filesystem>

#include <fmt/format.h>

#include "core/hash.h"
#include "core/version.h"
#include "data/file_list.h"

namespace frictab::study {

namespace fs = std::filesystem;

namespace {

std::uint64_t hash_of_data(const std::string& base, const std::string& file, WatchedFiles& files) {
  std::error_code error;
  const fs::path path = fs::path(base) / file;
  if (!fs::exists(path, error)) throw no_such_file(file);
  return files.add(path, file);
}

// Whether rules match a file's folders; then these are part of the key.
bool looks_at_folders(const data::DataOptions& options) {
  return std::ranges::any_of(options.files, [](const data::FileRule& rule) {
    return (rule.match + rule.from_name).find('/') != std::string::npos;
  });
}

std::string files_text(const std::vector<std::string>& named, const data::DataOptions& options,
                       WatchedFiles& watched) {
  std::string text;
  const bool folders = looks_at_folders(options);
  const auto files = data::find_files(named, options.base, options.place);
  for (const data::FilePlan& plan : data::plan_files(files, data::ReadRequest(options)).files)
    text += fmt::format("\n{} {} {}", plan.label,
                        folders ? plan.file : fs::path(plan.file).filename().string(),
                        hash_text(hash_of_data(options.base, plan.file, watched)));
  return text;
}

std::string data_text(const Study& study, const Campaign& campaign, WatchedFiles& files) {
  if (campaign.twin)
    return fmt::format("twin {} {}", study.twins[campaign.twin->block].text, campaign.twin->seed);
  const data::DataOptions& options = study.jobs[campaign.job].job.data;
  return "training" + files_text(campaign.training, options, files) + "\nvalidation" +
         files_text(campaign.validation, options, files);
}

} // namespace

InputError no_such_file(const std::string& file) {
  return InputError({file, 0, 0}, "cannot be read",
                    "files of a campaign are named relative to the study");
}

std::uint64_t key_of(const Study& study, const Campaign& campaign, WatchedFiles& files) {
  return hash_of(fmt::format("{}\n{}\n{}\n{}", tool_version(), stage_name(study.stage),
                             study.jobs[campaign.job].fingerprint,
                             data_text(study, campaign, files)));
}

std::string key_text(std::uint64_t key) {
  return hash_text(key);
}

std::optional<std::uint64_t> read_key(std::string_view text) {
  std::uint64_t key = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), key, 16);
  if (text.size() != 16 || error != std::errc() || end != text.data() + text.size())
    return std::nullopt;
  return key;
}

job::Job job_of(const Study& study, const Campaign& campaign) {
  job::Job job = study.jobs[campaign.job].job;
  job.data.training = campaign.training;
  job.data.validation = campaign.validation;
  return job;
}

} // namespace frictab::study
