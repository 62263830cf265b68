// A made-up calibration of a realistic size for tests of the report: every law, autocorrelated
// noise, tables and drift.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "core/random.h"
#include "report/report.h"

namespace frictab::test {

struct ReportSample {
  calibrate::Calibration calibration;
  data::Dataset training;
  data::Dataset validation;
  std::vector<std::vector<double>> predicted;
  std::vector<table::Table> tables;
  verify::Verification verification;
  std::vector<std::string> files{"report.html", "calibration.json"};

  report::ReportInput input() const {
    return {"job.toml", "job.toml", calibration,  training, validation,
            predicted,  tables,     verification, files};
  }
};

// tau_R = 0.1 sigma_N and a drifting error per experiment.
inline data::Dataset report_data(std::size_t experiments, std::size_t rows, std::uint64_t seed) {
  data::Dataset data;
  data.columns = {{"sigma_n_MPa", "MPa", {}, {}}, {"tau_R_MPa", "MPa", {}, {}}};
  Random random(seed);
  for (std::size_t e = 0; e < experiments; ++e) {
    const double level = random.uniform(700, 2000);
    double error = 5 * random.normal();
    for (std::size_t i = 0; i < rows; ++i) {
      const double sigma = level * (1 + 0.3 * std::sin(0.02 * static_cast<double>(i)));
      error = 0.97 * error + 2.5 * random.normal();
      data.columns[0].values.push_back(sigma);
      data.columns[1].values.push_back(0.1 * sigma + error);
    }
    data.experiments.push_back("E" + std::to_string(e));
    data.first_row.push_back(data.first_row.back() + rows);
  }
  data.sources = {"campaign.csv"};
  return data;
}

inline calibrate::Metrics report_metrics(const data::Dataset& data,
                                         const std::vector<double>& predicted) {
  calibrate::Metrics m;
  m.n_rows = data.rows();
  m.n_experiments = data.experiments.size();
  const auto measured = data.values("tau_R_MPa");
  for (std::size_t i = 0; i < m.n_rows; ++i) {
    const double r = measured[i] - predicted[i];
    m.mae_MPa += std::abs(r) / static_cast<double>(m.n_rows);
    m.bias_MPa += r / static_cast<double>(m.n_rows);
    m.rmse_MPa += r * r / static_cast<double>(m.n_rows);
  }
  m.rmse_MPa = std::sqrt(m.rmse_MPa);
  m.mae_interval = {0.9 * m.mae_MPa, 1.1 * m.mae_MPa};
  return m;
}

// The first `laws` laws of the registry, each a little worse than the one before.
inline ReportSample report_sample(std::size_t laws, std::size_t experiments, std::size_t rows) {
  ReportSample s;
  s.training = report_data(experiments, rows, 1);
  s.validation = report_data(experiments, rows, 2);
  const auto sigma = s.validation.values("sigma_n_MPa");
  for (std::size_t l = 0; l < laws; ++l) {
    calibrate::ModelFit fit;
    fit.model.law = models::shared_law(
        models::all_laws()[models::all_laws().size() - 1 - l % models::all_laws().size()]);
    std::vector<double> predicted;
    for (const double value : sigma)
      predicted.push_back((0.1 - 0.003 * static_cast<double>(l)) * value);
    for (const models::Parameter& parameter : fit.model.law->parameters) {
      fit.model.parameters.push_back(parameter.start);
      fit.std_error.push_back(0.01 * std::abs(parameter.start));
    }
    fit.training = fit.validation = report_metrics(s.validation, predicted);
    s.predicted.push_back(std::move(predicted));
    s.calibration.fits.push_back(std::move(fit));
  }
  s.calibration.data_hash = "0123456789abcdef";
  table::Table table;
  table.model = "coulomb";
  table.axes = {{"sigma_n_MPa", "MPa", "contact normal stress", true, {500, 1000, 2750}}};
  table.value = {0.1, 0.09, 0.08};
  table.combine = expr::Expr::symbol("value") * expr::Expr::symbol("sigma_n_MPa");
  table.record.refinement = "3 nodes: 0.4 MPa";
  s.tables = {table};
  s.verification.max_drift_MPa = 0.5;
  verify::DriftRecord record;
  record.model = "coulomb";
  record.subject = "table";
  record.rows = {0.3, 0.1, 0.15, 0.25};
  record.n_rows = 1000;
  record.n_outside = 10;
  record.worst_case_MPa = 0.42;
  record.worst_state = {{"sigma_n_MPa", 1234.5}};
  record.passed = true;
  s.verification.records = {record};
  return s;
}

} // namespace frictab::test
