// The one error type: the fault, its place (file:line:col) and its remedy.
#pragma once

#include <cstddef>
#include <exception>
#include <map>
#include <string>
#include <system_error>
#include <vector>

namespace frictab {

// A key of the job, where it is known which one is at fault and not where the job states it.
struct JobKey {
  std::string table; // "export.inputs"
  std::string name;  // "psi"; empty: the whole table
};

// A place in a user's file; line and column count from 1, 0 = unknown. With a key: no file yet.
struct Place {
  std::string file;
  std::size_t line = 0;
  std::size_t column = 0;
  JobKey key = {};
};
Place at_job_key(std::string table, std::string name);

// Formats "file:line:col" without the unknown parts; of a key of the job "export.inputs.psi".
std::string format_place(const Place& place);

// One fault of the input. `hint` gives the remedy and may be empty.
struct Fault {
  Place place;
  std::string what;
  std::string hint;
};

// Thrown for everything the user can fix (exit code 2). Carries every fault found in one pass.
class InputError : public std::exception {
public:
  explicit InputError(std::vector<Fault> faults);
  InputError(Place place, std::string what, std::string hint = "");
  const char* what() const noexcept override { return text_.c_str(); }
  const std::vector<Fault>& faults() const { return faults_; }

private:
  std::vector<Fault> faults_;
  std::string text_;
};

// Collects faults so that a file's faults are reported together: the first 20 in full, the rest
// counted.
class FaultList {
public:
  static constexpr std::size_t shown = 20;
  void add(Place place, std::string what, std::string hint = "");
  void add(const InputError& error); // adds each of its faults
  bool empty() const { return faults_.empty(); }
  std::size_t size() const { return faults_.size(); }
  const std::vector<Fault>& all() const { return faults_; }
  void throw_if_any() const;

private:
  std::vector<Fault> faults_;
};

// Collects faults with the same cause and reports each cause once, with its count.
class FaultsByCause {
public:
  // `cause`: any text shared by the faults of one cause. Only the first fault of a cause is
  // reported.
  void add(const std::string& cause, Fault fault);
  // Adds "what (and 12 more rows)" per cause to `faults`, in the order in which the causes came.
  void tell(FaultList& faults, const std::string& noun) const;

private:
  struct Cause {
    Fault first;
    std::size_t more = 0;
  };
  std::vector<Cause> causes_;
  std::map<std::string, std::size_t> index_;
};

// "place: error: what\n  hint: ..." per fault; the text that `InputError::what()` returns.
std::string format_faults(const std::vector<Fault>& faults);

// True if a call failed by the path it was given: a link that leads to itself, a name too long, a
// file where a directory is needed, no permission.
bool is_fault_of_path(const std::error_code& why);

} // namespace frictab
