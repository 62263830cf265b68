// Fills templates/report/page.html.
#include "report/page.h"

#include "core/template.h"
#include "words/render.h"

namespace frictab::report {

std::string html_of(const Page& page) {
  TemplateValues values;
  values.text = {{"title", words::escape(page.title)},
                 {"kicker", words::escape(page.kicker)},
                 {"style", std::string(embedded_template("report/style.css"))},
                 {"first", words::as_html(page.first)}};
  values.lists["warnings"];
  for (const words::Text& warning : page.warnings)
    values.lists["warnings"].push_back({{{"text", words::html_of(warning)}}, {}, {}});
  std::vector<words::Section> shown;
  for (const words::Section& section : page.sections)
    if (!section.blocks.empty()) shown.push_back(section);
  values.text["menu"] = words::menu_html(shown);
  for (const words::Section& section : shown)
    values.text["sections"] += "\n" + words::as_html(section);
  return render_template("report/page.html", values);
}

words::Text synthetic_warning() {
  return words::strong("Synthetic data.") +
         " Nothing here was measured: the rows come from a simulated tribometer. The answers hold "
         "for the simulation, not for a friction pair of yours.";
}

} // namespace frictab::report
