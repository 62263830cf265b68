// A law that is a table, as a file of rows.
#include <cmath>

#include "fuzz/target.h"
#include "fuzz/temporary_file.h"
#include "job/table_law.h"

namespace frictab::fuzz::law_table_target {
namespace {

void read(std::string_view bytes) {
  static const TemporaryFile file("table.csv");
  file.write(bytes);
  models::LawText text;
  text.name = "paper";
  text.table = "table.csv";
  FaultList faults;
  const auto table = job::read_law_table(text, file.path().string(), {}, faults);
  promise(table.has_value() == faults.empty(), "there is a table or a fault");
  faults.throw_if_any();
  std::size_t nodes = 1;
  for (const models::LawTableAxis& axis : table->axes) {
    promise(axis.nodes.size() >= 2, "an axis has nodes");
    for (std::size_t i = 1; i < axis.nodes.size(); ++i)
      promise(axis.nodes[i - 1] < axis.nodes[i], "nodes ascend");
    nodes *= axis.nodes.size();
  }
  promise(table->value.size() == nodes && nodes <= models::most_law_nodes, "the grid is full");
  for (const double value : table->value)
    promise(std::isfinite(value) && value >= 0, "values are finite and not negative");
  const expr::Expr piece = models::law_of_table(*table).build({}).value;
  const std::string written = expr::to_text(piece);
  promise(expr::to_text(expr::parse_expr(written)) == written, "the formula reads back");
}

const Registered<Target> registered([] { return Target{"law_table", read}; });

} // namespace
} // namespace frictab::fuzz::law_table_target
