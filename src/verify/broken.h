// Routines that cannot be compiled here, do not compile, or whose files their driver cannot read.
#pragma once

#include <functional>
#include <string>

#include "codegen/exporter.h"
#include "verify/verification.h"

namespace frictab::verify {

// Returns true if this machine has the variant's program; otherwise records that it has not.
bool can_run(DriftRecord& record, const codegen::BuildVariant& variant);

// Returns the record of `verify`. If that throws because the routine itself is at fault, returns a
// record of `subject` that has failed, with the beginning of the message. Lets pass what another
// routine would meet as well: InputError, a full disk, no memory.
DriftRecord or_broken(const std::string& model, const std::string& subject, double allowed_MPa,
                      const std::function<DriftRecord()>& verify);

} // namespace frictab::verify
