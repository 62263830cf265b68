// Target `openradioss_friction`: the card /FRICTION with the closed form that is nearest to the law
// at the fixed states. OpenRadioss has no user friction and no friction table.
#include "codegen/exporter.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "codegen/native_table.h"
#include "codegen/number_text.h"
#include "codegen/read_me.h"
#include "codegen/recipe.h"
#include "codegen/table_text.h"
#include "core/template.h"
#include "core/version.h"
#include "fit.h"
#include "io/file_streams.h"
#include "io/json.h"
#include "table/outside.h"

namespace frictab::openradioss::friction {

using namespace codegen;

namespace {

using json = nlohmann::ordered_json;

constexpr const char* file_name = "frictab_friction.rad";
constexpr const char* card_id = "90000";
constexpr std::size_t width = 20; // of a real field; integers have half of it

const char* const source_of_signature =
    "verified: fields of /FRICTION and their order; formulas of Ifric 0 to 4; speed is the "
    "tangential part of the relative velocity, pressure the node's normal force over the area of "
    "its main segment (help of Radioss 2021; OpenRadioss' own reader, and engine for interfaces "
    "of type 7). recalled, check against your release: interfaces of types 24 and 25 take both "
    "alike; releases before 2023 lack Ifric = 4; #include";

const std::string target_notes =
    std::string("OpenRadioss has no user friction: of its closed forms the nearest is fitted to "
                "tau_R over pressure and speed; every other state of the law ") +
    native_fixed_words +
    "THE CARD DOES NOT FOLLOW THE LAW: its loss in MPa, rms and largest over the tested range, is "
    "in the card, in recipe.json (loss) and README.md; verify reads the card and looks for a "
    "larger "
    "one. Beyond the tested range the solver continues the closed form, "
    "and there is no shear limit. The pressure is right where one node meets a main segment; where "
    "several share one, each counts with its own force over the whole area. Do not use "
    "the card where the loss exceeds what you accept; lsdyna_usrfrc and the Abaqus targets have "
    "the law itself.";

NativeForm form() {
  NativeForm out;
  out.gives.states = {
      {.state = "sigma_n_MPa", .text = "normal force over area of the main segment"},
      {.state = "v_rel_mm_s", .text = "tangential relative velocity"}};
  out.every_column = true;
  return out;
}

std::string formula_text(const Card& card) {
  switch (card.ifric) {
  case 1:
    return "mu = Fric + C1 p + C2 v + C3 p v + C4 p^2 + C5 v^2";
  case 2:
    return "mu = C1 exp(C2 v) p^2 + C3 exp(C4 v) p + C5 exp(C6 v)";
  case 3:
    return "Renard: mu from C1 by C3 at the speed C5 to C4 at the speed C6";
  case 4:
    return "mu = C1 + (Fric - C1) exp(-C2 v)";
  default:
    return "mu = Fric";
  }
}

std::string loss_text(const FittedCard& fitted) {
  return fmt::format(
      "{:.3g} MPa rms, {:.3g} MPa at most off the law at the fixed states over the "
      "tested range, at sigma_n = {:.4g} MPa, v = {:.4g} mm/s; {:.3g} MPa at most in "
      "the decade of pressures below it (largest found)",
      fitted.loss.rms_MPa, fitted.loss.worst_MPa, fitted.loss.pressure_MPa, fitted.loss.speed_mm_s,
      fitted.loss.below_MPa);
}

std::string range_of(const NativeAxis& axis) {
  return fmt::format("{:.6g} .. {:.6g} {}", axis.unit.from_canonical(axis.low),
                     axis.unit.from_canonical(axis.high), axis.unit.name);
}

std::vector<std::string> comments(const Exporter& self, const ExportRequest& request,
                                  const NativeProblem& problem, const FittedCard& fitted,
                                  const table::FixedStates& held) {
  std::vector<std::string> texts = native_head(self, request);
  texts.push_back(fmt::format("Ifric = {}: {}", fitted.card.ifric, formula_text(fitted.card)));
  texts.push_back("LOSS: " + loss_text(fitted));
  for (const NativeAxis& axis : problem.axes)
    texts.push_back(axis.state + ": tested " + range_of(axis) + "; beyond it the form goes on");
  for (const auto& [state, value] : held)
    texts.push_back(fmt::format("held: {} = {:.6g}", state, value));
  texts.push_back("Worst drift of the frictab table it is made from: " + drift_text(request.table));
  texts.push_back("Source: " + self.signature_source);
  return comment_lines(texts, 88, "  ");
}

std::string real_field(double value) {
  return fmt::format("{:>20}", native_number(value));
}

std::string card_text(const Exporter& self, const ExportRequest& request,
                      const NativeProblem& problem, const FittedCard& fitted,
                      const table::FixedStates& held) {
  TemplateValues values;
  values.lists["comments"] = items(comments(self, request, problem, fitted, held));
  values.text = {{"id", card_id},
                 {"title", comment_text(request.table.model).substr(0, 100)},
                 {"ifric", fmt::format("{:>10}", fitted.card.ifric)},
                 {"fric", real_field(fitted.card.fric)}};
  for (std::size_t i = 0; i < fitted.card.c.size(); ++i)
    values.text[fmt::format("c{}", i + 1)] = real_field(fitted.card.c[i]);
  return render_template("openradioss/friction/frictab_friction.rad", values);
}

double cell(std::string_view line, std::size_t first, std::size_t size) {
  if (line.size() < first + size) throw std::runtime_error("a line of the card is too short");
  const auto cells = split_cells(line.substr(first, size), ' ');
  if (cells.size() != 1) throw std::runtime_error("a card has no number where one belongs");
  return read_number(cells[0]);
}

// Reads the card back from its text.
Card read_card(const std::string& text) {
  const auto lines = deck_lines(text, "#");
  if (lines.size() != 5 || lines[0] != fmt::format("/FRICTION/{}", card_id))
    throw std::runtime_error("not one card /FRICTION");
  Card card;
  card.ifric = static_cast<int>(cell(lines[2], 0, width / 2));
  if (card.ifric < 0 || card.ifric > 4) throw std::runtime_error("unknown Ifric");
  for (std::size_t i = 0; i < 5; ++i)
    card.c[i] = cell(lines[3], i * width, width);
  card.c[5] = cell(lines[4], 0, width);
  card.fric = cell(lines[4], width, width);
  return card;
}

json argument_json(const NativeColumn& column, const NativeAxis& axis) {
  return {{"quantity", column.argument.name},
          {"unit", column.argument.solver.name},
          {"meaning", column.argument.meaning},
          {"source", column.text},
          {"range", range_of(axis)}};
}

class Friction final : public Exporter {
public:
  Friction()
      : Exporter({.name = "openradioss_friction",
                  .order = 88,
                  .title = "OpenRadioss /FRICTION, the nearest of its closed forms",
                  .signature_source = source_of_signature,
                  .notes = target_notes}) {}

  SourceBundle generate(const ExportRequest& request) const override {
    const NativeProblem problem = native_problem(request, form());
    const FittedCard fitted =
        fit_card(problem, input_index(request.table, "v_rel_mm_s").has_value());
    const table::FixedStates held = fixed_states(request);
    SourceBundle files = {{file_name, card_text(*this, request, problem, fitted, held)}};
    files["recipe.json"] = recipe(request, problem, fitted, held, files);
    return explained(files, *this);
  }

  std::vector<BuildVariant> variants(const ExportRequest&) const override {
    return {native_deck()};
  }

  void drive(const Built& built, const ExportRequest& request, std::size_t rows,
             std::span<const double* const> columns, std::span<double> tau) const override {
    const Card card = read_card(io::read_file(built.directory / file_name));
    const auto mu = [&](std::span<const double> x) { return mu_by_solver(card, x[0], x[1]); };
    drive_coefficient(form(), mu, std::nullopt, request, rows, columns, tau);
  }

  bool is_routine() const override { return false; }
  bool gives_mu(const ExportRequest&) const override { return true; }

  table::FixedStates fixed_states(const ExportRequest& request) const override {
    return native_fixed_states(request, form());
  }

  table::Table own_table(const ExportRequest& request, const SourceBundle& files) const override;

  std::optional<double> stated_loss_MPa(const SourceBundle& files) const override {
    const json loss = io::parse_json(files.at("recipe.json"), "recipe.json").at("loss");
    return std::max(loss.at("worst_MPa").get<double>(), loss.at("below_MPa").get<double>());
  }

private:
  std::string recipe(const ExportRequest& request, const NativeProblem& problem,
                     const FittedCard& fitted, const table::FixedStates& held,
                     const SourceBundle& files) const;
};

table::Table Friction::own_table(const ExportRequest& request, const SourceBundle& files) const {
  const Card card = read_card(files.at(file_name));
  const std::vector<NativeColumn> columns = native_columns(request, form());
  const NativeProblem problem = native_problem(request, form());
  const auto in_solvers_unit = [&](std::size_t c) {
    const SolverUnit& unit = columns[c].argument.solver;
    return expr::Expr::symbol(columns[c].argument.name) * (unit.over / unit.times);
  };
  table::Table out;
  out.model = request.table.model;
  out.value = {1};
  const expr::Expr mu = mu_formula(card.ifric, in_solvers_unit(0), in_solvers_unit(1),
                                   [&](const std::string& one) { return card.field(one); });
  out.combine =
      expr::Expr::symbol("value") * expr::Expr::symbol("sigma_n_MPa") * maximum(mu, least_mu);
  for (const NativeAxis& axis : problem.axes) {
    out.record.inputs[axis.state].low = axis.low;
    out.record.inputs[axis.state].high = axis.high;
  }
  return out;
}

std::string Friction::recipe(const ExportRequest& request, const NativeProblem& problem,
                             const FittedCard& fitted, const table::FixedStates& held,
                             const SourceBundle& files) const {
  json out = recipe_head(*this, request, fmt::format("/FRICTION/{}", card_id), files);
  const std::vector<NativeColumn> columns = native_columns(request, form());
  out["arguments"] = json::array();
  for (std::size_t c = 0; c < columns.size(); ++c)
    out["arguments"].push_back(argument_json(columns[c], problem.axes[c]));
  out["result"] = {{"name", "mu"}, {"meaning", "tau_R = mu * contact pressure"}};
  add_fixed_states(out, held);
  out["card"] = {{"Ifric", fitted.card.ifric}, {"formula", formula_text(fitted.card)}};
  out["card"]["Fric"] = fitted.card.fric;
  for (std::size_t i = 0; i < fitted.card.c.size(); ++i)
    out["card"][fmt::format("C{}", i + 1)] = fitted.card.c[i];
  const bool follows = table::below_pressures(request.table) == table::Outside::law;
  out["loss"] = {
      {"rms_MPa", fitted.loss.rms_MPa},
      {"worst_MPa", fitted.loss.worst_MPa},
      {"worst_at",
       {{"sigma_n_MPa", fitted.loss.pressure_MPa}, {"v_rel_mm_s", fitted.loss.speed_mm_s}}},
      {"below_MPa", follows ? fitted.loss.below_MPa : 0.0}};
  out["loss_text"] = loss_text(fitted);
  return recipe_of_text(std::move(out), request,
                        fmt::format("#include {}\n# /INTER/TYPE7, TYPE24 or TYPE25: fric_ID = {}\n",
                                    file_name, card_id));
}

const Registered<ExporterPointer> registered{make_exporter<Friction>};

} // namespace

} // namespace frictab::openradioss::friction
