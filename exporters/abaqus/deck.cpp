// Keyword lines of the targets for Abaqus.
#include "deck.h"

#include <fmt/format.h>

namespace frictab::abaqus {

using namespace codegen;

namespace {

// Writes property lines, eight values each.
std::string property_deck(const std::vector<Placeholder>& values) {
  std::string deck;
  for (std::size_t i = 0; i < values.size(); ++i)
    deck += (i % 8 == 0 ? " " : ", ") + values[i].text +
            (i % 8 == 7 || i + 1 == values.size() ? "\n" : "");
  return deck;
}

} // namespace

Deck friction_deck(const std::string& user, std::size_t depvar,
                   const std::vector<SolverInput>& inputs, const FurtherProperties& further,
                   const std::string& of_model) {
  Deck deck = {.file = "frictab.inp",
               .reference = "*Include, input=frictab.inp",
               .comment = "** ",
               .lines = "*Surface Interaction, name=FRICTAB\n*Friction, " + user,
               .of_model = of_model,
               .script = "frictab_cae.py",
               .placeholders = property_placeholders(inputs, further)};
  if (depvar > 0) deck.lines += fmt::format(", depvar={}", depvar);
  if (!deck.placeholders.empty())
    deck.lines += fmt::format(", properties={}", deck.placeholders.size());
  deck.lines += "\n" + property_deck(deck.placeholders);
  return deck;
}

std::string field_lines(const std::vector<SolverInput>& inputs) {
  std::string lines;
  for (const SolverInput& input : inputs) {
    if (input.source != Source::field) continue;
    lines += fmt::format("** field variable {0}: {1}; both surfaces need it\n"
                         "*Initial Conditions, type=FIELD, variable={0}\n"
                         " <nodes of both surfaces>, <{1}, at the start>\n"
                         "** and in the step:\n"
                         "*Field, variable={0}\n"
                         " <nodes of both surfaces>, <{1}>\n",
                         input.field, meaning_and_unit(input));
  }
  return lines;
}

std::string standard_lines(const std::vector<SolverInput>& inputs) {
  return "*Contact Pair, interaction=FRICTAB\n <secondary>, <main>\n"
         "** and on the step, for derivatives by the pressure:\n"
         "*Step, unsymm=YES, nlgeom=YES\n" +
         field_lines(inputs);
}

} // namespace frictab::abaqus
