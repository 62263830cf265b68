// The billet as a finite-element model: mesh, unknowns, one implicit step, what it remembers.
//
// Weak form on the undeformed billet (total Lagrange), axisymmetric, quasi-static:
//   int (P : grad v) 2 pi r dr dz = int t.v 2 pi r dL,   int (ln J - pressure/K) q 2 pi r dr dz =
//   0,
// with displacements of second order and the pressure of first order, both continuous (Taylor-Hood
// on quadrilaterals): without a pressure of its own such an element locks when the plastic flow
// keeps the volume. Newton's method with the exact tangent starts from displacements extrapolated
// from the last step; a step that does not lower the residual is halved. Where that fails, the step
// is solved with friction spread over 1000, 100 and 10 times the sticking speed first: each
// solution starts the next, the last is the one that is kept.
#pragma once

#include <memory>
#include <set>
#include <vector>

#include <getfem/getfem_im_data.h>
#include <getfem/getfem_models.h>

#include "operators.h"
#include "records.h"

enum Side : std::size_t { inner = 1, outer, bottom, top };

// Rectangle of the half section that is meshed, mm, and its elements.
struct Shape {
  double inner_radius, outer_radius, height;
  std::size_t columns, rows;
};

class Billet {
public:
  using Vector = getfem::model_real_plain_vector;

  // `touching`: the sides that may meet the die.
  Billet(const Shape& shape, const std::set<Side>& touching, ContactSetting& setting,
         double temperature);

  // One step: the bottom is moved to `bottom_z`; the first step starts from a homogeneous
  // compression by the share `squeeze`. Throws std::exception if Newton's method fails, with
  // everything as before the step. The number of iterations.
  int step(double bottom_z, double squeeze);
  // After a step that is to be kept: histories, energies.
  void keep();

  std::vector<ContactRecord> contact() const;
  double integral(const std::string& expression, std::size_t region) const;
  double volume_integral(const Vector& values) const;   // values at the volume's points
  double contact_integral(const Vector& values) const;  // values at the contact's points
  double force() const;                                 // of the die on the billet along z, N
  double bottom_force() const;                          // along z, N
  double volume() const;                                // mm^3
  std::array<double, 2> node(double r, double z) const; // where the node that was there is now
  double friction_error() const;                        // see friction_check.cpp, MPa
  double unbalanced() const { return unbalanced_; }     // N, largest at a node
  const Energies& energies() const { return energies_; }

  // For the heat equation: per volume (MPa) and per area of the billet (N/mm), of the last step.
  const Vector& plastic_work() const { return plastic_work_; }
  const Vector& friction_work() const { return friction_work_; }
  const getfem::mesh& mesh() const { return mesh_; }
  const getfem::mesh_im& integration() const { return mim_; }
  const getfem::mesh_fem& displacement() const { return mf_u_; }
  const getfem::im_data& volume_points() const { return volume_points_; }
  const getfem::im_data& contact_points() const { return contact_points_; }
  const getfem::model& model() const { return model_; }
  void set_temperature(const Vector& at_volume_points, const Vector& at_contact_points);

  static constexpr std::size_t contact_region = 10;

private:
  void make_mesh(const Shape& shape, const std::set<Side>& touching);
  void make_model(double temperature);
  void make_weights();
  void start_guess(double bottom_z, double squeeze);
  int newton();
  double residual();
  Vector at_volume(const std::string& expression, std::size_t size) const;
  Vector at_contact(const std::string& expression, std::size_t size) const;
  std::vector<Traction<double>> tractions() const;

  ContactSetting& set_;
  Shape shape_;
  getfem::mesh mesh_;
  getfem::mesh_fem mf_u_, mf_p_;
  getfem::mesh_im mim_;
  getfem::im_data volume_points_, contact_points_, history_points_, memory_points_;
  getfem::model model_;
  Energies energies_;
  Vector plastic_work_, friction_work_, old_tau_;
  Vector weights_;          // of the contact points, mm^2 of the billet
  std::vector<bool> fixed_; // unknowns that a condition gives
  Vector last_move_;        // displacement of the last step, for the start of the next
  double last_time_ = 0, unbalanced_ = 0;
};
