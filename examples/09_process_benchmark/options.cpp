#include "options.h"

#include <functional>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace {

// One option with a number: what it sets, and what is allowed.
struct Number {
  const char* name;
  double low, high;
  const char* meaning;
  std::function<void(Command&, double)> set;
};

template <class T> std::function<void(Command&, double)> into(T Setup::*member) {
  return [member](Command& c, double x) { c.setup.*member = static_cast<T>(x); };
}
std::function<void(Command&, double)> into(double Material::*member) {
  return [member](Command& c, double x) { c.setup.material.*member = x; };
}
std::function<void(Command&, double)> into(double HeatData::*member) {
  return [member](Command& c, double x) { c.setup.heat.*member = x; };
}
std::function<void(Command&, double)> into(double Command::*member) {
  return [member](Command& c, double x) { c.*member = x; };
}

const std::vector<Number>& numbers() {
  static const std::vector<Number> all = {
      {"--outer-diameter", 0.1, 1000, "mm", into(&Setup::outer_diameter)},
      {"--inner-diameter", 0.1, 1000, "mm, ring", into(&Setup::inner_diameter)},
      {"--height", 0.1, 1000, "mm, of the billet", into(&Setup::height)},
      {"--reduction", 0.01, 0.7, "share of the height, ring and upsetting",
       into(&Setup::reduction)},
      {"--stroke", 0.01, 1000, "mm, rod", into(&Setup::stroke)},
      {"--exit-diameter", 0.1, 1000, "mm, rod", into(&Setup::exit_diameter)},
      {"--half-angle", 1, 60, "deg, of the die's cone, rod", into(&Setup::half_angle)},
      {"--corner", 0.01, 10, "mm, rounding of the die's corners, rod", into(&Setup::corner)},
      {"--press-fit", 0, 0.1, "mm of radius that the bar exceeds the container, rod",
       into(&Setup::press_fit)},
      {"--speed", 1e-3, 1e5, "mm/s, at which the platens close or the punch moves",
       into(&Setup::speed)},
      {"--temperature", -50, 1000, "degC, of the billet at the start", into(&Setup::temperature)},
      {"--tool-temperature", -50, 1000, "degC, with --heat", into(&HeatData::tool)},
      {"--film", 0, 1000, "kW/(m^2 K), billet to tool, with --heat", into(&HeatData::film)},
      {"--conductivity", 0, 1000, "W/(m K), with --heat", into(&HeatData::conductivity)},
      {"--capacity", 0.1, 100, "MPa/K, heat per volume, with --heat", into(&HeatData::capacity)},
      {"--young", 100, 1e6, "MPa", into(&Material::young)},
      {"--poisson", 0, 0.49, "1", into(&Material::poisson)},
      {"--strength", 1, 1e5, "MPa, C of the flow stress C (e0 + ep)^n", into(&Material::strength)},
      {"--offset", 1e-6, 1, "e0", into(&Material::offset)},
      {"--exponent", 0, 0.6, "n", into(&Material::n)},
      {"--softening", 0, 0.002, "share of the flow stress lost per K above 20 degC",
       into(&Material::softening)},
      {"--columns", 1, 200, "elements along r", into(&Setup::columns)},
      {"--rows", 1, 400, "elements along z", into(&Setup::rows)},
      {"--steps", 1, 10000, "of the path", into(&Setup::steps)},
      {"--penalty", 1e3, 1e9, "MPa/mm", into(&Setup::penalty)},
      {"--sticking-share", 1e-6, 1, "share of the speed, v0 of the regularisation",
       into(&Setup::sticking_share)},
      {"--soft-pressure", 1e-6, 1000, "MPa, p0 of the regularisation", into(&Setup::soft_pressure)},
      {"--every", 1, 1000, "contact points of each so many steps are written",
       into(&Command::every)},
      {"--ccx-force", 0, 1e5, "kN, check: CalculiX's force with --ccx-mu",
       into(&Command::ccx_force)},
      {"--ccx-radius", 0, 1e3, "mm, check: CalculiX's inner radius at mid height",
       into(&Command::ccx_radius)},
      {"--ccx-mu", 0, 1, "check: the coefficient that CalculiX had", into(&Command::ccx_mu)},
  };
  return all;
}

double number_in(const Number& option, const std::string& text) {
  std::size_t used = 0;
  double value = 0;
  try {
    value = std::stod(text, &used);
  } catch (const std::logic_error&) {
    used = 0;
  }
  if (used == 0 || used != text.size() || !(value >= option.low && value <= option.high)) {
    std::ostringstream message;
    message << option.name << " " << text << ": a number from " << option.low << " to "
            << option.high << " expected (" << option.meaning << ")";
    throw std::invalid_argument(message.str());
  }
  return value;
}

void check_geometry(const Setup& s) {
  if (s.process == "ring" && s.inner_diameter >= s.outer_diameter)
    throw std::invalid_argument("--inner-diameter must be below --outer-diameter");
  if (s.process == "rod" && s.exit_diameter >= s.outer_diameter)
    throw std::invalid_argument("--exit-diameter must be below --outer-diameter");
}

} // namespace

std::string usage() {
  std::ostringstream text;
  text << "Usage: process_benchmark ring|upsetting|rod [--law LAW] [--heat] [--output NAME] "
          "[OPTION NUMBER]...\n"
          "       process_benchmark check [--law LIBRARY.so] [--ccx-force KN --ccx-radius MM "
          "--ccx-mu MU]\n"
          "  LAW: none, shear:M, coulomb:MU or a path of a compiled routine of frictab's target "
          "c (./LIBRARY.so)\n"
          "  --heat: temperatures from plastic work, friction and conduction; else constant\n"
          "  --output NAME: writes NAME_force.csv and NAME_contact.csv\n";
  for (const Number& option : numbers())
    text << "  " << option.name << "  " << option.low << " .. " << option.high << "; "
         << option.meaning << "\n";
  text << "Exit codes: 0 done, 1 a check failed, 2 wrong options, 3 no equilibrium found.\n";
  return text.str();
}

Command read_command(int count, char** words) {
  const std::vector<std::string> all(words + 1, words + count);
  Command command;
  if (all.empty()) throw std::invalid_argument("a process is required: ring, upsetting or rod");
  if (all[0] == "--help" || all[0] == "-h") {
    command.help = true;
    return command;
  }
  if (all[0] != "ring" && all[0] != "upsetting" && all[0] != "rod" && all[0] != "check")
    throw std::invalid_argument("unknown process '" + all[0] + "': ring, upsetting or rod");
  command.setup = default_setup(all[0]);
  for (std::size_t i = 1; i < all.size(); ++i) {
    const std::string& word = all[i];
    if (word == "--heat") {
      command.setup.heat.on = true;
      continue;
    }
    const bool text = word == "--law" || word == "--output";
    const Number* found = nullptr;
    for (const Number& option : numbers())
      if (word == option.name) found = &option;
    if (!text && !found) throw std::invalid_argument("unknown option '" + word + "'");
    if (++i == all.size()) throw std::invalid_argument("'" + word + "' needs a value");
    if (found)
      found->set(command, number_in(*found, all[i]));
    else
      (word == "--law" ? command.setup.law : command.output) = all[i];
  }
  check_geometry(command.setup);
  return command;
}
