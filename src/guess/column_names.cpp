// Likeness of names with those that are known.
#include "guess/column_names.h"

#include <algorithm>
#include <cctype>

#include "core/text.h"
#include "core/units.h"
#include "data/name_words.h"
#include "data/quantity.h"
#include "data/scale.h"
#include "io/csv.h"

namespace frictab::guess {

namespace {

struct Names {
  const char* canonical;
  bool coefficient;
  std::vector<std::string> whole; // complete names
  std::vector<std::string> part;  // parts of names
  std::vector<std::string> weak;  // parts that other quantities have as well
};

// Known names in lower case, without units, with blanks for other characters. Letters of other
// scripts are in the case of the start of a name.
const std::vector<Names>& known_names() {
  static const std::vector<Names> all = {
      {"experiment",
       false,
       {"experiment",  "test",      "versuch",       "versuch nr",   "versuchsnummer",
        "versuchsnr",  "run",       "probe",         "specimen",     "sample",
        "test id",     "test no",   "test nr",       "test name",    "id",
        "specimen id", "sample id", "probe nr",      "probennummer", "run id",
        "run no",      "run nr",    "experiment id", "trial",        "trial id"},
       {},
       {}},
      {"time_s",
       false,
       {"time", "zeit", "t", "elapsed", "sekunden", "tempo", "tid", "x value"},
       {"time", "zeit", "temps", "tiempo", "czas", "Čas", "čas", "tijd", "zaman", "Время", "время",
        "时间", "時間", "시간"},
       {}},
      {"F_N_N",
       false,
       {"f n", "fn", "fz", "load", "last", "fnormal", "carico", "carga", "Нагрузка", "载荷", "荷重",
        "하중"},
       {"normal force",      "normalkraft",      "normal load",
        "prüfkraft",         "ball load",        "axial load",
        "vertical force",    "clamping force",   "sled weight",
        "dead weight",       "schlittengewicht", "auflagekraft",
        "axial force",       "axialkraft",       "vertikalkraft",
        "anpresskraft",      "normallast",       "niederhalterkraft",
        "blankholder force", "effort normal",    "force normale",
        "forza normale",     "fuerza normal",    "siła normalna",
        "vorspannkraft",     "clamp force",      "síla",
        "normaalkracht",     "normal kuvvet"},
       {}},
      {"F_R_N",
       false,
       {"f r", "fr", "ff", "f f", "fx", "ft", "friction", "reibung"},
       {"friction force", "frictional force", "reibkraft", "reibungskraft", "tangential",
        "lateral force", "tangentiel", "attrito", "fuerza de fricci", "atrito", "siła tarcia",
        "třecí", "Třecí", "friktionskraft", "wrijvingskracht", "sürtünme kuvveti", "Сила трения",
        "摩擦力", "마찰력"},
       {}},
      {"sigma_n_MPa",
       false,
       {"p", "pressure", "sigma n", "sigman", "σ n", "σn", "σ", "sigma", "druck", "cpress",
        "pressung", "fn mpa", "p mpa"},
       {"normal stress", "contact pressure", "surface pressure", "normalspannung", "pressung",
        "kontaktdruck", "pression de contact"},
       {}},
      {"tau_R_MPa",
       false,
       {"tau", "tau r", "taur", "τ r", "τr", "τ", "cshear", "cshear1", "shear", "friction stress"},
       {"shear stress", "schubspannung", "reibspannung", "cisaillement"},
       {}},
      {"tau_R_MPa",
       true,
       {"mu", "µ", "μ", "cof", "cf"},
       {"coefficient of friction",
        "friction coeff",
        "traction coeff",
        "adhesion coeff",
        "reibwert",
        "reibzahl",
        "reibungszahl",
        "reibungskoeffizient",
        "reibkoeffizient",
        "reibbeiwert",
        "coefficient de frottement",
        "coefficiente di attrito",
        "coeficiente de fricci",
        "coeficiente de atrito",
        "współczynnik tarcia",
        "Współczynnik tarcia",
        "koeficient t",
        "friktionskoefficient",
        "wrijvingsco",
        "sürtünme katsay",
        "Коэффициент трения",
        "摩擦系数",
        "摩擦係数",
        "마찰계수"},
       {"cof"}},
      {"v_rel_mm_s",
       false,
       {"v", "v rel", "vrel", "v slide", "speed", "velocity", "sliding speed"},
       {"speed", "velocity", "geschw", "vitesse", "velocit", "velocidad", "速度"},
       {}},
      {"s_mm",
       false,
       {"s", "distance", "distanza", "weg", "slip", "path", "s d"},
       {"sliding distance", "sliding path", "gleitweg", "reibweg"},
       {}},
      {"T_tool_C",
       false,
       {"t tool", "t werkzeug"},
       {"tool temp", "werkzeugtemp", "die temp", "temp tool", "temperature tool", "temp werkzeug",
        "temperatur werkzeug", "temperature of tool", "temp die", "temperature die"},
       {}},
      {"T_contact_C",
       false,
       {"t contact", "temperature", "temperatur", "temp", "t", "温度"},
       {"contact temp", "kontakttemp"},
       {"temp"}},
      {"psi",
       false,
       {"psi"},
       {"surface expansion", "surface enlargement", "oberflächenvergr", "oberflaechenvergr"},
       {}},
      {"sigma_f_MPa",
       false,
       {"sigma f", "kf", "k f"},
       {"flow stress", "fließspannung", "fliessspannung", "fliessspg"},
       {}},
  };
  return all;
}

// Names in the history output of Abaqus: contact forces ("CFN2: Normal force ...", CFSM) anywhere,
// and velocities and temperatures of a node ("V1 PI: PART-1-1 N: 1"). The other components of a
// vector stay separate columns.
std::string of_abaqus(const std::string& name) {
  const std::string word = name.substr(0, name.find(' '));
  const bool component =
      word.size() == 4 && (std::isdigit(static_cast<unsigned char>(word[3])) || word[3] == 'm');
  if (component && word.starts_with("cfn")) return "F_N_N";
  if (component && word.starts_with("cfs")) return "F_R_N";
  if (name.find(" pi ") == name.npos && name != word) return "";
  if (word == "temp" || word == "nt11") return "T_contact_C";
  const bool velocity =
      word.size() == 2 && word[0] == 'v' && std::isdigit(static_cast<unsigned char>(word[1]));
  return velocity ? "v_rel_mm_s" : "";
}

// "LOAD_N" of "LC01_LOAD_N", as controllers number their channels; "Fn" of a struct "data.Fn".
std::string without_channel(const std::string& name) {
  for (const std::string_view group : {"data.", "signals.", "raw."})
    if (name.starts_with(group)) return name.substr(group.size());
  const std::size_t end = name.find('_');
  const std::size_t digits = name.find_first_of("0123456789");
  const bool is_channel = end != name.npos && digits >= 2 && digits + 2 <= end &&
                          name.find_first_not_of("0123456789", digits) == end &&
                          std::all_of(name.begin(), name.begin() + static_cast<long>(digits),
                                      [](unsigned char c) { return std::isupper(c) != 0; });
  return is_channel ? name.substr(end + 1) : name;
}

// Wanted values.
bool is_set(const std::string& name) {
  return data::has_word(name, {"soll", "sollwert", "set", "setpoint", "target", "nominal", "nom",
                               "demand", "command", "consigne"});
}

// Temperatures of another body than the one in contact, or of another time than the row's.
bool is_beside_contact(const std::string& name) {
  const bool at_end =
      data::has_word(name, {"end", "final", "ende", "after", "nach", "start", "initial"}) ||
      data::has_part(name, {"endtemp", "starttemp"});
  const bool of_another =
      data::has_word(name,
                     {"oil",     "öl",     "Öl",        "oel",   "sump",    "sumpf",    "bath",
                      "bad",     "pot",    "lubricant", "fluid", "coolant", "emulsion", "water",
                      "wasser",  "inlet",  "outlet",    "tank",  "furnace", "ofen",     "oven",
                      "chamber", "kammer", "heater",    "motor", "bearing"}) ||
      data::has_part(name, {"öltemp", "Öltemp", "oeltemp", "sumpftemp", "badtemp", "ofentemp",
                            "kammertemp", "lagertemp", "wassertemp", "schmierstofftemp"});
  return at_end || (of_another && !data::has_part(name, {"contact", "kontakt"}));
}

// Units of a speed of rotation, as the words of names, and their factors in a formula for a speed
// in mm/s at a radius in mm.
struct TurnUnit {
  const char* words;
  const char* factor;
};
constexpr TurnUnit turn_units[] = {
    {"rpm", "2*pi/60"},    {"upm", "2*pi/60"},      {"rev min", "2*pi/60"}, {"u min", "2*pi/60"},
    {"1 min", "2*pi/60"},  {"min 1", "2*pi/60"},    {"min⁻¹", "2*pi/60"},   {"r min", "2*pi/60"},
    {"tr min", "2*pi/60"}, {"giri min", "2*pi/60"}, {"rps", "2*pi"},        {"rev s", "2*pi"},
    {"u s", "2*pi"},       {"rad s", ""},           {"deg s", "pi/180"},
};

const TurnUnit* turn_unit_in(const std::string& words) {
  for (const TurnUnit& unit : turn_units)
    if (data::has_word(words, {unit.words})) return &unit;
  return nullptr;
}

// Speeds of rotation, without regard to their unit.
bool names_rotation(const std::string& name) {
  return data::has_word(name,
                        {"rotation", "rotational", "rotary", "spindle", "angular", "spindel"}) ||
         data::has_part(name, {"drehzahl", "drehgeschw", "winkelgeschw", "rotationsgeschw"});
}

// Times of a part of a test, which no clock shows.
bool is_duration(const std::string& name) {
  return data::has_word(name, {"stop", "stopping", "braking", "dwell", "delay", "hold", "holding",
                               "haltezeit", "bremszeit", "verweilzeit"});
}

// Wanted or extreme values, scatter, and speeds of rolling, which are taken only if nothing else is
// there.
bool is_second_choice(const std::string& name) {
  return is_set(name) ||
         data::has_word(name, {"max", "maximum", "min", "minimum", "std", "sd", "stdev",
                               "deviation", "abweichung", "streuung", "rolling", "entrainment"});
}

// The name without the words for wanted values: "v" of "v set".
std::string without_set(const std::string& name) {
  std::string out;
  for (std::size_t begin = 0; begin <= name.size();) {
    const std::size_t end = std::min(name.find(' ', begin), name.size());
    const std::string word = name.substr(begin, end - begin);
    if (!is_set(word)) out += (out.empty() ? "" : " ") + word;
    begin = end + 1;
  }
  return out;
}

// 4: the canonical name; 3: a complete name; 2: part of one; 1: a weak part, or a second choice; 0:
// no such column.
int likeness(const Names& names, const Column& column) {
  if (column.name == names.canonical && !names.coefficient) return 4;
  const data::Quantity* quantity = data::find_quantity(names.canonical);
  const std::string wanted = names.coefficient || !quantity ? "1" : quantity->unit;
  const bool is_weight = std::string_view(names.canonical) == "F_N_N" && is_in_mass(column);
  if (quantity && !column.unit.empty() && !convert(column.unit, wanted) && !is_weight) return 0;
  const bool is_clock = column.clock && std::string(names.canonical) == "time_s";
  if (quantity && column.text && !is_clock) return 0;
  const std::string bare = without_channel(io::read_header_name(column.name).name),
                    unit = quantity ? data::unit_in_name(bare, is_weight ? "kg" : wanted) : "",
                    name = data::words_of_name(bare),
                    without_unit = data::words_of_name(bare.substr(0, bare.size() - unit.size()));
  const std::string_view canonical = names.canonical;
  if (data::names_surroundings(name) || (canonical == "time_s" && is_duration(name))) return 0;
  if (canonical == "v_rel_mm_s" && column.unit.empty() &&
      (names_rotation(name) || turn_unit_in(name)))
    return 0;
  const auto is_whole = [&](const std::string& one) {
    return std::find(names.whole.begin(), names.whole.end(), one) != names.whole.end();
  };
  const auto has_part = [&](const std::vector<std::string>& parts) {
    return std::any_of(parts.begin(), parts.end(),
                       [&](const std::string& part) { return name.find(part) != name.npos; });
  };
  const bool is_in_newtons = canonical == "F_R_N" && convert(column.unit, "N").has_value();
  int found = 0;
  if (is_whole(name) || is_whole(without_unit) ||
      (quantity && canonical != "time_s" && is_set(name) && is_whole(without_set(without_unit))) ||
      (!names.coefficient && of_abaqus(name) == canonical))
    found = 3;
  else if (has_part(names.part) ||
           (names.coefficient && data::has_word(name, {"mu", "µ", "μ", "cof"})) ||
           (is_in_newtons && data::has_word(name, {"friction", "reibung"})))
    found = 2;
  else if (has_part(names.weak))
    found = 1;
  if (is_second_choice(name)) return std::min(found, 1);
  return is_clock ? std::min(found, 2) : found; // seconds go before a clock
}

// Marks temperatures that are, by their names, not those of a contact: of another body, of another
// time, set, or of the air, whose humidity stands next to them.
void doubt_temperatures(std::vector<Column>& columns) {
  const auto words = [](const Column& column) {
    return data::words_of_name(io::read_header_name(column.name).name);
  };
  const bool has_humidity = std::any_of(columns.begin(), columns.end(), [&](const Column& column) {
    return data::has_part(words(column), {"humid", "feucht"}) ||
           data::has_word(words(column), {"rh"});
  });
  for (Column& column : columns) {
    int most = 0;
    for (const Names& names : known_names())
      if (std::string_view(names.canonical).starts_with("T_"))
        most = std::max(most, likeness(names, column));
    const std::string name = words(column);
    const bool is_plain = name == "temp" || name == "temperature" || name == "temperatur";
    column.beside_contact =
        most > 0 && most < 4 &&
        (is_beside_contact(name) || is_second_choice(name) || (is_plain && has_humidity));
  }
}

} // namespace

void name_columns(std::vector<Column>& columns) {
  doubt_temperatures(columns);
  for (int least = 4; least >= 1; --least)
    for (const Names& names : known_names()) {
      const auto taken = [&](const Column& c) { return c.canonical == names.canonical; };
      if (std::any_of(columns.begin(), columns.end(), taken)) continue;
      for (Column& column : columns)
        if (column.canonical.empty() && !column.beside_contact &&
            likeness(names, column) >= least) {
          column.canonical = names.canonical;
          column.coefficient = names.coefficient;
          break;
        }
    }
}

std::string turn_factor(const Column& column) {
  if (!column.canonical.empty() || column.text) return "";
  const std::string name = data::words_of_name(column.name);
  if (data::has_part(name, {"strok", "hub", "cycl", "zykl", "freq"})) return "";
  const TurnUnit* const unit =
      turn_unit_in(column.unit.empty() ? name : data::words_of_name(column.unit));
  if (unit) return *unit->factor == 0 ? "1" : unit->factor;
  return column.unit.empty() && names_rotation(name) ? turn_units->factor : "";
}

bool is_in_mass(const Column& column) {
  const std::string unit =
      column.unit.empty() ? data::unit_in_name(column.name, "kg") : column.unit;
  const auto kilograms = convert(unit, "kg");
  return kilograms && kilograms->factor == 1;
}

bool names_wanted(const Column& column) {
  return is_set(data::words_of_name(column.name));
}

} // namespace frictab::guess
