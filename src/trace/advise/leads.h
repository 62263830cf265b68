// Leads: effects that may exist but are not in the law, with the reason.
#pragma once

#include "trace/judge/delivery.h"

namespace frictab::trace {

// Appends leads. First, findings that are not delivered. Then causes that the order of tests
// explains as well, each with the tests that would decide. Then the strongest unexplained terms,
// also those that chance may explain; where the tests are too few for any p-value, the strongest
// single quantities, recorded ones before those computed from them. Last, columns that were
// measured along with friction or are known only after it, and correlate with the residual of the
// delivered law: they may be its consequence, so each is a lead and never an effect.
void add_leads(Trace& trace, const Found& found, const Delivery& delivery);

// Names a cause, its recorded columns and what is computed from them.
Lead lead_of(const Cause& cause, const Candidates& candidates);

} // namespace frictab::trace
