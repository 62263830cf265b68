// Adds to the tables where their axes lie against the data.
#include <fmt/format.h>

#include "core/text.h"
#include "report/sections.h"
#include "words/tables.h"

namespace frictab::report {

namespace {

// The sizes of a source with the table and with the law itself.
words::Text forms_text(const ReportInput& input, const table::Table& table) {
  for (const verify::FormComparison& form : input.forms)
    if (form.model == table.model && !table.axes.empty())
      return fmt::format("A source holds {} of numbers as this table, {} as the law itself (",
                         human_bytes(static_cast<double>(form.table.bytes)),
                         human_bytes(static_cast<double>(form.direct.bytes))) +
             words::code("export.form = \"direct\"") +
             ", no drift but rounding); which of the two is faster " + words::code("frictab run") +
             " measures and prints.";
  return {};
}

words::Section axes_of(const ReportInput& input, const table::Table& table) {
  words::Section section{"", "", "Axes of " + table.model};
  if (table.axes.empty()) return section;
  words::Table axes = words::table_axes(table);
  axes.columns.push_back({"against the data", false, "", words::Shown::in_html});
  for (std::size_t i = 0; i < table.axes.size(); ++i)
    axes.rows[i].cells.push_back(reach_cell(input, table.axes[i]));
  section.add(std::move(axes));
  section.say(forms_text(input, table));
  if (const std::string how = table.record.refinement.value_or(""); !how.empty())
    section.say("Largest drift while the grid was refined: " + how, "small");
  return section;
}

} // namespace

words::Section tables_with_data(const ReportInput& input) {
  words::Section section = words::tables(input.tables);
  if (input.tables.empty()) return section;
  section.say("Against the data: the frame is the range of the table, the thin bar all rows, the "
              "thick bar 90 % of them; where the frame is empty the law is used beyond the tests.");
  for (const table::Table& table : input.tables)
    if (words::Section axes = axes_of(input, table); !axes.blocks.empty())
      section.add(std::move(axes));
  return section;
}

} // namespace frictab::report
