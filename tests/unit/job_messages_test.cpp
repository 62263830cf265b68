// The exact text of what a faulty job file is told.
#include <gtest/gtest.h>

#include "job/job.h"

namespace frictab::job_messages_test {
namespace {

std::string message(const std::string& text, const std::vector<std::string>& set = {}) {
  try {
    job::parse_job(text, "job.toml", set);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

// The job's first two lines are right; `lines` start on line 3.
std::string with(const std::string& lines) {
  return message("[data]\ntraining = \"a.csv\"\n" + lines);
}

std::string set(const std::string& assignment) {
  return message("[data]\ntraining = \"a.csv\"\n", {assignment});
}

TEST(JobMessages, NameTheNearestKnownKey) {
  EXPECT_EQ(with("[table]\n"
                 "tolerence_MPa = 1"),
            "job.toml:4:1: error: unknown key 'tolerence_MPa' in [table]\n"
            "  hint: did you mean 'tolerance_MPa'?");
  EXPECT_EQ(with("[tabel]\n"
                 "x = 1"),
            "job.toml:3:2: error: unknown key 'tabel' at the top of the file\n"
            "  hint: did you mean 'table'?");
  EXPECT_EQ(with("tolerance_MPa = 1"),
            "job.toml:3:1: error: unknown key 'tolerance_MPa' in [data]\n"
            "  hint: did you mean 'table.tolerance_MPa'? It stands in [table]");
  EXPECT_EQ(with("\"data.holdout\" = 1"),
            "job.toml:3:1: error: unknown key 'data.holdout' in [data]\n"
            "  hint: did you mean 'holdout'?");
  EXPECT_EQ(with("[data.columns]\n"
                 "psi = { colum = \"a\" }"),
            "job.toml:4:9: error: unknown key 'colum' in [data.columns.psi]\n"
            "  hint: did you mean 'column'?");
  EXPECT_EQ(
      with("zzzzzzzz = 1"),
      "job.toml:3:1: error: unknown key 'zzzzzzzz' in [data]\n"
      "  hint: known: drop, columns, constants, roles, files, wide, segments, join, training, "
      "validation, oracle, holdout, delimiter, decimal, thousands, sheet, tests, tests_sheet, "
      "skip_rows, skip_footer, units_row, header, header_rows, missing_values, fill_down, missing, "
      "rows, force_zero, allow_implausible, experiment, recording, condense, above, bystanders");
}

TEST(JobMessages, NameTheRuleOfSomeFiles) {
  EXPECT_EQ(with("files = 3"), "job.toml:3:9: error: data.files must be a list of tables, not 3\n"
                               "  hint: write [[data.files]]");
  EXPECT_EQ(with("[[data.files]]\nlabels = { rig = \"new\" }"),
            "job.toml:3:1: error: data.files[1] has no match\n"
            "  hint: match = \"*.csv\" says which files");
  EXPECT_EQ(with("[[data.files]]\nmatch = \"a\"\n[[data.files]]\nmatch = \"b\"\nskip_row = 1"),
            "job.toml:7:1: error: unknown key 'skip_row' in [data.files[2]]\n"
            "  hint: did you mean 'skip_rows'?");
  EXPECT_EQ(with("[[data.files]]\nmatch = \"a\"\nfrom_name = '(\\d+)mm'"),
            "job.toml:5:13: error: data.files[1].from_name has no named group\n"
            "  hint: what becomes a column is written (?<name>...)");
  EXPECT_EQ(with("[[data.files]]\nmatch = \"a\"\nconstants = { sigma_f = 480 }"),
            "job.toml:5:25: error: 'sigma_f' in [data.files[1].constants] is not a quantity\n"
            "  hint: did you mean 'sigma_f_MPa'? A column of your own needs a name less like it");
  EXPECT_EQ(with("[[data.files]]\nmatch = \"a\"\nlabels = { psi = \"2\" }"),
            "job.toml:5:18: error: psi is a quantity, no label\n"
            "  hint: give it in `constants`");
  EXPECT_EQ(
      with(
          "[[data.files]]\nmatch = \"a\"\ncolumns = { F_R_N = { column = \"F\", unit = \"mm\" } }"),
      "job.toml:5:44: error: data.files[1].columns.F_R_N.unit = \"mm\" does not convert to N\n"
      "  hint: did you mean 'mN'?");
  EXPECT_EQ(with("[[data.files]]\nmatch = \"a\"\ncolumns = { F_R_N = \"F\" }\nconstants = { "
                 "radius_mm = 3 }"),
            "accepted");
  EXPECT_EQ(with("allow_implausible = [\"speeed\"]"),
            "job.toml:3:22: error: unknown plausibility check 'speeed' in data.allow_implausible\n"
            "  hint: did you mean 'speed'?");
}

TEST(JobMessages, SayWhatTypeIsWanted) {
  EXPECT_EQ(with("skip_rows = \"x\""),
            "job.toml:3:13: error: data.skip_rows must be a whole number >= 0, not the text \"x\"\n"
            "  hint: lines before the header line; default 0");
  EXPECT_EQ(with("skip_rows = -1"),
            "job.toml:3:13: error: data.skip_rows must be a whole number >= 0, not -1\n"
            "  hint: lines before the header line; default 0");
  EXPECT_EQ(with("skip_rows = 1.0"),
            "job.toml:3:13: error: data.skip_rows must be a whole number >= 0, not 1.0\n"
            "  hint: lines before the header line; default 0");
  EXPECT_EQ(with("skip_rows = [1, 2]"),
            "job.toml:3:13: error: data.skip_rows must be a whole number >= 0, not a list of 2\n"
            "  hint: lines before the header line; default 0");
  EXPECT_EQ(with("units_row = \"yes\""),
            "job.toml:3:13: error: data.units_row must be true or false, not the text \"yes\"\n"
            "  hint: write true or false");
  EXPECT_EQ(with("[table]\n"
                 "tolerance_MPa = \"0,5\""),
            "job.toml:4:17: error: table.tolerance_MPa must be \"auto\" or a number > 0, not the "
            "text \"0,5\"\n"
            "  hint: write the number without quotes, with a decimal point");
  EXPECT_EQ(with("[output]\n"
                 "directory = 3"),
            "job.toml:4:13: error: output.directory must be a text, not 3\n"
            "  hint: a text stands in quotes");
  EXPECT_EQ(with("holdout = 2026-01-01"),
            "job.toml:3:11: error: data.holdout must be a number > 0 and < 1, not a date or time\n"
            "  hint: share of the EXPERIMENTS that is held out where data.validation is absent");
  EXPECT_EQ(with("[data.columns]\n"
                 "psi = { column = 0 }"),
            "job.toml:4:18: error: data.columns.psi.column must be a text, a list of texts or a "
            "column number >= 1, not 0\n"
            "  hint: the file's own name of the column, a list of names (the first one that is "
            "there counts), or the column's number from 1");
  EXPECT_EQ(with("[table.axes.psi]\n"
                 "range = [1]"),
            "job.toml:4:9: error: table.axes.psi.range must be two numbers [from, to] with from < "
            "to, not a list of 1\n"
            "  hint: ends of the axis in the canonical unit");
  EXPECT_EQ(
      with("[table.tolerance_MPa]"),
      "job.toml:3:1: error: table.tolerance_MPa must be \"auto\" or a number > 0, not a table\n"
      "  hint: largest drift of the table from its law, anywhere in the range; the grid is "
      "made to fit it. auto: 0.5 or a twentieth of the law's mean absolute error on unseen "
      "tests, the smaller; default \"auto\"");
  EXPECT_EQ(with("[[table]]\n"
                 "model = \"best\""),
            "job.toml:3:1: error: table must be a table, not a list of 1\n"
            "  hint: write [table]");
  EXPECT_EQ(message("[data]\n"
                    "training = { }"),
            "job.toml:2:12: error: data.training must be a text or a list of texts, not a table\n"
            "  hint: CSV or HDF5 file, a folder, names with * (\"tests/*.csv\"), or a list of "
            "these; they are joined; relative to the job file");
}

TEST(JobMessages, SayTheBounds) {
  EXPECT_EQ(with("holdout = 1"),
            "job.toml:3:11: error: data.holdout must be a number > 0 and < 1, not 1\n"
            "  hint: share of the EXPERIMENTS that is held out where data.validation is absent");
  EXPECT_EQ(with("[table]\n"
                 "tolerance_MPa = 0"),
            "job.toml:4:17: error: table.tolerance_MPa must be \"auto\" or a number > 0, not 0\n"
            "  hint: largest drift of the table from its law, anywhere in the range; the grid is "
            "made to fit it. auto: 0.5 or a twentieth of the law's mean absolute error on unseen "
            "tests, the smaller; default \"auto\"");
  EXPECT_EQ(with("[table]\n"
                 "tolerance_MPa = nan"),
            "job.toml:4:17: error: table.tolerance_MPa must be \"auto\" or a number > 0, not nan\n"
            "  hint: largest drift of the table from its law, anywhere in the range; the grid is "
            "made to fit it. auto: 0.5 or a twentieth of the law's mean absolute error on unseen "
            "tests, the smaller; default \"auto\"");
  EXPECT_EQ(with("[table.axes.psi]\n"
                 "nodes = 1"),
            "job.toml:4:9: error: table.axes.psi.nodes must be a whole number >= 2 and <= 1000000, "
            "not 1\n"
            "  hint: number of nodes");
  EXPECT_EQ(with("[trace]\n"
                 "alpha = 2"),
            "job.toml:4:9: error: trace.alpha must be a number > 0 and < 1, not 2\n"
            "  hint: family-wise error of a false alarm; default 0.02");
  EXPECT_EQ(
      with("[verify]\n"
           "samples = 0"),
      "job.toml:4:11: error: verify.samples must be a whole number >= 1 and <= 1000000000, not 0\n"
      "  hint: points over the whole range at which table and law are compared; default 200000");
  EXPECT_EQ(with("[output]\n"
                 "directory = \"\""),
            "job.toml:4:13: error: output.directory must not be an empty text\n"
            "  hint: where results are written; relative to the job file; default \"out\"");
  EXPECT_EQ(with("[data.constants]\n"
                 "sigma_f_MPa = -480.0"),
            "job.toml:4:15: error: data.constants.sigma_f_MPa must be a number >= 0, not -480\n"
            "  hint: flow stress of the workpiece");
}

TEST(JobMessages, SayTheAllowedWords) {
  EXPECT_EQ(with("decimal = \";\""),
            "job.toml:3:11: error: data.decimal must be \".\" or \",\", not the text \";\"\n"
            "  hint: the decimal sign of numbers; default \".\"");
  EXPECT_EQ(with("[models]\n"
                 "shear_yield = \"misess\""),
            "job.toml:4:15: error: models.shear_yield must be \"mises\", \"tresca\" or "
            "\"flow_stress\", not the text \"misess\"\n"
            "  hint: did you mean \"mises\"?");
  EXPECT_EQ(with("[calibration]\n"
                 "loss = \"L3\""),
            "job.toml:4:8: error: calibration.loss must be \"L2\", \"L1\" or \"huber\", not the "
            "text \"L3\"\n"
            "  hint: did you mean \"L2\"?");
  EXPECT_EQ(
      with("[export]\n"
           "units = \"SI\""),
      "job.toml:4:9: error: export.units must be \"mm-t-s\", \"m-kg-s\", \"mm-ms-kg-GPa\" or "
      "\"mm-ms-g-MPa\", not the text \"SI\"\n"
      "  hint: unit system of the simulation: mm-t-s (MPa, mm/s), m-kg-s (Pa, m/s), mm-ms-kg-GPa "
      "(GPa, mm/ms) or mm-ms-g-MPa (MPa, mm/ms); default \"mm-t-s\"");
  EXPECT_EQ(with("[table.axes.psi]\n"
                 "spacing = \"logg\""),
            "job.toml:4:11: error: table.axes.psi.spacing must be \"linear\" or \"log\", not the "
            "text \"logg\"\n"
            "  hint: did you mean \"log\"?");
  EXPECT_EQ(with("[table.axes.psi]\n"
                 "outside = \"clmp\""),
            "job.toml:4:11: error: table.axes.psi.outside must be \"clamp\", \"error\" or \"law\", "
            "not the text \"clmp\"\n"
            "  hint: did you mean \"clamp\"?");
  EXPECT_EQ(with("[table.axes.psi]\n"
                 "outside = [\"law\", \"law\", \"clamp\"]"),
            "job.toml:4:11: error: table.axes.psi.outside must be one word for both ends or [low "
            "end, high end], not 3 words\n"
            "  hint: for example outside = [\"clamp\", \"law\"]");
  EXPECT_EQ(with("[export]\n"
                 "form = \"drect\""),
            "job.toml:4:8: error: export.form must be \"table\" or \"direct\", not the text "
            "\"drect\"\n"
            "  hint: did you mean \"direct\"?");
  EXPECT_EQ(
      with("[export.options]\n"
           "abaqus_release = \"2019\"\n"
           "marc_fricton = \"shear\""),
      "job.toml:4:18: error: export.options.abaqus_release must be one of 2024, 2020, not the "
      "text \"2019\"\n"
      "  hint: did you mean '2024'?\n"
      "job.toml:5:1: error: unknown option 'marc_fricton' in [export.options]\n"
      "  hint: did you mean 'marc_friction'?");
  for (const std::string prefix :
       {"2nd", "die oil", "_die", "d\u00fcse", "a23456789b123456789c12345"})
    EXPECT_EQ(with("[export.options]\nprefix = \"" + prefix + "\""),
              "job.toml:4:10: error: export.options.prefix must be a name of at most 24 letters, "
              "digits and underscores that starts with a letter, not the text \"" +
                  prefix + "\"");
  EXPECT_EQ(with("[export.options]\nprefix = \"Die_oil_2\""), "accepted");
  EXPECT_EQ(with("[export.inputs]\n"
                 "psi = \"const:1\""),
            "job.toml:4:7: error: export.inputs.psi must be \"constant:NUMBER\", \"property\", "
            "\"field:NUMBER\", \"area_ratio\" or what the target itself gives (\"state\", "
            "\"temperature\", \"solver\"), not the text \"const:1\"\n"
            "  hint: for example psi = \"constant:1.0\"");
  EXPECT_EQ(with("[export.inputs]\n"
                 "psi = \"field:x\""),
            "job.toml:4:7: error: export.inputs.psi must be \"constant:NUMBER\", \"property\", "
            "\"field:NUMBER\", \"area_ratio\" or what the target itself gives (\"state\", "
            "\"temperature\", \"solver\"), not the text \"field:x\"\n"
            "  hint: for example psi = \"constant:1.0\"");
}

TEST(JobMessages, LetStatesHaveTheSourceThatIsTheirsAlone) {
  EXPECT_EQ(with("[export.inputs]\n"
                 "psi = \"area_ratio\"\n"
                 "v_rel_mm_s = \"smoothed:20\"\n"
                 "sigma_f_MPa = \"curve:700*(0.01 + strain)**0.2\""),
            "accepted");
  EXPECT_EQ(with("[export.inputs]\n"
                 "s_mm = \"area_ratio\""),
            "job.toml:4:8: error: export.inputs.s_mm must be \"constant:NUMBER\", \"property\", "
            "\"field:NUMBER\" or what the target itself gives (\"state\", \"temperature\", "
            "\"solver\"), not the text \"area_ratio\"\n"
            "  hint: for example psi = \"constant:1.0\"");
}

TEST(JobMessages, LetWhatATracedEffectBringsInBeAnInputOfARoutine) {
  EXPECT_EQ(with("[export.inputs]\n"
                 "humidity_pct = \"field:1\"\n"
                 "friction_work = \"state\""),
            "accepted");
  EXPECT_EQ(with("[export.inputs]\n"
                 "\"humidity pct\" = \"field:1\""),
            "job.toml:4:1: error: unknown quantity 'humidity pct' in [export.inputs]\n"
            "  hint: known: sigma_n_MPa, psi, v_rel_mm_s, T_contact_C, s_mm, sigma_f_MPa");
  EXPECT_EQ(with("[export.inputs]\n"
                 "tau_R_MPa = \"field:1\""),
            "job.toml:4:1: error: tau_R_MPa cannot stand in [export.inputs]\n"
            "  hint: possible: sigma_n_MPa, psi, v_rel_mm_s, T_contact_C, s_mm, sigma_f_MPa");
}

TEST(JobMessages, LetOneTargetHaveInputsOfItsOwn) {
  EXPECT_EQ(with("[export.abaqus_vfric.inputs]\n"
                 "psi = \"field:1\"\n"
                 "humidity_pct = \"field:2\""),
            "accepted");
  EXPECT_EQ(with("[export.abaqus_vfrc.inputs]\n"
                 "psi = \"field:1\""),
            "job.toml:3:9: error: unknown key 'abaqus_vfrc' in [export]\n"
            "  hint: did you mean 'abaqus_vfric'?");
  EXPECT_EQ(with("[export.c]\n"
                 "psi = \"field:1\""),
            "job.toml:4:1: error: unknown key 'psi' in [export.c]\n"
            "  hint: known: inputs");
  EXPECT_EQ(with("[export.c.inputs]\n"
                 "tau_R_MPa = \"field:1\""),
            "job.toml:4:1: error: tau_R_MPa cannot stand in [export.c.inputs]\n"
            "  hint: possible: sigma_n_MPa, psi, v_rel_mm_s, T_contact_C, s_mm, sigma_f_MPa");
  EXPECT_EQ(with("[export.c.inputs]\n"
                 "psi = \"const:1\""),
            "job.toml:4:7: error: export.c.inputs.psi must be \"constant:NUMBER\", \"property\", "
            "\"field:NUMBER\", \"area_ratio\" or what the target itself gives (\"state\", "
            "\"temperature\", \"solver\"), not the text \"const:1\"\n"
            "  hint: for example psi = \"constant:1.0\"");
}

TEST(JobMessages, KnowALawWithTracedEffectsByItsName) {
  EXPECT_EQ(with("[table]\n"
                 "model = \"wzl_traced\""),
            "accepted");
  EXPECT_EQ(with("[models]\n"
                 "use = [\"coulomb\"]\n"
                 "[table]\n"
                 "model = \"wzl_traced\""),
            "job.toml:6:9: error: 'wzl_traced' in table.model is not among models.use\n"
            "  hint: add wzl to models.use");
  EXPECT_NE(with("[trace]\n"
                 "models = \"wzl_traced\""),
            "accepted");
}

TEST(JobMessages, SayWhatAListOfNumbersHolds) {
  const std::string text = with("[table]\n"
                                "quantile = [0.05, 1.5]");
  EXPECT_EQ(text.substr(0, text.find('\n')),
            "job.toml:4:19: error: table.quantile must be a number >= 0.001 and <= 0.999, or a "
            "list of such numbers, not 1.5");
  EXPECT_EQ(with("[table]\n"
                 "quantile = [0.05, 0.05]"),
            "job.toml:4:19: error: table.quantile holds 0.05 twice\n  hint: name it once");
}

TEST(JobMessages, NameTheNearestLawTargetAndQuantity) {
  EXPECT_EQ(with("[models]\n"
                 "use = \"coulom\""),
            "job.toml:4:7: error: unknown friction law 'coulom' in models.use\n"
            "  hint: did you mean 'coulomb'?");
  EXPECT_EQ(with("[models]\n"
                 "use = \"coulomb, shaw\""),
            "job.toml:4:7: error: unknown friction law 'coulomb, shaw' in models.use\n"
            "  hint: several are a list: [\"coulomb\", \"shaw\"]");
  EXPECT_EQ(with("[export]\n"
                 "targets = [\"c\", \"abaqus_vfrik\"]"),
            "job.toml:4:17: error: unknown target 'abaqus_vfrik' in export.targets\n"
            "  hint: did you mean 'abaqus_vfric'?");
  EXPECT_EQ(with("[data.columns]\n"
                 "sigma_n_mpa = { column = \"a\" }"),
            "job.toml:4:1: error: unknown quantity 'sigma_n_mpa' in [data.columns]\n"
            "  hint: did you mean 'sigma_n_MPa'?");
  EXPECT_EQ(
      with("[data.columns]\n"
           "sigma_n_MPa = { unit = \"Paa\" }"),
      "job.toml:4:24: error: data.columns.sigma_n_MPa.unit = \"Paa\" does not convert to MPa\n"
      "  hint: did you mean 'Pa'?");
  EXPECT_EQ(with("[table.axes.tau_R_MPa]\n"
                 "nodes = 3"),
            "job.toml:3:13: error: tau_R_MPa cannot stand in [table.axes]\n"
            "  hint: possible: sigma_n_MPa, psi, v_rel_mm_s, T_contact_C, s_mm, sigma_f_MPa");
  EXPECT_EQ(with("[data.constants]\n"
                 "tau_R_MPa = 1"),
            "job.toml:4:1: error: tau_R_MPa cannot stand in [data.constants]\n"
            "  hint: possible: sigma_n_MPa, psi, v_rel_mm_s, T_contact_C, T_tool_C, s_mm, "
            "sigma_f_MPa, tau_R_error_MPa, F_N_N");
  EXPECT_EQ(with("[data.columns]\n"
                 "tau_R_MPa = { times = \"sigma_n\" }"),
            "job.toml:4:23: error: unknown quantity 'sigma_n' in data.columns.tau_R_MPa.times\n"
            "  hint: did you mean 'sigma_n_MPa'?");
}

TEST(JobMessages, SayWhatContradictsItself) {
  EXPECT_EQ(with("delimiter = \"comma\"\n"
                 "decimal = \",\""),
            "job.toml:3:13: error: data.delimiter and data.decimal are both \",\"\n"
            "  hint: with decimal commas the columns are separated by \";\" or \"\\t\"");
  EXPECT_EQ(with("drop = { tau_R_MPa = { } }"),
            "job.toml:3:22: error: data.drop.tau_R_MPa says neither below nor above nor texts\n"
            "  hint: write tau_R_MPa = { below = 0.1 }, or tau_R_MPa = [\"TEXT\"]");
  EXPECT_EQ(with("drop = { psi = { below = 3, above = 2 } }"),
            "job.toml:3:16: error: data.drop.psi leaves out every row: below 3 and above 2\n"
            "  hint: `below` is the smaller one");
  EXPECT_EQ(with("[data.columns]\n"
                 "tau_R_MPa = { times = \"sigma_n_MPa\" }\n"
                 "sigma_n_MPa = { times = \"tau_R_MPa\" }"),
            "job.toml:5:25: error: the columns are multiplied in a circle: sigma_n_MPa times "
            "tau_R_MPa times sigma_n_MPa\n"
            "  hint: one of them is measured itself: leave its `times` out");
  EXPECT_EQ(with("[data.columns]\n"
                 "psi = { times = \"psi\" }"),
            "job.toml:4:17: error: data.columns.psi.times names the column itself\n"
            "  hint: a friction coefficient is multiplied with sigma_n_MPa");
  EXPECT_EQ(with("[data.columns]\n"
                 "psi = { times = \"s_mm\", area_mm2 = 1 }"),
            "job.toml:4:7: error: data.columns.psi has more than one of times, area_mm2, "
            "slope_rows and formula\n"
            "  hint: keep the one that says what the column is");
  EXPECT_EQ(with("[data.columns]\n"
                 "psi = \"A\"\n"
                 "[data.constants]\n"
                 "psi = 1"),
            "job.toml:6:7: error: psi stands in [data.columns] and in [data.constants]\n"
            "  hint: keep one of the two");
  EXPECT_EQ(with("[data.columns]\n"
                 "experiment = { column = \"No\", unit = \"mm\" }"),
            "job.toml:4:14: error: data.columns.experiment is a label: it has no unit and is not "
            "computed\n"
            "  hint: leave only `column`");
  EXPECT_EQ(with("[models]\n"
                 "use = [\"coulomb\", \"coulomb\"]"),
            "job.toml:4:19: error: 'coulomb' is named twice in models.use\n"
            "  hint: name it once");
  EXPECT_EQ(with("[models]\n"
                 "use = []"),
            "job.toml:4:7: error: models.use is an empty list\n"
            "  hint: leave the key out for: all that the columns allow");
  EXPECT_EQ(with("[table]\n"
                 "model = [\"all\", \"coulomb\"]"),
            "job.toml:4:9: error: 'all' stands alone in table.model\n"
            "  hint: table.model = \"all\", or a list of names");
  EXPECT_EQ(with("[models]\n"
                 "use = \"coulomb\"\n"
                 "[table]\n"
                 "model = \"orowan\""),
            "job.toml:6:9: error: 'orowan' in table.model is not among models.use\n"
            "  hint: add it to models.use");
  EXPECT_EQ(with("[table.axes.v_rel_mm_s]\n"
                 "range = [500, 5]"),
            "job.toml:4:9: error: table.axes.v_rel_mm_s.range must rise, not go from 500 to 5\n"
            "  hint: write [5, 500]");
  EXPECT_EQ(with("[table.axes.v_rel_mm_s]\n"
                 "range = [0, 5]\n"
                 "spacing = \"log\""),
            "job.toml:4:9: error: table.axes.v_rel_mm_s.range starts at 0, but a log axis needs a "
            "start > 0\n"
            "  hint: raise the start, or spacing = \"linear\"");
  EXPECT_EQ(with("[table.axes.psi]\n"
                 "range = [0, 5]"),
            "job.toml:4:9: error: table.axes.psi.range starts at 0, but psi is never below 1\n"
            "  hint: surface expansion ratio A1/A0");
}

TEST(JobMessages, PlaceSyntaxFaults) {
  EXPECT_EQ(with("x = "), "job.toml:3:5: error: not valid TOML: Error while parsing key-value "
                          "pair: encountered end-of-file\n"
                          "  hint: a line reads key = value; a text stands in quotes, a list in [ "
                          "], a section head is [name]");
  EXPECT_EQ(with("x = abc"), "job.toml:3:5: error: not valid TOML: Error while parsing value: "
                             "could not determine value type\n"
                             "  hint: a line reads key = value; a text stands in quotes, a list in "
                             "[ ], a section head is [name]");
  EXPECT_EQ(with("decimal = 0,5"), "job.toml:3:12: error: not valid TOML: Error while parsing "
                                   "key-value pair: expected a comment or whitespace, saw ','\n"
                                   "  hint: numbers have a point, 0.5; a list stands in [ ]");
  EXPECT_EQ(with("holdout = 0.5\n"
                 "holdout = 0.5"),
            "job.toml:4:11: error: not valid TOML: Error while parsing key-value pair: cannot "
            "redefine existing floating-point 'holdout'\n"
            "  hint: a key or section may stand once only");
  EXPECT_EQ(with("path = \"C:\\data\""),
            "job.toml:3:12: error: not valid TOML: Error while parsing string: unknown escape "
            "sequence '\\d'\n"
            "  hint: write a path with / or in single quotes: 'C:\\data\\rig.csv'");
  EXPECT_EQ(with("y = \"\xff\""),
            "job.toml:3:5: error: not valid TOML: Encountered invalid utf-8 sequence\n"
            "  hint: save the file as UTF-8 text");
  EXPECT_EQ(with("[data"), "job.toml:3:6: error: not valid TOML: Error while parsing table header: "
                           "encountered end-of-file\n"
                           "  hint: a line reads key = value; a text stands in quotes, a list in [ "
                           "], a section head is [name]");
  EXPECT_EQ(
      with("a = [1,"),
      "job.toml:3:8: error: not valid TOML: Error while parsing array: encountered end-of-file\n"
      "  hint: a line reads key = value; a text stands in quotes, a list in [ ], a section head is "
      "[name]");
}

TEST(JobMessages, NameTheOverride) {
  EXPECT_EQ(set("x"), "--set 1: error: \"x\" is not key=value\n"
                      "  hint: write for example --set table.tolerance_MPa=0.1");
  EXPECT_EQ(set("=1"), "--set 1: error: \"=1\" is not key=value\n"
                       "  hint: write for example --set table.tolerance_MPa=0.1");
  EXPECT_EQ(set("table.tolerance_MPa="), "--set 1: error: \"table.tolerance_MPa=\" has no value\n"
                                         "  hint: an empty text is \"\"");
  EXPECT_EQ(set("table.tolerance_MPa=-1"),
            "--set 1: error: table.tolerance_MPa must be \"auto\" or a number > 0, not -1\n"
            "  hint: largest drift of the table from its law, anywhere in the range; the grid is "
            "made to fit it. auto: 0.5 or a twentieth of the law's mean absolute error on unseen "
            "tests, the smaller; default \"auto\"");
  EXPECT_EQ(set("tabel.x=1"), "--set 1: error: unknown key 'tabel' at the top of the file\n"
                              "  hint: did you mean 'table'?");
  EXPECT_EQ(
      set("models.use=[coulomb"),
      "--set 1: error: not valid TOML: Error while parsing value: could not determine value type\n"
      "  hint: a line reads key = value; a text stands in quotes, a list in [ ], a section head is "
      "[name]");
  EXPECT_EQ(set("data=3"), "--set 1: error: data must be a table, not 3\n"
                           "  hint: write [data]");
  EXPECT_EQ(set("data.columns.psi.unit=3"),
            "--set 1: error: data.columns.psi.unit must be a text, not 3\n"
            "  hint: a text stands in quotes");
  EXPECT_EQ(set("table.tolerance_MPa=0.1 0.2"),
            "--set 1: error: table.tolerance_MPa must be \"auto\" or a number > 0, not the text "
            "\"0.1 0.2\"\n"
            "  hint: largest drift of the table from its law, anywhere in the range; the grid is "
            "made to fit it. auto: 0.5 or a twentieth of the law's mean absolute error on unseen "
            "tests, the smaller; default \"auto\"");
  EXPECT_EQ(set("a\n"
                "b=1"),
            "--set 1: error: \"a\\nb=1\" is not key=value\n"
            "  hint: write for example --set table.tolerance_MPa=0.1");
}

TEST(JobMessages, SayThatNothingIsThere) {
  EXPECT_EQ(message(""), "job.toml: error: the job file is empty\n"
                         "  hint: `frictab init DIR` writes one with every key explained");
  EXPECT_EQ(message("\n[data]\n"), "job.toml:2:1: error: data.training is missing\n"
                                   "  hint: write below [data]: training = \"training.csv\"");
  EXPECT_EQ(message("# nothing\n"), "job.toml: error: data.training is missing\n"
                                    "  hint: write below [data]: training = \"training.csv\"");
  EXPECT_EQ(message("data = 3"), "job.toml:1:8: error: data must be a table, not 3\n"
                                 "  hint: write [data]");
}

TEST(JobMessages, LocateAFormulaAndAPattern) {
  EXPECT_EQ(with("[data.columns]\npsi = { formula = \"2*(s_mm\" }"),
            "job.toml:4:19: error: expected ')' in the formula '2*(s_mm', at character 8");
  EXPECT_EQ(with("[data.columns]\npsi = { column = \"A\", formula = \"2\" }"),
            "job.toml:4:7: error: data.columns.psi has a formula and a column\n"
            "  hint: keep one of the two");
  EXPECT_EQ(with("[data.wide]\ncolumns = 'OA\\d+'"),
            "job.toml:4:11: error: data.wide.columns has no named group\n"
            "  hint: what becomes a column is written (?<name>...)");
  EXPECT_EQ(with("[data.join]\noffset = 0.5"), "job.toml:3:1: error: data.join has no files\n"
                                               "  hint: files = \"fe/*.csv\" says which");
  EXPECT_EQ(with("[data.join]\nfiles = \"fe\"\noffset = \"found\""),
            "job.toml:5:10: error: data.join.offset must be \"auto\" or a number, not the text "
            "\"found\"\n  hint: what is added to the clock of these files; \"auto\": where F_N_N, "
            "else s_mm, of both agrees best, for each test; default \"auto\"");
  EXPECT_EQ(with("thousands = \".\""),
            "job.toml:3:13: error: data.thousands is \".\", as data.decimal is\n"
            "  hint: it is what stands between groups of three digits");
}

} // namespace
} // namespace frictab::job_messages_test
