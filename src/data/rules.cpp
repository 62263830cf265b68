// The table of reading rules.
#include "data/rules.h"

namespace frictab::data {

namespace {

constexpr const char *by_roles = "data.roles", *by_rows = "data.rows",
                     *by_allowing = "data.allow_implausible";

constexpr const char *not_a_cause = "no cause of friction",
                     *fitted = "counted and fitted like sliding rows", *left_out = "left out",
                     *told = "an error where most rows are so, else reported with their count",
                     *remarked = "reported, never an error";

constexpr FalseCalls of_columns = {0, 788, "columns"}, of_rows = {0, 425940, "rows"},
                     of_campaigns = {0, 100, "campaigns"}, not_measured = {0, 0, ""};

constexpr ReadingRule all_rules[] = {
    {"columns", "state", "a quantity of frictab's, or what one is computed from",
     "laws may take it", by_roles, not_measured},
    {"columns",
     "response",
     "what the stress is computed from, or what carries what the states leave of it, at slope one",
     "no cause, no lead, no setting",
     by_roles,
     {0, 60, "campaigns with channels that follow"}},
    {"columns", "setting", "one value per test, or few that are held within tests",
     "may be a cause that a law lacks", by_roles, of_columns},
    {"columns", "channel", "numbers that vary within tests, or a name of wear, sound, vibration",
     "a lead, never an effect: it may follow from friction", by_roles, of_columns},
    {"columns", "outcome", "one value per test and a name of wear, mass loss, roughness after",
     "a lead, never an effect", by_roles, of_columns},
    {"columns", "label", "text whose levels tests share", "may be a cause", by_roles, of_columns},
    {"columns", "order", "a name of a sequence or a date, one value per test",
     "no cause; drift is looked for along it", by_roles, of_columns},
    {"columns", "clock", "a name of time, varies within tests", not_a_cause, by_roles, of_columns},
    {"columns", "test", "a name of a test's number or specimen", not_a_cause, by_roles, of_columns},
    {"columns", "ignore",
     "free text: a remark in few tests, more texts than half of the tests; a verdict on tests",
     not_a_cause, by_roles, of_columns},

    {"rows", "sliding", "under load and in motion", "fitted", by_rows, not_measured},
    {"rows", "rest",
     "speed is 0, or below 2 % of the test's and cannot be distinguished from 0; with a set "
     "speed "
     "where the path stands still or a few end rows lack friction",
     left_out, by_rows, of_rows},
    {"rows", "turning", "where a stroke ends: slow, or the force still builds up", left_out,
     by_rows, of_rows},
    {"rows", "closing", "the load builds up while it slides", fitted, by_rows, not_measured},
    {"rows", "opening", "the load falls away while it slides", fitted, by_rows, not_measured},
    {"rows", "unloaded", "below 5 % of the test's load", left_out, by_rows, of_rows},
    {"rows",
     "shear_yield",
     "tau_R_MPa above 1.15 times the shear yield stress, beyond the scatter of its test",
     "left out up to 5 % of a campaign, else an error",
     by_allowing,
     {1, 425940, "rows"}},
    {"rows", "friction_coefficient",
     "tau_R_MPa/sigma_n_MPa above 3.6 in size and far from its test; reported: also below 0.001",
     "left out up to 5 % of a campaign, else an error", by_allowing, of_rows},
    {"rows",
     "spike",
     "one to three rows far above those around them",
     "left out up to 5 % of a campaign, else kept",
     by_allowing,
     {1, 425940, "rows"}},
    {"rows", "dropout", "a temperature that jumps by 30 K or more to one value and back",
     "left out", by_allowing, not_measured},
    {"rows", "high_coefficient", "tau_R_MPa/sigma_n_MPa of 1 to 3.6", remarked, by_allowing,
     of_campaigns},
    {"rows", "no_load", "friction where sigma_n_MPa is 0", told, by_allowing, of_campaigns},
    {"rows", "pressure", "sigma_n_MPa above 20,000", told, by_allowing, of_campaigns},
    {"rows", "sliding_speed", "faster than 200 m/s", told, by_allowing, of_campaigns},
    {"rows", "surface_expansion", "psi as in percent", told, by_allowing, of_campaigns},
    {"rows", "speed", "s_mm grows at another speed than v_rel_mm_s", told, by_allowing,
     of_campaigns},
    {"rows", "forces", "F_R_N/F_N_N is not tau_R_MPa/sigma_n_MPa", told, by_allowing, of_campaigns},

    {"tests", "interval", "header lines, files or a clock that go on from test to test",
     "intervals of one recording are held out together, and get its number and name",
     "data.recording", of_campaigns},
    {"tests", "direction", "the force changes sign with the direction of a stroke",
     "the zero of the force cell is taken off, magnitudes are fitted", "data.force_zero",
     of_campaigns},
    {"tests", "test_apart", "off the other tests by 1.5 times, with a gap next to it", told,
     by_allowing, of_campaigns},
    {"tests", "copied_test", "the rows of another test, value by value", told, by_allowing,
     of_campaigns},
    {"tests", "mixed_units", "off the others by a factor between two units, or by kelvin",
     "an error where no design does that, else reported", by_allowing, of_campaigns},
    {"tests", "no_coefficient", "its mean coefficient is not above 0", remarked, by_allowing,
     of_campaigns},
    {"tests", "elapsed_time", "lasts more than 10^7 s or less than 10^-6 s", told, by_allowing,
     of_campaigns},
    {"tests", "sliding_path", "slides more than 10,000 km", told, by_allowing, of_campaigns},
    {"tests", "path", "its sliding distance runs backwards", told, by_allowing, of_campaigns},
    {"tests", "clipped_channel", "a channel stays at the end of its range", told, by_allowing,
     of_campaigns},
    {"tests", "stuck_channel", "a channel stands still while load or speed change", told,
     by_allowing, of_campaigns},
    {"tests", "force_offset", "a force is off 0 without contact", told, by_allowing, of_campaigns},
    {"tests", "no_motion", "begins or ends without friction, and no column shows motion", remarked,
     by_allowing, not_measured},

    {"campaign", "no_friction", "tau_R_MPa is 0 in every row", told, by_allowing, of_campaigns},
    {"campaign", "temperature", "outside -200 to 1500 degC, or as in kelvin", told, by_allowing,
     of_campaigns},
    {"campaign", "flow_stress", "sigma_n_MPa below a hundredth or above 20 times sigma_f_MPa", told,
     by_allowing, of_campaigns},
    {"campaign", "unit", "nobody gave it", "the canonical one is taken, and asked for",
     "data.columns", not_measured},
};

} // namespace

std::span<const ReadingRule> reading_rules() {
  return all_rules;
}

} // namespace frictab::data
