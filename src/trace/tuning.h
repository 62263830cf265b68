// Tuning constants of the search for missing effects, grouped by the steps of the method.
//
// A comment gives the meaning of a constant, its unit or what it multiplies, and the measurement or
// the reason for its value. "Rounding": the value separates rounding errors from numbers. A
// value without such a reason was chosen and not measured. Measured errors and rates are of
// synthetic campaigns (docs/measurements.md, research/results); those "of the step" do not show
// that another value would be worse.
//
// Random streams, texts, the lengths of printed lists and sizes that affect only memory or speed
// stand in the files that use them.
#pragma once

#include <array>
#include <cstddef>

#include "stats/blocks.h"
#include "trace/basics.h"

namespace frictab::trace::tuning {

// ---- Guards of the arithmetic ----

inline constexpr double smallest_divisor = 1e-300; // keeps quotients finite
// Step of a parameter for derivatives by differences, as a share of its size, and the least size:
// between rounding and the curvature of formulas.
inline constexpr double step_share_of_parameter = 1e-5, smallest_stepped_size = 1e-3;
// Least stress of a law in a quotient by it, as a share of the campaign's mean stress.
inline constexpr double smallest_share_of_tau = 1e-3;
// Share of the squares of a derivative below which a row or a site does not feel an effect.
inline constexpr double felt_share_of_squares = 1e-6;
// Probabilities beyond a two-sided 95 % interval at either end, and of a one-sided bound.
inline constexpr double tail_of_interval = 0.025, confidence_of_bound = 0.95;

// ---- Columns and candidates ----

// Columns up to which every pair of them is a candidate: a pair has about a dozen shapes, each as
// long as the data, so that pairs of a thousand columns would exhaust memory.
inline constexpr std::size_t most_columns_for_all_pairs = 100;
inline constexpr std::size_t most_levels_of_text = 12; // a text with more identifies tests
// Squared correlation above which two columns are one, up to offset and scale: rounding.
inline constexpr double identical_r2 = 1 - 1e-9;
// Squared correlation above which two columns form no pair, as their product is a parabola of
// either. A surface over sliding distance and displacement, nearly one column, ended the search of
// a shear cell campaign of 135 tests too early: with this rule, and with causes excluded that fit
// worse than none, its error fell from 0.292 to 0.141 kPa (as low as the truth's).
inline constexpr double near_collinear_r2 = 0.98;
// Distance of the projections of unit vectors on a common direction, within which the columns are
// compared: those of identical columns differ by at most sqrt(1 - identical_r2) = 3.2e-5.
inline constexpr double same_projection_tolerance = 4e-5;
// Intervals between the tested quantiles of a column, in which a form may not have a hump.
inline constexpr std::size_t quantile_intervals = 30;
// A campaign changes one state at a time if at most this share of its tests (of at least so many)
// have more than one state further from its median than this share of its range.
inline constexpr double share_of_tests_changing_several = 0.05, changed_share_of_range = 0.2;
inline constexpr Index fewest_tests_for_one_factor = 5;
// Tests of each pair of levels from which on two texts may act together: of one test, its own
// scatter would be that of the pair.
inline constexpr std::size_t fewest_tests_of_pair = 2;
// Central range of a number, as a share of its median, from which on it may act with others.
inline constexpr double pair_spread_share_of_median = 0.2;

// ---- Terms: coordinates, splines, shapes ----

// Ratio of the largest to the least value above which a column is taken in ln x; for an input of a
// trained law; and for a column that starts at 0 the ratio to the shift, which is this quantile of
// its positive values. Such a column must have more than so many values.
inline constexpr double ratio_for_log = 4, ratio_for_log_of_trained = 5;
inline constexpr double ratio_for_log_from_zero = 8, log_shift_quantile = 0.05;
inline constexpr std::size_t values_for_log_from_zero = 6;
// Share of its range within which values of a column are one: rounding.
inline constexpr double same_value_share_of_range = 1e-9;
// Knots of the spline of a column, and their least distance as a share of its range.
inline constexpr std::size_t most_spline_knots = 9;
inline constexpr double knot_gap_share_of_range = 0.01;
// Bent columns (the smoothest first) that each partner gives to the product of two columns.
inline constexpr Index bent_columns_of_pair = 3;
// |cosine| between centred shapes of a grid above which one represents both, the rounding of single
// precision that is granted to it, and the norm below which a shape does not vary.
inline constexpr float same_shape_cosine = 0.999f, single_precision_slack = 1e-4f;
inline constexpr float smallest_norm_of_shape = 1e-6f;
// |cosine| between sharp shapes of one column (thresholds, steps, humps) above which only the first
// is tried. Measured: 40 % fewer directions.
inline constexpr double same_sharp_shape_cosine = 0.97;
// |cosine| between the derivatives at two sites of the law above which the second is not offered.
inline constexpr double same_site_cosine = 0.995;
// A saturating form needs a column whose least value is below this share of its largest, and a wave
// a column of whose range a typical test covers this share: else neither shows.
inline constexpr double begun_share_of_largest = 0.5, reach_of_wave = 0.5;
// Least width of a local form, as a share of the widest gap between tested values.
inline constexpr double narrowest_share_of_gap = 0.5;
// Limits of a fitted width: the column's range over the first, times the second.
inline constexpr double spans_over_narrowest_width = 60, widest_width_in_spans = 6;

// ---- The regression: response, modes, term sizes and variances ----

// Measured friction over the law's, and its inverse, are cut here before the logarithm.
inline constexpr double largest_response_ratio = 5;
// Pieces into which a test is cut, and their number in a campaign, which limits the cost: above 500
// tests each has fewer pieces, as many tests determine shared structure as well with fewer.
inline constexpr std::size_t most_pieces_of_test = 12, fewest_pieces_of_test = 2;
inline constexpr std::size_t most_pieces_of_campaign = 6000;
// Standard deviations of a term's coefficients that are tried, in ln of friction: by the search for
// each term and flip, and for the terms that are in.
inline constexpr double coarse_term_sizes[] = {0, 0.02, 0.1, 0.5};
inline constexpr double fine_term_sizes[] = {0, 0.008, 0.015, 0.03, 0.06, 0.12, 0.25, 0.5, 1};
// Least variance of a class of modes, (ln of friction)^2: a scatter of 0.003 %.
inline constexpr double smallest_class_variance = 1e-9;
// A class of modes with fewer degrees of freedom takes the variance of the class before it.
inline constexpr double fewest_class_freedom = 3;
// Least share of the squares of a class that a term may leave; bounds a logarithm in the likelihood
// where a term explains everything.
inline constexpr double smallest_share_left = 1e-6;
// Alternations of coefficients and noise in a fit that starts from the response's mean square, and
// after terms have entered: the noise no longer changes.
inline constexpr int noise_rounds_from_nothing = 4, noise_rounds_with_new_terms = 3;
// Added to a matrix that is factored, as a share of its largest entry: rounding of sums over rows.
inline constexpr double information_slack = 1e-9;
// Ridge of the law's own directions, as a share of their squares (they may be collinear, and are
// hardly shrunk), and of a direction that is 0 everywhere.
inline constexpr double law_ridge = 1e-8, smallest_law_ridge = 1e-10;
// Cosines over the order of tests that form the random walk, and the log likelihood ratio above
// which it is part of the noise.
inline constexpr int walk_waves = 8;
inline constexpr double walk_log_likelihood_ratio = 2;
// Degrees of freedom of Student's t by which tests are weighted in each class of modes, so that one
// outlying test cannot decide; alternations of fit and weights before the search.
inline constexpr double weight_t_freedom = 4;
inline constexpr int weight_rounds = 3;
// Share of the variance of a history's test means that the states must explain for the history to
// enter by its part within tests. Measured of the step, together with the comparison of each
// finding next to all others: error on held-out tests of a pin-on-disc look-alike from 0.062 and
// 0.066 to 0.052 and 0.041 MPa, of a reciprocating one from 12.8 to 10.0 MPa.
inline constexpr double imitated_share_of_variance = 0.5;
// Share of the information about a column's coefficient that the law's parameters must leave for
// the column to be identifiable.
inline constexpr double identifiable_share_of_information = 0.02;

// ---- The gate: how rare a term is by chance ----

// Levels of the two rounds in units of trace.alpha. Their sum exceeds 1, but findings must also
// predict left-out tests. Measured of the step: 3 false alarms in 400 campaigns that lack nothing,
// at trace.alpha = 0.02.
inline constexpr std::array<double, 2> round_shares_of_alpha = {1, 0.5};
// Level of the look-ahead in units of its round's level. Measured: with 0.5 in place of 0.25 hidden
// causes of a look-alike are found, and false alarms stay at 3 of 400.
inline constexpr double look_ahead_share_of_level = 0.5;
inline constexpr std::size_t look_ahead_terms = 3; // of a path
// Flips of a look-ahead, and the first of them: it ends there if its p-value on these exceeds the
// limit. Saves time (with other changes, a trace took a third less).
inline constexpr std::size_t look_ahead_flips = 199;
inline constexpr Index first_look_ahead_flips = 49;
inline constexpr double look_ahead_end_p_value = 0.2;
// Flips of a step: this product over the number of terms, within the limits. Few terms are cheap
// and get more flips, hence more precise p-values. 999 resolve p-values of 0.001.
inline constexpr std::size_t flips_times_terms = 500000;
inline constexpr std::size_t fewest_flips = 999, most_flips = 4999;
inline constexpr std::size_t most_terms_found = 8; // in both rounds together
// Multiple of the threshold of rarity above which terms are ranked by likelihood, because a share
// among flips no longer distinguishes them.
inline constexpr double thresholds_for_ranking_by_likelihood = 2;
// Terms that may fail for unequal scatter of tests (HC3); one more ends the search.
inline constexpr std::size_t most_unsure_terms = 6;
// A term is a rival of one that entered if its log likelihood ratio exceeds this share of that
// one's, with all other terms in the fit; and the number of rivals.
inline constexpr double near_rival_share_of_ratio = 0.7;
inline constexpr std::size_t most_near_rivals = 12;
// Relative difference of ratios that differ by rounding: with few tests many flips are equal.
inline constexpr double same_ratio_tolerance = 1e-6;
// Weight of the theoretical tail of a likelihood ratio (mean excess 1), as a number of values added
// to those observed.
inline constexpr double theoretical_tail_values = 5;
// One of so many flips is in the tail of the largest ratios, beyond which rarity is extrapolated.
inline constexpr Index flips_per_tail_value = 10;
// Norm below which the fit explains all of a flip, which is then not scaled up: rounding.
inline constexpr double smallest_norm_of_flip = 1e-15;
// The test with unequal variances (HC3): norm below which a term is a combination of the others,
// and the least share of a test that the fit leaves to it.
inline constexpr double collinear_norm = 1e-9, smallest_leverage_left = 0.02;
// Steps of the iteration for a term's threshold, which shrinks the error at each.
inline constexpr int threshold_iterations = 50;
// Standard deviation of a lead's coefficient, in ln of friction: so large (friction times e) that
// the estimate is not shrunk.
inline constexpr double lead_coefficient_size = 1;
// Standard errors above a threshold for a probability of 80 %: the normal quantile.
inline constexpr double std_errors_for_80_percent = 0.84;

// ---- Fits of the law with effects ----

// The law's own parameters are tied to those without effects by this share of the tests'
// information about them (tie_parameters): a tenth is negligible where the tests separate a
// parameter from an effect, and decides where only other states would. All of it where tests change
// one state at a time.
inline constexpr double tied_share_of_information = 0.1, tied_share_by_one_factor = 1;
// Root mean square of the residual, as a share of tau_R, below which a law lacks nothing.
inline constexpr double exact_law_share_of_tau = 1e-4;
// Tests that represent a larger campaign where a few hundred serve as well: the largest campaign
// that is not reduced. 200 tests determine a standard deviation between tests to
// 1/sqrt(2 x 200) = 5 %, which changes no weight that matters.
inline constexpr std::size_t selected_tests = stats::uncut_experiments;
// Steps of a fit to all tests that starts from the end of a fit to selected tests and only serves a
// choice.
inline constexpr int most_steps_from_selected = 12;
// Shares of the cost by which the last step of a fit reduces it: fits of folds and of selected
// tests; with many tests, where the cost is so large that a millionth is far less than a unit of
// log likelihood; and fits that only serve a choice.
inline constexpr double coarse_fit_end = 1e-5, fit_end_with_many_tests = 1e-6;
inline constexpr double fit_end_of_choice = 1e-8;
// Widths by which the limit is rounded off, one fit after the other, as shares of the mean stress:
// otherwise rows below it have no influence on it.
inline constexpr double rounding_widths_of_limit[] = {0.15, 0.05};
// Ridge of the effective number of parameters, as a share of the largest information: rounding.
inline constexpr double freedom_ridge = 1e-12;
// Change of a factor for central differences by it: so large that rows near the limit feel mu as
// well as the limit.
inline constexpr double factor_step = 0.06;
// Knots of the piecewise linear functions that stand for any form of a quantity, so that the misfit
// of a chosen form is not found as another effect of it.
inline constexpr int knots_of_any_form = 7;
// Parts of a test from whose means the variance of its gain is estimated, rows that each must have,
// and parts below which the variance is taken from the other tests.
inline constexpr std::size_t most_gain_parts = 10, rows_per_gain_part = 5, fewest_gain_parts = 3;
// Least argument of the logarithm of a gain: measured friction over the law's.
inline constexpr double smallest_gain_ratio = 1e-3;

// ---- The choice of causes and forms ----

inline constexpr std::size_t shortlisted_causes = 6; // from which a set is made
// Standard errors of log likelihood over the selected tests from which on a cause is dropped before
// the fit to all tests, which separate it even more clearly, so that it cannot be in a set.
inline constexpr double distinguishable_std_errors = 3;
// Costs of a step away from recorded columns (complexity): in -2 log likelihood where causes are
// compared, in log likelihood where fits are. Both are the same cost.
inline constexpr double cause_step_cost = 3, rival_step_cost = 1.5;
// Further costs in log likelihood: of a parameter; of the sites mu, limit, addition to tau_R, and
// mu with limit (`sites` of rivals.h: where the data cannot distinguish them, an effect acts on
// mu); of a smooth, which a closed form replaces if it is at most this much less likely.
inline constexpr double parameter_cost = 2.5, smooth_cost = 3;
inline constexpr std::array<double, 4> site_costs = {0.0, 0.5, 1.5, 0.25};
// Penalty, times the square of an amplitude, where a form has none of its own: so weak that it only
// makes the smooth's equations solvable.
inline constexpr double penalty_of_plain_amplitudes = 1e-3;
// Largest amplitude at which the fit of a closed form starts: half of friction, either way.
inline constexpr double largest_start_amplitude = 0.5;
// Closed forms that are fitted at each site, and forms that are then fitted to all tests where the
// first fits are to selected ones.
inline constexpr std::size_t most_forms_at_site = 8, most_forms_on_all_tests = 3;
// Intervals of an effect's range at whose ends its factor is examined for humps.
inline constexpr int plausibility_intervals = 32;
// Costs, in log likelihood: times the square of the largest change of friction (as if changes were
// normal with a standard deviation of 50 %: 1/(2 x 0.5^2)), and of a factor that is not finite.
inline constexpr double large_change_cost = 2, infinite_factor_cost = 1e6;
// Cost of a hump, in log likelihood, times the range of the factor between tested values beyond
// that at them, in units of the latter (at least the last): what is tolerated, and the most that
// counts.
inline constexpr double hump_cost = 8, tolerated_hump = 0.3, largest_hump = 10;
inline constexpr double smallest_tested_range = 1e-6;
// Resamples of whole tests by which rivals are compared: a share of 95 % is then known to 1 %.
inline constexpr std::size_t rival_resamples = 500;
// Difference of log restricted likelihood below which rivals are in one set: e^2, or 7 to 1.
inline constexpr double clear_lead_of_criterion = 2;

// ---- Judging on unseen tests ----

inline constexpr std::size_t most_folds = 10; // of whole tests
// Tests have one setting, and are left out together, if each state differs by less than this, in
// its standard deviations over tests: repeats would predict each other.
inline constexpr double same_setting_std_deviations = 0.25;
// A term is dropped if the score of left-out tests falls by at most this without it, in standard
// errors over tests; least standard error of a score: rounding.
inline constexpr double worth_of_term_std_errors = 1, smallest_score_error = 1e-12;
// Degrees of freedom of Student's t in the scores of the regression (per mode) and of the law (per
// test): one test for which a fold's noise is too small does not outweigh all others.
inline constexpr double mode_score_t_freedom = 4, law_score_t_freedom = 5;
// Largest ratio between law and measurement in an error of a left-out test, either way: fits of a
// few folds of a shear cell campaign ended at a law without friction, where scores were not
// numbers.
inline constexpr double largest_error_ratio = 1e3;
// Plain weights are used if their error is below this share of the error under the noise model's
// weights: these are better where the law is right, and may spoil a law that is wrong itself. Among
// 75 campaigns with an effect 8 were made worse before effects were compared with the law under its
// better weights, and none of 150 after (0.96 until then).
inline constexpr double plain_weights_share_of_error = 0.98;
// Standard errors below which the 95 % interval of an effect includes "none": the normal quantile.
// Such an effect is removed where all rows weigh alike.
inline constexpr double doubtful_std_errors = 1.96;
// With fewer validation tests (8 before the joint search), these are searched together with the
// training tests and cross-validation judges: they are too few for a veto, and their information is
// needed.
inline constexpr std::size_t fewest_judging_validation_tests = 20;

// ---- Delivery, verdict and leads ----

// Effects are implausibly good if they leave less than this share of the mean square: a torque from
// which the stress is computed was named as its cause and left a millionth of the error.
inline constexpr double implausible_share_left = 1e-3;
// Smallest gain of an effect on unseen tests that is worth a place in the law, as a share of the
// error without effects: a history that took 0.0003 from 0.266 MPa was added.
inline constexpr double least_gain_share = 0.005;
// p-value below which validation tests differ from training tests as a whole.
inline constexpr double validation_shift_p_value = 1e-3;
// The validation tests hardly vary a column if it spreads less than this share of its spread over
// the training rows.
inline constexpr double small_share_of_spread = 0.2;
// The scatter agrees with repeated tests if it is at most this multiple of their repeatability: few
// repeats determine it poorly, so that a significance test alone would nearly always agree.
inline constexpr double repeatability_slack = 1.2;
// Scatter of repeated tests above which they differ in something else: between laboratories, on
// their own specimens of one material, the coefficient scatters by 18 % (ASTM G99, recalled).
inline constexpr double largest_repeatability = 0.2;
// Least share of the degrees of freedom that the parameters leave in a bound of the noise, and
// degrees of freedom of repeats from which on they give a repeatability.
inline constexpr double smallest_freedom_left = 0.5, fewest_degrees_of_repeats = 3;
// The scatter between tests lies below this multiple of their variance, plus the least end;
// halvings of that interval, down to rounding. Variance of a gain at least: rounding.
inline constexpr double widest_scatter_ratio = 10, smallest_scatter_end = 1e-12;
inline constexpr int scatter_halvings = 80;
inline constexpr double smallest_gain_variance = 1e-18;
inline constexpr double chance_p_value = 0.2; // above it chance explains a lead most simply
// Change of mu per e-fold of speed from which on a lead's text gives the law's own: rounding.
inline constexpr double smallest_rate_named = 1e-9;
// Channels and outcomes are compared with the residual from this number of tests on.
inline constexpr std::size_t fewest_tests_for_followers = 5;
// Effect on tau_R, as a share, for which `trace --power` gives the number of tests: an example.
inline constexpr double wanted_share_of_tau = 0.02;

// ---- What the design ties to a state ----

// Share of the variance of a state's test means that a column must explain to be tied to it. The
// standard error of the column's effect is then more than (1 - 0.9)^-1/2 = 3 times that of a design
// that crosses the two.
inline constexpr double aliased_share_of_variance = 0.9;
// The same for a state that the law does not follow: one that the column sets.
inline constexpr double same_share_of_variance = 0.999;
// Largest variation of a setting within a test, as a share of its range.
inline constexpr double held_share_of_range = 1e-3;
// Range of a level's tests, as a share of their mean, that the text gives as one value.
inline constexpr double same_value_share_of_mean = 0.05;
// Range of a state's test means, as a share of what a test runs through, from which on the tests
// differ in it.
inline constexpr double apart_share_of_range = 0.1;
// Share of a value by which two significant digits may change it in a text.
inline constexpr double rounded_share_of_value = 0.01;
inline constexpr std::size_t fewest_tests_for_aliases = 4;

// ---- The order of tests ----

inline constexpr std::size_t order_permutations = 999; // resolve p-values of 0.001
// Level of the test along the order in units of trace.alpha. Measured of the step, with earlier
// searches: structure in 4 of 1000 campaigns that lack nothing, at trace.alpha = 0.02.
inline constexpr double order_share_of_alpha = 0.5;
// A structure along the order has a direction if a step or a line leaves less than this share of
// the squares of the tests' gains; half the range of a random walk is explained by a line.
inline constexpr double most_left_by_direction = 0.7;
inline constexpr int order_test_waves = 4; // cosines over the order whose squares are added up
inline constexpr std::size_t fewest_tests_for_order = 10;
// Standard errors by which neighbours by name are more alike than by chance: the normal quantile of
// 1 %, one-sided.
inline constexpr double drift_std_errors = 2.33;
// Maximum distance of tests that may be alike, as in a batch; nearer ones weigh more. Measured:
// batches of nine show, 97 in place of 92 % of hidden causes along the order are reported.
inline constexpr Index largest_batch_distance = 6;
// Slow functions of the order that are removed once a structure is found: at most so many, and so
// many tests for each.
inline constexpr int most_order_functions = 12;
inline constexpr std::size_t tests_per_order_function = 5;

// ---- Advice on next tests ----

inline constexpr std::size_t fewest_advised_tests = 3, most_advised_tests = 6;
inline constexpr std::size_t fewest_tests_in_turn = 4; // two of each of two settings
inline constexpr std::size_t most_rivals_in_plan = 4;
// Probability with which a plan settles the question: 80 %, the usual power of an experiment.
inline constexpr double wanted_power = 0.8;
// Standard errors of a two-sided test at 5 %: the normal quantile.
inline constexpr double two_sided_std_errors = 1.96;
// No plan is given where more tests would be needed (nobody would run them), or where it succeeds
// with a smaller probability.
inline constexpr double most_tests_needed = 60, smallest_power = 0.2;
// A plan with one setting fewer is preferred if it keeps this share of the standardised amplitude.
inline constexpr double kept_share_of_amplitude = 0.97;
// Ridge of the parameters, as a share of each one's information: for parameters without any.
inline constexpr double information_ridge = 1e-9;
// Relative gain of the determinant for which a test of a plan is exchanged: above rounding, so that
// the exchange ends.
inline constexpr double determinant_gain_that_counts = 1e-6;
// Settings that candidate tests vary: 3^5 combinations of three values.
inline constexpr std::size_t most_varied_settings = 5;
inline constexpr std::size_t most_candidate_rows = 200; // more would not change a decision
// Least range of a setting that was varied, as a share of its mean.
inline constexpr double varied_share_of_mean = 0.02;
// A number is set only to values that tests have if these are few, and tests many per value.
inline constexpr std::size_t most_fixed_values = 5, tests_per_fixed_value = 2;
// Width by which the range of the campaign is extended at either end, as a share of it; least value
// of a positive quantity that is extended downwards, as a share of the least one tested; share of
// the range by which a candidate's rows may exceed it, for rounding of settings.
inline constexpr double range_extension = 0.1, kept_share_of_least = 0.5, reach_tolerance = 0.01;
// Least amplitude of one test, in standard errors: bounds the number of tests needed.
inline constexpr double smallest_amplitude_of_test = 1e-9;
// Place of the other inputs of a plotted effect of several, from their least value to the largest.
inline constexpr double place_of_other_inputs = 0.75;

} // namespace frictab::trace::tuning
