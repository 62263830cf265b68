// Conditions that stand above the rows of a file.
#pragma once

#include <string_view>

#include "guess/guess.h"
#include "io/csv.h"

namespace frictab::guess {

// Adds what stands above the rows as columns, and quantities that rigs hold as these. Radii of
// bodies in contact become those of the file.
void add_conditions(File& file, const io::CsvTable& table);

// Takes the meaning from a load that pulls a sled, whose weight stands above the rows: such a force
// is friction.
void doubt_load(File& file, const io::CsvTable& table);

// The area of contact in mm2 that a line of a preamble gives ("Area [mm2]: 78.5", "Kontaktfläche;4;
// cm2" in any encoding); 0: none does.
double area_in(std::string_view preamble, char decimal);

} // namespace frictab::guess
