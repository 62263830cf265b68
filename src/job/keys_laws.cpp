// The keys of a law given as a text (models/law_text.h): [models.NAME], or a law of the registry.
#include <algorithm>

#include "job/key_builder.h"

namespace frictab::job::schema {

namespace {

// Returns "my_law" for "my_law.mu"; a law of the program may have a dot in its name.
std::string law_name(const std::string& name) {
  return name.substr(0, name.rfind('.'));
}
std::string last_name(const std::string& name) {
  return name.substr(name.rfind('.') + 1);
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

std::vector<std::string> conventions_of_k() {
  std::vector<std::string> names;
  for (const models::ShearYield convention : models::shear_yields)
    names.push_back(models::shear_yield_name(convention));
  return names;
}

// Returns a key that sets a member of a law's text and that only the program's texts use, so that
// it needs no explanation.
template <auto member> auto registry_key(const char* key) {
  using T = std::remove_cvref_t<decltype(models::LawText{}.*member)>;
  return named<T>(
      std::string("models.*.") + key,
      [](Job & job, const std::string& name) -> auto& { return law_text(job, name).*member; }, "",
      "", "");
}

} // namespace

models::LawText& law_text(Job& job, const std::string& name) {
  auto& texts = job.models.texts;
  const auto found = std::find_if(texts.begin(), texts.end(),
                                  [&](const models::LawText& text) { return text.name == name; });
  if (found != texts.end()) return *found;
  texts.emplace_back().name = name;
  return texts.back();
}

models::ParameterText& parameter_text(Job& job, const std::string& name) {
  auto& parameters = law_text(job, law_name(name)).parameters;
  const auto found =
      std::find_if(parameters.begin(), parameters.end(),
                   [&](const models::ParameterText& p) { return p.name == last_name(name); });
  if (found != parameters.end()) return *found;
  parameters.emplace_back().name = last_name(name);
  return parameters.back();
}

std::vector<KeyRule> law_keys() {
  KeyRule where = named<std::string>(
      "models.*.where.*", [](Job & job, const std::string& name) -> auto& {
        auto& parts = law_text(job, law_name(name)).where;
        const auto found = std::find_if(parts.begin(), parts.end(), [&](const auto& part) {
          return part.first == last_name(name);
        });
        return found != parts.end()
                   ? found->second.text
                   : parts.emplace_back(last_name(name), models::FormulaText{}).second.text;
      },
      "a formula that others may use by this name, in the order in which they stand", "none",
      "\"mu*sigma_n_MPa/(m*k_MPa)\"");
  return {
      named<std::string>(
          "models.*.formula", [](Job & job, const std::string& name) -> auto& {
            return law_text(job, name).formula.text;
          },
          "tau_R in MPa, of parameters, parts, states, k_MPa (the shear yield stress), pi, "
          "recorded "
          "columns and histories; + - * / ** ( ), exp, ln, sqrt, sin, tanh, atan, arccos, abs, "
          "sign, min, "
          "max, "
          "where(a <= b, x, y)",
          "`piece` and `combine` say it", "\"min(mu*sigma_n_MPa, m*k_MPa)\""),
      named<std::string>(
          "models.*.piece", [](Job & job, const std::string& name) -> auto& {
            return law_text(job, name).piece.text;
          },
          "the smooth part that a table holds, instead of a formula", "found in the formula",
          "\"mu0*(sigma_n_MPa/1000)**a\""),
      named<std::string>(
          "models.*.combine", [](Job & job, const std::string& name) -> auto& {
            return law_text(job, name).combine.text;
          },
          "tau_R of the piece, called `value`: evaluated exactly, outside the table",
          "value*sigma_n_MPa", "\"min(value*sigma_n_MPa, m*k_MPa)\""),
      named<std::string>(
          "models.*.quantity",
          [](Job & job, const std::string& name) -> auto& { return law_text(job, name).quantity; },
          "what the piece is", "mu where `combine` has sigma_n_MPa, else tau_R", "\"mu\"") |
          Allowed{"", quantities_of_a_piece},
      named<std::string>(
          "models.*.table",
          [](Job & job, const std::string& name) -> auto& { return law_text(job, name).table; },
          "instead of a formula: a file, relative to the job, with a column per axis, one of mu or "
          "tau_R_MPa, and a row per node in any order (CSV, workbook, HDF5), or one of tables/*.h5",
          "a formula says it", "\"mu_of_p_v.csv\""),
      named<std::string>(
          "models.*.interpolation", [](Job & job, const std::string& name) -> auto& {
            return law_text(job, name).interpolation;
          },
          "between the nodes of `table`; beyond its axes the law is held at their ends",
          "an error, where there is a table", "\"linear\"") |
          Allowed{"", interpolations_of_a_table},
      named<std::vector<std::string>>(
          "models.*.log_axes",
          [](Job & job, const std::string& name) -> auto& { return law_text(job, name).log_axes; },
          "axes of `table` along which it is straight in ln x", "none", "[\"v_rel_mm_s\"]"),
      named<std::string>(
          "models.*.title",
          [](Job & job, const std::string& name) -> auto& { return law_text(job, name).title; },
          "a line about it", "\"law of the user\"", "\"Coulomb with a film\""),
      named<std::string>(
          "models.*.reference",
          [](Job & job, const std::string& name) -> auto& { return law_text(job, name).reference; },
          "where it comes from", "\"the job file\"", "\"own measurements, 2026\""),
      std::move(where),
      named<std::optional<std::pair<double, double>>>(
          "models.*.parameters.*.range", [](Job & job, const std::string& name) -> auto& {
            return parameter_text(job, name).range;
          },
          "where it is looked for", "an error, except for a constant", "[0, 1]"),
      named<std::optional<double>>(
          "models.*.parameters.*.start", [](Job & job, const std::string& name) -> auto& {
            return parameter_text(job, name).start;
          },
          "where the search begins; others are tried over the range", "the middle of the range",
          "0.1"),
      named<std::optional<double>>(
          "models.*.parameters.*.value", [](Job & job, const std::string& name) -> auto& {
            return parameter_text(job, name).value;
          },
          "a constant, which is not calibrated", "calibrated", "0.08"),
      named<std::string>(
          "models.*.parameters.*.unit", [](Job & job, const std::string& name) -> auto& {
            return parameter_text(job, name).unit;
          },
          "its unit, for people", "\"1\"", "\"MPa\""),
      named<std::string>(
          "models.*.parameters.*.meaning", [](Job & job, const std::string& name) -> auto& {
            return parameter_text(job, name).meaning;
          },
          "what it is, for people", "nothing", "\"friction factor\""),
  };
}

std::vector<KeyRule> registry_law_keys() {
  using models::LawText;
  return {
      registry_key<&LawText::order>("order"),
      registry_key<&LawText::people>("people"),
      registry_key<&LawText::calibrated>("calibrated") | Allowed{"", ways_without_a_fit},
      registry_key<&LawText::log_value>("log_value"),
      registry_key<&LawText::nodes_at_kinks>("nodes_at_kinks"),
      registry_key<&LawText::revisions>("revisions") | Allowed{"", conventions_of_k},
      named<std::string>(
          "models.*.parameters.*.settled_by", [](Job & job, const std::string& name) -> auto& {
            return parameter_text(job, name).settled_by;
          },
          "", "", ""),
  };
}

} // namespace frictab::job::schema
