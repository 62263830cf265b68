#include "job/answers.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/names.h"
#include "core/text.h"
#include "core/units.h"
#include "data/quantity.h"
#include "data/scale.h"
#include "io/number.h"
#include "job/open_points.h"

namespace frictab::job {

namespace {

constexpr const char* coefficient_name = "mu"; // as users call the coefficient of friction

// A number above 0, with either decimal sign.
std::optional<double> positive(std::string_view text) {
  text = trimmed(text);
  double value = 0;
  if (!io::read_number(text, '.', value) && !io::read_number(text, ',', value)) return std::nullopt;
  return std::isfinite(value) && value > 0 ? std::optional(value) : std::nullopt;
}

std::string no_number(const std::string& answer) {
  return fmt::format("'{}' is not a number above 0", printable(answer));
}

class Interview {
public:
  Interview(guess::Campaign campaign, const AskUser& ask)
      : campaign_(std::move(campaign)), ask_(ask), most_(guess::most_common(campaign_.files)) {
    for (std::size_t f = 0; f < campaign_.files.size(); ++f)
      if (campaign_.files[f].is_read_as(campaign_.files[most_])) alike_.push_back(f);
  }

  guess::Campaign hold() {
    if (!campaign_.files[most_].header) ask_for_names();
    take_known_formulas(campaign_);
    if (points().lacks_tests()) ask_for_tests();
    if (points().lacks_friction()) ask_for_friction();
    if (points().lacks_normal_force()) ask_for_normal_force();
    if (points().lacks_pressure()) ask_for_pressure();
    ask_for_units();
    if (!points().has("sigma_f_MPa")) ask_for_flow_stress();
    if (!points().has("v_rel_mm_s")) ask_for_speed();
    return std::move(campaign_);
  }

private:
  OpenPoints points() const { return OpenPoints(campaign_); }
  const std::vector<guess::Column>& columns() const { return campaign_.files[most_].columns; }

  // Asks until `take` accepts the answer, which returns what is wrong with it; an empty answer
  // leaves the point open.
  template <class Take> void ask(std::string lines, const std::string& kind, const Take& take) {
    lines += fmt::format("  {}, or Enter to leave it open: ", kind);
    while (!is_over_) {
      const std::optional<std::string> line = ask_(lines);
      is_over_ = !line;
      const std::string answer(trimmed(line.value_or("")));
      if (answer.empty()) return;
      const std::string wrong = take(answer);
      if (wrong.empty()) return;
      lines = fmt::format("  {}\n  {}, or Enter to leave it open: ", wrong, kind);
    }
  }

  // Columns without a meaning, with their first values, numbered from 1.
  std::vector<std::size_t> open_columns(bool numbers_only) const {
    std::vector<std::size_t> out;
    for (std::size_t c = 0; c < columns().size(); ++c)
      if (columns()[c].canonical.empty() && !(numbers_only && columns()[c].text)) out.push_back(c);
    return out;
  }
  std::string list_of(const std::vector<std::size_t>& open) const {
    std::string lines;
    for (std::size_t i = 0; i < open.size(); ++i)
      lines += fmt::format("  {:>4}  {} ({})\n", i + 1, printable(shown_name(columns()[open[i]])),
                           printable(columns()[open[i]].first_values));
    return lines;
  }

  // The column with this number in the list, or this name.
  std::optional<std::size_t> chosen(const std::string& answer,
                                    const std::vector<std::size_t>& open) const {
    for (std::size_t i = 0; i < open.size(); ++i)
      if (answer == std::to_string(i + 1) ||
          lower_case(answer) == lower_case(columns()[open[i]].name))
        return open[i];
    return std::nullopt;
  }
  std::string not_a_column(const std::string& answer, const std::vector<std::size_t>& open) const {
    const auto names = all_names(open, [&](std::size_t c) { return columns()[c].name; });
    return fmt::format("'{}' is none of them: {}", printable(answer), suggest(answer, names));
  }

  // Files that are read alike may have further columns, in another order.
  template <class Change> void change(std::size_t column, const Change& change) {
    const guess::Column meant = columns()[column];
    for (const std::size_t f : alike_)
      for (guess::Column& one : campaign_.files[f].columns)
        if (one.name == meant.name && one.number == meant.number) change(one);
  }
  void name(std::size_t column, const std::string& canonical, bool coefficient = false) {
    change(column, [&](guess::Column& one) {
      one.canonical = canonical;
      one.coefficient = coefficient;
    });
  }

  // Quantity of each column of files without a line of names.
  void ask_for_names() {
    std::vector<std::string> known = {coefficient_name, "experiment"};
    for (const data::Quantity& quantity : data::quantities())
      known.push_back(quantity.name);
    for (std::size_t c = 0; c < columns().size(); ++c) {
      change(c, [&](guess::Column& one) { one.number = c + 1; });
      ask(fmt::format("What is column {} ({})?\n", c + 1, printable(columns()[c].first_values)),
          "a name of frictab list quantities, mu or experiment", [&](const std::string& answer) {
            if (std::ranges::find(known, answer) == known.end())
              return fmt::format("'{}' is not a quantity: {}", printable(answer),
                                 suggest(answer, known));
            const bool mu = answer == coefficient_name;
            const std::string canonical = mu ? "tau_R_MPa" : answer;
            if (points().has(canonical))
              return fmt::format("{} is another column already", canonical);
            name(c, canonical, mu);
            return std::string();
          });
    }
  }

  void ask_for_tests() {
    const auto open = open_columns(false);
    if (open.empty()) return;
    ask("Which column names the tests? None was found: the file is taken as one test.\n" +
            list_of(open),
        "its number or name",
        [&](const std::string& answer) { return take_column(answer, "experiment", open); });
  }

  void ask_for_friction() {
    const OpenPoints now = points();
    if (const guess::Column* const torque = now.torque()) {
      ask(torque_question(*torque) + "\n", "a number in mm", [&](const std::string& answer) {
        const auto radius_mm = positive(answer);
        if (!radius_mm) return no_number(answer);
        const std::string formula = force_of_torque(*torque, shortest(*radius_mm / 1000));
        for (const std::size_t f : alike_)
          campaign_.files[f].friction = {formula, "the torque over the radius, in m, as answered"};
        return std::string();
      });
      return;
    }
    if (const guess::Column* const voltage = now.aid(guess::Aid::voltage)) {
      ask_for_calibration(*voltage);
      return;
    }
    const auto open = open_columns(true);
    if (open.empty()) return;
    std::optional<std::size_t> column;
    ask("Which column is friction? No force, stress or coefficient was found.\n" + list_of(open),
        "its number or name", [&](const std::string& answer) {
          column = chosen(answer, open);
          return column ? "" : not_a_column(answer, open);
        });
    if (column) ask_for_form(*column);
  }

  // The friction force from the voltage of its cell: with the factor that the files give, or one
  // that is answered.
  void ask_for_calibration(const guess::Column& voltage) {
    const guess::Column* const calibration = points().aid(guess::Aid::calibration);
    const auto take = [&](const std::string& factor, const char* comment) {
      const guess::Formula formula = {force_of_voltage(voltage, calibration, factor), comment};
      for (const std::size_t f : alike_)
        campaign_.files[f].friction = formula;
    };
    if (calibration) {
      take("", "a voltage times the factor of calibration");
      return;
    }
    ask(fmt::format("How many newtons is one unit of {}? It is a voltage.\n",
                    printable(shown_name(voltage))),
        "a number", [&](const std::string& answer) {
          const auto newtons = positive(answer);
          if (!newtons) return no_number(answer);
          take(shortest(*newtons), "a voltage times its newtons, as answered");
          return std::string();
        });
  }

  // The radius of a rotation, or whether strokes give the speed.
  void ask_for_speed() {
    const OpenPoints now = points();
    const auto take = [&](const std::string& formula, const char* comment) {
      for (const std::size_t f : alike_)
        campaign_.files[f].speed = {formula, comment};
    };
    if (const guess::Column* const turns = now.rotation())
      ask(fmt::format("At which radius is the contact? {} is a speed of rotation.\n",
                      printable(shown_name(*turns))),
          "a number in mm", [&](const std::string& answer) {
            const auto radius_mm = positive(answer);
            if (!radius_mm) return no_number(answer);
            take(speed_of_turns(*turns, shortest(*radius_mm)),
                 "a rotation at this radius, in mm, as answered");
            return std::string();
          });
    else if (const std::string formula = speed_of_strokes(now); !formula.empty())
      ask(fmt::format("Is {} the speed, in mm/s? No column is one.\n", formula), "yes",
          [&](const std::string& answer) {
            if (lower_case(answer) != "yes")
              return fmt::format("'{}' is not yes", printable(answer));
            take(formula, "mean speed of a stroke to and fro, as answered");
            return std::string();
          });
  }

  // The form in which a column has friction.
  void ask_for_form(std::size_t column) {
    const std::vector<std::string> forms = {"force", "stress", "coefficient"};
    ask(fmt::format(
            "What of friction is {}?\n     1  force\n     2  stress\n     3  coefficient{}\n",
            printable(shown_name(columns()[column])),
            columns()[column].as_small ? " (its numbers are as small)" : ""),
        "its number or name", [&](const std::string& answer) {
          for (std::size_t i = 0; i < forms.size(); ++i)
            if (answer == std::to_string(i + 1) || lower_case(answer) == forms[i]) {
              name(column, i == 0 ? "F_R_N" : "tau_R_MPa", i == 2);
              return std::string();
            }
          return fmt::format("'{}' is none of them: {}", printable(answer), suggest(answer, forms));
        });
  }

  // A column or one value for all rows.
  void ask_for_normal_force() {
    const auto open = open_columns(true);
    ask("Which normal force belongs to the friction force? None was found.\n" + list_of(open) +
            "   =50  the same N for all rows\n",
        "a number or name, or =VALUE", [&](const std::string& answer) {
          return answer[0] == '=' ? take_constant(answer, "F_N_N")
                                  : take_column(answer, "F_N_N", open);
        });
  }

  // A column, one value for all rows, or a force over the area of contact.
  void ask_for_pressure() {
    const auto open = open_columns(true);
    const bool has_force = points().has("F_N_N");
    std::string lines = "Where does the contact normal stress come from? None was found.\n" +
                        list_of(open) + "  =500  the same MPa for all rows\n";
    if (has_force)
      lines += " /78.5  the normal force over this area, in mm2\n";
    else if (!open.empty())
      lines += "1/78.5  column 1 of these, a force, over this area, in mm2\n";
    ask(lines, "a number or name, =VALUE or FORCE/AREA", [&](const std::string& answer) {
      const std::size_t slash = answer.rfind('/');
      if (answer[0] == '=') return take_constant(answer, "sigma_n_MPa");
      if (slash == answer.npos || chosen(answer, open))
        return take_column(answer, "sigma_n_MPa", open);
      const auto area_mm2 = positive(std::string_view(answer).substr(slash + 1));
      if (!area_mm2) return no_number(answer.substr(slash + 1));
      if (!has_force)
        if (std::string wrong =
                take_column(std::string(trimmed(answer.substr(0, slash))), "F_N_N", open);
            !wrong.empty())
          return wrong;
      divide_force_by(*area_mm2);
      return std::string();
    });
  }

  void divide_force_by(double area_mm2) {
    if (campaign_.constants.count("F_N_N"))
      campaign_.constants["sigma_n_MPa"] = campaign_.constants.at("F_N_N") / area_mm2;
    else
      for (guess::File& file : campaign_.files)
        file.area_mm2 = area_mm2;
  }

  std::string take_column(const std::string& answer, const std::string& canonical,
                          const std::vector<std::size_t>& open) {
    const auto column = chosen(answer, open);
    if (!column) return not_a_column(answer, open);
    name(*column, canonical);
    return "";
  }
  // "=50".
  std::string take_constant(const std::string& answer, const std::string& canonical) {
    const auto value = positive(std::string_view(answer).substr(1));
    if (!value) return no_number(answer.substr(1));
    campaign_.constants[canonical] = *value;
    return "";
  }

  void ask_for_units() {
    for (std::size_t c = 0; c < columns().size(); ++c) {
      const guess::Column& column = columns()[c];
      if (!lacks_unit(column)) continue;
      const std::string unit = data::find_quantity(column.canonical)->unit;
      ask(fmt::format("In which unit is {} ({})? The file does not say: {} is assumed.\n",
                      printable(shown_name(column)), printable(column.first_values), unit),
          fmt::format("{} or {}", unit, fmt::join(data::other_units(unit), ", ")),
          [&](const std::string& answer) {
            if (!convert(answer, unit))
              return fmt::format("'{}' does not convert to {}: {}", printable(answer), unit,
                                 suggest(answer, units_like(unit)));
            change(c, [&](guess::Column& one) { one.answered_unit = answer; });
            return std::string();
          });
    }
  }

  void ask_for_flow_stress() {
    ask("What is the flow stress of the workpiece? Laws with a shear limit need it.\n",
        "a number in MPa", [&](const std::string& answer) {
          const auto value = positive(answer);
          if (!value) return no_number(answer);
          campaign_.constants["sigma_f_MPa"] = *value;
          return std::string();
        });
  }

  guess::Campaign campaign_;
  const AskUser& ask_;
  const std::size_t most_;
  std::vector<std::size_t> alike_; // files that are read like most
  bool is_over_ = false;           // the user's lines
};

} // namespace

guess::Campaign with_answers(guess::Campaign campaign, const AskUser& ask) {
  return Interview(std::move(campaign), ask).hold();
}

} // namespace frictab::job
