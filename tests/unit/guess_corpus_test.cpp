// Files as rigs of many makers describe theirs: which column is which. SYNTHETIC numbers under
// headers that were written from the makers' manuals and from habits of laboratories.
#include <map>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/text.h"
#include "guess/guess.h"
#include "support/run_command.h"

namespace frictab::guess_corpus_test {

namespace {

// Roles: t time, FN and FR forces, mu coefficient, p and tau stresses, v speed, s distance, Tc and
// Tt temperatures, psi, sf, id test; - none of these.
struct LookAlike {
  const char* rig;
  const char* preamble;
  const char* dialect; // delimiter, decimal sign
  const char* header;  // names between |
  const char* units;   // of a row below the names, between |; "" none
  const char* roles;   // between blanks, one per column
};

const LookAlike look_alikes[] = {
    {"ball on disc, English", "", ",.", "Time (s)|Fx (N)|Fz (N)|COF|Z (mm)", "", "t FR FN mu -"},
    {"ball on disc with capitals", "", ",.", "TIME|FZ|FX|COF|AE", "", "t FN FR mu -"},
    {"tribometer with laps", "Tribometer 5\nRadius [mm]: 3\n\n", "\t.",
     "Time [s]|Distance [m]|laps|Sequence ID|µ [-]|Penetration depth [µm]", "", "t s - - mu -"},
    {"oscillating rig", "SRV protocol\n", ";,",
     "Zeit [s]|Reibzahl|Last [N]|Hub [mm]|Temperatur [°C]|Verschleiß [µm]", "", "t mu FN - Tc -"},
    {"traction machine", "", ",.",
     "Step time (s)|Traction coeff (-)|Ball load (N)|Rolling speed (mm/s)|SRR (%)|Pot temp (°C)",
     "", "t mu FN v - -"},
    {"reciprocating rig", "", "\t.",
     "Time (s)|Friction Force (N)|Load (N)|Temperature (C)|Contact Potential (mV)", "",
     "t FR FN Tc -"},
    {"pin on disc, wear in micron", "", ",.",
     "TIME [s]|WEAR [micron]|FRICTION FORCE [N]|COF|NORMAL LOAD [N]", "", "t - FR mu FN"},
    {"pin on disc, units below", "Pin on disc\n", ";,",
     "Zeit|Drehzahl|Normalkraft|Reibkraft|Reibwert", "s|1/min|N|N|-", "t - FN FR mu"},
    {"strip drawing, German", "Streifenzug\nDatum: 3.4.2021\n", ";,",
     "Prüfzeit|Ziehweg|Ziehkraft|Normalkraft|Reibungszahl", "s|mm|kN|kN|-", "t - - FN mu"},
    {"sliding compression, German", "", ";,",
     "Zeit [s]|Kontaktnormalspannung [MPa]|Reibschubspannung [MPa]|Relativgeschwindigkeit "
     "[mm/s]|Oberflächenvergrößerung [-]",
     "", "t p tau v psi"},
    {"sliding compression, English", "", ",.",
     "time|contact normal stress|friction shear stress|sliding velocity|surface enlargement",
     "s|MPa|MPa|mm/s|1", "t p tau v psi"},
    {"French", "Essai 4\n", ";,",
     "Temps (s)|Effort normal (N)|Effort tangentiel (N)|Coefficient de frottement", "",
     "t FN FR mu"},
    {"French, stresses", "", ";,",
     "temps [s]|pression de contact [MPa]|contrainte de cisaillement [MPa]|vitesse [mm/s]", "",
     "t p tau v"},
    {"Italian", "", ";,", "Tempo [s]|Forza normale [N]|Forza di attrito [N]|Velocità [mm/s]", "",
     "t FN FR v"},
    {"Italian, coefficient", "", ";,", "Tempo|Carico|Coefficiente di attrito|Distanza", "s|N|-|m",
     "t FN mu s"},
    {"Spanish", "", ";,",
     "Tiempo (s)|Fuerza normal (N)|Fuerza de fricción (N)|Coeficiente de fricción", "",
     "t FN FR mu"},
    {"Portuguese", "", ";,", "Tempo (s)|Carga (N)|Força de atrito (N)|Velocidade (mm/s)", "",
     "t FN FR v"},
    {"Polish", "", ";,", "Czas [s]|Siła normalna [N]|Siła tarcia [N]|Współczynnik tarcia", "",
     "t FN FR mu"},
    {"Czech", "", ";,", "Čas [s]|Normálová síla [N]|Třecí síla [N]|Koeficient tření", "",
     "t FN FR mu"},
    {"Swedish", "", ";,", "Tid [s]|Normalkraft [N]|Friktionskraft [N]|Friktionskoefficient", "",
     "t FN FR mu"},
    {"Dutch", "", ";,", "Tijd [s]|Normaalkracht [N]|Wrijvingskracht [N]|Wrijvingscoëfficiënt", "",
     "t FN FR mu"},
    {"Turkish", "", ";,", "Zaman (s)|Normal kuvvet (N)|Sürtünme kuvveti (N)|Sürtünme katsayısı", "",
     "t FN FR mu"},
    {"Chinese", "", ",.", "时间(s)|载荷(N)|摩擦力(N)|摩擦系数|温度(°C)", "", "t FN FR mu Tc"},
    {"Japanese", "", ",.", "時間(s)|荷重(N)|摩擦力(N)|摩擦係数|速度(mm/s)", "", "t FN FR mu v"},
    {"Korean", "", ",.", "시간(s)|하중(N)|마찰력(N)|마찰계수", "", "t FN FR mu"},
    {"Russian", "", ";,", "Время, с|Нагрузка, N|Сила трения, N|Коэффициент трения", "",
     "t FN FR mu"},
    {"ring compression by a press", "", "\t.", "t/s|F/kN|s/mm|v/mm/s", "", "t - s v"},
    {"letters with units", "", "\t.", "t / s|F_N / N|F_R / N|v_rel / mm/s|T / °C", "",
     "t FN FR v Tc"},
    {"letters alone", "", ",.", "t|FN|FT|mu", "", "t FN FR mu"},
    {"Greek letters", "", ";.", "t [s]|σ_N [MPa]|τ_R [MPa]|µ [-]", "", "t p tau -"},
    {"underscores", "", ",.", "time_s|normal_force_N|friction_force_N|sliding_speed_mm_s", "",
     "t FN FR v"},
    {"camel case", "", ",.", "TimeStamp|NormalForce|FrictionForce|SlidingVelocity|ToolTemperature",
     "s|N|N|mm/s|°C", "t FN FR v Tt"},
    {"several temperatures", "", ",.",
     "Time (s)|Normal force (N)|Friction force (N)|Tool temperature (°C)|Contact temperature "
     "(°C)|Room temperature (°C)",
     "", "t FN FR Tt Tc -"},
    {"set and actual", "", ";.", "Zeit [s]|Normalkraft Soll [N]|Normalkraft Ist [N]|Reibkraft [N]",
     "", "t - FN FR"},
    {"target and measured", "", ",.",
     "Time (s)|Load setpoint (N)|Load (N)|Friction force (N)|Speed setpoint (mm/s)|Speed (mm/s)",
     "", "t - FN FR - v"},
    {"torque and forces", "", ",.",
     "Time (s)|Torque (N m)|Normal force (N)|Friction force (N)|Friction coefficient", "",
     "t - FN FR mu"},
    {"maximum and mean", "", ";,", "Zeit [s]|Reibwert Max|Reibwert Mittel|Normalkraft [N]|Weg [mm]",
     "", "t - mu FN s"},
    {"deviation of the coefficient", "", ",.", "Time (s)|COF|COF std|Load (N)|Sliding distance (m)",
     "", "t mu - FN s"},
    {"counter first", "", ",.", "No|Time (s)|Load (N)|Friction (N)", "", "- t FN FR"},
    {"test number first", "", ";,", "Versuch|Zeit [s]|Normalkraft [N]|Reibkraft [N]", "",
     "id t FN FR"},
    {"specimen", "", ",.", "Specimen|Time (s)|Contact pressure (MPa)|Shear stress (MPa)", "",
     "id t p tau"},
    {"finite elements", "", ",.", "Time|CPRESS|CSHEAR1|SLIP", "s|MPa|MPa|mm", "t p tau s"},
    {"friction as a coefficient", "", "\t.", "Time(s)|Friction|Normal_stress(MPa)", "", "t mu p"},
    {"rock friction", "", "\t.",
     "Time (s)|Shear stress (MPa)|Normal stress (MPa)|Displacement (mm)", "", "t tau p -"},
    {"clutch bench", "", ";.",
     "Time [s]|Sliding speed [m/s]|Surface pressure [N/mm2]|Friction coefficient [-]|Disc "
     "temperature "
     "[°C]",
     "", "t v p mu Tc"},
    {"brake dynamometer", "", ",.",
     "Time [s]|Speed [mm/s]|Pressure [bar]|Torque [N m]|Mu|Disc temp [degC]", "", "t v - - mu Tc"},
    {"lubricant bench", "", ",.", "elapsed time (s)|CoF|load (kg)|oil temp (C)|wear scar (mm)", "",
     "t mu FN - -"},
    {"temperatures of other bodies and times", "", ",.",
     "Time (s)|Pressure (MPa)|COF|Sump temp (C)|lab_temperature_C|pin_end_temperature_C|"
     "Temp setpoint (C)|Max temperature (C)",
     "", "t p mu - - - - -"},
    {"temperature and humidity of the air", "", ";.",
     "Zeit [s]|Pressung [MPa]|Reibwert|Temperatur [°C]|rel. Feuchte [%]", "", "t p mu - -"},
    {"contact temperature in an oil bath", "", ",.",
     "Time (s)|Pressure (MPa)|COF|Bath temperature (C)|Contact temperature (C)", "", "t p mu - Tc"},
    {"speeds of rotation without brackets", "", ",.",
     "Time (s)|Load (N)|Friction (N)|Speed rpm|Rotational speed|speed_1/min", "", "t FN FR - - -"},
    {"rotation and sliding", "", ",.",
     "Time (s)|Load (N)|Friction (N)|Spindle speed|Sliding speed (mm/s)", "", "t FN FR - v"},
    {"set values alone", "", ",.", "t_s|p_nom_MPa|v_set_mm_s|F_F_N|F_set_N", "", "t p v FR FN"},
    {"inclined names", "", ",.",
     "Elapsed Time [s]|Tangential Force [N]|Normal Load [N]|Sliding Speed "
     "[mm/s]",
     "", "t FR FN v"},
    {"lateral force", "", ",.",
     "Time [s]|Lateral force [N]|Vertical force [N]|Friction coefficient", "", "t FR FN mu"},
    {"pull force", "", ",.", "Time [s]|Pull force [N]|Clamping force [N]|COF", "", "t - FN mu"},
    {"drag and lift", "", ",.",
     "Time [s]|Friction torque [N m]|Axial load [N]|Rotation speed [1/min]", "", "t - FN -"},
    {"flow stress given", "", ";,",
     "Zeit [s]|Normalspannung [MPa]|Schubspannung [MPa]|Fließspannung [MPa]|Werkzeugtemperatur "
     "[°C]",
     "", "t p tau sf Tt"},
    {"kilonewtons", "", ";,", "Zeit in s|Normalkraft in kN|Reibkraft in N|Gleitweg in mm", "",
     "t FN FR s"},
    {"umlauts written out", "", ";,",
     "Zeit [s]|Oberflaechenvergroesserung [-]|Kontaktdruck [MPa]|Reibkoeffizient [-]", "",
     "t psi p mu"},
    {"surface strain", "", ",.",
     "Time [s]|Surface expansion [-]|Contact pressure [MPa]|Friction shear stress [MPa]", "",
     "t psi p tau"},
    {"milliseconds", "", ",.", "Time (ms)|Normal Force (kN)|Friction Force (kN)|Velocity (m/s)", "",
     "t FN FR v"},
    {"remarks", "", ";,", "Zeit [s]|Normalkraft [N]|Reibkraft [N]|Bemerkung", "", "t FN FR -"},
    {"signals of channels", "", "\t.", "Time|Ch1 Normal force|Ch2 Friction force|Ch3 Speed",
     "s|N|N|mm/s", "t FN FR v"},
    {"average columns", "", ",.",
     "Cycle|Time [s]|Average friction coefficient|Average normal force [N]", "", "- t mu FN"},
    {"thermocouples", "", ",.", "Time [s]|Normal force [N]|Friction force [N]|TC1 [°C]|TC2 [°C]",
     "", "t FN FR - -"},
};

std::vector<std::string> split(const std::string& text, char sign) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, sign);)
    parts.push_back(part);
  return parts;
}

const std::map<std::string, std::string> canonical = {
    {"t", "time_s"},       {"FN", "F_N_N"},      {"FR", "F_R_N"},     {"mu", "tau_R_MPa"},
    {"p", "sigma_n_MPa"},  {"tau", "tau_R_MPa"}, {"v", "v_rel_mm_s"}, {"s", "s_mm"},
    {"Tc", "T_contact_C"}, {"Tt", "T_tool_C"},   {"psi", "psi"},      {"sf", "sigma_f_MPa"},
    {"id", "experiment"},
};

double value_of(const std::string& role, int row) {
  const double wave = 1 + 0.01 * (row % 5);
  if (role == "t") return 0.1 * row;
  if (role == "id") return row / 15 + 1;
  if (role == "mu") return 0.12 * wave;
  if (role == "psi") return 1.5 * wave;
  if (role == "-") return 7.3 * wave;
  return (role == "FR" || role == "tau" ? 60 : 500) * wave;
}

std::string file_of(const LookAlike& rig) {
  const std::string delimiter(1, rig.dialect[0]);
  const auto joined = [&](const char* cells) { return join(split(cells, '|'), delimiter) + "\n"; };
  std::string text = rig.preamble + joined(rig.header);
  if (*rig.units) text += joined(rig.units);
  for (int row = 0; row < 30; ++row) {
    std::vector<std::string> cells;
    for (const std::string& role : split(rig.roles, ' ')) {
      const std::string number = fmt::format("{:.4f}", value_of(role, row));
      cells.push_back(rig.dialect[1] == ',' ? replace_all(number, ".", ",") : number);
    }
    text += join(cells, delimiter) + "\n";
  }
  return text;
}

// "Load (N) is F_N_N and not -" for each wrong column.
std::vector<std::string> wrong_guesses(const LookAlike& rig, const std::string& path) {
  const guess::File guess = guess::guess_file(path, rig.rig).front();
  const std::vector<std::string> names = split(rig.header, '|'), roles = split(rig.roles, ' ');
  std::vector<std::string> wrong;
  for (std::size_t i = 0; i < roles.size(); ++i) {
    const auto role = canonical.find(roles[i]);
    const std::string wanted = role == canonical.end() ? "" : role->second;
    const std::string found = i < guess.columns.size() ? guess.columns[i].canonical : "?";
    if (found != wanted)
      wrong.push_back(fmt::format("{}: '{}' is taken as {}, it is {}", rig.rig, names[i],
                                  found.empty() ? "nothing" : found,
                                  wanted.empty() ? "nothing" : wanted));
  }
  return wrong;
}

TEST(GuessCorpus, AtMostThreeColumnsOfSixtyRigsAreTakenForAnother) {
  const test::TemporaryDirectory directory;
  std::vector<std::string> wrong;
  for (const LookAlike& rig : look_alikes) {
    directory.write("a.csv", file_of(rig));
    for (std::string& line : wrong_guesses(rig, directory.path("a.csv")))
      wrong.push_back(std::move(line));
  }
  EXPECT_GE(std::size(look_alikes), 60u);
  EXPECT_LE(wrong.size(), 3u) << join(wrong, "\n");
}

} // namespace

} // namespace frictab::guess_corpus_test
