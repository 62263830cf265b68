// A flow stress from a hardening curve. Solvers give a friction routine no flow stress, but many
// models have the equivalent plastic strain as a field. The job gives the curve as a formula,
//
//   [export.inputs]
//   sigma_f_MPa = "curve:760*(0.002 + strain)**0.21*(1 - 0.0006*(T_contact_C - 20))"
//   strain = "field:1"
//
// in strain (equivalent plastic strain, from 0), the contact temperature and other states of the
// law. The curve replaces sigma_f_MPa in the law's formula, so that values, derivatives and every
// source follow from it as from any formula. Verification evaluates a row at the smallest strain at
// which the curve has the row's flow stress; rows without such a strain up to `most_strain` cannot
// be represented.
//
// Likewise a factor by which friction differs between zones of the surface (a polished or a worn
// part of a tool),
//
//   zone_factor = "field:2"      or "property"
//
// multiplies the law's own value (mu, or tau_R) ahead of its shear limit. Where the deck gives none
// it is 1, and so it is in verification.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "codegen/exporter.h"
#include "codegen/solver_inputs.h"
#include "expr/expr.h"

namespace frictab::codegen {

// Name in the curve and in [export.inputs].
inline constexpr const char* strain_name = "strain";
inline constexpr double most_strain = 5;
inline constexpr const char* zone_name = "zone_factor";

// The request that the target fills: with curve and factor in its table, if the job has them.
class CurvedRequest {
public:
  // Throws InputError if the solver gives a flow stress itself or the flow stress is an axis of the
  // table, and for a text that is not a formula, has unknown names or no strain, or has values at
  // which the law was never tested.
  CurvedRequest(const ExportRequest& request, const SolverGives& gives);

  const ExportRequest& get() const { return curved_ ? *curved_ : original_; }

  // Calls `drive` with the rows that can be represented, as columns of get().table.inputs();
  // `columns` are those of the original request. Other rows are left unchanged.
  using Drive = std::function<void(std::size_t, std::span<const double* const>, std::span<double>)>;
  void drive(std::size_t rows, std::span<const double* const> columns, std::span<double> tau,
             const Drive& drive) const;

private:
  void add_curve(const std::string& text);
  void add_zones(const std::string& choice);
  void set_range();
  std::vector<double> strains(std::size_t rows, std::span<const double* const> columns) const;

  const ExportRequest& original_;
  bool has_curve_ = false;
  expr::Expr curve_;
  table::Table table_; // table of the curved request
  std::optional<ExportRequest> curved_;
};

} // namespace frictab::codegen
