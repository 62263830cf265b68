// Formats faults; every message a user sees goes through here.
#include "core/error.h"

#include <fmt/format.h>

#include "core/text.h"

namespace frictab {

Place at_job_key(std::string table, std::string name) {
  return {"", 0, 0, {std::move(table), std::move(name)}};
}

std::string format_place(const Place& place) {
  if (!place.key.name.empty()) return place.key.table + "." + place.key.name;
  if (!place.key.table.empty()) return place.key.table;
  if (place.line == 0) return place.file;
  if (place.column == 0) return fmt::format("{}:{}", place.file, place.line);
  return fmt::format("{}:{}:{}", place.file, place.line, place.column);
}

std::string format_faults(const std::vector<Fault>& faults) {
  std::string text;
  for (std::size_t i = 0; i < faults.size() && i < FaultList::shown; ++i) {
    const Fault& fault = faults[i];
    const std::string place = format_place(fault.place);
    if (!text.empty()) text += '\n';
    text += place.empty() ? "error: " : place + ": error: ";
    text += fault.what;
    if (!fault.hint.empty()) text += "\n  hint: " + fault.hint;
  }
  text = printable(text);
  if (faults.size() > FaultList::shown)
    text += fmt::format("\n... and {} more faults", faults.size() - FaultList::shown);
  return text;
}

InputError::InputError(std::vector<Fault> faults)
    : faults_(std::move(faults)), text_(format_faults(faults_)) {}

InputError::InputError(Place place, std::string what, std::string hint)
    : InputError(std::vector<Fault>{{std::move(place), std::move(what), std::move(hint)}}) {}

void FaultList::add(Place place, std::string what, std::string hint) {
  faults_.push_back({std::move(place), std::move(what), std::move(hint)});
}

void FaultList::add(const InputError& error) {
  faults_.insert(faults_.end(), error.faults().begin(), error.faults().end());
}

void FaultList::throw_if_any() const {
  if (!faults_.empty()) throw InputError(faults_);
}

void FaultsByCause::add(const std::string& cause, Fault fault) {
  const auto [found, is_new] = index_.emplace(cause, causes_.size());
  if (is_new)
    causes_.push_back({std::move(fault)});
  else
    ++causes_[found->second].more;
}

void FaultsByCause::tell(FaultList& faults, const std::string& noun) const {
  for (const Cause& cause : causes_)
    faults.add(cause.first.place, cause.first.what + and_more(cause.more, noun), cause.first.hint);
}

bool is_fault_of_path(const std::error_code& why) {
  return why == std::errc::too_many_symbolic_link_levels || why == std::errc::filename_too_long ||
         why == std::errc::not_a_directory || why == std::errc::permission_denied;
}

} // namespace frictab
