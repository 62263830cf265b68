// Condensed campaigns, for data larger than memory: means over blocks of neighbouring rows.
//
// A block stores the mean of every column, its number of rows, and the sum of squares of the
// measured stress about its mean. To second order in the variation within a block, the sum over
// rows of any loss of tau_R - law(state) equals the sum over blocks, weighted by their rows, of the
// loss at the means, plus a term from the sum of squares: a law can be fitted to blocks as to rows.
// The range of a table, ratios of means, histories and the number of rows are taken from the rows
// themselves before these are discarded. Errors of laws are computed by reading the rows a second
// time (read_again).
//
// A test changes most at its beginning, so blocks are short there: an eighth of the rows so far. A
// block ends where a text column or the direction changes, or where the load begins or ends, so
// that it averages only similar rows; cells without a value are not in the mean. An experiment with
// no more rows than blocks keeps its rows.
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "data/dataset.h"
#include "data/options.h"

namespace frictab::data {

// `rows` have sigma_n_MPa and tau_R_MPa. `blocks`: number of blocks of about equal size in each
// experiment, at least 1.
Dataset condense(const Dataset& rows, std::size_t blocks,
                 const std::shared_ptr<const RowSource>& source);

// take(d, e, rows): called with all rows of experiment e of all[d], on any thread. Each source is
// read once, even if only some of its experiments are requested. The datasets must be condensed.
// Throws InputError if the rows have changed since they were condensed.
using TakeRows =
    std::function<void(std::size_t dataset, std::size_t experiment, const Dataset& rows)>;
void read_again(std::span<const Dataset* const> all, const TakeRows& take);

// Sums above/below over the rows in which `below` is positive.
RatioSum ratio_sum(std::span<const double> above, std::span<const double> below);

// Smallest and largest value of a column or a history over the source rows; over the rows in memory
// if the data are not condensed. NaN without any value.
std::pair<double, double> source_range(const Dataset& data, const std::string& name,
                                       std::span<const double> held);

} // namespace frictab::data
