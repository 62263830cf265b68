// A flow stress from a hardening curve. Solvers give a friction routine no flow stress, but many
// models carry the equivalent plastic strain as a field. The job states the curve as a formula,
//
//   [export.inputs]
//   sigma_f_MPa = "curve:760*(0.002 + strain)**0.21*(1 - 0.0006*(T_contact_C - 20))"
//   strain = "field:1"
//
// in strain (equivalent plastic strain, from 0), the contact temperature and other states of the
// law. It takes the place of sigma_f_MPa in the law's formula, so that values, derivatives and
// every source follow from it as from any formula. Verified like any: a row is asked at the
// smallest strain at which the curve gives its flow stress; rows at which none up to `most_strain`
// does cannot be represented.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "codegen/exporter.h"
#include "codegen/solver_inputs.h"
#include "expr/expr.h"

namespace frictab::codegen {

inline constexpr const char* strain_name = "strain"; // in the curve, and in [export.inputs]
inline constexpr double most_strain = 5;

// A request as the target has to fill it: with the curve in its table, where the job states one.
class CurvedRequest {
public:
  // Throws InputError where the solver gives a flow stress itself, for a formula that is none, with
  // a name it cannot have, without strain, with values that the law was never tested at, and where
  // the flow stress is an axis of the table.
  CurvedRequest(const ExportRequest& request, const SolverGives& gives);

  const ExportRequest& get() const { return curved_ ? *curved_ : original_; }

  // Calls `drive` with the rows that can be represented, as columns of get().table.inputs();
  // `columns` are those of the original's. The others are left unchanged.
  using Drive = std::function<void(std::size_t, std::span<const double* const>, std::span<double>)>;
  void drive(std::size_t rows, std::span<const double* const> columns, std::span<double> tau,
             const Drive& drive) const;

private:
  void set_range();
  std::vector<double> strains(std::size_t rows, std::span<const double* const> columns) const;

  const ExportRequest& original_;
  expr::Expr curve_;
  table::Table table_; // of a curved request
  std::optional<ExportRequest> curved_;
};

} // namespace frictab::codegen
