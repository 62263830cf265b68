// All causes that friction may follow beside the base law.
#include "foreign/shapes.h"

namespace frictab::foreign {

namespace {

template <int which> Shape hidden(const Part&, Random& random) {
  const double s = sign(random);
  return [=](const Part& part) {
    Values out = part.at(which == 0 ? "hidden_block" : "hidden_batch");
    for (double& x : out)
      x *= s;
    return out;
  };
}

} // namespace

const std::vector<EffectKind>& effects() {
  static const std::vector<EffectKind> all = [] {
    std::vector<EffectKind> both = effects_of_states();
    const auto& others = effects_of_bystanders();
    both.insert(both.end(), others.begin(), others.end());
    return both;
  }();
  return all;
}

const std::vector<EffectKind>& hidden_effects() {
  static const std::vector<EffectKind> all = {
      {"hidden batch in blocks", {}, false, hidden<0>},
      {"hidden batch by chance", {}, false, hidden<1>},
      {"hidden batch without a trace", {}, false, hidden<1>},
  };
  return all;
}

const EffectKind* find_kind(const std::string& name) {
  for (const auto* list : {&effects(), &hidden_effects()})
    for (const EffectKind& kind : *list)
      if (kind.name == name) return &kind;
  return nullptr;
}

std::vector<std::string> effect_kinds() {
  std::vector<std::string> names;
  for (const EffectKind& kind : effects())
    names.push_back(kind.name);
  return names;
}

std::vector<std::string> hidden_kinds() {
  std::vector<std::string> names;
  for (const EffectKind& kind : hidden_effects())
    names.push_back(kind.name);
  return names;
}

bool within_tests(const std::string& effect) {
  const EffectKind* kind = find_kind(effect);
  return kind != nullptr && kind->within;
}

} // namespace frictab::foreign
