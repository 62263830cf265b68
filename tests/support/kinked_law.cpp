#include "support/kinked_law.h"

#include "models/symbols.h"

namespace frictab::test {

using expr::Expr;
namespace state = models::state;

namespace {

models::Formula build(const models::Conventions&) {
  const Expr mu = Expr::symbol("mu0") * pow(state::sigma_n() / 1000, Expr::symbol("a")) *
                  pow(Expr::symbol("psi"), Expr::symbol("b")) *
                  (1 - Expr::symbol("c") * log(Expr::symbol("v_rel_mm_s"))) *
                  exp(-(Expr::symbol("d") * (Expr::symbol("T_contact_C") - 20)));
  return {mu, minimum(state::value() * state::sigma_n(),
                      Expr::symbol("m") * Expr::symbol("sigma_f_MPa"))};
}

} // namespace

models::Model kinked_model() {
  models::Law law;
  law.name = "kinked";
  law.title = "product of powers, cut off";
  law.formula =
      "tau_R = min(mu0 sigma_N (sigma_N/1000)^a psi^b (1 - c ln v) exp(-d (T - 20)), m k)";
  law.reference = "a test law, ours";
  for (const char* name : {"mu0", "a", "b", "c", "d", "m"})
    law.parameters.push_back({name, "1", "of the test law", 0.1, -1, 1, "nothing"});
  law.log_value = true;
  law.build = build;
  models::Model model;
  model.law = models::unregistered_law(law);
  model.conventions = {models::ShearYield::flow_stress, 1, false};
  model.parameters = {0.12, -0.2, 0.1, 0.03, 0.001, 0.8};
  return model;
}

std::vector<table::StateRange> kinked_ranges() {
  return {{"sigma_n_MPa", 10, 2000, "test"},
          {"psi", 1, 10, "test"},
          {"v_rel_mm_s", 1, 1000, "test"},
          {"T_contact_C", 20, 600, "test"},
          {"sigma_f_MPa", 50, 500, "test"}};
}

} // namespace frictab::test
