// Rows of a campaign too large to be held, as means over blocks of neighbouring rows.
//
// A block is a mean of every column, the number of its rows and the sum of squares of the measured
// stress about its mean. To second order in what varies within a block a sum over rows of any loss
// of tau_R - law(state) is the sum over blocks, weighted by their rows, of that of the means, with
// the sum of squares on top: a law is fitted to blocks as to rows, and what a table reaches, a
// ratio of means, a history and the number of rows are taken from the rows themselves before they
// go. Errors of laws are taken in a second look at the rows (read_again).
//
// A test changes most where it begins: there blocks are short, an eighth of the way so far. A block
// ends where a text column or the direction changes or the load begins or ends, so that its mean is
// one of alike rows; cells without a value are not in the mean. An experiment with no more rows
// than blocks keeps its rows.
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "data/dataset.h"
#include "data/options.h"

namespace frictab::data {

// `rows` have sigma_n_MPa and tau_R_MPa. `blocks`: of about equal numbers of rows in each
// experiment, at least 1.
Dataset condense(const Dataset& rows, std::size_t blocks,
                 const std::shared_ptr<const RowSource>& source);

// take(d, e, rows): all rows of experiment e of all[d], on any thread. Each source is read once,
// whatever share of its experiments is asked for. The datasets are condensed. Throws InputError
// where the rows are no longer those that were condensed.
using TakeRows =
    std::function<void(std::size_t dataset, std::size_t experiment, const Dataset& rows)>;
void read_again(std::span<const Dataset* const> all, const TakeRows& take);

// Over the rows where what stands below is positive.
RatioSum ratio_sum(std::span<const double> above, std::span<const double> below);

// Least and largest value of a column or a history over the rows that were read; of the held ones
// where they are these. NaN where there is no value.
std::pair<double, double> span_behind(const Dataset& data, const std::string& name,
                                      std::span<const double> held);

} // namespace frictab::data
