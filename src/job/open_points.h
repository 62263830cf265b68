// Points that the guesses of a campaign leave open: the questions of a guessed job.
#pragma once

#include <string>
#include <vector>

#include "guess/aids.h"
#include "guess/guess.h"

namespace frictab::job {

// Name of the column, or "column 3".
std::string shown_name(const guess::Column& column);

// Unit of its quantity that the user answered, or else that the end of its name gives; empty where
// the file gives it or nothing does.
std::string unit_besides(const guess::Column& column);

// Whether the quantity has a unit that nothing gives.
bool lacks_unit(const guess::Column& column);

class OpenPoints {
public:
  explicit OpenPoints(const guess::Campaign& campaign)
      : campaign_(campaign), file_(campaign.files[guess::most_common(campaign.files)]) {}

  const guess::File& file() const { return file_; } // that most are read like
  // Whether the rows, the table of tests or an answer have the quantity.
  bool has(const std::string& canonical) const;
  // Whether the rows have it, so that no column of the table of tests is needed.
  bool is_of_rows(const std::string& canonical) const;
  // Area of contact that all files give above their rows, mm2; 0: none.
  double common_area() const;
  // Area and radius of the bodies in contact by the lengths above the rows, for an example; 0:
  // none.
  double example_area_mm2() const;
  double example_radius_mm() const;

  bool lacks_tests() const;        // a single file, without a column of tests
  bool lacks_pressure() const;     // nor is it a force over an area that is given
  bool lacks_friction() const;     // in any form
  bool lacks_normal_force() const; // for the friction force that there is
  // Torques that friction may come from, those of friction before total ones.
  std::vector<const guess::Column*> torques() const;
  const guess::Column* torque() const; // the first of these; nullptr: none
  // The column of the rows or of the table of tests, or the condition that all files give; nullptr:
  // none.
  const guess::Column* aid(guess::Aid aid) const;
  // Radius of the track in a formula, in this unit, and the column that gives it; empty and
  // nullptr: no column does.
  struct Radius {
    std::string term;
    const guess::Column* column = nullptr;
  };
  Radius radius_in(const std::string& unit) const;
  // The only column without a meaning that is as small as coefficients of friction; nullptr: none,
  // or several.
  const guess::Column* likely_coefficient() const;
  // A speed of rotation where no speed is known: measured before wanted; nullptr: none.
  const guess::Column* rotation() const;
  // Temperatures that may be those of the contact, where none is known.
  std::vector<const guess::Column*> temperatures() const;
  // The only force without a meaning; nullptr: none, or several.
  const guess::Column* only_force() const;

private:
  // Columns of the rows with the conditions that all files give, then those of the tests.
  std::vector<const guess::Column*> columns() const;

  const guess::Campaign& campaign_;
  const guess::File& file_;
};

// Fills in speeds and friction forces whose formulas columns give without an answer: rotation and
// torque at a radius that is known.
void take_known_formulas(guess::Campaign& campaign);

// Formula of the sliding speed from a speed of rotation at `radius_mm`, a number or its name.
std::string speed_of_turns(const guess::Column& turns, const std::string& radius_mm);
// Formula of the friction force from the voltage of its cell at `factor`, a number or its name.
std::string force_of_voltage(const guess::Column& voltage, const guess::Column* calibration,
                             const std::string& factor);

// Twice the stroke times the frequency; empty where one of them is not known.
std::string speed_of_strokes(const OpenPoints& points);
// Stress of the load on a flat pin, punch or specimen, and that of Hertz under a ball; empty where
// no column gives the size.
std::string pressure_of_pin(const OpenPoints& points);
std::string pressure_of_ball(const OpenPoints& points);

// True if the surface enlargement is an increase and not A1/A0: it falls clearly below 1, which no
// A1/A0 does.
bool is_increase(const guess::Column& column);

// Asks for the radius of a torque.
std::string torque_question(const guess::Column& torque);
// Formula of the friction force from a torque at `radius_m`, a number or its name.
std::string force_of_torque(const guess::Column& torque, const std::string& radius_m);

} // namespace frictab::job
