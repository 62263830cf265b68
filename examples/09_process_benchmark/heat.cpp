#include "heat.h"

#include <getfem/getfem_generic_assembly.h>

#include "linear_solver.h"

Heat::Heat(Billet& billet, const HeatData& data, double temperature)
    : billet_(billet), data_(data), mf_(billet.mesh()) {
  mf_.set_finite_element(getfem::fem_descriptor("FEM_QK(2,1)"));
  model_.add_fem_variable("T", mf_);
  model_.add_fem_data("T_before", mf_);
  model_.add_fem_data("u", billet.displacement());
  model_.add_im_data("source", billet.volume_points());  // MPa/s
  model_.add_im_data("rubbed", billet.contact_points()); // N/(mm s)
  model_.add_im_data("film", billet.contact_points());   // N/(mm s K), of the billet's area
  model_.add_initialized_scalar_data("tool", data.tool);
  model_.add_initialized_scalar_data("capacity", data.capacity);
  model_.add_initialized_scalar_data("conductivity", data.conductivity);
  model_.add_initialized_scalar_data("rate", 1);
  gmm::fill(model_.set_real_variable("T"), temperature);
  const std::string F = "(Id(2)+Grad_u)", ring = "2*pi*X(1)*";
  getfem::add_nonlinear_term(model_, billet.integration(),
                             ring +
                                 "((capacity*(T-T_before)*rate-source)*Test_T+conductivity*(Inv(" +
                                 F + "')*Grad_T).(Inv(" + F + "')*Grad_Test_T))");
  getfem::add_nonlinear_term(model_, billet.integration(), ring + "(film*(T-tool)-rubbed)*Test_T",
                             Billet::contact_region);
}

void Heat::step(double time_step) {
  gmm::copy(model_.real_variable("T"), model_.set_real_variable("T_before"));
  gmm::copy(billet_.model().real_variable("u"), model_.set_real_variable("u"));
  model_.set_real_variable("rate")[0] = 1 / time_step;
  gmm::copy(gmm::scaled(billet_.plastic_work(), data_.plastic_share / time_step),
            model_.set_real_variable("source"));
  gmm::copy(gmm::scaled(billet_.friction_work(), 0.5 / time_step),
            model_.set_real_variable("rubbed"));
  const std::vector<ContactRecord> contact = billet_.contact();
  Billet::Vector& film = model_.set_real_variable("film");
  for (std::size_t i = 0; i < contact.size(); ++i)
    film[i] = contact[i].touches ? data_.film * contact[i].state.expansion : 0;
  model_.assembly(getfem::model::BUILD_ALL); // linear: one solution is all
  Billet::Vector rise;
  solve(model_.real_tangent_matrix(), model_.real_rhs(), {}, rise);
  gmm::add(rise, model_.set_real_variable("T"));
  Billet::Vector volume, surface;
  getfem::ga_interpolation_im_data(model_, "T", billet_.volume_points(), volume);
  getfem::ga_interpolation_im_data(model_, "T", billet_.contact_points(), surface,
                                   billet_.mesh().region(Billet::contact_region));
  billet_.set_temperature(volume, surface);
}
