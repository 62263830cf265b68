#include "billet.h"

#include <cmath>
#include <stdexcept>

#include <getfem/getfem_generic_assembly.h>
#include <getfem/getfem_regular_meshes.h>

#include "linear_solver.h"

namespace {

using getfem::size_type;
using Vector = Billet::Vector;

// H = F - I, and the same of the test function.
const std::string strain = "[Grad_u(1,1),Grad_u(1,2),Grad_u(2,1),Grad_u(2,2),u(1)/X(1)]";
const std::string test_strain =
    "[Grad_Test_u(1,1),Grad_Test_u(1,2),Grad_Test_u(2,1),Grad_Test_u(2,2),Test_u(1)/X(1)]";
const std::string volume_ratio = "(((1+Grad_u(1,1))*(1+Grad_u(2,2))-Grad_u(1,2)*Grad_u(2,1))"
                                 "*(1+u(1)/X(1)))";
const std::string ring_length = "2*pi*X(1)*"; // a point stands for a ring

constexpr double tolerance = 1e-9; // of the largest force at a node
constexpr int most_iterations = 25;

bgeot::multi_index length(size_type n) {
  bgeot::multi_index sizes(1);
  sizes[0] = n;
  return sizes;
}

Gradient<double> gradient_at(const Vector& H, size_type point) {
  const double* h = &H[5 * point];
  return {1 + h[0], h[1], h[2], 1 + h[3], 1 + h[4]};
}

} // namespace

Billet::Billet(const Shape& shape, const std::set<Side>& touching, ContactSetting& setting,
               double temperature)
    : set_(setting), shape_(shape), mf_u_(mesh_), mf_p_(mesh_), mim_(mesh_), volume_points_(mim_),
      contact_points_(mim_, contact_region), history_points_(mim_, length(history_size)),
      memory_points_(mim_, length(memory_size), contact_region) {
  register_operators(setting);
  make_mesh(shape, touching);
  make_model(temperature);
  make_weights();
}

void Billet::make_mesh(const Shape& shape, const std::set<Side>& touching) {
  getfem::regular_unit_mesh(mesh_, {shape.columns, shape.rows},
                            bgeot::geometric_trans_descriptor("GT_QK(2,1)"));
  bgeot::base_matrix scale(2, 2);
  scale(0, 0) = shape.outer_radius - shape.inner_radius;
  scale(1, 1) = shape.height;
  mesh_.transformation(scale);
  mesh_.translation(bgeot::base_small_vector(shape.inner_radius, 0));
  getfem::mesh_region border;
  getfem::outer_faces_of_mesh(mesh_, border);
  for (getfem::mr_visitor face(border); !face.finished(); ++face) {
    const auto normal = mesh_.normal_of_face_of_convex(face.cv(), face.f());
    const Side side = std::abs(normal[0]) > std::abs(normal[1]) ? (normal[0] > 0 ? outer : inner)
                                                                : (normal[1] > 0 ? top : bottom);
    mesh_.region(side).add(face.cv(), face.f());
    if (touching.count(side)) mesh_.region(contact_region).add(face.cv(), face.f());
  }
  mf_u_.set_qdim(2);
  mf_u_.set_finite_element(getfem::fem_descriptor("FEM_QK(2,2)"));
  mf_p_.set_finite_element(getfem::fem_descriptor("FEM_QK(2,1)"));
  mim_.set_integration_method(getfem::int_method_descriptor("IM_GAUSS_PARALLELEPIPED(2,5)"));
}

void Billet::make_model(double temperature) {
  model_.add_fem_variable("u", mf_u_);
  model_.add_fem_variable("pressure", mf_p_);
  model_.add_fem_data("u_before", mf_u_);
  model_.add_initialized_scalar_data("K", set_.material->bulk_modulus());
  model_.add_im_data("history", history_points_);
  model_.add_im_data("memory", memory_points_);
  History fresh;
  fresh.temperature = temperature;
  Vector& history = model_.set_real_variable("history");
  for (size_type i = 0; i < history.size(); i += history_size)
    pack_history(fresh, history, i);
  Vector& memory = model_.set_real_variable("memory");
  for (size_type i = 0; i < memory.size(); i += memory_size)
    pack_history(fresh, memory, i);
  plastic_work_.resize(volume_points_.nb_filtered_index());
  friction_work_.resize(contact_points_.nb_filtered_index());
  old_tau_.resize(friction_work_.size());
  getfem::add_nonlinear_term(model_, mim_,
                             ring_length + "(Nominal_stress(" + strain + ",pressure,history)." +
                                 test_strain + "+(log(" + volume_ratio +
                                 ")-pressure/K)*Test_pressure)");
  getfem::add_nonlinear_term(model_, mim_,
                             "-" + ring_length + "Die_traction(" + strain +
                                 ",u,X,u_before,Normal,memory).Test_u",
                             contact_region);
}

void Billet::make_weights() {
  weights_.resize(contact_points_.nb_filtered_index());
  Vector one(weights_.size());
  for (size_type i = 0; i < one.size(); ++i) {
    one[i] = 1;
    getfem::ga_workspace workspace(model_);
    workspace.add_im_data("one", contact_points_, one);
    workspace.add_expression(ring_length + "one", mim_, mesh_.region(contact_region), 0);
    workspace.assembly(0);
    weights_[i] = workspace.assembled_potential();
    one[i] = 0;
  }
}

void Billet::start_guess(double bottom_z, double squeeze) {
  Vector& u = model_.set_real_variable("u");
  const bool first = last_move_.empty();
  const double scale = first ? 0 : set_.time_step / last_time_;
  for (size_type i = 0; i < u.size(); i += 2) {
    const auto at = mf_u_.point_of_basic_dof(i);
    u[i] += first ? 0.5 * squeeze * at[0] : scale * last_move_[i];
    u[i + 1] += first ? bottom_z - squeeze * at[1] : scale * last_move_[i + 1];
    if (at[1] == 0) u[i + 1] = bottom_z;
    if (at[0] == 0) u[i] = 0;
  }
}

double Billet::residual() {
  model_.assembly(getfem::model::BUILD_RHS);
  double sum = 0;
  unbalanced_ = 0;
  const Vector& rhs = model_.real_rhs();
  const size_type first = model_.interval_of_variable("u").first();
  for (size_type i = 0; i < rhs.size(); ++i) {
    if (fixed_[i]) continue;
    sum += rhs[i] * rhs[i];
    if (i >= first && i < first + mf_u_.nb_dof())
      unbalanced_ = std::max(unbalanced_, std::abs(rhs[i]));
  }
  return std::sqrt(sum);
}

int Billet::newton() {
  Vector state(model_.nb_dof()), move(state.size()), trial(state.size());
  double rest = residual();
  for (int iteration = 1; iteration <= most_iterations; ++iteration) {
    model_.assembly(getfem::model::BUILD_ALL);
    solve(model_.real_tangent_matrix(), model_.real_rhs(), fixed_, move);
    model_.from_variables(state);
    double part = 1, next = rest;
    for (int halving = 0; halving < 6; ++halving, part *= 0.5) {
      gmm::add(state, gmm::scaled(move, part), trial);
      model_.to_variables(trial);
      next = residual();
      if (next < rest * (1 - 0.1 * part)) break;
    }
    if (!std::isfinite(next)) break;
    rest = next;
    double largest = 1e3; // N: below, rounding is all that is left
    for (size_type i = 0; i < fixed_.size(); ++i)
      if (fixed_[i]) largest = std::max(largest, std::abs(model_.real_rhs()[i]));
    if (rest <= tolerance * largest) return iteration;
  }
  throw std::runtime_error("Newton's method did not converge");
}

int Billet::step(double bottom_z, double squeeze) {
  Vector before(model_.nb_dof());
  model_.from_variables(before);
  gmm::copy(model_.real_variable("u"), model_.set_real_variable("u_before"));
  fixed_.assign(model_.nb_dof(), false);
  const size_type first = model_.interval_of_variable("u").first();
  for (size_type i = 0; i < mf_u_.nb_dof(); i += 2) {
    const auto at = mf_u_.point_of_basic_dof(i);
    if (at[0] == 0) fixed_[first + i] = true;
    if (at[1] == 0) fixed_[first + i + 1] = true;
  }
  const double sticking_speed = set_.sticking_speed;
  int iterations = 0;
  for (const bool gently : {false, true}) {
    try {
      start_guess(bottom_z, squeeze);
      if (gently)
        for (const double softer : {1000, 100, 10}) {
          set_.sticking_speed = softer * sticking_speed;
          iterations += newton();
        }
      set_.sticking_speed = sticking_speed;
      return iterations + newton();
    } catch (const std::exception&) {
      set_.sticking_speed = sticking_speed;
      model_.to_variables(before);
      if (gently) throw;
    }
  }
  return iterations;
}

Vector Billet::at_volume(const std::string& expression, size_type size) const {
  Vector values;
  const getfem::im_data points(mim_, length(size));
  getfem::ga_interpolation_im_data(model_, expression, points, values);
  return values;
}

Vector Billet::at_contact(const std::string& expression, size_type size) const {
  Vector values;
  const getfem::im_data points(mim_, length(size), contact_region);
  getfem::ga_interpolation_im_data(model_, expression, points, values,
                                   mesh_.region(contact_region));
  return values;
}

std::vector<Traction<double>> Billet::tractions() const {
  const Vector H = at_contact(strain, 5), x = at_contact("X+u", 2),
               move = at_contact("u-u_before", 2), normal = at_contact("Normal", 2);
  const Vector& memory = model_.real_variable("memory");
  std::vector<Traction<double>> all;
  for (size_type i = 0; 2 * i < x.size(); ++i) {
    const size_type m = memory_size * i;
    all.push_back(traction<double>(set_, {x[2 * i], x[2 * i + 1], move[2 * i], move[2 * i + 1],
                                          gradient_at(H, i), normal[2 * i], normal[2 * i + 1],
                                          memory[m + history_size], unpack_history(memory, m)}));
  }
  return all;
}

void Billet::keep() {
  const Material& material = *set_.material;
  const Vector H = at_volume(strain, 5), pressure = at_volume("pressure", 1);
  Vector& history = model_.set_real_variable("history");
  Vector elastic(pressure.size());
  for (size_type i = 0; i < pressure.size(); ++i) {
    const Gradient<double> F = gradient_at(H, i);
    const History old = unpack_history(history, history_size * i);
    const History now = advance(material, old, F);
    pack_history(now, history, history_size * i);
    plastic_work_[i] = 0.5 * (now.strain - old.strain) *
                       (material.flow_stress(old.strain, old.temperature) +
                        material.flow_stress(now.strain, now.temperature));
    elastic[i] =
        shear_energy(material, now, F) + 0.5 * pressure[i] * pressure[i] / material.bulk_modulus();
  }
  const std::vector<Traction<double>> points = tractions();
  const Vector surface_H = at_contact(strain, 5);
  Vector& memory = model_.set_real_variable("memory");
  Vector springs(points.size());
  for (size_type i = 0; i < points.size(); ++i) {
    const size_type m = memory_size * i;
    pack_history(advance(material, unpack_history(memory, m), gradient_at(surface_H, i)), memory,
                 m);
    const double slip = std::abs(points[i].velocity) * set_.time_step; // 0 where nothing touches
    const double tau = std::abs(points[i].tau) * points[i].state.expansion;
    memory[m + history_size] += slip;
    friction_work_[i] = 0.5 * (old_tau_[i] + tau) * slip;
    old_tau_[i] = tau;
    const double p = points[i].state.pressure;
    springs[i] = 0.5 * p * p / set_.penalty * points[i].state.expansion;
  }
  energies_.plastic += volume_integral(plastic_work_);
  energies_.friction += contact_integral(friction_work_);
  energies_.elastic = volume_integral(elastic) + contact_integral(springs);
  last_move_.resize(mf_u_.nb_dof());
  gmm::add(model_.real_variable("u"), gmm::scaled(model_.real_variable("u_before"), -1.0),
           last_move_);
  last_time_ = set_.time_step;
}

void Billet::set_temperature(const Vector& at_volume_points, const Vector& at_contact_points) {
  Vector& history = model_.set_real_variable("history");
  for (size_type i = 0; i < at_volume_points.size(); ++i)
    history[history_size * i + history_size - 1] = at_volume_points[i];
  Vector& memory = model_.set_real_variable("memory");
  for (size_type i = 0; i < at_contact_points.size(); ++i)
    memory[memory_size * i + history_size - 1] = at_contact_points[i];
}

std::vector<ContactRecord> Billet::contact() const {
  const Vector x = at_contact("X+u", 2);
  const std::vector<Traction<double>> points = tractions();
  std::vector<ContactRecord> records(points.size());
  for (size_type i = 0; i < points.size(); ++i) {
    const Traction<double>& t = points[i];
    records[i] = {x[2 * i], x[2 * i + 1], t.touches,  weights_[i] * t.state.expansion,
                  t.state,  t.tau,        t.velocity, t.touches ? set_.law->outside(t.state) : 0};
  }
  return records;
}

double Billet::integral(const std::string& expression, size_type region) const {
  getfem::ga_workspace workspace(model_);
  workspace.add_expression(ring_length + "(" + expression + ")", mim_, mesh_.region(region), 0);
  workspace.assembly(0);
  return workspace.assembled_potential();
}

double Billet::volume_integral(const Vector& values) const {
  getfem::ga_workspace workspace(model_);
  workspace.add_im_data("values", volume_points_, values);
  workspace.add_expression(ring_length + "values", mim_, getfem::mesh_region::all_convexes(), 0);
  workspace.assembly(0);
  return workspace.assembled_potential();
}

double Billet::contact_integral(const Vector& values) const {
  return gmm::vect_sp(values, weights_);
}

double Billet::force() const {
  Vector pull;
  for (const Traction<double>& t : tractions())
    pull.push_back(t.z);
  return contact_integral(pull);
}

double Billet::bottom_force() const {
  const Vector& rhs = model_.real_rhs();
  const size_type first = model_.interval_of_variable("u").first();
  double sum = 0;
  for (size_type i = 0; i < mf_u_.nb_dof(); i += 2)
    if (mf_u_.point_of_basic_dof(i)[1] == 0) sum -= rhs[first + i + 1];
  return sum;
}

double Billet::volume() const {
  getfem::ga_workspace workspace(model_);
  workspace.add_expression(ring_length + volume_ratio, mim_, getfem::mesh_region::all_convexes(),
                           0);
  workspace.assembly(0);
  return workspace.assembled_potential();
}

std::array<double, 2> Billet::node(double r, double z) const {
  const Vector& u = model_.real_variable("u");
  for (size_type i = 0; i < u.size(); i += 2) {
    const auto at = mf_u_.point_of_basic_dof(i);
    if (std::hypot(at[0] - r, at[1] - z) < 1e-9) return {r + u[i], z + u[i + 1]};
  }
  throw std::logic_error("no node there");
}
