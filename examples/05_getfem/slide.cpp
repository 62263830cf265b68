// A contact problem in GetFEM whose friction is the C routine that frictab has generated: an
// elastic block is pressed on a rigid, slightly crowned die and slid over it (plane strain, mm, N,
// s, degC). Contact is GetFEM's Nitsche brick for rigid obstacles; its friction coefficient is an
// expression with the function frictab_mu(p, v) = tau_R(p, psi, v, T, s, sigma_f)/p, so that
// Newton's method sees how friction depends on pressure and speed. Usage: slide NAME [MU]   writes
// NAME_contact.csv and NAME_force.csv; with MU the coefficient is this constant and the routine
// only serves to compare. Exit code 1: a check failed.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/SparseLU>
#include <getfem/getfem_contact_and_friction_integral.h>
#include <getfem/getfem_generic_assembly.h>
#include <getfem/getfem_im_data.h>
#include <getfem/getfem_model_solvers.h>
#include <getfem/getfem_regular_meshes.h>

#include "frictab_tau_R.h"

namespace {

using getfem::model;
using getfem::size_type;
using Vector = getfem::model_real_plain_vector;

// A direct solver: Debian's GetFEM offers MUMPS without the file to link with.
struct Direct : getfem::abstract_linear_solver<getfem::model_real_sparse_matrix, Vector> {
  void operator()(const MATRIX& matrix, Vector& x, const Vector& right,
                  gmm::iteration& iteration) const override {
    std::vector<Eigen::Triplet<double>> entries;
    for (size_type column = 0; column < gmm::mat_ncols(matrix); ++column) {
      const auto& entry = gmm::mat_const_col(matrix, column);
      for (auto i = gmm::vect_const_begin(entry); i != gmm::vect_const_end(entry); ++i)
        entries.emplace_back(static_cast<int>(i.index()), static_cast<int>(column), *i);
    }
    Eigen::SparseMatrix<double> a(static_cast<int>(x.size()), static_cast<int>(x.size()));
    a.setFromTriplets(entries.begin(), entries.end());
    Eigen::SparseLU<Eigen::SparseMatrix<double>> lu(a);
    Eigen::Map<Eigen::VectorXd>(x.data(), a.rows()) =
        lu.solve(Eigen::Map<const Eigen::VectorXd>(right.data(), a.rows()));
    iteration.enforce_converged(lu.info() == Eigen::Success);
  }
};

// The block and the die.
constexpr double width = 20, height = 10, crown_radius = 400;
constexpr double young = 210e3, poisson = 0.3;
constexpr double press = 0.09; // the top goes down by this, in so many parts
constexpr int press_parts = 4;
constexpr size_type columns = 48, rows = 12;
constexpr size_type top = 1, bottom = 2;

// One step of sliding: the top moves at this speed for time_step, the contact has this temperature.
struct Step {
  double speed, temperature;
};
constexpr double time_step = 1e-3;
constexpr Step steps[] = {{100, 60}, {20, 90}, {50, 120}, {200, 150}, {400, 180}};

// What GetFEM's functions of two numbers cannot be given as arguments.
constexpr double psi = 2, sigma_f = 480;
double temperature = steps[0].temperature, slid = 0;

double tau_R(double p, double v) {
  return frictab_tau_R(p, psi, v, temperature, slid, sigma_f);
}

// The coefficient and its derivatives by central differences. Without contact it multiplies no
// pressure; a quotient is needed all the same.
constexpr double smallest_pressure = 1e-3;
double coefficient(double p, double v) {
  p = std::max(p, smallest_pressure);
  return tau_R(p, std::abs(v)) / p;
}
double by_pressure(double p, double v) {
  if (p <= smallest_pressure) return 0;
  const double h = 1e-4 * p;
  return (coefficient(p + h, v) - coefficient(p - h, v)) / (2 * h);
}
double by_speed(double p, double v) {
  const double h = 1e-4 * std::max(std::abs(v), 1.0);
  return (coefficient(p, v + h) - coefficient(p, v - h)) / (2 * h);
}

// The brick's own terms, written out once more: normal, pressure, tangential direction, sliding
// velocity relative to the die, and the traction that the brick puts on the contact.
struct Terms {
  std::string neumann, normal = "(-Normalized(Grad_obstacle))";
  std::string gap = "(obstacle-u." + normal + ")", gamma = "(gamma0/element_size)";
  std::string tangent = "([[0,1],[-1,0]]*" + normal + ")";
  std::string speed = "(((u-u_before)." + tangent + ")/time_step)";
  std::string pressure, mu, traction;

  Terms(const std::string& neumann_term, const std::string& coefficient)
      : neumann("(" + neumann_term + ")") {
    pressure = "neg_part(" + neumann + "." + normal + "+" + gamma + "*" + gap + ")";
    mu = "(rubs*" +
         (coefficient.empty() ? "frictab_mu(" + pressure + "," + speed + ")" : coefficient) + ")";
    traction = "Coulomb_friction_coupled_projection(" + neumann + "," + normal + ",(u-u_before)," +
               gap + "," + mu + "," + gamma + ")";
  }
};

// A point below this speed sticks: Nitsche's method leaves (stress - traction)/gamma of slip there.
constexpr double sliding_speed = 1;
constexpr double rounding = 1e-9; // MPa, of stresses of 10^3 MPa

// State of one quadrature point of the contact.
struct Point {
  double x, pressure, speed, tau;
};

// One step's forces per mm of thickness, N/mm.
struct Forces {
  double driving, friction, normal;
};

class Block {
public:
  explicit Block(const std::string& constant_mu)
      : mf_(mesh_), mf_obstacle_(mesh_), mim_(mesh_), points_(mim_) {
    make_mesh();
    fill_model();
    terms_ = std::make_unique<Terms>(model_.Neumann_term("u", bottom), constant_mu);
    getfem::add_Nitsche_contact_with_rigid_obstacle_brick(model_, mim_, "u", terms_->neumann,
                                                          "obstacle", "gamma0", 0, terms_->mu, "",
                                                          "u_before", bottom);
  }

  // Moves the top there and solves; the largest force out of balance at a node, N/mm.
  double move(double right, double down) {
    gmm::copy(model_.real_variable("u"), model_.set_real_variable("u_before"));
    Vector& goal = model_.set_real_variable("top");
    goal[0] = right;
    goal[1] = -down;
    gmm::iteration iteration(1e-11, 0, 100);
    getfem::simplest_newton_line_search full(1); // whole steps: contact opens and closes
    getfem::standard_solve(model_, iteration, std::make_shared<Direct>(), full);
    if (!iteration.converged()) throw std::runtime_error("Newton's method did not converge");
    iterations = iteration.get_iteration();
    model_.assembly(model::BUILD_RHS);
    return gmm::vect_norminf(model_.real_rhs());
  }

  std::vector<Point> contact() const {
    const Vector x = at_points("X(1)+u(1)"), p = at_points(terms_->pressure),
                 v = at_points(terms_->speed),
                 tau = at_points("(" + terms_->traction + ")." + terms_->tangent);
    std::vector<Point> points(x.size());
    for (size_type i = 0; i < x.size(); ++i)
      points[i] = {x[i], p[i], v[i], tau[i]};
    return points;
  }

  // Pressing is without friction, sliding with it.
  void rub() { model_.set_real_variable("rubs")[0] = 1; }

  // Of the contact and of the top.
  Forces forces() const {
    return {-integral(driving_ + "(1)", top), // the multiplier is the force on what moves the top
            integral("(" + terms_->traction + ")(1)", bottom),
            integral("(" + terms_->traction + ")(2)", bottom)};
  }
  size_type unknowns() const { return model_.nb_dof(); }

  size_type iterations = 0;

private:
  void make_mesh() {
    getfem::regular_unit_mesh(mesh_, {columns, rows},
                              bgeot::geometric_trans_descriptor("GT_QK(2,1)"));
    bgeot::base_matrix scale(2, 2);
    scale(0, 0) = width;
    scale(1, 1) = height;
    mesh_.transformation(scale);
    mesh_.translation(bgeot::base_small_vector(-width / 2, 0));
    getfem::mesh_region border;
    getfem::outer_faces_of_mesh(mesh_, border);
    for (getfem::mr_visitor face(border); !face.finished(); ++face) {
      const auto normal = mesh_.normal_of_face_of_convex(face.cv(), face.f());
      if (normal[1] > 0.5) mesh_.region(top).add(face.cv(), face.f());
      if (normal[1] < -0.5) mesh_.region(bottom).add(face.cv(), face.f());
    }
    mf_.set_qdim(2);
    mf_.set_finite_element(getfem::fem_descriptor("FEM_QK(2,2)"));
    mf_obstacle_.set_finite_element(getfem::fem_descriptor("FEM_QK(2,2)"));
    mim_.set_integration_method(getfem::int_method_descriptor("IM_GAUSS_PARALLELEPIPED(2,6)"));
    points_.set_region(bottom);
  }

  void fill_model() {
    model_.add_fem_variable("u", mf_);
    model_.add_initialized_scalar_data("lambda",
                                       young * poisson / ((1 + poisson) * (1 - 2 * poisson)));
    model_.add_initialized_scalar_data("shear_modulus", young / (2 * (1 + poisson)));
    getfem::add_isotropic_linearized_elasticity_brick(model_, mim_, "u", "lambda", "shear_modulus");
    model_.add_fixed_size_data("top", 2);
    driving_ = getfem::mult_varname_Dirichlet(
        model_,
        getfem::add_Dirichlet_condition_with_multipliers(model_, mim_, "u", mf_, top, "top"));
    model_.add_fem_data("u_before", mf_);
    model_.add_initialized_scalar_data("time_step", time_step);
    model_.add_initialized_scalar_data("rubs", 0);
    model_.add_initialized_scalar_data("gamma0", 10 * young);
    // Signed distance to the die, whose highest point is the origin.
    Vector distance(mf_obstacle_.nb_dof());
    for (size_type i = 0; i < distance.size(); ++i) {
      const auto at = mf_obstacle_.point_of_basic_dof(i);
      distance[i] = std::hypot(at[0], at[1] + crown_radius) - crown_radius;
    }
    model_.add_initialized_fem_data("obstacle", mf_obstacle_, distance);
  }

  Vector at_points(const std::string& expression) const {
    Vector values(points_.nb_filtered_index());
    getfem::ga_interpolation_im_data(model_, expression, points_, values, mesh_.region(bottom));
    return values;
  }
  double integral(const std::string& expression, size_type region) const {
    getfem::ga_workspace workspace(model_);
    workspace.add_expression(expression, mim_, mesh_.region(region), 0);
    workspace.assembly(0);
    return workspace.assembled_potential();
  }

  getfem::mesh mesh_;
  getfem::mesh_fem mf_, mf_obstacle_;
  getfem::mesh_im mim_;
  getfem::im_data points_;
  model model_;
  std::string driving_; // the multiplier that moves the top
  std::unique_ptr<Terms> terms_;
};

struct Result {
  std::vector<Forces> forces;
  std::vector<Point> contact; // at the end
  bool right = true;
};

// What the step's contact must fulfil: where a point slides, the shear stress is tau_R(p, v, T) of
// the routine, called here once more; where it sticks, no more than that; and what slides the block
// is what rubs on the die. GetFEM takes the coefficient from the same displacements as the pressure
// and the speed here, so that the first may differ by rounding only. The last may differ by the
// forces that Newton's method left out of balance, at most all of them added up.
bool check(const std::vector<Point>& contact, const Forces& force, double unbalanced,
           size_type dofs, const std::string& label) {
  size_type touching = 0, sliding = 0, outside = 0;
  double slowest = 1e300, fastest = 0, highest = 0, worst = 0, beyond = 0;
  for (const Point& point : contact) {
    if (point.pressure <= 0) continue;
    ++touching;
    const double v = std::abs(point.speed), limit = tau_R(point.pressure, v);
    outside += frictab_outside(point.pressure, psi, v, temperature, slid, sigma_f) != 0;
    highest = std::max(highest, point.pressure);
    if (v > sliding_speed) {
      ++sliding;
      slowest = std::min(slowest, v);
      fastest = std::max(fastest, v);
      worst = std::max(worst, std::abs(std::abs(point.tau) - limit));
    } else {
      beyond = std::max(beyond, std::abs(point.tau) - limit);
    }
  }
  const double balance = std::abs(force.driving + force.friction);
  const double allowed = unbalanced * static_cast<double>(dofs);
  std::printf(
      "  %s: %zu points touch, %zu slide (%.1f .. %.1f mm/s), p up to %.0f MPa, %zu outside\n"
      "    | |tau| - tau_R | <= %.1e MPa; driving %.4f, rubbing %.4f N/mm (off by %.1e, "
      "allowed %.1e)\n",
      label.c_str(), touching, sliding, sliding ? slowest : 0, fastest, highest, outside, worst,
      force.driving, -force.friction, balance, allowed);
  return touching > 0 && worst <= rounding && beyond <= rounding && balance <= allowed;
}

Result slide(const std::string& constant_mu, bool say) {
  Block block(constant_mu);
  Result result;
  double right = 0;
  slid = 0;
  temperature = steps[0].temperature;
  for (int part = 1; part <= press_parts; ++part)
    block.move(0, press * part / press_parts);
  block.rub();
  for (const Step& step : steps) {
    temperature = step.temperature;
    right += step.speed * time_step;
    slid = right;
    const double unbalanced = block.move(right, press);
    const Forces force = block.forces();
    result.contact = block.contact();
    result.forces.push_back(force);
    if (!say) continue;
    char label[80];
    std::snprintf(label, sizeof label, "%.0f mm/s, %.0f degC, %zu Newton steps", step.speed,
                  step.temperature, block.iterations);
    result.right &= check(result.contact, force, unbalanced, block.unknowns(), label);
  }
  return result;
}

void write(const std::string& name, const Result& result) {
  std::ofstream contact(name + "_contact.csv"), force(name + "_force.csv");
  contact.precision(10);
  force.precision(10);
  contact << "x_mm,sigma_n_MPa,v_rel_mm_s,tau_MPa,mu\n";
  for (const Point& p : result.contact)
    if (p.pressure > 0)
      contact << p.x << ',' << p.pressure << ',' << std::abs(p.speed) << ',' << std::abs(p.tau)
              << ',' << std::abs(p.tau) / p.pressure << '\n';
  force << "speed_mm_s,T_contact_C,slid_mm,normal_N_mm,tangential_N_mm\n";
  double path = 0;
  for (size_type i = 0; i < result.forces.size(); ++i)
    force << steps[i].speed << ',' << steps[i].temperature << ','
          << (path += steps[i].speed * time_step) << ',' << result.forces[i].normal << ','
          << result.forces[i].driving << '\n';
}

} // namespace

int main(int count, char** words) try {
  const std::string name = count > 1 ? words[1] : "slide", mu = count > 2 ? words[2] : "";
  gmm::set_traces_level(0);
  getfem::ga_define_function("frictab_mu_p", by_pressure);
  getfem::ga_define_function("frictab_mu_v", by_speed);
  getfem::ga_define_function("frictab_mu", coefficient, "frictab_mu_p", "frictab_mu_v");
  std::printf("%s\n", name.c_str());
  const Result result = slide("", true);
  write(name, result);
  bool right = result.right;
  if (!mu.empty()) {
    const Result plain = slide(mu, false);
    double worst = 0;
    for (size_type i = 0; i < plain.forces.size(); ++i)
      worst = std::max(worst, std::abs(plain.forces[i].driving / result.forces[i].driving - 1));
    std::printf("  GetFEM's own constant coefficient %s: the force differs by %.1e of it\n",
                mu.c_str(), worst);
    right &= worst <= 1e-8; // Newton's method stops at 1e-11 of the residual
  }
  std::printf("  %s\n", right ? "ok" : "NOT WITHIN THE TOLERANCES");
  return right ? 0 : 1;
} catch (const std::exception& fault) {
  std::fprintf(stderr, "slide: %s\n", fault.what());
  return 3;
}
