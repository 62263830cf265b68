// The message of an action that is refused.
#pragma once

#include <string>

#include "core/error.h"

namespace frictab::test {

// Returns what the InputError of `act` says; "accepted" if it throws none.
template <class Act> std::string refusal(const Act& act) {
  try {
    act();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

} // namespace frictab::test
