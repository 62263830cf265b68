// Job files: a remark at the end changes nothing.
#include "job/job.h"
#include "fuzz/target.h"

namespace frictab::fuzz::job_target {
namespace {

void read(std::string_view text) {
  const job::Job job = job::parse_job(text, "job.toml");
  const job::Job again = job::parse_job(std::string(text) + "\n# a remark\n", "job.toml");
  promise(job.sections == again.sections, "a remark changes no section");
}

const Registered<Target> registered([] { return Target{"job", read}; });

} // namespace
} // namespace frictab::fuzz::job_target
