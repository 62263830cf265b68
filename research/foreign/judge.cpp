#include "foreign/judge.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <set>

#include "calibrate/calibration.h"
#include "core/text.h"
#include "data/derived.h"
#include "trace/advise/leads.h"
#include "trace_results.h"
#include "words/render.h"
#include "words/trace.h"

namespace frictab::foreign {

using trace::Trace;

namespace {

// --- the stage under test: all that is read of its results stands here --------------------------

using Names = std::vector<std::string>;

// Derived quantities by their names instead of the columns they are computed from.
Names names_of(const Names& columns, const std::string& derived) {
  if (derived.empty()) return columns;
  Names names{derived};
  const data::DerivedQuantity* quantity = data::find_derived(derived);
  if (quantity == nullptr) return names;
  for (const std::string& column : columns)
    if (std::find(quantity->needs.begin(), quantity->needs.end(), column) == quantity->needs.end())
      names.push_back(column);
  return names;
}

struct Found {
  Names names;
  std::vector<Names> as_good; // that these data cannot tell from it
};

std::vector<Found> found_effects(const Trace& trace) {
  std::vector<Found> found;
  for (const trace::TracedEffect& effect : trace.effects) {
    found.push_back({names_of(effect.columns, effect.derived), {}});
    for (const trace::Alternative& other : effect.alternatives)
      if (other.in_set) found.back().as_good.push_back(names_of(other.columns, other.derived));
  }
  return found;
}

void read_verdict(const Trace& trace, Score& score) {
  score.verdict = trace::verdict_name(trace.verdict);
  score.unexplained = trace.verdict == trace::Verdict::unexplained_structure;
  score.order_found = trace.order.found;
  if (!trace.effects.empty()) score.p_value = trace.effects.front().p_value;
  score.scatter = trace.scatter_between;
  score.scatter_low = trace.scatter_interval.low;
  score.scatter_high = trace.scatter_interval.high;
}

Trace traced(const Campaign& campaign, const calibrate::ModelFit& fit, const Options& options,
             double alpha) {
  trace::TraceOptions how;
  how.alpha = alpha;
  Trace found = trace::trace({campaign.training, campaign.validation, fit, how, 50, options.seed});
  if (options.show)
    std::fputs(words::as_text(words::trace(found, words::Detail::full)).c_str(), stderr);
  return found;
}

// --- what is the same column --------------------------------------------------------------------

// Columns of one campaign: those that go together in its data have found each other.
class Sameness {
public:
  explicit Sameness(const data::Dataset& data) : data_(data) {}

  bool operator()(const std::string& a, const std::string& b) const {
    if (a == b) return true;
    const auto x = values(a), y = values(b);
    return bench::go_together(x, y, 0.999);
  }

  bool any(const std::string& name, const Names& among) const {
    return std::any_of(among.begin(), among.end(),
                       [&](const std::string& other) { return (*this)(name, other); });
  }

  bool all(const Names& names, const Names& among) const {
    return std::all_of(names.begin(), names.end(),
                       [&](const std::string& name) { return any(name, among); });
  }

private:
  std::vector<double> values(const std::string& name) const {
    if (const data::Column* column = data_.find(name))
      return column->levels.empty() ? column->values : std::vector<double>{};
    const data::DerivedQuantity* quantity = data::find_derived(name);
    if (quantity == nullptr) return {};
    for (const std::string& need : quantity->needs)
      if (need != "tau" && !data_.has(need)) return {};
    return data::derive(*quantity, data_, data_.oracle_MPa);
  }

  const data::Dataset& data_;
};

// --- score --------------------------------------------------------------------------------------

class Judge {
public:
  Judge(const Campaign& campaign, const std::vector<Found>& found)
      : campaign_(campaign), found_(found), same_(campaign.training) {
    for (const Cause& cause : campaign.causes)
      for (const Names& answer : cause.answers)
        true_.insert(true_.end(), answer.begin(), answer.end());
  }

  void score(Score& score) const {
    Names named, words;
    for (const Found& effect : found_) {
      words.push_back(word_of(effect.names));
      const bool right = is_right(effect.names);
      Names sorted = effect.names;
      std::sort(sorted.begin(), sorted.end());
      score.found.push_back(join(sorted, " x "));
      score.right_anywhere = score.right_anywhere || right;
      score.wrong += !right;
      score.in_set = score.in_set || right ||
                     std::any_of(effect.as_good.begin(), effect.as_good.end(),
                                 [&](const Names& names) { return is_right(names); });
      named.insert(named.end(), effect.names.begin(), effect.names.end());
    }
    std::sort(words.begin(), words.end());
    score.answer = score.verdict + ": " + join(words, "; ");
    score.right_first = !found_.empty() && is_right(found_.front().names);
    score.causes = campaign_.causes.size();
    score.causes_named = static_cast<std::size_t>(
        std::count_if(campaign_.causes.begin(), campaign_.causes.end(),
                      [&](const Cause& cause) { return is_named(cause, named); }));
    score.complete = score.causes > 0 && score.causes_named == score.causes;
  }

private:
  // Part of an answer is right as well, and so is a product of two causes.
  bool is_right(const Names& names) const { return !names.empty() && same_.all(names, true_); }

  std::string word_of(Names names) const {
    for (std::string& name : names) {
      const auto known = std::find_if(true_.begin(), true_.end(),
                                      [&](const std::string& other) { return same_(name, other); });
      if (known != true_.end()) name = *known;
    }
    std::sort(names.begin(), names.end());
    return join(names, " x ");
  }

  bool is_named(const Cause& cause, const Names& named) const {
    return std::any_of(cause.answers.begin(), cause.answers.end(),
                       [&](const Names& answer) { return same_.all(answer, named); });
  }

  const Campaign& campaign_;
  const std::vector<Found>& found_;
  Sameness same_;
  Names true_;
};

double mean_error(std::span<const double> measured, const std::vector<double>& predicted) {
  double sum = 0;
  for (std::size_t i = 0; i < measured.size(); ++i)
    sum += std::abs(measured[i] - predicted[i]);
  return sum / static_cast<double>(measured.size());
}

} // namespace

namespace {

// What was found, and the law with it.
struct Outcome {
  std::vector<Found> found;
  models::Model law; // without one where nothing is delivered
};

Outcome of_trace(const Campaign& campaign, const calibrate::ModelFit& fit, const Options& options,
                 double alpha, Score& score) {
  const Trace trace = traced(campaign, fit, options, alpha);
  read_verdict(trace, score);
  score.why = bench::turned_down(trace);
  return {found_effects(trace), trace.extended.model};
}

// As if all that is significant were delivered.
Outcome of_search(const Campaign& campaign, const calibrate::ModelFit& fit, const Options& options,
                  double alpha, Score& score) {
  trace::TraceOptions how;
  how.alpha = alpha;
  const trace::TraceInput input{campaign.training, campaign.validation, fit, how, 50, options.seed};
  const trace::Found found = trace::search_effects(input);
  Outcome outcome;
  for (const trace::Cause& cause : found.search.last().causes) {
    const trace::Lead lead = trace::lead_of(cause, found.search.candidates());
    outcome.found.push_back({names_of(lead.columns, lead.derived), {}});
  }
  score.order_found = found.order.found;
  score.verdict = outcome.found.empty() ? "nothing" : "search";
  if (outcome.found.empty()) return outcome;
  score.p_value = found.findings.front().p_value;
  outcome.law = found.search.model_of(found.search.last());
  return outcome;
}

} // namespace

// Tracing sees every second of the held-out tests, and may use them for what it delivers. The
// others (all of them, where it sees none) say what that is worth.
Score judged(const Options& options, double alpha) try {
  Campaign campaign = make_campaign(options);
  std::vector<std::size_t> seen, judging;
  for (std::size_t e = 0; e < campaign.validation.experiments.size(); ++e)
    (options.no_validation || e % 2 ? judging : seen).push_back(e);
  const data::Dataset held_out = campaign.validation.subset(judging);
  campaign.validation = campaign.validation.subset(seen);
  Score score;
  score.absorbed = campaign.absorbed;
  score.gain_scatter = campaign.gain_scatter;
  score.gain_sample = campaign.gain_sample;
  calibrate::CalibrationInput input{
      campaign.training, options.no_validation ? campaign.training : campaign.validation, {}, {}};
  if (options.no_validation) input.judged_by = calibrate::JudgedBy::leave_one_out;
  input.models.use = {campaign.base};
  input.options.bootstrap = 50; // no interval of it is judged here
  const calibrate::Calibration calibration = calibrate::calibrate(input);
  const calibrate::ModelFit& fit = calibration.fits.front();
  const auto begin = std::chrono::steady_clock::now();
  const Outcome outcome =
      (options.search_only ? of_search : of_trace)(campaign, fit, options, alpha, score);
  const auto end = std::chrono::steady_clock::now();
  score.seconds = std::chrono::duration<double>(end - begin).count();
  Judge(campaign, outcome.found).score(score);
  const auto error_of = [&](const models::Model& model) {
    return mean_error(held_out.values("tau_R_MPa"), calibrate::predict(model, held_out));
  };
  score.delivered = outcome.law.law != nullptr;
  score.before = error_of(fit.model);
  score.after = score.delivered ? error_of(outcome.law) : score.before;
  score.oracle = mean_error(held_out.values("tau_R_MPa"), held_out.oracle_MPa);
  return score;
} catch (const std::exception& error) {
  Score failed;
  failed.error = error.what();
  return failed;
}

} // namespace frictab::foreign
