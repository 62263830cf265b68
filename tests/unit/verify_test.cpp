// What verification makes of the states that a driver does not pose.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/sample_data.h"
#include "verify/beyond.h"
#include "verify/verify.h"

namespace frictab {
namespace {

SourceBundle no_files(const ExportRequest&) {
  return {{"recipe.json", "{}"}};
}

std::vector<BuildVariant> nothing_to_compile(const ExportRequest&) {
  BuildVariant variant;
  variant.name = "read";
  return {variant};
}

// tau_R of every third state; off by 1 MPa.
void drive_some(const Built&, const ExportRequest& request, std::size_t rows,
                std::span<const double* const> columns, std::span<double> tau) {
  std::vector<double> all(rows);
  TableFunction(request.table).evaluate(rows, columns, all);
  for (std::size_t i = 0; i < rows; i += 3)
    tau[i] = all[i] + 1;
}

void drive_none(const Built&, const ExportRequest&, std::size_t, std::span<const double* const>,
                std::span<double>) {}

class NotPosed : public testing::Test {
protected:
  NotPosed()
      : model(test::plausible_model(*find_law("log_coulomb"))), data(test::sample_data(model)),
        table(build_table(model, state_ranges(model, data, {}), {})) {
    exporter.name = "some_solver";
    exporter.generate = no_files;
    exporter.variants = nothing_to_compile;
  }
  DriftRecord verified(decltype(Exporter::drive) drive) {
    exporter.drive = drive;
    const ExportRequest request{.table = table};
    return verify({model, table, "table", &data, 0.5, 2000},
                  {{&exporter, request, exporter.generate(request)}})
        .back();
  }
  Model model;
  Dataset data;
  Table table;
  Exporter exporter;
};

TEST_F(NotPosed, StatesAreCountedAndCountAsTheTablesOwn) {
  const DriftRecord record = verified(drive_some);
  const std::size_t answered = (data.rows() + 2) / 3;
  EXPECT_EQ(record.n_rows_not_posed, data.rows() - answered);
  EXPECT_GT(record.n_points_not_posed, record.n_points / 2);
  EXPECT_NEAR(record.max_vs_table_MPa, 1, 1e-9);
  EXPECT_FALSE(record.passed);
  EXPECT_THAT(not_posed_text(record), testing::HasSubstr("states its solver is never in"));
  Verification all;
  all.records = {record};
  const Verification back = parse_verification(verification_json(all), "verify.json");
  EXPECT_EQ(back.records[0].n_rows_not_posed, record.n_rows_not_posed);
  EXPECT_EQ(back.records[0].n_points_not_posed, record.n_points_not_posed);
}

TEST_F(NotPosed, ASourceThatIsAskedNothingHasNotPassed) {
  EXPECT_FALSE(verified(drive_none).passed);
}

} // namespace
} // namespace frictab
