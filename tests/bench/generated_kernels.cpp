// Exports, adds, compiles, loads.
#include "bench/generated_kernels.h"

#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "codegen/fortran_core.h"
#include "core/random.h"
#include "io/file_streams.h"

namespace frictab::bench {

using table::Table;

namespace {

const char* const names[] = {"sigma_n_MPa", "psi", "v_rel_mm_s", "T_contact_C", "s_mm"};

// Cells by one division or by a walk from the left, then the sum as it stands in a textbook.
const char* const added = R"(
double bench_value(const double* u) { return {kernel}_{axes}({arguments}, u, 0); }
double bench_gradient(const double* u, double* by_u) {
  return {kernel}_gradient_{axes}({arguments}, u, by_u, 0);
}
static float bench_singles[{values}];
void bench_fill(void) {
  int i;
  for (i = 0; i < {values}; ++i) bench_singles[i] = (float)ft_value[i];
}
double bench_single(const double* u) {
  const ft_values singles = {0, bench_singles};
  return {kernel}_{axes}(ft_axes, singles, u, 0);
}
double bench_nested(const double* u) {
  double w[{axes}][4];
  long first[{axes}];
  int d, j;
  for (d = 0; d < {axes}; ++d) {
    const ft_axis* a = &ft_axes[d]{nodes};
    int i = 0;
    double t;
    if (!a->guide) i = (int)((u[d] - a->u[0]) * a->scale);
    while (i > 0 && u[d] < a->u[i]) --i;
    while (i < a->n - 2 && u[d] >= a->u[i + 1]) ++i;
    t = (u[d] - a->u[i]) / (a->u[i + 1] - a->u[i]);
    {weights}
  }
  {loops}
}
)";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

// Nested loops over the taps of each axis, each with its own short array of what is left.
std::string loops(std::size_t axes, int taps, const char* nodes) {
  std::string out;
  for (std::size_t d = 0; d < axes; ++d)
    out +=
        fmt::format("  double s{0}[{1}]; for (int j{0} = 0; j{0} < {1}; ++j{0}) {{ const long a{0} "
                    "= {2}(first[{0}] + j{0}) * ft_axes[{0}]{3}.stride;\n",
                    d, taps, d == 0 ? "" : fmt::format("a{} + ", d - 1), nodes);
  out += fmt::format("  s{0}[j{0}] = ft_value[a{0}]; }}\n", axes - 1);
  for (std::size_t d = axes; d-- > 0;) {
    std::string sum = fmt::format("w[{0}][0] * s{0}[0] + w[{0}][1] * s{0}[1]", d);
    if (taps == 4) sum += fmt::format(" + w[{0}][2] * s{0}[2] + w[{0}][3] * s{0}[3]", d);
    out += d == 0 ? fmt::format("  return {};\n", sum)
                  : fmt::format("  s{0}[j{0}] = {1}; }}\n", d - 1, sum);
  }
  return out;
}

std::string additions(const Table& table) {
  const bool cubic = table.interpolation == table::Interpolation::cubic;
  const std::string kernels = std::string(FRICTAB_SOURCE_DIR) + "/src/table/";
  std::string text = io::read_file(kernels + "frictab_cubic.h") +
                     io::read_file(kernels + "frictab_gradient.h") +
                     io::read_file(kernels + "frictab_cubic_gradient.h") + added;
  text = replaced(text, "{loops}", loops(table.axes.size(), cubic ? 4 : 2, cubic ? ".nodes" : ""));
  text = replaced(text, "{kernel}", cubic ? "ft_cubic" : "ft_linear");
  text = replaced(text, "{axes}", std::to_string(table.axes.size()));
  text = replaced(text, "{arguments}", "ft_axes, ft_table");
  text = replaced(text, "{values}", "(int)(sizeof ft_value / sizeof ft_value[0])");
  text = replaced(text, "{nodes}", cubic ? ".nodes" : "");
  return replaced(text, "{weights}",
                  cubic ? "first[d] = ft_axes[d].first[i];\n"
                          "    for (j = 0; j < 4; ++j) {\n"
                          "      const double* b = ft_axes[d].basis + 16 * i + j;\n"
                          "      w[d][j] = b[0] + t * (b[4] + t * (b[8] + t * b[12]));\n    }"
                        : "first[d] = i; w[d][0] = 1.0 - t; w[d][1] = t;");
}

} // namespace

Table random_table(const std::vector<std::size_t>& counts, bool even, bool cubic) {
  Table table;
  table.quantity = models::PieceQuantity::tau_R;
  table.interpolation = cubic ? table::Interpolation::cubic : table::Interpolation::linear;
  table.combine = expr::Expr::symbol("value");
  std::size_t nodes = 1;
  for (const std::size_t count : counts) {
    table::TableAxis axis;
    axis.name = names[table.axes.size()];
    for (std::size_t i = 0; i < count; ++i) {
      const double w = static_cast<double>(i) / static_cast<double>(count - 1);
      axis.nodes.push_back(even ? w : 0.5 * w * (1 + w));
    }
    table.axes.push_back(axis);
    nodes *= count;
  }
  Random random(1);
  for (std::size_t i = 0; i < nodes; ++i)
    table.value.push_back(random.uniform(1, 2));
  return table;
}

CKernel::CKernel(const Table& table, const std::vector<std::string>& flags) {
  const codegen::Exporter& c = *codegen::find_exporter("c");
  const codegen::ExportRequest request{table, "mm-t-s", {}};
  codegen::SourceBundle bundle = c.generate(request);
  if (!table.axes.empty()) bundle["frictab_tau_R.c"] += additions(table);
  codegen::BuildVariant build = c.variants(request)[0];
  build.command.insert(build.command.begin() + 1, flags.begin(), flags.end());
  library_ = std::make_unique<codegen::Library>(
      codegen::compile_library(bundle, build, directory_.path()));
  value = library_->find<double(const double*)>("bench_value");
  single = library_->find<double(const double*)>("bench_single");
  gradient = library_->find<double(const double*, double*)>("bench_gradient");
  nested = library_->find<double(const double*)>("bench_nested");
  tau = library_->find<double(double, double, double, double, double, double)>("frictab_tau_R");
  library_->find<void()>("bench_fill")();
}

FortranKernel::FortranKernel(const Table& table, bool has_gradient) {
  codegen::BuildVariant build;
  build.name = "core";
  build.command = {"gfortran", "-O2", "-std=legacy", "-ffp-contract=off", "-fPIC",
                   "-shared",  "-o",  "@{out}",      "@{dir}/core.f"};
  const std::string text =
      codegen::fortran::core({.table = table}, {.gradient = has_gradient}).text + "\n";
  library_ = std::make_unique<codegen::Library>(
      codegen::compile_library({{"core.f", text}}, build, directory_.path()));
  value = library_->find<double(const double*)>("ftintp_");
  if (has_gradient)
    gradient = library_->find<void(const double*, double*, double*, const int*)>("ftintg_");
}

BatchEntries::BatchEntries(const Table& table, const std::string& target) {
  const codegen::Exporter& exporter = *codegen::find_exporter(target);
  const codegen::ExportRequest request{table, "mm-t-s", {}};
  library_ = std::make_unique<codegen::Library>(codegen::compile_library(
      exporter.generate(request), exporter.variants(request)[0], directory_.path()));
  value = library_->find<std::remove_pointer_t<decltype(value)>>("frictab_tau_R_batch");
  gradient =
      library_->find<std::remove_pointer_t<decltype(gradient)>>("frictab_tau_R_gradient_batch");
}

void write_generated(const std::filesystem::path& directory) {
  const Table table = random_table({17, 9, 9, 9, 17}, false, false);
  const auto write = [&](const std::string& name, const std::string& text) {
    std::ofstream(directory / name, std::ios::binary) << text;
  };
  for (const auto& [name, text] : codegen::find_exporter("c")->generate({table, "mm-t-s", {}}))
    write(name, text);
  nlohmann::json nodes;
  for (const table::TableAxis& axis : table.axes)
    nodes[axis.name] = axis.nodes;
  write("table.json", nlohmann::json{{"nodes", nodes}, {"value", table.value}}.dump());
}

} // namespace frictab::bench
