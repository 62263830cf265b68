// Tribosystems: a friction law with constants measured for one pair of materials, with its source.
// The program has templates/systems/*.toml; a laboratory can write its own file in the same form:
//
//   title = "Al10Cu, dry, pin-on-disc"
//   pair = "Al10Cu; the origin does not name the other body"
//   lubricant = "none"
//   law = "coulomb"                  # of `frictab list models`
//   tests = 3                        # from which the constants come
//   error = "9.5 % of the stress"    # mean absolute error on tests left out; optional
//   source = "..."                   # where the measurements are
//   licence = "CC BY 4.0"
//   made = "..."                     # how the constants were found
//   caution = "..."                  # limits of their use; optional
//   [parameters]
//   mu = { value = 0.41, std_error = 0.013 }
//   [range]                          # tested states, in canonical units
//   sigma_n_MPa = [1, 1]
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace frictab::job {

struct System {
  std::string name; // of the file, without .toml
  std::string title, pair, lubricant, law, error, source, licence, made, caution;
  std::size_t tests = 0;
  struct Constant {
    std::string name;
    double value = 0, std_error = 0; // 0: not known
  };
  std::vector<Constant> parameters;
  std::map<std::string, std::pair<double, double>> range;
};

// The systems of the program, by name.
const std::vector<System>& systems();

// Reads the text of one system. Throws InputError with all faults: keys that are missing, unknown
// or of another type. Laws, parameters and states are checked where the system is used.
System read_system(const std::string& text, const std::string& file);

// Returns the system of the program with this name, or reads a file whose name ends in .toml.
System system_named(const std::string& name);

} // namespace frictab::job
