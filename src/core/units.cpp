// Unit conversion by UDUNITS-2.
#include "core/units.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <stdexcept>
#include <utility>

#include <udunits2.h>

namespace frictab {

namespace {

// As rigs write units that the library does not know, or takes for coulombs and farads.
constexpr std::pair<const char*, const char*> spellings[] = {
    {"-", "1"},       {"C", "degC"},     {"deg C", "degC"}, {"Grad C", "degC"}, {"ºC", "degC"},
    {"F", "degF"},    {"deg F", "degF"}, {"lbs", "lbf"},    {"ksi", "kpsi"},    {"Sekunden", "s"},
    {"Sekunde", "s"}, {"Sek", "s"},      {"sek", "s"},      {"Sek.", "s"},      {"sec.", "s"},
    {"Sec", "s"},     {"deg_C", "degC"}, {"deg_F", "degF"}};

// The library's database; one thread at a time may query it.
class Units {
public:
  Units() {
    ut_set_error_message_handler(ut_ignore); // unknown names are expected
    system_ = ut_read_xml(nullptr);
    if (!system_)
      throw std::runtime_error("the units of UDUNITS-2 cannot be read: is libudunits2-data "
                               "installed, and UDUNITS2_XML_PATH unset or right?");
  }

  std::optional<Conversion> convert(const std::string& from, const std::string& to) {
    const std::lock_guard lock(mutex_);
    const auto [found, is_new] = known_.try_emplace({from, to});
    if (is_new) found->second = ask(from, to);
    return found->second;
  }

private:
  ut_unit* parse(const std::string& name) {
    if (name.empty()) return nullptr;
    for (const auto& [of_rigs, of_library] : spellings)
      if (name == of_rigs) return ut_parse(system_, of_library, UT_UTF8);
    if (ut_unit* const unit = ut_parse(system_, name.c_str(), UT_UTF8)) return unit;
    return name.starts_with("kp") ? parse("kgf" + name.substr(2)) : parse_torque(name);
  }

  // "Nm", "kNm", "Ncm", "kgcm": the library wants a blank between the two, and a force.
  ut_unit* parse_torque(const std::string& name) {
    for (const char* const length : {"mm", "cm", "m"}) {
      if (!name.ends_with(length)) continue;
      const std::string force = name.substr(0, name.size() - std::strlen(length));
      for (const char* const known : {"N", "kN", "mN", "kgf", "kg"})
        if (force == known)
          return ut_parse(system_, ((force == "kg" ? "kgf" : force) + " " + length).c_str(),
                          UT_UTF8);
    }
    return nullptr;
  }

  std::optional<Conversion> ask(const std::string& from, const std::string& to) {
    ut_unit *a = parse(from), *b = parse(to);
    std::optional<Conversion> out;
    if (a && b && ut_are_convertible(a, b)) out = converter(a, b);
    ut_free(a);
    ut_free(b);
    return out;
  }

  // nullopt if the conversion is not linear: logarithmic units, or the reciprocal of the unit.
  static std::optional<Conversion> converter(ut_unit* a, ut_unit* b) {
    cv_converter* const how = ut_get_converter(a, b);
    if (!how) return std::nullopt;
    const double at_0 = cv_convert_double(how, 0), at_1 = cv_convert_double(how, 1),
                 at_4096 = cv_convert_double(how, 4096);
    cv_free(how);
    const double factor = at_0 == 0 ? at_1 : (at_4096 - at_0) / 4096;
    const bool straight = std::abs(at_0 + factor - at_1) <= 1e-12 * (std::abs(at_0) + factor);
    if (!straight || !(factor > 0)) return std::nullopt;
    return Conversion{rounded(factor), rounded(at_0)};
  }

  // Rounds 9.9999999999999995e-07, which the library's own multiplications give, to 1e-06.
  static double rounded(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.12g", value);
    const double written = std::strtod(text, nullptr);
    return std::abs(written - value) <= 4e-16 * std::abs(value) ? written : value;
  }

  std::mutex mutex_;
  ut_system* system_;
  std::map<std::pair<std::string, std::string>, std::optional<Conversion>> known_;
};

Units& units() {
  static Units* const all = new Units; // never destroyed: threads may still use it at exit
  return *all;
}

} // namespace

std::optional<Conversion> convert(std::string_view from, std::string_view to) {
  return units().convert(std::string(from), std::string(to));
}

std::vector<std::string> units_like(std::string_view unit) {
  std::vector<std::string> names;
  for (const char* name :
       {"MPa",  "N/mm2", "GPa", "kPa", "Pa",   "bar", "psi",  "ksi", "mm/s", "m/s", "m/min",
        "um/s", "mm",    "m",   "cm",  "um",   "in",  "s",    "ms",  "min",  "h",   "N",
        "mN",   "kN",    "MN",  "lbf", "degC", "K",   "degF", "1",   "%"})
    if (convert(name, unit)) names.emplace_back(name);
  return names;
}

} // namespace frictab
