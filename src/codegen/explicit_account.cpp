// Continues and compares the state variables of routines for explicit solvers.
#include "codegen/explicit_account.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "codegen/histories.h"

namespace frictab::codegen {

std::size_t explicit_state_count(const std::vector<SolverInput>& inputs) {
  return explicit_states + 2 * history_count(inputs) + shown_states;
}

std::vector<StateVariable> explicit_state_variables(const std::vector<SolverInput>& inputs,
                                                    const SolverUnits& units,
                                                    const ExplicitWords& words) {
  const std::string length = solver_unit("mm", units).name, stress = solver_unit("MPa", units).name;
  const std::string work = stress + "*" + length;
  std::vector<StateVariable> all = {
      {"slip", length, words.slip},
      {"friction_work", work, "friction work per area"},
      {"peak_pressure", stress, "peak pressure"},
      {"n_outside", "1", words.step + "s in which the state was outside the range"},
      {"slip_remainder", length, "what the solver's precision rounds off 1"},
      {"friction_work_remainder", work, "what the solver's precision rounds off 2"}};
  for (const HistoryState& state : with_remainders(history_states(inputs, units), explicit_states))
    all.push_back({state.name, state.unit, state.meaning});
  all.push_back(
      {"tau_R", stress, "frictional shear stress of the last " + words.step + " in contact"});
  all.push_back({"mu", "1", words.mu});
  return all;
}

nlohmann::ordered_json state_variables_json(const std::vector<StateVariable>& variables) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const StateVariable& variable : variables)
    out.push_back({{"number", out.size() + 1},
                   {"name", variable.name},
                   {"unit", variable.unit},
                   {"meaning", variable.meaning}});
  return out;
}

ExplicitAccount::ExplicitAccount(DrivenPath& path, std::string name, std::size_t states)
    : path_(path), name_(std::move(name)), states_(states), histories_(history_count(path.inputs)),
      all_(explicit_state_count(path.inputs)) {}

bool ExplicitAccount::keeps_histories() const {
  return histories_ > 0 && keeps(all_ - shown_states);
}

ExplicitVariables ExplicitAccount::kept(const ExplicitVariables& variables) const {
  ExplicitVariables out;
  if (keeps(1)) out.slip = variables.slip;
  if (keeps(2)) out.work = variables.work;
  if (keeps(3)) out.peak = variables.peak;
  return out;
}

void ExplicitAccount::fill(GivenStates& out, const ExplicitVariables& kept,
                           const ContactMemory& memory, double motion, double area) const {
  out.slip = path_.length.to_canonical(kept.slip) + motion;
  out.work = path_.length.to_canonical(path_.stress.to_canonical(kept.work));
  out.peak_pressure = std::max(path_.stress.to_canonical(kept.peak), out.pressure);
  out.area = path_.length.to_canonical(path_.length.to_canonical(area));
  if (keeps_histories()) out.memory = &memory;
}

void ExplicitAccount::advance(ContactMemory& memory, const ExplicitChange& change, double peak,
                              double area, double seconds, double temperature) const {
  const double slip = path_.length.to_canonical(change.slip);
  memory.advance(
      {path_.stress.to_canonical(change.pressure), seconds > 0 ? slip / seconds : 0, temperature,
       path_.length.to_canonical(path_.length.to_canonical(area))},
      {path_.stress.to_canonical(peak), path_.stress.to_canonical(change.stress), slip, seconds});
}

double ExplicitAccount::summed(double value, std::size_t remainder) const {
  return keeps(remainder) ? value : path_.held(value);
}

void ExplicitAccount::add(ExplicitVariables& variables, const ExplicitChange& change) const {
  variables.slip = summed(variables.slip + change.slip, 5);
  variables.work = summed(variables.work + change.work, 6);
  variables.peak = std::max(variables.peak, path_.held(change.pressure));
  variables.outside += change.outside ? 1 : 0;
  variables.stress = change.stress;
  variables.mu = change.stress /
                 std::max(change.pressure, path_.stress.from_canonical(fortran::least_pressure));
}

void ExplicitAccount::compare_one(const double* st, std::size_t number, std::size_t remainder,
                                  const std::string& what, const std::string& unit,
                                  double expected) const {
  if (!keeps(number)) return;
  const bool has_rest = remainder > 0 && keeps(remainder);
  const std::string quantity = fmt::format("{}({}) {}", name_, number, what);
  path_.compare(quantity, unit, st[number - 1] + (has_rest ? st[remainder - 1] : 0), expected);
  // The number itself is the sum as the solver's precision holds it.
  if (has_rest) path_.compare(quantity + ", rounded", unit, st[number - 1], expected);
}

void ExplicitAccount::compare(const ExplicitVariables& variables, const ContactMemory& memory,
                              const double* st) const {
  const std::string length = path_.length.name, stress = path_.stress.name;
  compare_one(st, 1, 5, "slip", length, variables.slip);
  compare_one(st, 2, 6, "friction work", stress + "*" + length, variables.work);
  compare_one(st, 3, 0, "peak pressure", stress, variables.peak);
  compare_one(st, 4, 0, "increments outside", "1", variables.outside);
  if (keeps_histories()) {
    const std::vector<double> kept = memory.variables(path_.request.units);
    const std::vector<HistoryState> known = history_states(path_.inputs, path_.request.units);
    for (std::size_t h = 0; h < kept.size(); ++h)
      compare_one(st, explicit_states + h + 1, explicit_states + histories_ + h + 1, known[h].name,
                  known[h].unit, kept[h]);
  }
  if (!keeps(all_)) return;
  compare_one(st, all_ - 1, 0, "tau_R", stress, variables.stress);
  compare_one(st, all_, 0, "mu", "1", variables.mu);
}

} // namespace frictab::codegen
