// The keys of a law given as a text (models/law_text.h): [models.NAME], or a law of the registry.
#include "job/key_builder.h"

namespace frictab::job::schema {

using models::FormulaText;
using models::LawText;
using models::ParameterText;

template <> std::vector<std::string> words_of<models::ShearYield>() {
  std::vector<std::string> names;
  for (const models::ShearYield convention : models::shear_yields)
    names.emplace_back(models::shear_yield_name(convention));
  return names;
}

namespace {

// Returns "my_law" for "my_law.mu"; a law of the program may have a dot in its name.
std::string law_name(const std::string& name) {
  return name.substr(0, name.rfind('.'));
}

std::vector<std::string> quantities_of_a_piece() {
  return {"mu", "tau_R"};
}

std::vector<std::string> interpolations_of_a_table() {
  return {"linear"};
}

std::vector<std::string> ways_without_a_fit() {
  return {"fixed", "mean"};
}

} // namespace

LawText& law_text(Job& job, const std::string& name) {
  return find_or_add(job.models.texts, &LawText::name, name);
}

ParameterText& parameter_text(Job& job, const std::string& name) {
  return find_or_add(law_text(job, law_name(name)).parameters, &ParameterText::name,
                     last_part(name));
}

std::vector<KeyRule> law_keys() {
  const KeysOf law("models.*", law_text);
  const KeysOf parameter("models.*.parameters.*", parameter_text);
  const auto text_of = [](FormulaText LawText::*formula) {
    return [formula](Job & job, const std::string& name) -> auto& {
      return (law_text(job, name).*formula).text;
    };
  };
  return {
      key("models.*.formula", text_of(&LawText::formula),
          "tau_R in MPa, of parameters, parts, states, k_MPa (the shear yield stress), pi, "
          "recorded columns and histories; + - * / ** ( ), exp, ln, sqrt, sin, tanh, atan, arccos, "
          "abs, sign, min, max, where(a <= b, x, y)",
          "`piece` and `combine` say it", "\"min(mu*sigma_n_MPa, m*k_MPa)\""),
      key("models.*.piece", text_of(&LawText::piece),
          "the smooth part that a table holds, instead of a formula", "found in the formula",
          "\"mu0*(sigma_n_MPa/1000)**a\""),
      key("models.*.combine", text_of(&LawText::combine),
          "tau_R of the piece, called `value`: evaluated exactly, outside the table",
          "value*sigma_n_MPa", "\"min(value*sigma_n_MPa, m*k_MPa)\""),
      law("quantity", &LawText::quantity, "what the piece is",
          "mu where `combine` has sigma_n_MPa, else tau_R", "\"mu\"") |
          Allowed{"", quantities_of_a_piece},
      law("table", &LawText::table,
          "instead of a formula: a file, relative to the job, with a column per axis, one of mu or "
          "tau_R_MPa, and a row per node in any order (CSV, workbook, HDF5), or one of tables/*.h5",
          "a formula says it", "\"mu_of_p_v.csv\"") |
          names_files,
      law("interpolation", &LawText::interpolation,
          "between the nodes of `table`; beyond its axes the law is held at their ends",
          "an error, where there is a table", "\"linear\"") |
          Allowed{"", interpolations_of_a_table},
      law("log_axes", &LawText::log_axes, "axes of `table` along which it is straight in ln x",
          "none", "[\"v_rel_mm_s\"]"),
      law("title", &LawText::title, "a line about it", "\"law of the user\"",
          "\"Coulomb with a film\""),
      law("reference", &LawText::reference, "where it comes from", "\"the job file\"",
          "\"own measurements, 2026\""),
      key(
          "models.*.where.*", [](Job & job, const std::string& name) -> auto& {
            auto& parts = law_text(job, law_name(name)).where;
            return find_or_add(parts, &std::pair<std::string, FormulaText>::first, last_part(name))
                .second.text;
          },
          "a formula that others may use by this name, in the order in which they stand", "none",
          "\"mu*sigma_n_MPa/(m*k_MPa)\""),
      parameter("range", &ParameterText::range, "where it is looked for",
                "an error, except for a constant", "[0, 1]"),
      parameter("start", &ParameterText::start,
                "where the search begins; others are tried over the range",
                "the middle of the range", "0.1"),
      parameter("value", &ParameterText::value, "a constant, which is not calibrated", "calibrated",
                "0.08"),
      parameter("unit", &ParameterText::unit, "its unit, for people", "\"1\"", "\"MPa\""),
      parameter("meaning", &ParameterText::meaning, "what it is, for people", "nothing",
                "\"friction factor\""),
  };
}

// Keys that only the program's texts use, so that they need no explanation.
std::vector<KeyRule> registry_law_keys() {
  const KeysOf law("models.*", law_text);
  const KeysOf parameter("models.*.parameters.*", parameter_text);
  return {
      law("order", &LawText::order, ""),
      law("people", &LawText::people, ""),
      law("calibrated", &LawText::calibrated, "") | Allowed{"", ways_without_a_fit},
      law("log_value", &LawText::log_value, ""),
      law("nodes_at_kinks", &LawText::nodes_at_kinks, ""),
      law("revisions", &LawText::revisions, "") | Allowed{"", words_of<models::ShearYield>},
      parameter("settled_by", &ParameterText::settled_by, ""),
  };
}

} // namespace frictab::job::schema
