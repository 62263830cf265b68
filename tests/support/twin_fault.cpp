#include "support/twin_fault.h"

#include "core/error.h"

namespace frictab::test {

std::string fault_of(const twin::TwinOptions& options) {
  try {
    twin::make_twin(options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no fault";
}

} // namespace frictab::test
