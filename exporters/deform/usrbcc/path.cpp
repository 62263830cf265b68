// Account of USRBCC and FTUPD over steps: the result of each edge and the user variables of each
// node by their definitions in the recipe.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "codegen/driven_path.h"
#include "codegen/histories.h"
#include "deform/usrbcc/usrbcc.h"

namespace frictab::deform::usrbcc {

using namespace codegen;
using fortran::Coefficient;

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Memory of a node, in the solver's units.
struct Node {
  double slip = 0, work = 0, peak = 0;
  ContactMemory further;
  std::vector<double> state; // its user variables, as the routine left them
};

// Numbers that the solver gives in one step, for the edge from a node to the next and for the
// node.
struct Given {
  double pressure = 0, speed = 0, temperatures[2] = {}, flow_stress = 0, expansion = 1;
  double shear = 0, normal = 0, node_speed = 0, node_temperature = 0;
  std::vector<double> fields = {}; // user variables of the node that are fields
};

class StepPath {
public:
  StepPath(DrivenPath& path, std::size_t variables)
      : path_(path), kind_(coefficient_kind(path.request)), updates_(takes_history(path.inputs)),
        needed_(state_count(path.inputs)), variables_(variables) {
    for (const SolverInput& input : path.inputs)
      if (input.source == Source::field) last_field_ = std::max(last_field_, input.field);
    const std::size_t all = std::max({variables, last_field_, updates_ ? needed_ : 1});
    for (std::size_t k = 0; k < nodes; ++k)
      nodes_.push_back({.further = ContactMemory(path.inputs), .state = std::vector<double>(all)});
  }

  void increment(std::size_t i) {
    time_ = path_.time.from_canonical(path_.time_increment());
    given_.clear();
    for (std::size_t k = 0; k < nodes; ++k)
      given_.push_back(plan(k, i));
    for (std::size_t k = 0; k < nodes; ++k)
      if (path_.is_refused(path_.states(states_given(k)))) given_[k].pressure = 0;
    DrivenPath::Call call;
    call.points = nodes;
    call.par = {time_, double(variables_)};
    for (std::size_t k = 0; k < nodes; ++k) {
      const Given& g = given_[k];
      for (std::size_t f = 0; f < g.fields.size(); ++f)
        if (is_field(f + 1)) nodes_[k].state[f] = g.fields[f];
      call.v.insert(call.v.end(),
                    {g.pressure, g.speed, g.temperatures[0], g.temperatures[1], g.flow_stress,
                     g.expansion, g.shear, g.normal, g.node_speed, g.node_temperature});
      call.st.insert(call.st.end(), nodes_[k].state.begin(), nodes_[k].state.end());
    }
    call.out.assign(nodes * outputs, 0.0);
    path_.run(call);
    for (std::size_t k = 0; k < nodes; ++k) {
      path_.compare("VARIABLE", kind_ == Coefficient::stress ? path_.stress.name : "1",
                    call.out[k * outputs], answer(k));
      path_.compare("what else is written", "", call.out[k * outputs + 1], 0);
    }
    for (std::size_t k = 0; k < nodes; ++k)
      update(k, &call.st[k * nodes_[k].state.size()]);
  }

private:
  static constexpr std::size_t nodes = 5;
  static constexpr std::size_t outputs = 2; // per node, in ftincr

  bool keeps() const { return variables_ >= needed_; }
  bool is_field(std::size_t number) const {
    return std::any_of(path_.inputs.begin(), path_.inputs.end(), [&](const SolverInput& input) {
      return input.source == Source::field && input.field == number;
    });
  }

  Given plan(std::size_t k, std::size_t i) {
    Random& random = path_.random;
    const WantedStates wanted = path_.wanted(k, i);
    Given g;
    g.pressure = path_.stress.from_canonical(wanted.pressure) * (k % 2 == 0 ? 1 : -1);
    g.speed = path_.speed.from_canonical(wanted.speed) * (i % 2 == 0 ? 1 : -1);
    const double apart = random.uniform(-5, 5);
    g.temperatures[0] = path_.celsius.from_canonical(wanted.temperature - apart);
    g.temperatures[1] = path_.celsius.from_canonical(wanted.temperature + apart);
    g.flow_stress = path_.stress.from_canonical(wanted.flow_stress);
    g.expansion = wanted.expansion;
    g.shear = path_.stress.from_canonical(wanted.pressure * random.uniform(-0.2, 0.2));
    g.normal = -g.pressure * random.uniform(0.8, 1.2);
    g.node_speed = -g.speed * random.uniform(0.8, 1.2);
    g.node_temperature = path_.celsius.from_canonical(wanted.temperature + random.uniform(-5, 5));
    for (const double field : wanted.fields)
      g.fields.push_back(field * random.uniform(0.98, 1.02));
    const std::size_t turn = (7 * i + 3 * k) % 29;
    if (turn == 0) g.pressure = 0;
    if (turn == 1) g.normal = 0;
    if (turn == 2) g.speed = g.node_speed = 0;
    if (turn == 3) g.flow_stress = 0;
    if (turn == 4) g.pressure *= 1e-7; // below the pressure at which the coefficient is held
    if (turn == 5 && i % 2 == 0) g.pressure = nan;
    return g;
  }

  GivenStates states_given(std::size_t k) const {
    const std::size_t next = (k + 1) % nodes;
    const Given& g = given_[k];
    const Node &a = nodes_[k], &b = nodes_[next];
    GivenStates out;
    out.pressure = path_.stress.to_canonical(std::abs(g.pressure));
    out.speed = path_.speed.to_canonical(std::abs(g.speed));
    if (keeps()) {
      out.slip = path_.length.to_canonical(0.5 * (a.slip + b.slip));
      out.work = path_.length.to_canonical(path_.stress.to_canonical(0.5 * (a.work + b.work)));
    }
    const double peak = keeps() ? path_.stress.to_canonical(0.5 * (a.peak + b.peak)) : 0;
    out.peak_pressure = std::isnan(out.pressure) ? nan : std::max(peak, out.pressure);
    out.temperature = path_.celsius.to_canonical(0.5 * (g.temperatures[0] + g.temperatures[1]));
    out.flow_stress = path_.stress.to_canonical(g.flow_stress);
    out.expansion = g.expansion;
    for (std::size_t f = 0; f < g.fields.size() && f < variables_; ++f)
      out.fields.push_back(0.5 * (g.fields[f] + given_[next].fields[f]));
    const ContactMemory none(path_.inputs);
    between_ = ContactMemory::between(keeps() ? a.further : none, keeps() ? b.further : none,
                                      path_.followed_temperature(out));
    out.memory = &*between_;
    return out;
  }

  double answer(std::size_t k) const {
    const double result = path_.coefficient(states_given(k), kind_);
    return kind_ == Coefficient::stress ? path_.stress.from_canonical(result) : result;
  }

  // The temperature of a node that histories follow: what the job says, else the node's own.
  double temperature_of(std::size_t k) const {
    GivenStates given;
    given.temperature = path_.celsius.to_canonical(given_[k].node_temperature);
    given.fields = given_[k].fields;
    return path_.followed_temperature(given);
  }

  void update(std::size_t k, const double* st) {
    Node& node = nodes_[k];
    const Given& g = given_[k];
    const double pressure = std::abs(g.normal), slip = std::abs(g.node_speed) * time_;
    if (updates_ && pressure > 0) {
      node.slip += slip;
      node.work += std::abs(g.shear) * slip;
      node.peak = std::max(node.peak, pressure);
      node.further.advance({path_.stress.to_canonical(pressure),
                            path_.speed.to_canonical(std::abs(g.node_speed)), temperature_of(k), 0},
                           {path_.stress.to_canonical(node.peak),
                            path_.stress.to_canonical(std::abs(g.shear)),
                            path_.length.to_canonical(slip), path_.time.to_canonical(time_)});
    }
    if (updates_) compare_variables(node, st);
    node.state.assign(st, st + node.state.size());
  }

  void compare_variables(const Node& node, const double* st) {
    const std::vector<double> all =
        node.further.variables(path_.request.units, {node.slip, node.work, node.peak});
    std::vector<std::string> names = {"slip", "friction work", "peak pressure"};
    for (const HistoryState& state : history_states(path_.inputs, path_.request.units))
      names.push_back(state.name);
    for (std::size_t j = 0; j < all.size() && j < node.state.size(); ++j)
      path_.compare(fmt::format("USRNOD({}) {}", j + 1, names[j]), "", st[j], all[j]);
  }

  DrivenPath& path_;
  Coefficient kind_;
  bool updates_;
  std::size_t needed_, variables_, last_field_ = 0;
  double time_ = 0;
  std::vector<Node> nodes_;
  std::vector<Given> given_;
  mutable std::optional<ContactMemory> between_; // of the edge looked at last
};

} // namespace

void Usrbcc::follow(DrivenPath& path) const {
  std::size_t last_field = 0;
  for (const SolverInput& input : path.inputs)
    last_field = std::max(last_field, input.field);
  const std::size_t all = std::max(state_count(path.inputs), last_field);
  path.drive_at_both_paces([&] { return StepPath(path, all); });
  path.drive(StepPath(path, std::min<std::size_t>(all, 2)), 0.125);
}

} // namespace frictab::deform::usrbcc
