// Prints what each stage found, the findings in short, the files written, and the next step.
#include "run/summary.h"

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/text.h"
#include "verify/forms.h"
#include "words/data.h"
#include "words/drift.h"
#include "words/laws.h"
#include "words/numbers.h"
#include "words/process.h"
#include "words/render.h"
#include "words/tables.h"
#include "words/trace.h"

namespace frictab::run {

namespace {

// Groups files by directory: "report.html, models/ (15), ...".
std::string file_list(const std::vector<std::string>& files) {
  std::vector<std::pair<std::string, std::size_t>> groups;
  for (const std::string& file : files) {
    const std::size_t slash = file.find('/');
    const std::string name = slash == std::string::npos ? file : file.substr(0, slash + 1);
    if (groups.empty() || groups.back().first != name) groups.emplace_back(name, 0);
    ++groups.back().second;
  }
  std::string text;
  for (const auto& [name, count] : groups)
    text += (text.empty() ? "" : ", ") + name +
            (name.back() == '/' ? fmt::format(" ({})", count) : std::string());
  return text;
}

// Suggests the next step: fix the drift, open the page, or run the next stage.
std::string next_step(const Run& run) {
  const std::vector<std::string> files = run.workspace.files();
  const auto wrote = [&](std::string_view start) {
    return std::ranges::any_of(files,
                               [&](const std::string& file) { return file.starts_with(start); });
  };
  for (const char* page : {"report.html", "process.html"})
    if (wrote(page)) return "open " + shell_word(run.path(page));
  const std::string job = " " + run.job.arguments();
  if (wrote("verify.json"))
    return run.verification->passed() && run.missed.empty()
               ? "frictab report" + job
               : "a smaller table.tolerance_MPa, then frictab tabulate" + job;
  if (wrote("export/")) return "frictab verify" + job;
  if (wrote("tables/")) return "frictab export" + job;
  return "frictab tabulate" + job;
}

} // namespace

words::Answers answers_of(const Run& run) {
  static const std::vector<std::string> none;
  return {run.calibration ? &*run.calibration : nullptr,
          run.verification ? &*run.verification : nullptr,
          run.traces,
          run.tables,
          run.data ? run.data->training.cautions : none,
          run.job.file};
}

std::string summary_text(const Run& run, words::Detail detail) {
  // The command `process` alone says nothing of a calibration that was there.
  const bool is_of_process = run.process && run.made.count("calibrate") == 0;
  std::vector<words::Section> sections;
  if (run.data && !is_of_process)
    sections.push_back(words::data_read(
        {run.data->training, run.data->validation, run.data->judged_by}, words::Detail::brief));
  if (run.calibration && !is_of_process) {
    sections.push_back(words::ranking(*run.calibration, detail));
    sections.push_back(words::conditional_use(*run.calibration));
  }
  for (const trace::Trace& trace : run.traces)
    sections.push_back(words::trace(trace, detail));
  if (!run.tables.empty()) sections.push_back(words::tables(run.tables));
  if (run.verification && !run.verification->records.empty())
    sections.push_back(words::drift(*run.verification, detail));
  if (run.process) {
    if (is_of_process)
      for (auto* part : {words::process_coverage, words::process_laws, words::process_tests})
        sections.push_back(part(*run.process));
    if (detail == words::Detail::verbose) sections.push_back(words::process_reading(*run.process));
    sections.push_back(words::process_in_short(*run.process));
  }
  if (detail == words::Detail::brief) sections.push_back(words::in_short(answers_of(run)));
  std::string out;
  for (const words::Section& section : sections)
    if (!section.blocks.empty()) out += words::as_text(section) + "\n";
  if (detail != words::Detail::brief && !run.forms.empty())
    out += verify::forms_text(run.forms) + "\n";
  else if (const std::string tip = verify::forms_in_short(run.forms); !tip.empty())
    out += "Tip: " + tip + "\n";
  const auto files = run.workspace.files();
  out += fmt::format("Wrote {} to {}: {}\n", words::count_of(files.size(), "file"),
                     run.job.directory, file_list(files));
  return out + "next: " + next_step(run) + "\n";
}

} // namespace frictab::run
