// A trace as a terminal shows it.
#pragma once

#include <string>

#include "words/render.h"
#include "words/trace.h"

namespace frictab::test {

inline std::string trace_text(const trace::Trace& trace,
                              words::Detail detail = words::Detail::full) {
  return words::as_text(words::trace(trace, detail));
}

} // namespace frictab::test
