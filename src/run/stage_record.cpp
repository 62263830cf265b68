// Computes and compares the fingerprints of stages.
#include "run/stage_record.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/hash.h"
#include "core/text.h"
#include "core/version.h"
#include "io/file_streams.h"
#include "io/json.h"
#include "run/stage.h"

namespace frictab::run {

namespace {

constexpr const char* schema = "frictab/stages/1";
constexpr const char* mend = "remove it, then `frictab run`";

std::string file_fingerprint(const std::filesystem::path& file) {
  return hash_text(io::hash_of_file(file, file.string()));
}

// nullopt: there is no such file.
std::optional<bool> is_as_recorded(const std::filesystem::path& file,
                                   const std::string& fingerprint) {
  if (!std::filesystem::exists(file)) return std::nullopt;
  return file_fingerprint(file) == fingerprint;
}

// True if later stages read this file of the stage; "models/" is a whole folder.
bool is_result(const Stage& stage, std::string_view path) {
  return std::ranges::any_of(stage.results, [&](const std::string& result) {
    return result.ends_with("/") ? path.starts_with(result) : path == result;
  });
}

std::string sections_text(const Stage& stage) {
  std::vector<std::string> heads;
  for (const std::string& section : stage.sections)
    heads.push_back("[" + section + "]");
  return join(heads, " or ");
}

nlohmann::ordered_json read_record(const std::filesystem::path& file) {
  const std::string text = io::read_file(file);
  if (io::seal_of(text) == io::Seal::broken)
    throw InputError({file.string(), 0, 0}, "was changed or damaged: its hash does not fit", mend);
  return io::parse_json(text, file.string());
}

} // namespace

StageRecord::StageRecord(const job::Job& job, const std::filesystem::path& directory)
    : job_(job), directory_(directory) {
  const auto file = directory / "stages.json";
  if (!std::filesystem::exists(file)) return;
  const auto json = read_record(file);
  io::read_json(file.string(), mend, [&] {
    if (json.at("schema") != schema) return; // written by another version: nothing is known
    for (const auto& [name, inputs] : json.at("stages").items())
      made_[name] = {inputs.at("data"), inputs.at("job"), inputs.at("laws"), inputs.at("from"),
                     inputs.at("version")};
    open_ = json.value("unfinished", "");
    // Missing in files of version 0.1.
    files_ = json.value("files", std::map<std::string, std::string>());
    for (const auto& [path, fingerprint] : files_)
      had_files_.insert(path);
  });
}

std::string StageRecord::key(const std::string& stage) const {
  const StageInputs& made = made_.at(stage);
  return hash_text(hash_of(made.data + made.job + made.laws + made.from + made.version));
}

// Returns the last recorded stage before `stage`. This skips trace if it has not run.
std::string StageRecord::before(const std::string& stage) const {
  std::string last;
  for (const Stage& one : all_stages()) {
    if (one.name == stage) break;
    if (made_.count(one.name) > 0) last = one.name;
  }
  return last;
}

StageInputs StageRecord::now(const std::string& stage, const std::string& data) const {
  std::string job;
  for (const std::string& section : stage_named(stage).sections)
    if (const auto found = job_.sections.find(section); found != job_.sections.end())
      job += section + found->second;
  const bool first = stage == all_stages().front().name;
  if (first) job += fmt::format("seed {}", job_.calibration.seed);
  const std::string laws = stage == "tabulate" ? join(job_.table.model, ", ") : "";
  const std::string last = before(stage);
  return {first ? data : "", hash_text(hash_of(job)), laws, last.empty() ? "" : key(last),
          tool_version()};
}

void StageRecord::begin(const std::string& stage, const std::string& data) {
  made_[stage] = now(stage, data);
  open_ = stage;
}

void StageRecord::record(const std::string& stage, const std::string& data) {
  made_[stage] = now(stage, data);
  open_.clear();
  if (stage == "calibrate") made_.erase("trace");
}

void StageRecord::record_file(const std::string& path, const std::filesystem::path& file) {
  files_[path] = file_fingerprint(file);
}

std::vector<std::string> StageRecord::recorded_in(std::string_view folder) const {
  std::vector<std::string> paths;
  for (const auto& [path, fingerprint] : files_)
    if (path.starts_with(folder)) paths.push_back(path);
  return paths;
}

std::optional<bool> StageRecord::is_as_written(const std::string& path) const {
  const auto known = files_.find(path);
  return known == files_.end() ? std::nullopt : is_as_recorded(directory_ / path, known->second);
}

std::string StageRecord::changed_file(const std::string& stage) const {
  for (const auto& [path, fingerprint] : files_)
    if (is_result(stage_named(stage), path) && !is_as_written(path).value_or(true)) return path;
  return "";
}

std::string StageRecord::stale(const std::string& stage, const std::string& data) const {
  const auto found = made_.find(stage);
  if (found == made_.end()) return "";
  const StageInputs &made = found->second, wanted = now(stage, data);
  if (made.version != wanted.version)
    return fmt::format("made by frictab {}, this is {}", made.version, wanted.version);
  if (!data.empty() && made.data != wanted.data) return "the data have changed since";
  if (const std::string other = other_job(stage); !other.empty()) return other;
  if (made.laws != wanted.laws && !job_.table.names_laws())
    return "table.model of the job has changed since";
  if (made.from != wanted.from) return fmt::format("made before the last `{}`", before(stage));
  return "";
}

std::string StageRecord::other_job(const std::string& stage) const {
  const auto found = made_.find(stage);
  if (found == made_.end() || found->second.job == now(stage, "").job) return "";
  return sections_text(stage_named(stage)) + " of the job has changed since";
}

std::string StageRecord::json() const {
  nlohmann::ordered_json out = {{"schema", schema},
                                {"tool_version", tool_version()},
                                {"stages", nlohmann::ordered_json::object()}};
  for (const Stage& stage : all_stages())
    if (const auto found = made_.find(stage.name); found != made_.end())
      out["stages"][stage.name] = {{"data", found->second.data},
                                   {"job", found->second.job},
                                   {"laws", found->second.laws},
                                   {"from", found->second.from},
                                   {"version", found->second.version}};
  if (!open_.empty()) out["unfinished"] = open_;
  out["files"] = files_;
  return io::sealed(io::json_text(out));
}

std::vector<std::string> differences_in(const std::filesystem::path& directory) {
  const auto file = directory / "stages.json";
  const auto json = read_record(file);
  std::map<std::string, std::string> files;
  io::read_json(file.string(), mend, [&] { json.at("files").get_to(files); });
  std::vector<std::string> found;
  for (const auto& [path, fingerprint] : files)
    if (const auto same = is_as_recorded(directory / path, fingerprint); !same)
      found.push_back(path + " is missing");
    else if (!*same)
      found.push_back(path + " was changed");
  return found;
}

} // namespace frictab::run
