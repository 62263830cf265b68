// What each recorded column is to friction, before anything looks for causes among them.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "data/dataset.h"
#include "data/options.h"

namespace frictab::data {

// As jobs and files write it: "setting".
const char* role_name(Role role);
// Those that [data.roles] may give, in the order of the enumeration.
std::vector<std::string> role_names();

// Column::why where the job gives the role.
inline constexpr const char* said_by_job = "the job says so";

// Whether what friction follows may be looked for in a column of this role.
bool may_be_cause(Role role);
// The same, and of an order of tests, which a trace looks at in its own way.
bool may_be_searched(Role role);
// Whether it may follow from friction, and is shown as a lead only.
bool may_follow_friction(Role role);

// Whether a column says by its role, or by its name where none was decided, in which order tests
// were made.
bool is_order(const Column& column);

// Sets role and why of every column, alike in all parts (training and validation of one campaign),
// and adds a note to the first where a column belongs to the measured friction.
// What the job says in options.roles holds; a name there that no column has is a fault.
void find_roles(std::span<Dataset* const> parts, const DataOptions& options, FaultList& faults);

} // namespace frictab::data
