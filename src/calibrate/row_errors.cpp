// Reads rows experiment by experiment, and predicts each of them by every law.
#include "calibrate/row_errors.h"

#include <deque>

#include "calibrate/band.h"
#include "calibrate/experiment_errors.h"
#include "calibrate/metrics.h"
#include "data/condense.h"

namespace frictab::calibrate {

using data::Dataset;

namespace {

// Results of one law on one experiment.
struct Judged {
  ExperimentError error;
  RowsBeyond beyond;
};

Judged judged(const models::AssembledLaw& law, const Dataset& rows, const std::string& experiment,
              bool held_out) {
  const auto [columns, tau] = predict_with_columns(law, law.inputs, rows);
  Judged one;
  one.error = error_of(experiment, held_out, stats::error_sums(rows, tau).front(),
                       experiment_gains(rows, tau)[0]);
  one.beyond.add(*law.model.law, law.inputs, columns, rows);
  return one;
}

RowFindings empty_findings(const Dataset& data, std::size_t laws) {
  const std::size_t tests = data.experiments.size();
  RowFindings found;
  found.errors.assign(laws, std::vector<ExperimentError>(tests));
  found.beyond.resize(laws);
  found.scatter.resize(tests);
  return found;
}

} // namespace

std::vector<RowFindings> look_at_rows(std::span<const RowsToJudge> all, std::size_t laws) {
  std::vector<RowFindings> found;
  std::vector<std::vector<std::vector<RowsBeyond>>> beyond; // by dataset, experiment, law
  std::vector<const Dataset*> data;
  for (const RowsToJudge& one : all) {
    data.push_back(one.data);
    found.push_back(empty_findings(*one.data, laws));
    beyond.emplace_back(one.data->experiments.size(), std::vector<RowsBeyond>(laws));
  }
  data::read_again(data, [&](std::size_t d, std::size_t e, const Dataset& rows) {
    found[d].scatter[e] = scatter_within(rows.values("tau_R_MPa"));
    for (std::size_t l = 0; l < laws; ++l) {
      Judged one = judged(all[d].law(l, e), rows, all[d].data->experiments[e], all[d].held_out);
      found[d].errors[l][e] = std::move(one.error);
      if (!all[d].data->recording.empty())
        found[d].errors[l][e].recording = all[d].data->recording[e];
      beyond[d][e][l] = std::move(one.beyond);
    }
  });
  for (std::size_t d = 0; d < all.size(); ++d)
    for (const auto& of_experiment : beyond[d])
      for (std::size_t l = 0; l < laws; ++l)
        found[d].beyond[l].add(of_experiment[l]);
  return found;
}

namespace {

std::vector<double> gains_of(const std::vector<ExperimentError>& errors) {
  std::vector<double> gains;
  for (const ExperimentError& one : errors)
    gains.push_back(one.gain);
  return gains;
}

void append_errors(ModelFit& fit, const std::vector<ExperimentError>& errors) {
  fit.on_rows.insert(fit.on_rows.end(), errors.begin(), errors.end());
}

class RowJudge {
public:
  RowJudge(const std::vector<ModelFit*>& fits, const CalibrationInput& input)
      : fits_(fits), input_(input) {
    for (const ModelFit* fit : fits)
      laws_.emplace_back(fit->model);
  }

  ScatterWithin judge() {
    const LawOfExperiment own = [&](std::size_t law, std::size_t) -> const models::AssembledLaw& {
      return laws_[law];
    };
    std::vector<RowsToJudge> all = {{&input_.training, false, own}};
    if (on_other_experiments(input_.judged_by)) all.push_back({&input_.validation, true, own});
    if (leaves_out()) all.push_back({&input_.training, true, left_out()});
    std::vector<RowFindings> found = look_at_rows(all, fits_.size());
    for (std::size_t l = 0; l < fits_.size(); ++l)
      take(*fits_[l], l, found);
    ScatterWithin scatter;
    scatter.training = std::move(found.front().scatter);
    if (on_other_experiments(input_.judged_by)) scatter.validation = std::move(found[1].scatter);
    return scatter;
  }

private:
  bool leaves_out() const {
    return input_.judged_by == JudgedBy::leave_one_out && !fits_.front()->without.empty();
  }

  LawOfExperiment left_out() {
    for (const ModelFit* fit : fits_) {
      without_.emplace_back();
      for (const models::Model& model : fit->without)
        without_.back().emplace_back(model);
    }
    return [&](std::size_t law, std::size_t e) -> const models::AssembledLaw& {
      return without_[law][e];
    };
  }

  Metrics metrics_of(const std::vector<ExperimentError>& errors) const {
    return metrics(sums_of(errors), input_.options.bootstrap, input_.options.seed);
  }

  void remark_rows_outside(ModelFit& fit, const RowsBeyond& beyond, const char* data) const {
    for (std::string& remark : beyond.told(*fit.model.law, data))
      fit.remarks.push_back(std::move(remark));
  }

  void take(ModelFit& fit, std::size_t l, const std::vector<RowFindings>& found) const {
    fit.on_rows.clear();
    fit.training = metrics_of(found[0].errors[l]);
    remark_rows_outside(fit, found[0].beyond[l], "training");
    if (on_other_experiments(input_.judged_by)) {
      append_errors(fit, found[0].errors[l]);
      append_errors(fit, found[1].errors[l]);
      fit.validation = metrics_of(found[1].errors[l]);
      fit.band = check_band(fit.model, gains_of(found[1].errors[l]));
      remark_rows_outside(fit, found[1].beyond[l], "validation");
    } else if (leaves_out()) {
      fit.unseen = found[1].errors[l];
      fit.validation = metrics_of(fit.unseen);
    } else if (input_.judged_by == JudgedBy::fit) {
      fit.unseen = found[0].errors[l];
      fit.validation = fit.training;
    }
  }

  const std::vector<ModelFit*>& fits_;
  const CalibrationInput& input_;
  std::deque<models::AssembledLaw> laws_;
  std::deque<std::deque<models::AssembledLaw>> without_; // per law and experiment
};

} // namespace

ScatterWithin judge_on_rows(const std::vector<ModelFit*>& fits, const CalibrationInput& input) {
  if (!input.training.condensed || fits.empty()) return {};
  return RowJudge(fits, input).judge();
}

} // namespace frictab::calibrate
