// Assigns roles by the job first, then by the data, then by names.
#include "data/roles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "core/no_value.h"
#include "core/text.h"
#include "core/units.h"
#include "data/computed.h"
#include "data/disguise.h"
#include "data/middle.h"
#include "data/name_words.h"
#include "data/quantity.h"
#include "data/recordings.h"
#include "data/repeated_columns.h"
#include "data/scale.h"
#include "data/settings.h"
#include "data/signs.h"
#include "data/verdicts.h"

namespace frictab::data {

namespace {

constexpr std::array<const char*, 11> role_words = {"",        "state",   "response", "setting",
                                                    "channel", "outcome", "label",    "order",
                                                    "clock",   "test",    "ignore"};

// A column with at most most_held values within a test, each for at least rows_held rows, was set
// by the rig.
constexpr std::size_t most_held = 12, rows_held = 5;

struct Given {
  Role role = Role::undecided;
  std::string why;
  bool moves_by_noise = false; // within tests: their means are meant
};

// Names of columns that cannot be causes, independent of their contents. The first match counts;
// `when`: for columns with one value per test, for others, or for both.
enum class When { any, per_test, within };
struct NameRule {
  const char* pattern; // in lower case
  When when;
  Role role;
};
constexpr NameRule name_rules[] = {
    {"^(run|test)_?(order|no|nr|number)$|^(order|run|sequence|seq)$", When::per_test, Role::order},
    {"^(time_?stamp|date_?time|start(ed|_time|ed_at))$|(^|_)date$|datum$|zeitstempel",
     When::per_test, Role::order},
    {"time|clock|stamp|^(t|ms|tick)$", When::within, Role::clock},
    {"^((test|specimen|sample|probe|versuch|exp(eriment)?|(mess)?p(oin|unk)t)_?)?"
     "(id|no|nr|number|nummer|name|index)$|^lfd_?nr$|"
     "^(test|specimen|sample|probe|versuch|exp(eriment)?|(mess)?p(oin|unk)t)$",
     When::per_test, Role::test},
    {"^(rep|repeat|repetition|replicate|wiederholung|wdh)_?(id|no|nr|number|nummer)?$|"
     "^(screw|schraube|bolt|pin|stift|ball|kugel|strip|streifen|coupon|platine|ronde)n?_?"
     "(id|no|nr|number|nummer)$",
     When::per_test, Role::ignore},
    {"remark|comment|bemerkung|kommentar|^notes?$", When::any, Role::ignore},
    {"wear|worn|mass_?loss|weight_?loss|debris|scar|acoustic|vibration|"
     "contact_?(potential|resistance|voltage)",
     When::within, Role::channel},
    {"^wear(_(um|mm|mm2|mm3|mg|g))?$|wear_?(rate|loss|depth|volume|mass|scar|track_?(depth|width))|"
     "mass_?loss|weight_?loss|(^|_)scar(_|$)|"
     "verschlei|debris|(mass|weight|ra|rz|sa|roughness)\\w*_?(after|end|final)|"
     "(after|end|final)_?\\w*(mass|weight|ra|rz|roughness)|"
     "_(after|nach)_(the_)?(test|run|versuch|sliding)|"
     "(surface|oberfl\\w*|condition|zustand)_(after|nach)",
     When::per_test, Role::outcome},
    {"(^|_)(std(_?dev|_?abw)?|st_?dev|sd|standard_?(deviation|abweichung)|streuung|"
     "uncertainty|unsicherheit)(_|$)",
     When::per_test, Role::outcome},
    // Shapes of rings and cups, from which friction is read off
    {"(^|_)height_?ratio(_|$)|barrel|bulge|ausbauch|(^|_)(h|od|id|l)_?1(_|$)|^f_?max(_|$)|"
     "(^|_)(id|od|(inner|outer)_?diameter|(innen|au\\S*en)durchmesser)_?"
     "(end|final|change|top|bottom|\\S*nderung)(_|$)",
     When::per_test, Role::outcome},
    // A friction, temperature or forming force of a whole test
    {"(^|_)(mean|avg|average|mittl\\w*|max\\w*|peak|final|end)_(\\w+_)?"
     "(cof|mu|friction|reib\\w*|torque|drehmoment|temp\\w*)(_|$)|"
     "(^|_)(cof|mu|friction|reib\\w*|torque|drehmoment|temp\\w*)_(\\w+_)?"
     "(mean|avg|average|mittel\\w*|max\\w*|peak|final|end)(_|$)|"
     "(^|_)(punch|stempel|forming|umform|drawing|zieh|pull|ejection|auswerfer)_?(force|kraft)",
     When::per_test, Role::outcome},
};

// Names of readings of friction.
constexpr const char* friction_names =
    "(^|[^a-z])(cof|mu|friction|torque|drag|shear|pull|f_?[xtr])([^a-z]|$)|reib|friction|torque";

Given role_by_name(const std::string& name, bool within) {
  const std::string plain = plain_name(name);
  for (const NameRule& rule : name_rules)
    if ((rule.when == When::any || (rule.when == When::within) == within) &&
        has_match(rule.pattern, plain))
      return {rule.role, "by its name"};
  return {};
}

// Summary of a column over all parts, as needed for roles.
class Look {
public:
  Look(std::span<Dataset* const> parts, const std::string& name) {
    for (const Dataset* part : parts) {
      const Column* column = part->find(name);
      if (!column) continue;
      is_text = is_text || !column->levels.empty();
      for (std::size_t e = 0; e < part->experiments.size(); ++e)
        look_at(*column, part->first_row[e], part->first_row[e + 1]);
      rows += part->rows();
    }
  }

  std::size_t tests = 0, rows = 0, held = 0;
  std::size_t filled_tests = 0; // tests with a text
  std::set<std::string> words;
  std::set<double> values; // first ones of tests, and all while they are few
  bool is_text = false, within = false;
  bool is_constant() const { return is_text ? words.size() <= 1 : values.size() <= 1; }
  // Whether tests share the values that they were run at, as those of a length or a weight.
  bool is_set() const { return !within && (rows > tests || 2 * values.size() <= tests); }
  // Usual range within a test as a share of the range of the tests' means; NaN for text, or for
  // less than 3 tests.
  double share_within() const {
    if (means.size() < 3 || means.size() < tests) return no_value;
    const auto [low, high] = std::minmax_element(means.begin(), means.end());
    return median_of(ranges) / (*high - *low);
  }
  std::vector<double> means, ranges; // of the tests without an empty cell

private:
  void look_at(const Column& column, std::size_t begin, std::size_t end) {
    ++tests;
    bool filled = false;
    for (std::size_t i = begin; i < end; ++i) {
      const double value = column.values[i];
      const bool moves = i > begin && value != column.values[i - 1] &&
                         !(std::isnan(value) && std::isnan(column.values[i - 1]));
      within = within || moves;
      held += i > begin && !moves;
      if (is_text && i > begin && !moves) continue;
      if (is_text) {
        words.insert(column.levels[static_cast<std::size_t>(value)]);
        filled = filled || !column.levels[static_cast<std::size_t>(value)].empty();
      } else if ((i == begin || values.size() <= most_held) && !std::isnan(value)) {
        values.insert(value);
      }
    }
    filled_tests += filled;
    if (!is_text) look_at_numbers({column.values.data() + begin, end - begin});
  }

  // The range of a few rows, or of nine tenths of many: their ends are noise.
  void look_at_numbers(std::span<const double> of_test) {
    constexpr std::size_t many = 20;
    const double sum = std::accumulate(of_test.begin(), of_test.end(), 0.0);
    if (!std::isfinite(sum)) return;
    means.push_back(sum / static_cast<double>(of_test.size()));
    const double tail = of_test.size() < many ? 0 : 0.05;
    const std::vector<double> readings(of_test.begin(), of_test.end());
    ranges.push_back(quantile_of(readings, 1 - tail) - quantile_of(readings, tail));
  }
};

class RoleFinder {
public:
  RoleFinder(std::span<Dataset* const> parts, const DataOptions& options)
      : parts_(parts), options_(options) {
    std::set<std::string> known, of_states;
    for (const Column& column : parts.front()->columns)
      if (const Given said = role_known_without_values(column.name); !said.why.empty())
        (said.role == Role::state || said.role == Role::setting ? of_states : known)
            .insert(column.name);
    for (const Dataset* part : parts)
      units_ += units_of(*part).count;
    const std::vector<const Dataset*> all(parts.begin(), parts.end());
    if (parts.front()->has("tau_R_MPa")) disguises_ = find_disguises(all, known, of_states);
  }

  Given of(const Column& column) {
    const std::string& name = column.name;
    if (const Given said = role_known_without_values(name); !said.why.empty()) return said;
    const auto disguise = disguises_.find(name);
    if (disguise != disguises_.end() && disguise->second.sure)
      return {Role::response, disguise->second.how};
    const Look look(parts_, name);
    if (!look.is_text && !look.within && look.values.size() > 1)
      if (const Given set = nominal(name, look.values.size()); !set.why.empty()) return set;
    if (is_verdict(parts_, name)) return {Role::ignore, "a verdict on the test, no cause"};
    Given given = look.is_text ? of_text(name, look) : of_numbers(name, look);
    if (given.role != Role::setting && given.role != Role::channel && given.role != Role::outcome)
      return given;
    if (disguise != disguises_.end())
      given.why += question(name, disguise->second.how);
    else if (has_match(friction_names, plain_name(name)))
      given.why += question(name, "by its name");
    return given;
  }

private:
  // Role given by the job or by the definition of a quantity.
  Given role_known_without_values(const std::string& name) const {
    if (const auto said = options_.roles.find(name); said != options_.roles.end())
      return {said->second.role, set_by_job};
    if (is_measured(name)) return {Role::response, "what was measured of friction"};
    if (name == "time_s") return {Role::clock, "the time"};
    if (find_quantity(name)) return {Role::state, "a quantity that laws or routines take"};
    if (name == origin_column) return {Role::ignore, "says where rows come from"};
    if (name == interval_column) return {Role::setting, "number of the interval in its recording"};
    if (name == recording_column) return {Role::test, "which tests are of one recording"};
    if (name == direction_column) return {Role::setting, "sense of the motion"};
    return by_formula(name);
  }

  // Role of a formula's input: columns from which the job computes friction are responses, even if
  // a state is computed from them too; a length or a weight that was set is a state then. Columns
  // from which only a state is computed are states.
  Given by_formula(const std::string& name) const {
    std::string friction, state;
    for (const std::string& canonical : computed_from(options_, name))
      (is_measured(canonical) ? friction : state) = canonical;
    if (!friction.empty() && (state.empty() || !Look(parts_, name).is_set()))
      return {Role::response, friction + " is computed from it"};
    if (!state.empty()) return {Role::state, state + " is computed from it"};
    return {};
  }

  static std::string question(const std::string& name, const std::string& why) {
    return fmt::format("; another reading of the friction ({})? Then [data.roles] \"{}\" = "
                       "\"response\"",
                       why, name);
  }

  // A column with the set values of a state that was measured as well, or of a reading from which
  // the job computes one: a nominal load, in any unit that sets such a state.
  Given nominal(const std::string& name, std::size_t levels) const {
    for (const std::string& measured : measured_for_states()) {
      const auto slope = slope_along(name, measured);
      if (!slope) continue;
      const Quantity* const state = find_quantity(measured);
      const std::string unit = state ? state->unit : unit_of(measured);
      const SetKind *const kind = kind_of(name), *const of_measured =
                                                     state ? kind_of_unit(unit) : kind_of(measured);
      if (!unit_like(name, unit).empty() || (kind && kind == of_measured && *slope > 0) ||
          (!kind && unit_of(name).empty() && is_other_unit(*slope, levels)))
        return {Role::ignore, fmt::format("the set {}, which is measured", measured)};
    }
    return {};
  }

  // States that a rig sets, and the readings from which the job computes a state or friction.
  std::vector<std::string> measured_for_states() const {
    std::vector<std::string> names;
    for (const char* const state :
         {"sigma_n_MPa", "F_N_N", "v_rel_mm_s", "T_tool_C", "T_contact_C"})
      if (parts_.front()->has(state)) names.push_back(state);
    for (const Column& column : parts_.front()->columns)
      if (!find_quantity(column.name) && column.levels.empty() &&
          !computed_from(options_, column.name).empty() && Look(parts_, column.name).within)
        names.push_back(column.name);
    return names;
  }

  std::string unit_of(const std::string& name) const {
    const std::string& own = parts_.front()->find(name)->unit;
    return own.empty() ? io::read_header_name(name).unit : own;
  }

  // The column's unit if it converts to the wanted one; the end of a name goes before what a slash
  // seems to separate ("Speed mm/s").
  std::string unit_like(const std::string& name, const std::string& wanted) const {
    if (parts_.front()->find(name)->unit.empty())
      if (std::string in_name = unit_in_name(name, wanted); !in_name.empty()) return in_name;
    const std::string unit = unit_of(name);
    return convert(unit, wanted) ? unit : "";
  }

  // A kind of quantity that is set in several units: a speed in mm/s or by a number of turns.
  struct SetKind {
    std::array<const char*, 3> units;
    const char* names; // of columns without a unit
  };
  static constexpr SetKind set_kinds[] = {
      {{"N", "MPa", "kg"}, "(^|_)(load|force|fn|f_n|pressure)(_|$)|(kraft|last|druck)(_|$)"},
      {{"mm/s", "1/min", "rpm"}, "(^|_)(speed|velocity|rpm|u_min)(_|$)|geschw|drehzahl"}};

  static const SetKind* kind_of_unit(const std::string& unit) {
    for (const SetKind& kind : set_kinds)
      for (const char* const one : kind.units)
        if (convert(unit, one)) return &kind;
    return nullptr;
  }

  // nullptr for a column of another kind.
  const SetKind* kind_of(const std::string& name) const {
    for (const SetKind& kind : set_kinds)
      for (const char* const one : kind.units)
        if (const std::string unit = unit_like(name, one);
            !unit.empty() && unit != "mg") // a dose, no weight that presses
          return &kind;
    for (const SetKind& kind : set_kinds)
      if (unit_of(name).empty() && has_match(kind.names, plain_name(name))) return &kind;
    return nullptr;
  }

  // The ratio of one unit to another, where the file gives none: 50 for 0.05 MPa. Two levels may
  // have such a ratio by chance.
  static bool is_other_unit(double ratio, std::size_t levels) {
    constexpr double near = 0.02;
    const double tens = std::log10(ratio);
    return ratio > 0 && std::abs(tens - std::round(tens)) < near &&
           (levels > 2 || std::abs(tens) < near);
  }

  // The slope if the state's middles of the tests are in proportion to the column, to within a
  // twentieth. (A mean would count the way up to a set speed as well.) Temperatures have to be a
  // straight line.
  std::optional<double> slope_along(const std::string& name, const std::string& state) const {
    constexpr double near = 0.05;
    std::vector<double> x, y;
    for (const Dataset* part : parts_)
      for (std::size_t e = 0; part->has(name) && e < part->experiments.size(); ++e) {
        const std::size_t begin = part->first_row[e], end = part->first_row[e + 1];
        const auto values = part->values(state).subspan(begin, end - begin);
        x.push_back(part->values(name)[begin]);
        y.push_back(median_of({values.begin(), values.end()}));
      }
    const double n = static_cast<double>(x.size());
    const bool at_zero = !state.starts_with("T_");
    const double mx = at_zero ? 0 : std::accumulate(x.begin(), x.end(), 0.0) / n,
                 my = at_zero ? 0 : std::accumulate(y.begin(), y.end(), 0.0) / n;
    double xx = 0, xy = 0, most = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      xx += (x[i] - mx) * (x[i] - mx);
      xy += (x[i] - mx) * (y[i] - my);
      most = std::max(most, std::abs(y[i] - my));
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double size = at_zero ? std::abs(y[i]) : most;
      if (!(std::abs(y[i] - my - xy / xx * (x[i] - mx)) <= near * size)) return {};
    }
    return x.empty() ? std::nullopt : std::optional(xy / xx);
  }

  // Whether a text names what differs between recordings by intent, even if each has its own.
  static bool names_what_rubs(const std::string& plain) {
    return has_match("lubri|(^|_)oil|grease|fluid|schmier|(^|_)fett|coating|beschicht|material|"
                     "werkstoff|additiv|alloy|legierung",
                     plain);
  }

  Given of_text(const std::string& name, const Look& look) {
    const Given named = role_by_name(name, look.within);
    if (named.role == Role::ignore || named.role == Role::order || named.role == Role::outcome ||
        (named.role == Role::test &&
         has_match("^(test|versuch|experiment|specimen)_", plain_name(name))))
      return named;
    const std::size_t words = look.words.size() - look.words.count("");
    if (look.is_constant()) return {Role::label, "one value in all tests"};
    const std::size_t usable = std::max<std::size_t>(2, units_ / 2);
    const bool by_recording = units_ < look.tests && look.words.size() <= units_;
    if (look.words.size() > usable && !(by_recording && names_what_rubs(plain_name(name))))
      return {Role::ignore,
              fmt::format("{}{} values in {} {}",
                          look.filled_tests == look.tests ? many_texts : "free text: ",
                          look.words.size(), units_, units_ < look.tests ? "recordings" : "tests")};
    if (4 * look.filled_tests < look.tests && 2 * words > look.filled_tests)
      return {Role::ignore,
              fmt::format("free text: a remark in {} of {} tests", look.filled_tests, look.tests)};
    return {Role::label, fmt::format("{} levels", look.words.size())};
  }

  Given of_numbers(const std::string& name, const Look& look) const {
    if (look.is_constant()) return {Role::setting, "one value in all rows"};
    if (const Given named = role_by_name(name, look.within); !named.why.empty()) return named;
    const bool one_row_each = look.rows == look.tests;
    if (!look.within && one_row_each && look.values.size() > look.tests / 2)
      return {Role::setting, "one value per test; known before it, not measured in it?"};
    if (!look.within)
      return {Role::setting, fmt::format("one value per test, {} of them", look.values.size())};
    if (look.values.size() <= most_held && look.rows > look.tests &&
        look.held * (rows_held + 1) >= (look.rows - look.tests) * rows_held)
      return {Role::setting, fmt::format("held at {} values within tests", look.values.size())};
    if (hardly_moves(name, look)) {
      const auto [low, high] = std::minmax_element(look.means.begin(), look.means.end());
      return {Role::setting,
              fmt::format("moves by {:.2g} in a test, {:.4g} to {:.4g} between them",
                          median_of(look.ranges), *low, *high),
              true};
    }
    return {Role::channel, "varies within tests, measured along with friction"};
  }

  // Whether a column is all but constant in each test, and much more so than friction, from which
  // it can therefore not follow. Of the surroundings a larger share is noise: the air's humidity.
  // Another reading of a state is none.
  bool hardly_moves(const std::string& name, const Look& look) const {
    constexpr double most = 0.03, of_surroundings = 0.25, of_friction = 1.0 / 3, of_state = 0.95;
    const double share = look.share_within();
    if (names_surroundings(words_of_name(name)) && share <= of_surroundings) return true;
    if (!(share <= most) || !parts_.front()->has("tau_R_MPa") ||
        !(share <= of_friction * Look(parts_, "tau_R_MPa").share_within()))
      return false;
    const std::vector<std::string> states = measured_for_states();
    return std::none_of(states.begin(), states.end(), [&](const std::string& state) {
      return squared_correlation_of(look.means, Look(parts_, state).means) > of_state;
    });
  }

  static double squared_correlation_of(const std::vector<double>& x, const std::vector<double>& y) {
    if (x.size() != y.size()) return 0;
    const auto n = static_cast<double>(x.size());
    const double mx = std::accumulate(x.begin(), x.end(), 0.0) / n,
                 my = std::accumulate(y.begin(), y.end(), 0.0) / n;
    double xx = 0, xy = 0, yy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      xx += (x[i] - mx) * (x[i] - mx);
      xy += (x[i] - mx) * (y[i] - my);
      yy += (y[i] - my) * (y[i] - my);
    }
    return xx * yy > 0 ? xy * xy / (xx * yy) : 0;
  }

  std::span<Dataset* const> parts_;
  const DataOptions& options_;
  std::map<std::string, Disguise> disguises_;
  std::size_t units_ = 0; // tests; recordings where these hold several tests
};

void check_names(const Dataset& data, const DataOptions& options, FaultList& faults) {
  std::vector<std::string> known;
  for (const Column& column : data.columns)
    if (!find_quantity(column.name)) known.push_back(column.name);
  for (const auto& [name, wish] : options.roles)
    if (std::find(known.begin(), known.end(), name) == known.end())
      faults.add(wish.place,
                 find_quantity(name)
                     ? fmt::format("data.roles: {} is a quantity, no recorded column", name)
                     : fmt::format("data.roles: the data have no column '{}'", name),
                 find_quantity(name) ? "roles are those of the other columns; trace.ignore takes a "
                                       "state out of the search"
                                     : suggest(name, known));
}

} // namespace

const char* role_name(Role role) {
  return role_words[static_cast<std::size_t>(role)];
}

std::vector<std::string> role_names() {
  return {role_words.begin() + static_cast<long>(Role::response), role_words.end()};
}

bool may_be_cause(Role role) {
  return role == Role::undecided || role == Role::state || role == Role::setting ||
         role == Role::label;
}

bool may_be_searched(Role role) {
  return may_be_cause(role) || role == Role::order;
}

bool may_follow_friction(Role role) {
  return role == Role::channel || role == Role::outcome;
}

bool is_judgement(const Column& column) {
  return is_verdict(column) || role_by_name(column.name, false).role == Role::ignore;
}

bool is_order(const Column& column) {
  return column.role == Role::order ||
         (column.role == Role::undecided && role_by_name(column.name, false).role == Role::order);
}

namespace {

void set_role(std::span<Dataset* const> parts, const std::string& name, const Given& given) {
  for (Dataset* part : parts)
    for (Column& column : part->columns) {
      if (column.name != name) continue;
      column.role = given.role;
      column.why = given.why;
    }
  if (!given.moves_by_noise) return;
  take_mean_of_tests(parts, name);
  parts.front()->notes.push_back(
      fmt::format("{} {}: the mean of each test is taken", name, given.why));
}

void look_at_setting(std::span<Dataset* const> parts, const std::string& name) {
  const Look look(parts, name);
  if (!look.within) fill_missing_setting(parts, name);
  if (!look.within && look.rows == look.tests && look.values.size() > look.tests / 2)
    ask_if_reading(parts, name);
}

} // namespace

void find_roles(std::span<Dataset* const> parts, const DataOptions& options, FaultList& faults) {
  check_names(*parts.front(), options, faults);
  RoleFinder finder(parts, options);
  for (const Column& column : parts.front()->columns) {
    const Given given = finder.of(column);
    set_role(parts, column.name, given);
    if (given.role == Role::setting && column.levels.empty() && !find_quantity(column.name))
      look_at_setting(parts, column.name);
    if (given.role == Role::ignore && given.why != set_by_job) report_bad_tests(parts, column.name);
    if (given.role == Role::response && !find_quantity(column.name))
      parts.front()->notes.push_back(fmt::format(
          "{} belongs to the measured friction, no cause of it: {}", column.name, given.why));
  }
  ignore_repeated_columns(parts);
}

} // namespace frictab::data
