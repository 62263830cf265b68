// A target that exists in no release: what adding one takes. It is this file alone, linked to the
// program; nothing else names it. Tables without axes become a text that holds their formula.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "codegen/exporter.h"
#include "codegen/recipe.h"
#include "core/error.h"
#include "expr/program.h"
#include "io/file_streams.h"
#include "io/json.h"

namespace frictab {

namespace {

class Toy final : public codegen::Exporter {
public:
  Toy()
      : Exporter({.name = "toy",
                  .order = 1000,
                  .title = "A toy",
                  .signature_source = "verified: by its own test",
                  .notes = "Tables without axes only."}) {}

  codegen::SourceBundle generate(const codegen::ExportRequest& request) const override {
    if (!request.table.axes.empty())
      throw InputError({}, "the toy target knows no axes", "a law of one coefficient");
    std::map<std::string, expr::Expr> numbers = {{"value", request.table.value.at(0)}};
    for (const auto& [constant, number] : request.table.constants)
      numbers[constant] = number;
    codegen::SourceBundle files;
    files["toy.txt"] = expr::to_text(substitute(request.table.combine, numbers)) + "\n";
    files["recipe.json"] = io::json_text(codegen::recipe_head(*this, request, "toy.txt", files));
    return files;
  }

  std::vector<codegen::BuildVariant> variants(const codegen::ExportRequest&) const override {
    codegen::BuildVariant text;
    text.name = "text";
    text.eps = 0x1p-53;
    return {text};
  }

  void drive(const codegen::Built& built, const codegen::ExportRequest& request, std::size_t rows,
             std::span<const double* const> columns, std::span<double> tau) const override {
    std::string text = io::read_file(built.directory / "toy.txt");
    text.pop_back();
    expr::Program(expr::parse_expr(text), request.table.inputs(), {})
        .evaluate(rows, columns, {}, tau.data());
  }
};

const Registered<codegen::ExporterPointer> registered{codegen::make_exporter<Toy>};

} // namespace

} // namespace frictab
