// Writes the rows of campaigns.csv.
#include "study/campaigns_csv.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>

#include "core/text.h"
#include "io/csv.h"
#include "study/keys.h"

namespace frictab::study {

namespace {

// Columns before and after the factors.
constexpr std::array front = {"campaign", "key", "state", "synthetic"};
constexpr std::array back = {
    "experiments", "rows",         "judged_by",  "law",        "rank",         "mae_MPa",
    "mae_low_MPa", "mae_high_MPa", "rmse_MPa",   "bias_MPa",   "best_p_value", "may_be_best",
    "band_low",    "band_high",    "parameters", "std_errors", "effects",      "message"};

std::string cell_of(double value) {
  return std::isfinite(value) ? shortest(value) : "";
}

std::string cell_of(const std::optional<double>& value) {
  return value ? cell_of(*value) : "";
}

using Cells = std::vector<std::string>;

Cells front_cells(const Campaign& campaign, std::uint64_t key, State state) {
  return {campaign.name, key_text(key), state_name(state)};
}

void write_line(std::ostream& out, const Cells& cells) {
  for (std::size_t i = 0; i < cells.size(); ++i)
    out << (i > 0 ? "," : "") << (cells[i].empty() ? "" : io::csv_cell(cells[i]));
  out << "\n";
}

std::string list_of_parameters(const LawResult& law, double FittedParameter::*which) {
  std::string text;
  for (const FittedParameter& p : law.parameters)
    text += (text.empty() ? "" : ";") + p.name + "=" + cell_of(p.*which);
  return text;
}

std::string effects_text(const CampaignResult& result) {
  std::string text;
  for (const EffectResult& effect : result.effects)
    text += (text.empty() ? "" : ";") + effect.column;
  return text;
}

const char* may_be_best(const LawResult& law) {
  if (std::isnan(law.best_p_value)) return "";
  return law.best_p_value >= 0.05 ? "true" : "false";
}

} // namespace

bool is_campaigns_column(std::string_view name) {
  return std::ranges::find(front, name) != front.end() ||
         std::ranges::find(back, name) != back.end();
}

void write_header(std::ostream& out, const Study& study) {
  Cells cells(front.begin(), front.end());
  cells.insert(cells.end(), study.factors.begin(), study.factors.end());
  cells.insert(cells.end(), back.begin(), back.end());
  write_line(out, cells);
}

void write_rows(std::ostream& out, const Campaign& campaign, std::uint64_t key,
                const CampaignResult& result) {
  Cells begin = front_cells(campaign, key, State::done);
  begin.emplace_back(result.synthetic ? "true" : "false");
  begin.insert(begin.end(), campaign.factors.begin(), campaign.factors.end());
  const std::string effects = effects_text(result);
  std::size_t rank = 0;
  for (const LawResult& law : result.laws) {
    Cells cells = begin;
    for (std::string cell :
         {std::to_string(result.experiments), std::to_string(result.rows), result.judged_by,
          law.law, std::to_string(++rank), cell_of(law.mae_MPa), cell_of(law.mae_interval.low),
          cell_of(law.mae_interval.high), cell_of(law.rmse_MPa), cell_of(law.bias_MPa),
          cell_of(law.best_p_value), std::string(may_be_best(law)), cell_of(law.band_low),
          cell_of(law.band_high), list_of_parameters(law, &FittedParameter::value),
          list_of_parameters(law, &FittedParameter::std_error), effects, join(result.missed, "; ")})
      cells.push_back(std::move(cell));
    write_line(out, cells);
  }
}

void write_row_without(std::ostream& out, const Campaign& campaign, std::uint64_t key, State state,
                       const std::string& message) {
  Cells cells = front_cells(campaign, key, state);
  cells.emplace_back(campaign.twin ? "true" : "");
  cells.insert(cells.end(), campaign.factors.begin(), campaign.factors.end());
  cells.resize(cells.size() + back.size() - 1);
  cells.push_back(message);
  write_line(out, cells);
}

} // namespace frictab::study
