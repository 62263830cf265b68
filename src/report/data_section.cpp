// Writes on which data the laws were calibrated: files, rows, what was left out, ranges.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/text.h"
#include "data/condense.h"
#include "data/quantity.h"
#include "data/roles.h"
#include "report/data_lines.h"
#include "report/judged.h"
#include "report/numbers.h"
#include "report/sections.h"
#include "report/svg.h"

namespace frictab::report {

namespace {

// Returns escaped lines, one below the other.
std::string lines(const std::vector<std::string>& list) {
  std::string text;
  for (const std::string& line : list)
    text += (text.empty() ? "" : "<br/>") + svg::escape(line);
  return text.empty() ? "\u2013" : text;
}

std::vector<std::string> files_of(const data::Dataset& data) {
  std::vector<std::string> files;
  for (const std::string& source : data.sources)
    files.push_back(shown_path(source));
  return files;
}

std::vector<std::string> dropped_of(const data::Dataset& data) {
  std::vector<std::string> list;
  for (const data::Dataset::Dropped& dropped : data.dropped)
    list.push_back(fmt::format("{}: {}", count_of(dropped.rows, "row"), dropped.rule));
  return list;
}

std::vector<std::string> bystanders_of(const data::Dataset& data) {
  std::vector<std::string> list;
  for (const data::Column& column : data.columns)
    if (!data::find_quantity(column.name))
      list.push_back(column.role == data::Role::undecided
                         ? column.name
                         : fmt::format("{} ({})", column.name, data::role_name(column.role)));
  return list.empty() ? list : std::vector<std::string>{join(list, ", ")};
}

std::string range_of(const data::Dataset& data, const std::string& name) {
  if (!data.has(name)) return "\u2013";
  const auto [low, high] = data::source_range(data, name, data.values(name));
  if (!(low <= high)) return "\u2013";
  return low == high ? short_figures(low) : short_figures(low) + " to " + short_figures(high);
}

} // namespace

void add_data_lines(TemplateValues& page, const data::Dataset& t, const data::Dataset& v,
                    calibrate::JudgedBy judged_by) {
  const std::string none = judged_words(judged_by).files;
  const auto of_validation = [&](const std::string& text) {
    return none.empty() ? text : "\u2013";
  };
  std::vector<TemplateValues>& rows = page.lists["data"];
  const auto add = [&](const char* what, const std::string& training,
                       const std::string& validation) {
    rows.push_back({{{"what", what}, {"training", training}, {"validation", validation}}, {}, {}});
  };
  add("Files", lines(files_of(t)), none.empty() ? lines(files_of(v)) : none);
  add("Experiments", thousands(t.experiments.size()),
      of_validation(thousands(v.experiments.size())));
  add("Rows", thousands(t.source_rows()), of_validation(thousands(v.source_rows())));
  if (const std::string how = uneven_text(judged_by, t, v); !how.empty())
    add("Length of experiments", none.empty() ? "\u2013" : svg::escape(how),
        none.empty() ? svg::escape(how) : "\u2013");
  if (const std::string of_t = phases_text(t), of_v = phases_text(v);
      !of_t.empty() || !of_v.empty())
    add("Of the rows read", of_t, of_v);
  if (t.condensed)
    add("Held as means over blocks of rows", thousands(t.rows()),
        of_validation(thousands(v.rows())));
  // Held-out tests are read, and their rows counted, together with the training tests.
  const bool together = judged_by == calibrate::JudgedBy::held_out;
  const auto add_counted = [&](const char* what, const std::vector<std::string>& training,
                               const std::vector<std::string>& validation) {
    add(what, lines(training),
        together && !training.empty() ? "counted at left, with the training tests'"
                                      : lines(validation));
  };
  add_counted("Left out", dropped_of(t), dropped_of(v));
  add_counted("Derived", t.notes, v.notes);
  add_counted("Unit not given", t.unit_questions, v.unit_questions);
  add_counted("Implausible", t.implausible, v.implausible);
  if (!t.unused.empty()) add("Beside the data, in none of them", lines(t.unused), "\u2013");
  add("Other columns", lines(bystanders_of(t)), lines(bystanders_of(v)));
}

void add_data(TemplateValues& page, const ReportInput& input) {
  const calibrate::JudgedBy judged_by = input.calibration.judged_by;
  const data::Dataset none, &t = input.training,
                            &v = on_other_experiments(judged_by) ? input.validation : none;
  add_data_lines(page, t, v, judged_by);
  std::vector<TemplateValues>& ranges = page.lists["ranges"];
  for (const data::Quantity& quantity : data::quantities()) {
    if (!t.has(quantity.name) && !v.has(quantity.name)) continue;
    ranges.push_back({{{"meaning", svg::escape(quantity.meaning)},
                       {"name", svg::escape(quantity.name)},
                       {"unit", shown_unit(quantity.unit)},
                       {"training", range_of(t, quantity.name)},
                       {"validation", range_of(v, quantity.name)}},
                      {},
                      {}});
  }
  page.flags["has_ranges"] = !ranges.empty();
}

} // namespace frictab::report
