// Lengths, strokes and factors that formulas take, by the names that laboratories give them.
#include <gtest/gtest.h>

#include "guess/aids.h"

namespace frictab::aids_test {
namespace {

using guess::Aid;
using guess::Column;

Column column(const std::string& name, const std::string& unit) {
  Column out;
  out.name = name;
  out.unit = unit;
  return out;
}

bool is(Aid aid, const std::string& name, const std::string& unit) {
  return guess::is_aid(column(name, unit), aid);
}

TEST(Aids, RadiusOfATrackIsNotThatOfABodyOrAnEdge) {
  for (const char* const name : {"Track radius (mm)", "Wear track radius", "Reibradius", "Radius"})
    EXPECT_TRUE(is(Aid::track_radius, name, "mm")) << name;
  for (const char* const name :
       {"Ball radius", "Kugelradius", "Die radius", "Inner radius", "Pin tip radius"})
    EXPECT_FALSE(is(Aid::track_radius, name, "mm")) << name;
  EXPECT_FALSE(is(Aid::track_radius, "Radius", "N"));
}

TEST(Aids, DiametersBelongToTracksPinsOrBalls) {
  for (const char* const name : {"Ring diameter", "Ring dia", "Spurdurchmesser", "Track diameter"})
    EXPECT_TRUE(is(Aid::track_diameter, name, "mm")) << name;
  for (const char* const name : {"Pin diameter (mm)", "Stiftdurchmesser", "Probendurchmesser d0",
                                 "Stempeldurchmesser", "Punch dia"})
    EXPECT_TRUE(is(Aid::pin_diameter, name, "mm")) << name;
  for (const char* const name : {"Ball diameter", "Kugeldurchmesser"})
    EXPECT_TRUE(is(Aid::ball_diameter, name, "mm")) << name;
  EXPECT_FALSE(is(Aid::pin_diameter, "Ball diameter", "mm"));
  EXPECT_FALSE(is(Aid::ball_diameter, "Ball wear scar diameter", "mm"));
  EXPECT_FALSE(is(Aid::track_diameter, "Spring diameter", "mm"));
  EXPECT_FALSE(is(Aid::pin_diameter, "Spindle diameter", "mm"));
}

TEST(Aids, StrokesFrequenciesAndPositionsAreKnownByNameAndUnit) {
  EXPECT_TRUE(is(Aid::stroke, "Hub", "mm"));
  EXPECT_TRUE(is(Aid::stroke, "Stroke length", "mm"));
  EXPECT_FALSE(is(Aid::stroke, "Stroke", "")) << "a counter of strokes";
  EXPECT_TRUE(is(Aid::frequency, "Frequenz", "Hz"));
  EXPECT_FALSE(is(Aid::frequency, "Sampling frequency", "Hz"));
  EXPECT_TRUE(is(Aid::position, "Schlittenweg", "mm"));
  EXPECT_TRUE(is(Aid::position, "Position", "mm"));
  EXPECT_FALSE(is(Aid::position, "Wear displacement", "mm"));
}

TEST(Aids, VoltageOfFrictionHasAFactorInNewtons) {
  EXPECT_TRUE(is(Aid::voltage, "Friction", "mV"));
  EXPECT_FALSE(is(Aid::voltage, "Contact potential", "mV"));
  EXPECT_TRUE(is(Aid::calibration, "Friction force calibration factor", "N/mV"));
}

TEST(Aids, TermsOfFormulasConvertUnits) {
  EXPECT_EQ(guess::term_of(column("Track radius", "mm"), "mm"), "Track_radius");
  EXPECT_EQ(guess::term_of(column("Track radius", "cm"), "mm"), "10*Track_radius");
  EXPECT_EQ(guess::term_of(column("Track radius", "mm"), "m"), "Track_radius/1000");
  EXPECT_EQ(guess::term_of(column("Ring diameter", "mm"), "mm", 2), "Ring_diameter/2");
  EXPECT_EQ(guess::term_of(column("track_radius_mm", ""), "mm"), "track_radius_mm");
  EXPECT_EQ(guess::term_of(column("Frequency", "1/min"), "Hz"), "Frequency/60");
}

} // namespace
} // namespace frictab::aids_test
