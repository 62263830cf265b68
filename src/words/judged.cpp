// Wordings for the four ways of validation.
#include "words/judged.h"

#include <fmt/format.h>

#include "core/text.h"
#include "data/phases.h"
#include "data/recordings.h"
#include "words/numbers.h"

namespace frictab::words {

using calibrate::JudgedBy;

JudgedWords judged_words(JudgedBy judged_by) {
  const std::string unseen = "Laws by mean absolute error on experiments not trained on";
  switch (judged_by) {
  case JudgedBy::leave_one_out:
    return {unseen,
            "All rows, by the laws as they are delivered, fitted to these rows as well; the errors "
            "above are of tests left out",
            "Each test is predicted by the law fitted to all others.", "all experiments"};
  case JudgedBy::fit:
    return {
        "Laws by mean absolute error on the ONE experiment they are fitted to; no other was seen",
        "All rows: those that the laws are fitted to", "The one test that the law is fitted to.",
        "the one experiment"};
  case JudgedBy::held_out:
  case JudgedBy::validation_files:
    break;
  }
  return {unseen, "Validation rows", "", "unseen experiments"};
}

std::string size_text(JudgedBy judged_by, const data::Dataset& training,
                      const data::Dataset& validation) {
  const auto describe = [](const data::Dataset& data) {
    return count_of(data.source_rows(), "row") + " of " +
           count_of(data.experiments.size(), "experiment");
  };
  const data::Units units = data::units_of(training);
  const bool whole = units.count < units.of.size();
  switch (judged_by) {
  case JudgedBy::leave_one_out:
    return describe(training) +
           (whole ? fmt::format(", each of {} recordings judged by laws fitted without it",
                                units.count)
                  : ", each experiment judged by laws fitted without it") +
           (units.count == 2
                ? " (their two errors say one difference twice: no intervals, no comparison)"
                : "");
  case JudgedBy::fit:
    return describe(training) + ", no other to judge the laws by";
  case JudgedBy::held_out:
  case JudgedBy::validation_files:
    break;
  }
  return describe(training) + " to train, " + describe(validation) + " to validate";
}

std::string phases_text(const data::Dataset& data) {
  std::vector<std::string> parts;
  for (std::size_t p = 0; p < data::phase_count; ++p)
    if (data.phases[p] > 0)
      parts.push_back(thousands(data.phases[p]) + " " +
                      data::phase_name(static_cast<data::Phase>(p)));
  return parts.size() == 1 && data.phases[0] > 0 ? "" : join(parts, ", ");
}

std::string condensed_text(const data::Dataset& training, const data::Dataset& validation) {
  if (!training.condensed) return "";
  return fmt::format("held as {} means over blocks of rows (data.condense): laws are fitted to "
                     "these; their errors, ranges and counts are of all rows; of blocks are {}",
                     thousands(training.rows() + validation.rows()), join(from_blocks(), ", "));
}

std::string uneven_text(JudgedBy judged_by, const data::Dataset& training,
                        const data::Dataset& validation) {
  const data::Dataset& judged = calibrate::on_other_experiments(judged_by) ? validation : training;
  const std::size_t count = judged.experiments.size();
  double all = 0, squares = 0, most = 0;
  std::string longest;
  for (std::size_t e = 0; e < count; ++e) {
    const auto rows = static_cast<double>(judged.source_rows(e));
    all += rows;
    squares += rows * rows;
    if (rows <= most) continue;
    most = rows;
    longest = judged.experiments[e];
  }
  const double equal = all * all / squares;
  if (count < 3 || !(2 * equal < static_cast<double>(count))) return "";
  return fmt::format("errors and fits are over rows: these {} experiments weigh as {:.1f} of equal "
                     "length ('{}' has {:.0f} % of the rows), and their intervals are too narrow",
                     count, equal, longest, 100 * most / all);
}

std::vector<std::string> from_blocks() {
  return {"repeated tests", "other splits of the tests", "known sliding distances", "traces"};
}

std::string judged_text(const calibrate::Calibration& c) {
  const calibrate::Metrics& v = c.fits.front().validation;
  const std::string on =
      count_of(v.n_rows, "row") + " of " + count_of(v.n_experiments, "experiment");
  switch (c.judged_by) {
  case JudgedBy::leave_one_out:
    if (c.recordings > 0)
      return fmt::format("each of {} recordings left out in turn and predicted by the law fitted "
                         "to all the others",
                         c.recordings);
    return "each left out in turn and predicted by the law fitted to all the others";
  case JudgedBy::fit:
    return "not validated: " + on +
           ", to which the laws are fitted; how far they are off another test is not known";
  case JudgedBy::held_out:
    return fmt::format("validated on {}, held out by seed {}", on, c.seed);
  case JudgedBy::validation_files:
    break;
  }
  return "validated on " + on;
}

} // namespace frictab::words
