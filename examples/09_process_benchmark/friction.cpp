#include "friction.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <dlfcn.h>

namespace {

class Shear : public FrictionLaw {
public:
  explicit Shear(double m) : part_(m / std::sqrt(3.0)) {}
  double stress(const ContactState& s) const override { return part_ * s.flow_stress; }
  double gradient(const ContactState& s, std::array<double, 6>& by) const override {
    by = {0, 0, 0, 0, 0, part_};
    return stress(s);
  }
  unsigned outside(const ContactState&) const override { return 0; }

private:
  double part_;
};

class Coulomb : public FrictionLaw {
public:
  explicit Coulomb(double mu) : mu_(mu) {}
  double stress(const ContactState& s) const override {
    return std::min(mu_ * s.pressure, s.flow_stress / std::sqrt(3.0));
  }
  double gradient(const ContactState& s, std::array<double, 6>& by) const override {
    const bool limited = mu_ * s.pressure > s.flow_stress / std::sqrt(3.0);
    by = {limited ? 0 : mu_, 0, 0, 0, 0, limited ? 1 / std::sqrt(3.0) : 0};
    return stress(s);
  }
  unsigned outside(const ContactState&) const override { return 0; }

private:
  double mu_;
};

// The generated C routine, by the names that its header declares.
class Routine : public FrictionLaw {
public:
  explicit Routine(const std::string& path) : library_(dlopen(path.c_str(), RTLD_NOW), &dlclose) {
    if (!library_) throw std::invalid_argument("cannot load the routine: " + last_error());
    stress_ = reinterpret_cast<Value*>(symbol("frictab_tau_R"));
    gradient_ = reinterpret_cast<ValueAndSlopes*>(symbol("frictab_tau_R_gradient"));
    outside_ = reinterpret_cast<Bits*>(symbol("frictab_outside"));
  }
  double stress(const ContactState& s) const override {
    return stress_(s.pressure, s.expansion, s.speed, s.temperature, s.slid, s.flow_stress);
  }
  double gradient(const ContactState& s, std::array<double, 6>& by) const override {
    return gradient_(s.pressure, s.expansion, s.speed, s.temperature, s.slid, s.flow_stress,
                     by.data());
  }
  unsigned outside(const ContactState& s) const override {
    return outside_(s.pressure, s.expansion, s.speed, s.temperature, s.slid, s.flow_stress);
  }

private:
  using Value = double(double, double, double, double, double, double);
  using ValueAndSlopes = double(double, double, double, double, double, double, double*);
  using Bits = unsigned(double, double, double, double, double, double);

  static std::string last_error() {
    const char* message = dlerror();
    return message ? message : "unknown reason";
  }
  void* symbol(const char* name) {
    void* found = dlsym(library_.get(), name);
    if (!found) throw std::invalid_argument("the library has no " + std::string(name));
    return found;
  }

  std::unique_ptr<void, int (*)(void*)> library_;
  Value* stress_;
  ValueAndSlopes* gradient_;
  Bits* outside_;
};

double constant_after(const std::string& text, std::size_t prefix, double most) {
  std::size_t used = 0;
  double value = -1;
  try {
    value = std::stod(text.substr(prefix), &used);
  } catch (const std::logic_error&) {
    used = 0;
  }
  if (used == 0 || used != text.size() - prefix || !(value >= 0 && value <= most))
    throw std::invalid_argument("law '" + text + "': a number from 0 to " +
                                std::to_string(static_cast<int>(most)) + " must follow the colon");
  return value;
}

} // namespace

std::unique_ptr<FrictionLaw> friction_law(const std::string& text) {
  if (text == "none") return std::make_unique<Shear>(0);
  if (text.rfind("shear:", 0) == 0) return std::make_unique<Shear>(constant_after(text, 6, 1));
  if (text.rfind("coulomb:", 0) == 0) return std::make_unique<Coulomb>(constant_after(text, 8, 1));
  if (text.find('/') == std::string::npos)
    throw std::invalid_argument("law '" + text +
                                "': none, shear:M, coulomb:MU or a path (./LIBRARY.so) expected");
  return std::make_unique<Routine>(text);
}
