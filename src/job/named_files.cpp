#include "job/named_files.h"

#include "data/file_list.h"

namespace frictab::job {

namespace {

class FileChecker {
public:
  explicit FileChecker(const Job& job) : job_(job) {}

  // `without_place`: where the job's text does not have the name, as in a study.
  void check(const std::string& key, const std::vector<std::string>& names,
             const Place& without_place) {
    for (const std::string& name : names) {
      const auto known = job_.file_places.find({key, name});
      data::check_is_there(key, name, job_.data.base,
                           known == job_.file_places.end() ? without_place : known->second,
                           faults_);
    }
  }
  void check(const std::string& key, const std::string& name, const Place& without_place) {
    if (!name.empty()) check(key, std::vector{name}, without_place);
  }

  void finish() const { faults_.throw_if_any(); }

private:
  const Job& job_;
  FaultList faults_;
};

} // namespace

void check_data_files(const Job& job) {
  const data::DataOptions& data = job.data;
  FileChecker files(job);
  files.check("data.training", data.training, data.place);
  files.check("data.validation", data.validation, data.place);
  files.check("data.oracle", data.oracle, data.oracle_place);
  files.check("data.tests", data.tests, data.tests_place);
  files.check("data.join.files", data.join.files, data.join.place);
  files.finish();
}

void check_process_files(const Job& job) {
  const process::ProcessOptions& process = job.process;
  FileChecker files(job);
  files.check("process.contact", process.contact, process.place);
  files.check("process.tool", process.tool, process.place);
  files.check("process.flow_curve", process.flow_curve, process.place);
  files.check("process.add", process.add, process.place);
  files.finish();
}

} // namespace frictab::job
