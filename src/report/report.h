// report.html, report.md and benchmark.md: the results of a run as pages to read. Only renders
// values.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "calibrate/calibration.h"
#include "calibrate/experiment_errors.h"
#include "table/table.h"
#include "trace/trace.h"
#include "verify/forms.h"
#include "verify/verification.h"
#include "words/wiring.h"

namespace frictab::report {

struct ReportInput {
  std::string title; // the campaign's name
  std::string job;   // file name of the job
  const calibrate::Calibration& calibration;
  const data::Dataset& training;
  const data::Dataset& validation;
  std::vector<std::vector<double>> predicted; // per calibration.fits entry: validation rows, MPa
  const std::vector<table::Table>& tables;
  const verify::Verification& verification;
  std::vector<std::string> files; // files that were written, relative to the output directory
  std::vector<verify::FormComparison> forms =
      {};                                // per table, sizes only: times differ from run to run
  std::vector<trace::Trace> traces = {}; // empty if not traced
  std::vector<calibrate::ErrorsOfLaw> by_experiment = {}; // per calibration.fits entry
  std::vector<words::Recipe> recipes = {};                // recipes of the generated sources
  // States of a process that was judged, drawn by friction work: columns by name.
  std::map<std::string, std::vector<double>> process = {};
};

// Writes one self-contained page that opens offline: ranking, measured against predicted and
// residual against predicted tau_R with density per law (inline SVG), parameters, tables, drift.
std::string report_html(const ReportInput& input);

// Returns the answers of the first box as JSON: summary.json.
std::string report_json(const ReportInput& input);

// Writes a short version as Markdown, to be pasted into a ticket: ranking,
// drift, traced effects, wiring, remarks.
std::string report_md(const ReportInput& input);

// Writes all that a calibration found, as Markdown.
std::string benchmark_md(const calibrate::Calibration& calibration);

} // namespace frictab::report
