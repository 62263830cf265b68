// The form of an effect that a law may lack: a factor of one quantity, neutral parameters give 1.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/registry.h"
#include "expr/expr.h"
#include "models/law.h"

namespace frictab {

// One file per form in src/effects/. The factor is a formula of "x" (and "x2" for a product of two
// quantities) and of the parameters; `amplitude` scales the whole effect: 0 is neutral, bit for
// bit.
struct EffectForm {
  std::string name;
  int order = 0;
  std::string title;
  std::string formula;               // for people
  std::vector<Parameter> parameters; // the first is the amplitude; the others have units of x
  // For a text column: one factor per level instead of a formula of x (form "category").
  bool categorical = false;
  bool two_columns = false;
  Expr (*factor)() = nullptr; // nullptr where categorical
};

const std::vector<EffectForm>& all_effects();
const EffectForm* find_effect(std::string_view name);

} // namespace frictab
