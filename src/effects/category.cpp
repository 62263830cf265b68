// One factor per level of a text column: tool, batch, operator.
#include "effects/effect.h"

namespace frictab {
namespace {

EffectForm make() {
  EffectForm form;
  form.name = "category";
  form.order = 12;
  form.title = "one factor per level";
  form.formula = "1 + a_level";
  form.parameters = {
      {"a", "1", "relative change between the first and the last level", 0, -10, 10}};
  form.shapes = {};
  form.categorical = true;
  return form;
}

const Registered<EffectForm> registered{make};

} // namespace
} // namespace frictab
