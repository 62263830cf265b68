// Texts on the terms of a polynomial law, shared by the page and benchmark.md.
#pragma once

#include <cstddef>

namespace frictab::report {

inline constexpr std::size_t most_polynomial_terms = 15; // limit; the largest come first

inline constexpr const char* polynomial_words =
    "ln mu = ln mu0 + the sum of b times its term; each z runs from -1 to 1 over the data, P2 = "
    "(3 z\u00B2 - 1)/2, P3 = (5 z\u00B3 - 3 z)/2, so that a term moves ln mu by b at most. Errors "
    "by experiment, the ridge held.";

} // namespace frictab::report
