// Puts the sections of pages together.
#include "report/report.h"

#include <cctype>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/version.h"
#include "io/json.h"
#include "report/page.h"
#include "report/sections.h"
#include "words/answer.h"
#include "words/data.h"
#include "words/drift.h"
#include "words/laws.h"
#include "words/render.h"
#include "words/tables.h"
#include "words/trace.h"

namespace frictab::report {

using words::Detail;
using words::Section;

namespace {

// Links to a file next to the page; characters that RFC 3986 reserves are written as %XX.
std::string link_to(const std::string& file) {
  std::string link = "./";
  for (const char c : file)
    if (std::isalnum(static_cast<unsigned char>(c)) ||
        std::string_view("-._~/").find(c) != std::string_view::npos)
      link += c;
    else
      link += fmt::format("%{:02X}", static_cast<unsigned char>(c));
  return link;
}

Section files_written(const ReportInput& input) {
  Section section{"files", "Files", "Files written"};
  words::List list{{}, "files"};
  for (const std::string& file : input.files) {
    const std::string shown = words::shown_path(file);
    list.items.push_back(words::link(shown, link_to(shown)));
  }
  if (list.items.empty()) section.say("None.");
  section.add(std::move(list));
  return section;
}

words::DataParts data_of(const ReportInput& input) {
  static const data::Dataset none;
  return {input.training,
          on_other_experiments(input.calibration.judged_by) ? input.validation : none,
          input.calibration.judged_by};
}

Section data_with_ranges(const ReportInput& input) {
  Section section = words::data_read(data_of(input), Detail::full);
  section.add(words::ranges(data_of(input)));
  return section;
}

Section drift_with_details(const ReportInput& input) {
  Section section = words::drift(input.verification, Detail::full);
  if (input.verification.records.empty()) return section;
  Section each{"", "", "Each table and routine"};
  each.say("On the validation rows inside the table's range, and the largest found over the whole "
           "range, with its state. The bound of a table is by branch and bound over its cells.");
  each.add(words::drift_of_each(input.verification));
  section.add(std::move(each));
  return section;
}

words::Answers answers_of(const ReportInput& input) {
  return {&input.calibration,
          input.verification.records.empty() ? nullptr : &input.verification,
          input.traces,
          input.tables,
          input.training.cautions,
          input.job};
}

} // namespace

std::string report_html(const ReportInput& input) {
  Page page{words::shown_path(input.title),
            "Friction report",
            {},
            words::in_short(answers_of(input)),
            {}};
  if (input.calibration.synthetic) page.warnings.push_back(synthetic_warning());
  page.sections = {ranking_with_bars(input),
                   all_laws_with_data(input),
                   words::comparison(input.calibration),
                   words::all_errors(input.calibration),
                   errors_by_test(input),
                   words::experiment_band(input.calibration),
                   words::polynomial_terms(input.calibration),
                   best_law_with_data(input),
                   strokes(input),
                   words::published_comparison(input.calibration),
                   words::conditional_use(input.calibration),
                   traces_with_plots(input),
                   each_law(input),
                   data_with_ranges(input),
                   tables_with_data(input),
                   drift_with_details(input),
                   words::wiring(input.recipes, Detail::full),
                   files_written(input)};
  return html_of(page);
}

static Section markdown_page(const std::string& title, bool synthetic,
                             std::vector<Section> sections) {
  Section page{"", "", title};
  if (synthetic) page.say(words::strong("Synthetic data: nothing here was measured."));
  for (Section& section : sections)
    if (!section.blocks.empty()) page.add(std::move(section));
  return page;
}

std::string report_md(const ReportInput& input) {
  std::vector<Section> sections = {
      words::in_short(answers_of(input)), words::data_read(data_of(input), Detail::brief),
      words::ranking(input.calibration), words::drift(input.verification, Detail::brief),
      words::tables(input.tables)};
  for (const trace::Trace& trace : input.traces)
    sections.push_back(words::trace(trace, Detail::brief));
  sections.push_back(words::wiring(input.recipes, Detail::brief));
  return words::as_markdown(markdown_page("Friction report: " + input.title,
                                          input.calibration.synthetic, std::move(sections)),
                            1);
}

std::string report_json(const ReportInput& input) {
  nlohmann::ordered_json j = {{"schema", "frictab/summary/1"},
                              {"tool_version", tool_version()},
                              {"data_hash", input.calibration.data_hash},
                              {"synthetic_data", input.calibration.synthetic},
                              {"campaign", input.title}};
  words::add_answers(j, answers_of(input));
  j["in_short"] = words::as_json(words::in_short(answers_of(input)))["lines"];
  return io::json_text(j);
}

std::string benchmark_md(const calibrate::Calibration& calibration) {
  return words::as_markdown(
      markdown_page(
          "Friction laws on experiments they were not calibrated on", calibration.synthetic,
          {words::ranking(calibration), words::delivered_laws(calibration),
           words::comparison(calibration), words::all_errors(calibration),
           words::experiment_band(calibration), words::polynomial_terms(calibration),
           words::published_comparison(calibration), words::conditional_use(calibration)}),
      1);
}

} // namespace frictab::report
