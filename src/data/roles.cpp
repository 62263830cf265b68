// Assigns roles by the job first, then by the data, then by names.
#include "data/roles.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "core/no_value.h"
#include "core/pattern.h"
#include "core/text.h"
#include "core/units.h"
#include "data/clear_levels.h"
#include "data/name_words.h"
#include "data/computed.h"
#include "data/disguise.h"
#include "data/middle.h"
#include "data/quantity.h"
#include "data/recordings.h"
#include "data/scale.h"
#include "data/signs.h"
#include "expr/expr.h"

namespace frictab::data {

namespace {

constexpr std::array<const char*, 11> role_words = {"",        "state",   "response", "setting",
                                                    "channel", "outcome", "label",    "order",
                                                    "clock",   "test",    "ignore"};

constexpr const char* verdict_why = "a verdict on the test, no cause";

// A column with at most most_held values within a test, each for at least rows_held rows, was set
// by the rig.
constexpr std::size_t most_held = 12, rows_held = 5;

struct Given {
  Role role = Role::undecided;
  std::string why;
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
    {"^(rep|repeat|repetition|replicate|wiederholung|wdh)_?(id|no|nr|number)?$", When::per_test,
     Role::ignore},
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

// Names and texts of a verdict on a test, which somebody passed on it when it was over.
constexpr const char* verdict_names =
    "^((is|test|run|versuch|messung|data)_)?"
    "(in|un)?(valid(ity|ated)?|g\\S*ltig(keit)?|usable|verwendbar|brauchbar|accept(ed|able)?|"
    "pass(ed)?|fail(ed)?|ok|n?io|outlier|ausrei\\S*er|excluded?|reject(ed)?|discard(ed)?|"
    "use(_it)?|do_not_use)(_(test|run|versuch|flag|status))?$";
constexpr const char* judged_names =
    "verdict|urteil|bewertung|befund|status|quality|qualit|check|flag|rating|result|ergebnis";
constexpr const char* remark_of_the_bad = "do not use|don't use|not valid|invalid|discard|nicht "
                                          "(verwenden|verwertbar)|ung\\S*ltig|verwerfen";
constexpr const char* names_of_the_bad = // true of a test that failed
    "^(\\w+_)?(in|un)(valid|g\\S*ltig|usable|brauchbar)|fail|outlier|ausrei|exclude|reject|discard|"
    "do_not_use";
constexpr std::array yes_words{"true", "yes", "ja", "y", "j", "1", "x", "wahr"};
constexpr std::array no_words{"false", "no", "nein", "n", "0", "falsch", "-"};
constexpr std::array good_words{"ok",          "i.o.",    "i.o",  "io",     "i. o.",    "valid",
                                "g\u00fcltig", "gueltig", "pass", "passed", "accepted", "use"};
constexpr std::array bad_words{
    "nok",    "n.ok",     "not ok",     "not o.k.",      "n.i.o.",    "n.i.o",
    "nio",    "n. i. o.", "invalid",    "ung\u00fcltig", "ungueltig", "fail",
    "failed", "rejected", "do not use", "not valid",     "excluded",  "nicht verwenden"};
// A surface may be good or bad as well: only of a column that is named like a verdict.
constexpr std::array good_or_bad{"good", "gut", "bad", "schlecht"};

// In lower case, with _ between words: "Mass loss [mg]" is mass_loss_mg.
std::string plain_name(const std::string& name) {
  return replace_all(words_of_name(name), " ", "_");
}

bool fits(const char* pattern, const std::string& plain) {
  return Pattern(pattern, {}).search(plain).has_value();
}

template <class Words> bool is_one_of(const Words& words, const std::string& text) {
  return std::find(words.begin(), words.end(), text) != words.end();
}

// The texts of a verdict on tests that are bad; nullopt for another column. Yes and no need a name
// that says what they answer; "ok" and "nok" do not.
std::optional<std::set<std::string>> bad_of_verdict(const std::string& name,
                                                    const std::set<std::string>& texts) {
  constexpr std::size_t most = 3; // with an empty cell
  const std::string plain = plain_name(name);
  if (texts.size() < 2 || texts.size() > most) return {};
  const bool named = fits(verdict_names, plain), of_the_bad = fits(names_of_the_bad, plain),
             judged = named || fits(judged_names, plain);
  std::set<std::string> bad;
  std::size_t answers = 0;
  for (const std::string& text : texts) {
    const std::string word = lower_case(trimmed(text));
    const bool is_yes = is_one_of(yes_words, word), is_no = is_one_of(no_words, word);
    const bool graded = judged && is_one_of(good_or_bad, word);
    if (is_one_of(bad_words, word) || (graded && (word == "bad" || word == "schlecht")) ||
        (named && (of_the_bad ? is_yes : is_no)))
      bad.insert(text);
    answers += is_yes || is_no;
    if (!word.empty() && !is_yes && !is_no && !graded && !is_one_of(good_words, word) &&
        !is_one_of(bad_words, word))
      return {};
  }
  if (bad.empty() || (!named && answers > 0)) return {};
  return bad;
}

// Texts of a column while they are few; its numbers only if it is named like a verdict.
std::set<std::string> texts_of(const Column& column) {
  constexpr std::size_t few = 4;
  if (column.levels.empty() && !fits(verdict_names, plain_name(column.name))) return {};
  std::set<double> values;
  for (std::size_t i = 0; i < column.values.size() && values.size() < few; ++i)
    if (!std::isnan(column.values[i])) values.insert(column.values[i]);
  std::set<std::string> texts;
  for (const double value : values)
    texts.insert(column.levels.empty() ? shortest(value)
                                       : column.levels[static_cast<std::size_t>(value)]);
  return texts;
}

Given role_by_name(const std::string& name, bool within) {
  const std::string plain = plain_name(name);
  for (const NameRule& rule : name_rules)
    if ((rule.when == When::any || (rule.when == When::within) == within) &&
        fits(rule.pattern, plain))
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

  void look_at_numbers(std::span<const double> of_test) {
    double low = of_test.front(), high = low, sum = 0;
    for (const double value : of_test) {
      low = std::min(low, value);
      high = std::max(high, value);
      sum += value;
    }
    if (!std::isfinite(sum)) return;
    means.push_back(sum / static_cast<double>(of_test.size()));
    ranges.push_back(high - low);
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
    if (is_verdict(name)) return {Role::ignore, verdict_why};
    Given given = look.is_text ? of_text(name, look) : of_numbers(name, look);
    if (given.role != Role::setting && given.role != Role::channel && given.role != Role::outcome)
      return given;
    if (disguise != disguises_.end())
      given.why += question(name, disguise->second.how);
    else if (fits(friction_names, plain_name(name)))
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

  bool is_verdict(const std::string& name) const {
    std::set<std::string> texts;
    for (const Dataset* part : parts_)
      if (const Column* column = part->find(name)) texts.merge(texts_of(*column));
    return bad_of_verdict(name, texts).has_value();
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
      if (unit_of(name).empty() && fits(kind.names, plain_name(name))) return &kind;
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

  Given of_text(const std::string& name, const Look& look) {
    const Given named = role_by_name(name, look.within);
    if (named.role == Role::ignore || named.role == Role::order || named.role == Role::outcome ||
        (named.role == Role::test &&
         fits("^(test|versuch|experiment|specimen)_", plain_name(name))))
      return named;
    const std::size_t words = look.words.size() - look.words.count("");
    if (look.is_constant()) return {Role::label, "one value in all tests"};
    const std::size_t usable = std::max<std::size_t>(2, units_ / 2);
    if (look.words.size() > usable)
      return {Role::ignore,
              fmt::format("{}{} values in {} tests",
                          look.filled_tests == look.tests ? many_texts : "free text: ",
                          look.words.size(), units_)};
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
    if (hardly_moves(look)) {
      const auto [low, high] = std::minmax_element(look.means.begin(), look.means.end());
      return {Role::setting, fmt::format("moves by {:.2g} in a test, {:.4g} to {:.4g} between them",
                                         median_of(look.ranges), *low, *high)};
    }
    return {Role::channel, "varies within tests, measured along with friction"};
  }

  // Whether a column is all but constant in each test, and much more so than friction, from which
  // it can therefore not follow: the air's humidity. Another reading of a state is none.
  bool hardly_moves(const Look& look) const {
    constexpr double most = 0.03, of_friction = 1.0 / 3, of_state = 0.95;
    const double share = look.share_within();
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
  return bad_of_verdict(column.name, texts_of(column)).has_value() ||
         role_by_name(column.name, false).role == Role::ignore;
}

bool is_order(const Column& column) {
  return column.role == Role::order ||
         (column.role == Role::undecided && role_by_name(column.name, false).role == Role::order);
}

namespace {

// Texts of the tests of all parts; empty for a column that changes within a test.
std::vector<std::string> texts_of_tests(std::span<Dataset* const> parts, const std::string& name) {
  std::vector<std::string> texts;
  for (const Dataset* part : parts) {
    const Column* column = part->find(name);
    if (!column) return {};
    for (std::size_t e = 0; e < part->experiments.size(); ++e) {
      const double first = column->values[part->first_row[e]];
      for (std::size_t i = part->first_row[e]; i < part->first_row[e + 1]; ++i)
        if (column->values[i] != first) return {};
      texts.push_back(column->levels.empty() ? fmt::format("{}", first)
                                             : column->levels[static_cast<std::size_t>(first)]);
    }
  }
  return texts;
}

void set_role(std::span<Dataset* const> parts, const std::string& name, const Given& given) {
  for (Dataset* part : parts)
    for (Column& column : part->columns)
      if (column.name == name) {
        column.role = given.role;
        column.why = given.why;
      }
}

// Parts of file names are called name1, x2_MPa, ...
bool is_part_of_name(const std::string& name) {
  return fits("^(name|x)[0-9]+($|_)", name);
}

// Leaves out columns that repeat another one in every test: they cannot be causes of their own.
void drop_repeated_columns(std::span<Dataset* const> parts) {
  std::map<std::vector<std::string>, std::vector<std::string>> alike; // texts -> columns
  for (const Column& column : parts.front()->columns)
    if ((column.role == Role::label || column.role == Role::setting ||
         (column.role == Role::test && !column.levels.empty())) &&
        column.why != set_by_job && !find_quantity(column.name))
      if (auto texts = texts_of_tests(parts, column.name); !texts.empty())
        alike[std::move(texts)].push_back(column.name);
  for (auto& [texts, names] : alike) {
    if (std::set<std::string>(texts.begin(), texts.end()).size() < 2) continue;
    std::stable_partition(names.begin(), names.end(),
                          [](const std::string& name) { return !is_part_of_name(name); });
    for (std::size_t i = 1; i < names.size(); ++i)
      set_role(parts, names[i], {Role::ignore, "the same as " + names.front() + " in every test"});
  }
}

// The texts of a verdict, or of remarks, on tests that are bad.
std::set<std::string> bad_texts(std::span<Dataset* const> parts, const std::string& name) {
  const Pattern remark(remark_of_the_bad, {});
  std::set<std::string> texts, bad;
  for (const Dataset* part : parts)
    if (const Column* column = part->find(name)) {
      texts.merge(texts_of(*column));
      for (const std::string& level : column->levels)
        if (remark.search(lower_case(level))) bad.insert(level);
    }
  return bad_of_verdict(name, texts).value_or(bad);
}

// Notes the tests that are judged to be bad and are used, and the way to leave them out.
void report_bad_tests(std::span<Dataset* const> parts, const std::string& name) {
  const std::set<std::string> bad = bad_texts(parts, name);
  std::vector<std::string> tests, quoted;
  for (const std::string& text : bad)
    quoted.push_back("\"" + text + "\"");
  for (const Dataset* part : parts)
    if (const Column* column = part->find(name))
      for (std::size_t e = 0; e < part->experiments.size(); ++e) {
        const auto begin = column->values.begin() + static_cast<long>(part->first_row[e]),
                   end = column->values.begin() + static_cast<long>(part->first_row[e + 1]);
        if (std::any_of(begin, end, [&](double value) {
              return column->levels.empty()
                         ? bad.count(shortest(value)) > 0
                         : bad.count(column->levels[static_cast<std::size_t>(value)]) > 0;
            }))
          tests.push_back(part->experiments[e]);
      }
  if (tests.empty()) return;
  constexpr std::size_t shown = 3;
  const std::size_t more = tests.size() - std::min(tests.size(), shown);
  tests.resize(tests.size() - more);
  const std::string key = expr::is_name(name) ? name : "\"" + name + "\"";
  parts.front()->implausible.push_back(
      fmt::format("{} is {} in '{}'{}: judged to be bad, and used; data.drop = {{ {} = [{}] }} "
                  "leaves such rows "
                  "out",
                  name, join(quoted, " or "), join(tests, "', '"), and_more(more, "test"), key,
                  join(quoted, ", ")));
}

// ---- names of combinations ----

// Names that people give to combinations of settings.
constexpr const char* combination_names =
    "^((test|versuchs?|mess|exp|experiment|replicates?|repeat|wiederhol\\w*|parameter|process|run|"
    "sample|proben|load)_?)?(group|gruppe|series|serie|reihe|condition|bedingung|combination|combo|"
    "kombination|configuration|config|case|variante?|block|cell|zelle|design_?point)"
    "(en|s)?(_?(id|no|nr|number|nummer|name))?$";

// Setting of the tests: one value of each.
struct Factor {
  std::string name;
  std::vector<std::size_t> of; // level of each test
  std::size_t count = 0;
  std::vector<std::string> texts; // of each test
};

// Recorded columns with values that tests share.
std::optional<Factor> factor_of(std::span<Dataset* const> parts, const std::string& name) {
  Factor factor{name, {}, 0, texts_of_tests(parts, name)};
  const std::set<std::string> levels(factor.texts.begin(), factor.texts.end());
  if (levels.size() < 2 || 2 * levels.size() > factor.texts.size()) return {};
  for (const std::string& text : factor.texts)
    factor.of.push_back(static_cast<std::size_t>(std::distance(levels.begin(), levels.find(text))));
  factor.count = levels.size();
  return factor;
}

// States that were run at clear levels. Their texts are the tests' means.
std::optional<Factor> factor_of_state(std::span<Dataset* const> parts, const Quantity& state) {
  std::vector<double> means;
  for (const Dataset* part : parts) {
    if (!part->has(state.name)) return {};
    const auto values = part->values(state.name);
    for (std::size_t e = 0; e < part->experiments.size(); ++e)
      means.push_back(
          std::accumulate(values.begin() + static_cast<std::ptrdiff_t>(part->first_row[e]),
                          values.begin() + static_cast<std::ptrdiff_t>(part->first_row[e + 1]),
                          0.0) /
          static_cast<double>(part->first_row[e + 1] - part->first_row[e]));
  }
  if (!std::all_of(means.begin(), means.end(), [](double x) { return std::isfinite(x); }))
    return {};
  Factor factor{state.name, {}, 0, {}};
  for (double& mean : means) {
    factor.texts.push_back(fmt::format("{}", mean));
    if (state.log_axis && mean > 0) mean = std::log(mean);
  }
  ClearLevels levels = clear_levels(means, 0);
  if (levels.count < 2) return {};
  factor.of = std::move(levels.of);
  factor.count = levels.count;
  return factor;
}

// Words and numbers of a text: "base", "4" and "mpa" of "Base_4MPa".
std::vector<std::string> pieces_of(const std::string& text) {
  std::vector<std::string> pieces;
  int before = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const int kind = std::isdigit(byte) || c == '.'       ? 1
                     : std::isalpha(byte) || byte >= 0x80 ? 2
                                                          : 0;
    if (kind != 0 && kind != before) pieces.emplace_back();
    if (kind != 0) pieces.back() += static_cast<char>(std::tolower(byte));
    before = kind;
  }
  return pieces;
}

// Whether the name's text of every test holds the factor's: a word, or a number to within a tenth.
bool is_named_in(const Factor& name, const Factor& factor) {
  constexpr double near = 0.1;
  for (std::size_t e = 0; e < name.of.size(); ++e) {
    const std::vector<std::string> there = pieces_of(name.texts[e]);
    double number = 0;
    const char* const end = factor.texts[e].data() + factor.texts[e].size();
    const auto read = std::from_chars(factor.texts[e].data(), end, number);
    const bool is_number = read.ec == std::errc() && read.ptr == end;
    const auto holds = [&](const std::string& piece) {
      return std::find(there.begin(), there.end(), piece) != there.end();
    };
    const auto is_near = [&](const std::string& piece) {
      double value = 0;
      return std::from_chars(piece.data(), piece.data() + piece.size(), value).ec == std::errc() &&
             std::abs(value - number) <= near * std::abs(number);
    };
    const std::vector<std::string> own = pieces_of(factor.texts[e]);
    if (is_number ? std::none_of(there.begin(), there.end(), is_near)
                  : own.empty() || !std::all_of(own.begin(), own.end(), holds))
      return false;
  }
  return true;
}

// Whether each level of `name` has one level of the factor.
bool has_one_each(const Factor& name, const Factor& factor) {
  std::map<std::size_t, std::size_t> level;
  for (std::size_t e = 0; e < name.of.size(); ++e)
    if (level.emplace(name.of[e], factor.of[e]).first->second != factor.of[e]) return false;
  return factor.count < name.count;
}

std::size_t count_combinations(const std::vector<const Factor*>& factors) {
  std::set<std::vector<std::size_t>> all;
  for (std::size_t e = 0; e < factors.front()->of.size(); ++e) {
    std::vector<std::size_t> at;
    for (const Factor* factor : factors)
      at.push_back(factor->of[e]);
    all.insert(std::move(at));
  }
  return all.size();
}

// The settings whose combinations a column names, if its own name or its texts say so: one level
// for each combination. Empty otherwise, as for a lubricant that was tried at one load alone.
std::vector<std::string> named_combination(const Factor& column, bool is_text,
                                           const std::vector<Factor>& factors) {
  std::vector<const Factor*> refined, in_texts;
  for (const Factor& factor : factors) {
    if (factor.name == column.name || !has_one_each(column, factor)) continue;
    refined.push_back(&factor);
    if (is_text && is_named_in(column, factor)) in_texts.push_back(&factor);
  }
  const bool by_name = fits(combination_names, plain_name(column.name));
  for (const auto& some : {in_texts, by_name ? refined : in_texts}) {
    if (some.size() < 2 || count_combinations(some) != column.count) continue;
    std::vector<std::string> names;
    for (const Factor* factor : some)
      names.push_back(factor->name);
    return names;
  }
  return {};
}

// Leaves out columns that name combinations of the others: they would explain all that those do,
// and could not be set to anything new.
void drop_names_of_combinations(std::span<Dataset* const> parts) {
  std::vector<Factor> factors;
  for (const Column& column : parts.front()->columns) {
    const Quantity* const state = find_quantity(column.name);
    const bool is_state = state && state->state && column.name != "s_mm";
    if (!is_state && column.role != Role::label && column.role != Role::setting) continue;
    if (auto factor = is_state ? factor_of_state(parts, *state) : factor_of(parts, column.name))
      factors.push_back(std::move(*factor));
  }
  for (const Factor& factor : factors) {
    const Column& column = *parts.front()->find(factor.name);
    if (find_quantity(column.name) || column.why == set_by_job) continue;
    const std::vector<std::string> names =
        named_combination(factor, !column.levels.empty(), factors);
    if (!names.empty())
      set_role(parts, factor.name, {Role::ignore, "names combinations of " + join(names, ", ")});
  }
}

} // namespace

void find_roles(std::span<Dataset* const> parts, const DataOptions& options, FaultList& faults) {
  check_names(*parts.front(), options, faults);
  RoleFinder finder(parts, options);
  for (const Column& column : parts.front()->columns) {
    const Given given = finder.of(column);
    set_role(parts, column.name, given);
    if (given.role == Role::ignore && given.why != set_by_job) report_bad_tests(parts, column.name);
    if (given.role == Role::response && !find_quantity(column.name))
      parts.front()->notes.push_back(fmt::format(
          "{} belongs to the measured friction, no cause of it: {}", column.name, given.why));
  }
  drop_repeated_columns(parts);
  drop_names_of_combinations(parts);
}

} // namespace frictab::data
