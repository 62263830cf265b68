// Options of the synthetic tribometer as keys of a study.
#include "study/twin_block.h"

#include <charconv>
#include <limits>

#include <fmt/format.h>

#include "core/text.h"

namespace frictab::study {

using job::TomlNode;
using Type = job::TomlNode::Type;

namespace {

constexpr std::uint64_t largest_seed = std::numeric_limits<std::int64_t>::max();

bool read_seed(std::string_view text, std::uint64_t& seed) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  return error == std::errc() && end == text.data() + text.size() && seed <= largest_seed;
}

bool read_seeds(const TomlNode& node, Seeds& seeds) {
  if (node.type == Type::whole && node.whole >= 0) {
    seeds.first = seeds.last = static_cast<std::uint64_t>(node.whole);
    return true;
  }
  const std::size_t dots = node.text.find("..");
  if (node.type != Type::text || dots == std::string::npos) return false;
  return read_seed(std::string_view(node.text).substr(0, dots), seeds.first) &&
         read_seed(std::string_view(node.text).substr(dots + 2), seeds.last) &&
         seeds.first <= seeds.last;
}

// Reads a text in the twin's own syntax; its faults are at the place of the text.
template <class Read> void read_text(const TomlNode& node, FaultList& faults, const Read& read) {
  FaultList wrong_type;
  const std::string text = text_of(node, "twin." + node.key, wrong_type);
  for (const Fault& fault : wrong_type.all())
    faults.add(fault.place, fault.what, fault.hint);
  if (!wrong_type.empty()) return;
  try {
    read(text);
  } catch (const InputError& error) {
    add_at(node.place, error, faults);
  }
}

void read_effects(const TomlNode& node, twin::TwinOptions& options, FaultList& faults) {
  for (const std::string& text : texts_of(node, "twin.effect", faults)) {
    try {
      options.effects.push_back(twin::parse_effect(text));
    } catch (const InputError& error) {
      add_at(node.place, error, faults);
    }
  }
}

// Applies the design to the set's own, in whichever order the two keys are given.
void read_design(const TomlNode& block, twin::TwinOptions& options, FaultList& faults) {
  for (const TomlNode& node : block.items)
    if (node.key == "design")
      read_text(node, faults, [&](const std::string& text) {
        options.design =
            twin::parse_design(text, twin::default_design(twin::twin_set(options.set)));
      });
}

} // namespace

Seeds seeds_of(const TomlNode& node, FaultList& faults) {
  Seeds seeds;
  if (!read_seeds(node, seeds))
    faults.add(node.place,
               "twin.seed must be a seed or a range of them, not " + job::describe(node),
               "write seed = 7, or seed = \"1..1000\"");
  else if (seeds.last - seeds.first >= most_campaigns)
    faults.add(node.place,
               fmt::format("twin.seed asks for {} campaigns; a study has at most {}",
                           thousands(seeds.last - seeds.first + 1), thousands(most_campaigns)),
               "write several studies");
  else
    return seeds;
  return {};
}

void add_twin_keys(Keys& keys, twin::TwinOptions& options, FaultList& faults) {
  keys.text("set_name", options.set);
  keys.text("law", options.law);
  keys.text("profile", options.profile);
  keys.text("noise", options.noise);
  keys.number("noise_scale", options.noise_scale);
  keys.texts("hide", options.hide);
  keys.flag("bystanders", options.bystanders);
  keys.flag("more_bystanders", options.more_bystanders);
  keys.take("scatter", [&](const TomlNode& node) {
    read_text(node, faults,
              [&](const std::string& value) { options.scatter = twin::parse_scatter(value); });
  });
  keys.take("effect", [&](const TomlNode& node) { read_effects(node, options, faults); });
  keys.take("design", [](const TomlNode&) {}); // done by read_design
}

void finish_twin(const TomlNode& block, twin::TwinOptions& options, FaultList& faults) {
  try {
    twin::check_options(options);
    read_design(block, options, faults);
  } catch (const InputError& error) {
    add_at(block.place, error, faults);
  }
}

} // namespace frictab::study
