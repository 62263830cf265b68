// Identifies the job's files by their resolved paths. A file is foreign if the stages.json that was
// found does not list it and its text does not name frictab.
#include "run/results.h"

#include <algorithm>
#include <set>

#include "core/text.h"
#include "data/file_list.h"
#include "io/directory_lock.h"
#include "io/file_streams.h"
#include "run/stage.h"

namespace frictab::run {

namespace {

namespace fs = std::filesystem;

const char* const to_mend = "choose another directory: -o DIR, or output.directory of the job";
constexpr std::string_view stages_file = "stages.json", report = "report.";

// The job file, the files of [data], and law and table files of [models], with symbolic links
// resolved.
std::set<fs::path> files_read_by(const job::Job& job) {
  const data::DataOptions& data = job.data;
  std::vector<std::string> names = job.models.files;
  names.push_back(data.tests);
  for (const models::LawText& law : job.models.texts)
    names.push_back(law.table);
  for (const auto* named : {&data.training, &data.validation, &data.oracle, &data.join.files})
    for (const std::string& name : data::find_files(*named, data.base, data.place))
      names.push_back(name);
  std::set<fs::path> files{fs::weakly_canonical(job.file)};
  for (const std::string& name : names)
    if (!name.empty()) files.insert(fs::weakly_canonical(fs::path(data.base) / name));
  return files;
}

void check_not_read(const job::Job& job, const std::vector<std::string>& paths) {
  const std::set<fs::path> read = files_read_by(job);
  for (const std::string& path : paths)
    if (const fs::path target = fs::path(job.directory) / path;
        read.count(fs::weakly_canonical(target)) > 0)
      throw InputError({target.string(), 0, 0}, "is read by this job, and a result comes there",
                       to_mend);
}

std::string beginning_of(const fs::path& file) {
  // Covers the first attributes of an HDF5 file.
  return io::first_bytes(file, std::size_t{1} << 16);
}

// True if stages.json lists the file. The page of the data is not listed, and older versions listed
// none: pages are known as soon as stages.json lists any file.
bool is_known(const StageRecord& stages, const std::string& path) {
  const bool page = path.starts_with(report) || path == "data.html";
  return stages.had_file(path) || (page && stages.had_files());
}

// True if frictab is named, as results do near their beginning, or the file is empty. Columns and
// tables of numbers do not name it; has_header_of compares their first line.
bool is_of_frictab(const std::string& beginning) {
  return beginning.empty() || beginning.find("frictab") != beginning.npos;
}

bool has_header_of(const std::string& beginning, const fs::path& other) {
  const std::string line = beginning.substr(0, beginning.find('\n'));
  const std::string wanted = beginning_of(other);
  return line == wanted.substr(0, wanted.find('\n'));
}

[[noreturn]] void refuse(const job::Job& job, const std::vector<std::string>& foreign) {
  throw InputError({job.directory, 0, 0},
                   "has files called like results that frictab did not write: " +
                       join(foreign, ", "),
                   std::string(to_mend) + "; or --force to replace them");
}

void check_not_of_others(const job::Job& job, const StageRecord& stages,
                         const io::OutputFiles& files) {
  std::vector<std::string> foreign;
  for (const std::string& path : files.paths()) {
    const fs::path target = fs::path(job.directory) / path;
    if (is_known(stages, path) || !fs::is_regular_file(target)) continue;
    const std::string beginning = beginning_of(target);
    if (!is_of_frictab(beginning) && !has_header_of(beginning, files.staged(path)))
      foreign.push_back(path);
  }
  if (!foreign.empty()) refuse(job, foreign);
}

} // namespace

void check_directory(const job::Job& job, const StageRecord& stages) {
  if (job.replaces_others) return;
  std::vector<std::string> foreign;
  std::set<std::string> names = {std::string(stages_file)};
  for (const Stage& stage : all_stages())
    for (const std::string& result : stage.results)
      if (!result.ends_with("/")) names.insert(result);
  for (const std::string& name : names)
    if (!is_known(stages, name) && !is_of_frictab(beginning_of(fs::path(job.directory) / name)))
      foreign.push_back(name);
  if (!foreign.empty()) refuse(job, foreign);
}

void record_files(StageRecord& stages, const io::OutputFiles& files) {
  for (const std::string& path : files.old())
    stages.forget_file(path);
  for (const std::string& path : files.paths())
    if (path != stages_file) stages.record_file(path, files.staged(path));
}

void commit_results(const job::Job& job, StageRecord& stages, io::OutputFiles& files) {
  std::vector<std::string> touched = files.paths();
  touched.insert(touched.end(), files.old().begin(), files.old().end());
  check_not_read(job, touched);
  if (!job.replaces_others) check_not_of_others(job, stages, files);
  record_files(stages, files);
  files.write(std::string(stages_file), stages.json());
  files.commit();
}

void write_verify_xml(const fs::path& directory, const std::string& xml, bool replaces_others) {
  io::OutputFiles out(directory, io::OutputFiles::Claim::one_file);
  const io::DirectoryLock lock(directory);
  const fs::path file = directory / "verify.xml";
  if (!replaces_others && !is_of_frictab(beginning_of(file)))
    throw InputError({file.string(), 0, 0}, "was not written by frictab", to_mend);
  out.write("verify.xml", xml);
  out.commit();
}

} // namespace frictab::run
