// Tables as plain text, for codes and people that read those. One format = one file that registers
// itself.
#pragma once

#include <ostream>

#include "core/registry.h"
#include "table/states.h"

namespace frictab {

struct PlainRequest {
  const Table& table;
  const HeldStates& held;
};

struct PlainFormat {
  std::string name;
  int order = 0;
  std::string title;
  std::string source; // where the format comes from: "ours", "verified: ...", "recalled: ..."
  // Throws InputError where a state is missing or the format cannot hold the table.
  void (*write)(const PlainRequest&, std::ostream&) = nullptr;
};

// Throws InputError that names the nearest one where there is none of this name.
const PlainFormat& plain_format(const std::string& name);

// Decks hold the friction coefficient mu = tau_R/sigma_N over some states. Its places: the nodes of
// an axis, nine even places of an input that is none, empty where the table does not depend on the
// state or it is held.
struct DeckGrid {
  std::vector<double> pressure, speed, temperature;
};
// Throws InputError where other states are not held, or the grid has more than 100,000 places.
DeckGrid deck_grid(const PlainRequest& request);

// mu at one place of the grid; places of empty axes are ignored.
class DeckValue {
public:
  explicit DeckValue(const PlainRequest& request);
  double operator()(double pressure, double speed, double temperature) const;

private:
  TableFunction function_;
  HeldStates held_;
};

// Comment lines every deck starts with: law, origin of the format, units, held states.
std::string deck_head(const PlainRequest& request, const PlainFormat& format,
                      const std::string& comment);

} // namespace frictab
