// Every law far outside any data: finite, of the right sign, under the shear limit, without
// friction where nothing presses, and never less friction for more contact normal stress where the
// law says so.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "core/random.h"
#include "expr/program.h"
#include "job/literature.h"
#include "models/assembled_law.h"
#include "support/law_parameter.h"
#include "support/sample_data.h"

namespace frictab::limits_test {
namespace {

using models::Model;

// At and far beyond the ends of what a rig or a process reaches; sigma_f is nothing in a melt.
const std::map<std::string, std::vector<double>> far = {
    {"sigma_n_MPa", {0, 1e-12, 1e-3, 1, 1000, 1e6}},
    {"psi", {1, 20, 1e6}},
    {"v_rel_mm_s", {0, 1e-9, 100, 1e6}},
    {"T_contact_C", {-273.15, 0, 20, 1500, 3000}},
    {"s_mm", {0, 1e6}},
    {"sigma_f_MPa", {0, 1e-6, 450, 1e5}},
    // An age is above 0: D_c over the speed, however fast.
    {"aging_state_over_D_c", {1e-9, 1, 1e9}},
    {"slip_state_over_D_c", {1e-9, 1, 1e9}}};

// Their coefficient may fall faster than the stress rises: docs/laws.md says so.
const std::set<std::string> may_fall = {"log_coulomb", "neural_network"};

class EveryLawFarOut : public testing::TestWithParam<std::string> {
protected:
  // The network as its training leaves it.
  static Model model() {
    if (GetParam() == "neural_network") return test::network_model();
    return test::plausible_model(*models::find_law(GetParam()));
  }
};

// All combinations of far states, in the order of `names`.
std::vector<std::vector<double>> far_states(const std::vector<std::string>& names) {
  std::vector<std::vector<double>> rows{{}};
  for (const std::string& name : names) {
    std::vector<std::vector<double>> longer;
    for (const std::vector<double>& row : rows)
      for (const double x : far.count(name) ? far.at(name) : std::vector<double>{0, 1}) {
        longer.push_back(row);
        longer.back().push_back(x);
      }
    rows = std::move(longer);
  }
  return rows;
}

// The model's own parameters, all corners of the bounds (of few parameters), and inside.
std::vector<std::vector<double>> parameters_of(const Model& model) {
  std::vector<std::vector<double>> sets{model.parameters};
  const std::vector<models::Parameter>& bounds = model.law->parameters;
  const std::size_t corners = bounds.size() > 8 ? 0 : 1UL << bounds.size();
  for (std::size_t corner = 0; corner < corners; ++corner) {
    std::vector<double>& set = sets.emplace_back();
    for (std::size_t p = 0; p < bounds.size(); ++p)
      set.push_back(corner >> p & 1 ? bounds[p].upper : bounds[p].lower);
  }
  Random random(7);
  for (int i = 0; i < 50; ++i) {
    std::vector<double>& set = sets.emplace_back();
    for (const models::Parameter& p : bounds)
      set.push_back(random.uniform(p.lower, p.upper));
  }
  return sets;
}

std::size_t place_of(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
}

std::string words(const std::vector<double>& values) {
  std::string text;
  for (const double x : values)
    text += std::to_string(x) + " ";
  return text;
}

TEST_P(EveryLawFarOut, StaysFiniteAndBetweenZeroAndK) {
  for (const bool limit : {true, false}) {
    Model model = EveryLawFarOut::model();
    model.conventions.shear_limit = limit;
    const auto names = models::inputs(*model.law, model.conventions);
    const auto rows = far_states(names);
    const expr::Program program(models::tau_formula(*model.law, model.conventions), names,
                                models::parameter_names(*model.law));
    const std::size_t sigma_f = place_of(names, "sigma_f_MPa");
    for (const std::vector<double>& parameters : parameters_of(model))
      for (const std::vector<double>& row : rows) {
        const double tau = program(row, parameters);
        ASSERT_TRUE(std::isfinite(tau)) << words(row) << "| " << words(parameters);
        ASSERT_GE(tau, 0) << words(row) << "| " << words(parameters);
        if (!limit) continue;
        ASSERT_LE(tau, model.conventions.k_over_sigma_f * row[sigma_f])
            << words(row) << "| " << words(parameters);
      }
  }
}

TEST_P(EveryLawFarOut, HasNoFrictionWhereNothingPressesUnlessItIsMK) {
  const Model model = EveryLawFarOut::model();
  const auto names = models::inputs(*model.law, model.conventions);
  const std::size_t sigma_n = place_of(names, "sigma_n_MPa");
  if (sigma_n == names.size()) return; // m k, whatever presses
  const expr::Program program(models::tau_formula(*model.law, model.conventions), names,
                              models::parameter_names(*model.law));
  for (const std::vector<double>& parameters : parameters_of(model))
    for (std::vector<double> row : far_states(names)) {
      row[sigma_n] = 0;
      ASSERT_EQ(program(row, parameters), 0) << words(row) << "| " << words(parameters);
      if (parameters != model.parameters) continue; // any coefficient, however large
      row[sigma_n] = 1e-9;
      ASSERT_LE(program(row, parameters), 1e-6) << words(row) << "| " << words(parameters);
    }
}

TEST_P(EveryLawFarOut, NeverLosesFrictionByMoreContactNormalStressUnlessItSaysSo) {
  if (may_fall.count(GetParam()) > 0) return;
  const Model model = EveryLawFarOut::model();
  const auto names = models::inputs(*model.law, model.conventions);
  if (place_of(names, "sigma_n_MPa") == names.size()) return; // m k
  const expr::Program program(models::tau_formula(*model.law, model.conventions), names,
                              models::parameter_names(*model.law));
  const std::size_t sigma_n = place_of(names, "sigma_n_MPa");
  const auto states = test::random_states(names, 10, 3);
  for (const std::vector<double>& parameters : parameters_of(model))
    for (std::size_t i = 0; i < 10; ++i) {
      std::vector<double> row;
      for (const auto& column : states)
        row.push_back(column[i]);
      double before = 0;
      for (double s = 1e-6; s < 1e6; s *= 1.3) {
        row[sigma_n] = s;
        const double tau = program(row, parameters);
        ASSERT_GE(tau, before * (1 - 1e-12)) << words(row) << "| " << words(parameters);
        before = tau;
      }
    }
}

// Those of the literature at the constants that they come with, and anywhere within the bounds of
// what is fitted.
class EveryLawOfTheLiteratureFarOut : public testing::TestWithParam<std::string> {};

TEST_P(EveryLawOfTheLiteratureFarOut, StaysFiniteAndBetweenZeroAndK) {
  const models::Law& law = *job::literature().find(GetParam());
  const models::Conventions conventions;
  std::vector<std::string> names = models::inputs(law, conventions);
  const expr::Program program(models::tau_formula(law, conventions), names,
                              models::parameter_names(law));
  const std::size_t sigma_f = place_of(names, "sigma_f_MPa");
  Model model;
  model.law = models::unregistered_law(law);
  model.parameters = models::start_values(law.parameters);
  for (const std::vector<double>& row : far_states(names)) {
    const double tau = program(row, model.parameters);
    ASSERT_TRUE(std::isfinite(tau)) << words(row) << "| " << words(model.parameters);
    ASSERT_GE(tau, 0) << words(row);
    ASSERT_LE(tau, conventions.k_over_sigma_f * row[sigma_f]) << words(row);
  }
}

std::vector<std::string> names_of_the_literature() {
  std::vector<std::string> names;
  for (const models::Law* law : job::literature().all())
    if (!models::find_law(law->name)) names.push_back(law->name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Literature, EveryLawOfTheLiteratureFarOut,
                         testing::ValuesIn(names_of_the_literature()), test::law_test_name);

INSTANTIATE_TEST_SUITE_P(Registry, EveryLawFarOut, testing::ValuesIn(models::law_names()),
                         test::law_test_name);

} // namespace
} // namespace frictab::limits_test
