// Fingerprints of stages.
#include "run/stages.h"

#include <algorithm>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/hash.h"
#include "core/text.h"
#include "core/version.h"
#include "io/atomic_file.h"
#include "io/json.h"

namespace frictab::run {

namespace {

constexpr const char* tabulate = "tabulate";
constexpr const char* schema = "frictab/stages/1";

struct Stage {
  const char* name;
  std::vector<std::string> sections; // of the job, that it depends on
};

const std::vector<Stage>& stages() {
  static const std::vector<Stage> all = {{"calibrate", {"models", "calibration"}},
                                         {"trace", {"trace"}},
                                         {tabulate, {"table"}},
                                         {"export", {"export"}},
                                         {"verify", {"verify"}}};
  return all;
}

std::string hash_text(const std::string& text) {
  return fmt::format("{:016x}", hash_of(text));
}

// Of a large file, a table that is streamed, its size and its ends: to read all of it takes longer
// than many a stage.
constexpr std::uintmax_t largest_read_whole = std::uintmax_t{256} << 20;
constexpr std::size_t end_bytes = std::size_t{1} << 20;

std::string file_fingerprint(const std::filesystem::path& file) {
  const std::uintmax_t size = std::filesystem::file_size(file);
  if (size <= largest_read_whole) return hash_text(io::read_file(file));
  std::ifstream in(file, std::ios::binary);
  std::string ends(2 * end_bytes, '\0');
  in.read(ends.data(), end_bytes);
  in.seekg(-static_cast<std::streamoff>(end_bytes), std::ios::end);
  in.read(ends.data() + end_bytes, end_bytes);
  return hash_text(fmt::format("{} {}", size, ends));
}

const Stage& stage_named(const std::string& name) {
  return *std::find_if(stages().begin(), stages().end(),
                       [&](const Stage& stage) { return name == stage.name; });
}

// The stage that writes this result; empty for what no stage does.
std::string_view stage_of(std::string_view path) {
  constexpr std::pair<std::string_view, std::string_view> beginnings[] = {
      {"calibration.", "calibrate"}, {"models/", "calibrate"}, {"trace.", "trace"},
      {"tables/", tabulate},         {"export/", "export"},    {"verify.", "verify"}};
  for (const auto& [beginning, stage] : beginnings)
    if (path.starts_with(beginning)) return stage;
  return "";
}

std::string sections_text(const Stage& stage) {
  std::vector<std::string> heads;
  for (const std::string& section : stage.sections)
    heads.push_back("[" + section + "]");
  return join(heads, " or ");
}

} // namespace

const std::vector<std::string>& stage_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> out;
    for (const Stage& stage : stages())
      out.emplace_back(stage.name);
    return out;
  }();
  return names;
}

Stages::Stages(const job::Job& job, const std::filesystem::path& directory)
    : job_(job), directory_(directory) {
  const auto file = directory / "stages.json";
  if (!std::filesystem::exists(file)) return;
  const auto json = io::parse_json(io::read_file(file), file.string());
  io::read_json(file.string(), "remove it, then `frictab run`", [&] {
    if (json.at("schema") != schema) return; // of another version: nothing is known
    for (const auto& [name, inputs] : json.at("stages").items())
      made_[name] = {inputs.at("data"), inputs.at("job"), inputs.at("laws"), inputs.at("from"),
                     inputs.at("version")};
    open_ = json.value("unfinished", "");
    files_ = json.value("files", std::map<std::string, std::string>()); // none: of 0.1
    for (const auto& [path, fingerprint] : files_)
      had_files_.insert(path);
  });
}

std::string Stages::key(const std::string& stage) const {
  const StageInputs& made = made_.at(stage);
  return hash_text(made.data + made.job + made.laws + made.from + made.version);
}

// The last stage before it whose results it goes on from: tracing need not have run.
std::string Stages::before(const std::string& stage) const {
  const auto& names = stage_names();
  auto at = std::find(names.begin(), names.end(), stage);
  while (at != names.begin())
    if (--at; made_.count(*at) > 0) return *at;
  return "";
}

StageInputs Stages::now(const std::string& stage, const std::string& data) const {
  std::string job;
  for (const std::string& section : stage_named(stage).sections)
    if (const auto found = job_.sections.find(section); found != job_.sections.end())
      job += section + found->second;
  const bool first = stage == stage_names().front();
  if (first) job += fmt::format("seed {}", job_.calibration.seed);
  const std::string laws = stage == tabulate ? join(job_.table.model, ", ") : "";
  const std::string last = before(stage);
  return {first ? data : "", hash_text(job), laws, last.empty() ? "" : key(last), tool_version()};
}

void Stages::begin(const std::string& stage, const std::string& data) {
  made_[stage] = now(stage, data);
  open_ = stage;
}

void Stages::record(const std::string& stage, const std::string& data) {
  made_[stage] = now(stage, data);
  open_.clear();
  if (stage == "calibrate") made_.erase("trace");
}

void Stages::record_file(const std::string& path, const std::filesystem::path& file) {
  files_[path] = file_fingerprint(file);
}

std::vector<std::string> Stages::recorded_in(std::string_view folder) const {
  std::vector<std::string> paths;
  for (const auto& [path, fingerprint] : files_)
    if (path.starts_with(folder)) paths.push_back(path);
  return paths;
}

std::optional<bool> Stages::is_as_written(const std::string& path) const {
  const auto known = files_.find(path);
  if (known == files_.end() || !std::filesystem::exists(directory_ / path)) return std::nullopt;
  return file_fingerprint(directory_ / path) == known->second;
}

std::string Stages::changed_file(const std::string& stage) const {
  for (const auto& [path, fingerprint] : files_)
    if (stage_of(path) == stage && !is_as_written(path).value_or(true)) return path;
  return "";
}

std::string Stages::stale(const std::string& stage, const std::string& data) const {
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

std::string Stages::other_job(const std::string& stage) const {
  const auto found = made_.find(stage);
  if (found == made_.end() || found->second.job == now(stage, "").job) return "";
  return sections_text(stage_named(stage)) + " of the job has changed since";
}

std::string Stages::json() const {
  nlohmann::ordered_json out = {{"schema", schema},
                                {"tool_version", tool_version()},
                                {"stages", nlohmann::ordered_json::object()}};
  for (const std::string& name : stage_names())
    if (const auto found = made_.find(name); found != made_.end())
      out["stages"][name] = {{"data", found->second.data},
                             {"job", found->second.job},
                             {"laws", found->second.laws},
                             {"from", found->second.from},
                             {"version", found->second.version}};
  if (!open_.empty()) out["unfinished"] = open_;
  out["files"] = files_;
  return io::json_text(out);
}

} // namespace frictab::run
