// Friction coefficients as data of FE input decks.
#include <fmt/format.h>

#include "core/error.h"
#include "table/plain_text.h"

namespace frictab {

namespace {

// Places of an axis that is left out: one, whatever it is.
std::vector<double> or_one(const std::vector<double>& places) {
  return places.empty() ? std::vector<double>{0} : places;
}

std::string field(const std::vector<double>& places, double x) {
  return places.empty() ? "" : fmt::format(" {:.9g}", x);
}

PlainFormat abaqus();
PlainFormat lsdyna();

// mu, slip rate, pressure, temperature; the slip rate varies fastest. A column on which mu does not
// depend stays blank.
void write_abaqus(const PlainRequest& request, std::ostream& out) {
  const DeckGrid grid = deck_grid(request);
  const DeckValue mu(request);
  out << deck_head(request, abaqus(), "**") << "** mu, slip rate, contact pressure, temperature\n"
      << "*FRICTION\n";
  for (const double t : or_one(grid.temperature))
    for (const double p : or_one(grid.pressure))
      for (const double v : or_one(grid.speed))
        out << fmt::format("{:.9g},{},{},{}\n", mu(p, v, t), field(grid.speed, v),
                           field(grid.pressure, p), field(grid.temperature, t));
}

// A curve of mu over pressure for each speed, behind the table of speeds.
void write_lsdyna(const PlainRequest& request, std::ostream& out) {
  const DeckGrid grid = deck_grid(request);
  if (!grid.temperature.empty())
    throw InputError({}, "a *DEFINE_TABLE of friction has no temperature",
                     "hold it: --at T_contact_C=100");
  if (grid.pressure.empty())
    throw InputError({},
                     "the curves of *DEFINE_TABLE run over sigma_n_MPa, which is held or not "
                     "an input",
                     "hold other states, or use --to csv");
  const DeckValue mu(request);
  out << deck_head(request, lsdyna(), "$")
      << "*DEFINE_TABLE\n$     tbid\n         1\n$       speed, mm/s\n";
  for (const double v : or_one(grid.speed))
    out << fmt::format("{:>20.10g}\n", v);
  int curve = 1;
  for (const double v : or_one(grid.speed)) {
    out << fmt::format(
        "*DEFINE_CURVE\n$     lcid\n{:>10}\n$      pressure, MPa                  mu\n", ++curve);
    for (const double p : grid.pressure)
      out << fmt::format("{:>20.10g}{:>20.10g}\n", p, mu(p, v, 0));
  }
}

PlainFormat abaqus() {
  return {"abaqus", 3, "*FRICTION data lines: mu over slip rate, pressure and temperature",
          "verified: order of columns (Abaqus documentation); recalled: the slip rate varies "
          "fastest, linear between, constant outside",
          write_abaqus};
}
PlainFormat lsdyna() {
  return {"lsdyna", 4, "*DEFINE_TABLE and *DEFINE_CURVE: mu over pressure, a curve per speed",
          "verified: a table of relative velocity and pressure (FS=2, FD=table); recalled: curves "
          "over pressure, one per velocity, directly behind the table",
          write_lsdyna};
}

const Registered<PlainFormat> registered_abaqus{abaqus};
const Registered<PlainFormat> registered_lsdyna{lsdyna};

} // namespace

} // namespace frictab
