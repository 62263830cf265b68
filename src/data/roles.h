// Role of each recorded column with respect to friction, decided before any search for causes.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "data/dataset.h"
#include "data/options.h"

namespace frictab::data {

// Name in jobs and files: "setting".
const char* role_name(Role role);
// Names of the roles that [data.roles] may give, in the order of the enumeration.
std::vector<std::string> role_names();

// Column::why if the job gives the role.
inline constexpr const char* set_by_job = "the job says so";

// Column::why begins with this for a text in every test that few tests share: too many values to
// search, but the tests may differ by what it names.
inline constexpr const char* many_texts = "hardly any tests share a text: ";

// True if a column of this role may be searched for causes of friction.
bool may_be_cause(Role role);
// True also for an order of tests, which a trace examines in its own way.
bool may_be_searched(Role role);
// True if the column may be caused by friction, and is shown only as a lead.
bool may_follow_friction(Role role);

// True for a verdict on tests ("valid", "nok") or remarks, by name and texts: no condition of a
// test.
bool is_judgement(const Column& column);

// True if a column gives the order of tests, by its role, or by its name if no role was decided.
bool is_order(const Column& column);

// Sets role and why of every column, equally in all parts (training and validation of one
// campaign), and adds a note to the first part for a column that belongs to the measured friction.
// Roles in options.roles take precedence; a name there that is not a column is a fault.
void find_roles(std::span<Dataset* const> parts, const DataOptions& options, FaultList& faults);

} // namespace frictab::data
