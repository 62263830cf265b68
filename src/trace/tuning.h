// Tuning constants of the search for missing effects, grouped by the steps of the method.
//
// A comment gives the meaning of a constant, its unit or what it multiplies, and why it has that
// value: a measurement, a reason, or "chosen, not measured". Measured errors and rates are of
// synthetic campaigns (docs/measurements.md, research/results). Where a measurement is of a step as
// a whole, the comment says so: it does not show that another value would be worse.
//
// Random streams, texts, the lengths of printed lists and sizes that affect only memory or speed
// stand in the files that use them.
#pragma once

#include <array>
#include <cstddef>

#include <Eigen/Core>

#include "stats/blocks.h"

namespace frictab::trace::tuning {

// ---- Guards of the arithmetic ----

// Least divisor: keeps a quotient finite where nothing is there to divide by.
inline constexpr double smallest_divisor = 1e-300;
// Step of a parameter for derivatives by differences, as a share of its size, and the size it has
// at least: between rounding and curvature of formulas in double precision. Chosen, not measured.
inline constexpr double step_share_of_parameter = 1e-5, smallest_stepped_size = 1e-3;
// Least stress of a law in a quotient by it, as a share of the campaign's mean stress. Chosen, not
// measured.
inline constexpr double smallest_share_of_tau = 1e-3;
// Share of the squares of a derivative below which a row or a site does not feel an effect. Chosen,
// not measured.
inline constexpr double felt_share_of_squares = 1e-6;
// Probabilities beyond a two-sided 95 % interval at either end, and of a one-sided bound.
inline constexpr double tail_of_interval = 0.025, confidence_of_bound = 0.95;

// ---- Columns and candidates ----

// Number of columns up to which every pair of them is a candidate. A pair has about a dozen shapes,
// each as long as the data: pairs of a thousand columns would exhaust memory. Reason known; the
// value is chosen, not measured.
inline constexpr std::size_t most_columns_for_all_pairs = 100;
// Levels of a text column; one with more identifies tests. Chosen, not measured.
inline constexpr std::size_t most_levels_of_text = 12;
// Squared correlation above which two columns are one, up to offset and scale: 1 minus rounding.
inline constexpr double identical_r2 = 1 - 1e-9;
// Squared correlation above which two columns form no pair, as their product is a parabola of
// either. Introduced because a surface over sliding distance and displacement, nearly one column,
// ended the search of a shear cell campaign of 135 tests too early: with the rule, and with causes
// excluded that fit worse than none, its error fell from 0.292 to 0.141 kPa (as low as the
// truth's). The value itself is chosen, not measured.
inline constexpr double near_collinear_r2 = 0.98;
// Distance of the projections of two unit vectors on a common direction, within which the columns
// are compared. Unit vectors of identical columns differ by at most sqrt(1 - identical_r2)
// = 3.2e-5.
inline constexpr double same_projection_tolerance = 4e-5;
// Intervals between the quantiles that represent the tested values of a column, between which a
// form may not have a hump (plausibility.h). Chosen, not measured.
inline constexpr std::size_t quantile_intervals = 30;
// Campaigns that change one state at a time: a test changes a state if the state lies further from
// its median than this share of its range. Chosen, not measured.
inline constexpr double changed_share_of_range = 0.2;
// Share of the tests that may change more than one state in such a campaign. Chosen, not measured.
inline constexpr double share_of_tests_changing_several = 0.05;
// Tests below which a campaign is not judged to change one state at a time. Chosen, not measured.
inline constexpr Eigen::Index fewest_tests_for_one_factor = 5;
// Central range of a number, as a share of its median, from which on it may act together with
// others. Chosen, not measured.
inline constexpr double pair_spread_share_of_median = 0.2;

// ---- Terms: coordinates, splines, shapes ----

// Ratio of the largest to the least value above which a column is taken in ln x. Chosen, not
// measured.
inline constexpr double ratio_for_log = 4;
// The same for a column that starts at 0: ratio of the largest value to the shift below. Chosen,
// not measured.
inline constexpr double ratio_for_log_from_zero = 8;
// Quantile of the positive values of such a column, added to it before the logarithm. Chosen, not
// measured.
inline constexpr double log_shift_quantile = 0.05;
// Distinct values that such a column must exceed for a logarithm. Chosen, not measured.
inline constexpr std::size_t values_for_log_from_zero = 6;
// Ratio of the largest to the least value above which an input of a trained law is taken in ln x.
// Chosen, not measured.
inline constexpr double ratio_for_log_of_trained = 5;
// Values of a column are one if they differ by at most this share of its range: rounding.
inline constexpr double same_value_share_of_range = 1e-9;
// Knots of the spline of a column. Chosen, not measured.
inline constexpr std::size_t most_spline_knots = 9;
// Least distance between knots, as a share of the column's range. Chosen, not measured.
inline constexpr double knot_gap_share_of_range = 0.01;
// Bent columns (the smoothest first) that each partner gives to the product of two columns. Chosen,
// not measured.
inline constexpr Eigen::Index bent_columns_of_pair = 3;
// |cosine| between centred shapes of a grid above which one represents both. Chosen, not measured.
inline constexpr float same_shape_cosine = 0.999f;
// Norm below which a shape does not vary: rounding in single precision.
inline constexpr float smallest_norm_of_shape = 1e-6f;
// Rounding of a cosine in single precision, granted to the bound that rejects a pair of shapes
// early. Chosen, not measured.
inline constexpr float single_precision_slack = 1e-4f;
// |cosine| between sharp shapes of one column (thresholds, steps, humps) above which only the first
// is tried. Measured: 40 % fewer directions.
inline constexpr double same_sharp_shape_cosine = 0.97;
// |cosine| between the derivatives at two sites of the law above which the second is not offered.
// Chosen, not measured.
inline constexpr double same_site_cosine = 0.995;
// A saturating form needs a column whose least value is below this share of its largest, and a wave
// a column of whose range a typical test covers this share: else neither shows. Chosen, not
// measured.
inline constexpr double begun_share_of_largest = 0.5, reach_of_wave = 0.5;
// Least width of a local form, as a share of the widest gap between tested values. Chosen, not
// measured.
inline constexpr double narrowest_share_of_gap = 0.5;
// Limits of a fitted width: the column's range over the first, times the second. Chosen, not
// measured.
inline constexpr double spans_over_narrowest_width = 60, widest_width_in_spans = 6;

// ---- The regression: response, modes, term sizes and variances ----

// Measured friction over the law's, and its inverse, are cut here before the logarithm. Chosen, not
// measured.
inline constexpr double largest_response_ratio = 5;
// Pieces into which a test is cut, and their number in a campaign, which limits the cost: above 500
// tests each has fewer pieces, as many tests determine shared structure as well with fewer. Chosen,
// not measured.
inline constexpr std::size_t most_pieces_of_test = 12, fewest_pieces_of_test = 2;
inline constexpr std::size_t most_pieces_of_campaign = 6000;
// Standard deviations of a term's coefficients that are tried, in ln of friction: by the search for
// each term and flip, and for the terms that are in. Chosen, not measured.
inline constexpr double coarse_term_sizes[] = {0, 0.02, 0.1, 0.5};
inline constexpr double fine_term_sizes[] = {0, 0.008, 0.015, 0.03, 0.06, 0.12, 0.25, 0.5, 1};
// Least variance of a class of modes, (ln of friction)^2: a scatter of 0.003 %. Chosen, not
// measured.
inline constexpr double smallest_class_variance = 1e-9;
// A class of modes with fewer degrees of freedom takes the variance of the class before it. Chosen,
// not measured.
inline constexpr double fewest_class_freedom = 3;
// Least share of the squares of a class that a term may leave; bounds a logarithm in the likelihood
// where a term explains everything. Chosen, not measured.
inline constexpr double smallest_share_left = 1e-6;
// Alternations of coefficients and noise in a fit that starts from the response's mean square, and
// after terms have entered: the noise no longer changes. Chosen, not measured.
inline constexpr int noise_rounds_from_nothing = 4, noise_rounds_with_new_terms = 3;
// Added to a matrix that is factored, as a share of its largest entry: rounding of sums over rows.
inline constexpr double information_slack = 1e-9;
// Ridge of the law's own directions, as a share of their squares: they may be collinear, and are
// hardly shrunk. Chosen, not measured.
inline constexpr double law_ridge = 1e-8;
inline constexpr double smallest_law_ridge = 1e-10; // of a direction that is 0 everywhere
// Cosines over the order of tests that form the random walk. Chosen, not measured.
inline constexpr int walk_waves = 8;
// Log likelihood ratio above which the walk is part of the noise. Chosen, not measured.
inline constexpr double walk_log_likelihood_ratio = 2;
// Degrees of freedom of Student's t by which tests are weighted in each class of modes, so that one
// outlying test cannot decide. Chosen, not measured.
inline constexpr double weight_t_freedom = 4;
// Alternations of fit and weights before the search. Chosen, not measured.
inline constexpr int weight_rounds = 3;
// Share of the variance of a history's test means that the states must explain for the history to
// enter by its part within tests. Measured together with the comparison of each finding next to all
// others: error on held-out tests of a pin-on-disc look-alike from 0.062 and 0.066 to 0.052 and
// 0.041 MPa, of a reciprocating one from 12.8 to 10.0 MPa. The value itself is chosen.
inline constexpr double imitated_share_of_variance = 0.5;
// Share of the information about a column's coefficient that the law's parameters must leave for
// the column to be identifiable. Chosen, not measured.
inline constexpr double identifiable_share_of_information = 0.02;

// ---- The gate: how rare a term is by chance ----

// Levels of the two rounds in units of trace.alpha. Their sum exceeds 1, but findings must also
// predict left-out tests. Measured as a whole: 3 false alarms in 400 campaigns that lack nothing,
// at trace.alpha = 0.02.
inline constexpr std::array<double, 2> round_shares_of_alpha = {1, 0.5};
// Level of the look-ahead in units of its round's level. Measured: with 0.5 in place of 0.25 hidden
// causes of a look-alike are found, and false alarms stay at 3 of 400.
inline constexpr double look_ahead_share_of_level = 0.5;
// Terms of a path of the look-ahead. Chosen, not measured.
inline constexpr std::size_t look_ahead_terms = 3;
// Flips of a look-ahead, and the first of them: it ends there if its p-value on these exceeds the
// limit. Reason: time (with other changes, a trace took a third less). Chosen, not measured alone.
inline constexpr std::size_t look_ahead_flips = 199;
inline constexpr Eigen::Index first_look_ahead_flips = 49;
inline constexpr double look_ahead_end_p_value = 0.2;
// Flips of a step: this product over the number of terms, within the limits. Few terms are cheap
// and get more flips, hence more precise p-values. 999 resolve p-values of 0.001. The other values
// are chosen, not measured.
inline constexpr std::size_t flips_times_terms = 500000;
inline constexpr std::size_t fewest_flips = 999, most_flips = 4999;
// Terms that may enter, both rounds together. Chosen, not measured.
inline constexpr std::size_t most_terms_found = 8;
// Multiple of the threshold of rarity above which terms are ranked by likelihood, because a share
// among flips no longer distinguishes them. Chosen, not measured.
inline constexpr double thresholds_for_ranking_by_likelihood = 2;
// Terms that may fail for unequal scatter of tests (HC3) before the search ends; one more ends it.
// Chosen, not measured.
inline constexpr std::size_t most_unsure_terms = 6;
// A term is a rival of one that entered if its log likelihood ratio exceeds this share of that
// one's, with all other terms in the fit; and the number of rivals. Chosen, not measured.
inline constexpr double near_rival_share_of_ratio = 0.7;
inline constexpr std::size_t most_near_rivals = 12;
// Relative difference of ratios that differ by rounding: with few tests many flips are equal.
inline constexpr double same_ratio_tolerance = 1e-6;
// Weight of the theoretical tail of a likelihood ratio (mean excess 1), as a number of values added
// to those observed. Chosen, not measured.
inline constexpr double theoretical_tail_values = 5;
// One of so many flips is in the tail of the largest ratios, beyond which rarity is extrapolated.
// Chosen, not measured.
inline constexpr Eigen::Index flips_per_tail_value = 10;
// Norm below which the fit explains all of a flip, which is then not scaled up: rounding.
inline constexpr double smallest_norm_of_flip = 1e-15;
// The test with unequal variances (HC3): norm below which a term is a combination of the others,
// and the least share of a test that the fit leaves to it. Chosen, not measured.
inline constexpr double collinear_norm = 1e-9, smallest_leverage_left = 0.02;
// Steps of the iteration for a term's threshold, which shrinks the error at each. Chosen, not
// measured.
inline constexpr int threshold_iterations = 50;
// Standard deviation of a lead's coefficient, in ln of friction: so large (friction times e) that
// the estimate is not shrunk. Chosen, not measured.
inline constexpr double lead_coefficient_size = 1;
// Standard errors above a threshold for a probability of 80 %: the normal quantile.
inline constexpr double std_errors_for_80_percent = 0.84;

// ---- Fits of the law with effects ----

// The law's own parameters are tied to those without effects by this share of the tests'
// information about them (tie_parameters): a tenth is negligible where the tests separate a
// parameter from an effect, and decides where only other states would. All of it where tests change
// one state at a time. Chosen, not measured.
inline constexpr double tied_share_of_information = 0.1, tied_share_by_one_factor = 1;
// Root mean square of the residual, as a share of tau_R, below which a law is exact and lacks
// nothing. Chosen, not measured.
inline constexpr double exact_law_share_of_tau = 1e-4;
// Tests that represent a larger campaign where a few hundred serve as well: the largest campaign
// that is not reduced. 200 tests determine a standard deviation between tests to
// 1/sqrt(2 x 200) = 5 %, which changes no weight that matters.
inline constexpr std::size_t selected_tests = stats::uncut_experiments;
// Steps of a fit to all tests that starts from the end of a fit to selected tests and only serves a
// choice. Chosen, not measured.
inline constexpr int most_steps_from_selected = 12;
// Shares of the cost by which the last step of a fit reduces it: fits of folds and of selected
// tests; with many tests, where the cost is so large that a millionth is far less than a unit of
// log likelihood; and fits that only serve a choice. Chosen, not measured.
inline constexpr double coarse_fit_end = 1e-5, fit_end_with_many_tests = 1e-6;
inline constexpr double fit_end_of_choice = 1e-8;
// Widths by which the limit is rounded off, one fit after the other, as shares of the mean stress:
// otherwise rows below it have no influence on it. Chosen, not measured.
inline constexpr double rounding_widths_of_limit[] = {0.15, 0.05};
// Ridge of the effective number of parameters, as a share of the largest information: rounding.
inline constexpr double freedom_ridge = 1e-12;
// Change of a factor for central differences by it: +-6 %, so that rows near the limit feel mu as
// well as the limit. Reason known; the value is chosen, not measured.
inline constexpr double factor_step = 0.06;
// Knots of the piecewise linear functions that stand for any form of a quantity, so that the misfit
// of a chosen form is not found as another effect of it. Chosen, not measured.
inline constexpr int knots_of_any_form = 7;
// Parts of a test from whose means the variance of its gain is estimated, rows that each must have,
// and parts below which the variance is taken from the other tests. Chosen, not measured.
inline constexpr std::size_t most_gain_parts = 10, rows_per_gain_part = 5, fewest_gain_parts = 3;
// Least argument of the logarithm of a gain: measured friction over the law's. Chosen, not
// measured.
inline constexpr double smallest_gain_ratio = 1e-3;

// ---- The choice of causes and forms ----

// Causes on the shortlist from which a set is made. Chosen, not measured.
inline constexpr std::size_t shortlisted_causes = 6;
// Standard errors of log likelihood over the selected tests from which on a cause is dropped before
// the fit to all tests: what a few hundred tests separate this clearly, all separate even more
// clearly, so it cannot be in a set. The value is chosen, not measured.
inline constexpr double distinguishable_std_errors = 3;
// Costs of a step away from recorded columns (complexity): in -2 log likelihood where causes are
// compared, in log likelihood where fits are. Both are the same cost. Chosen, not measured.
inline constexpr double cause_step_cost = 3;
inline constexpr double rival_step_cost = 1.5;
// Cost of a parameter, in log likelihood. Chosen, not measured.
inline constexpr double parameter_cost = 2.5;
// Costs of the sites mu, limit, addition to tau_R, and mu with limit (`sites` of rivals.h), in log
// likelihood: where the data cannot distinguish sites, an effect acts on mu. Chosen, not measured.
inline constexpr std::array<double, 4> site_costs = {0.0, 0.5, 1.5, 0.25};
// Cost of a smooth, in log likelihood: a closed form replaces it if it is at most this much less
// likely. Chosen, not measured.
inline constexpr double smooth_cost = 3;
// Penalty, times the square of an amplitude, where a form has none of its own: so weak that it only
// makes the smooth's equations solvable. Chosen, not measured.
inline constexpr double penalty_of_plain_amplitudes = 1e-3;
// Largest amplitude at which the fit of a closed form starts: half of friction, either way. Chosen,
// not measured.
inline constexpr double largest_start_amplitude = 0.5;
// Closed forms that are fitted at each site, and forms that are then fitted to all tests where the
// first fits are to selected ones. Chosen, not measured.
inline constexpr std::size_t most_forms_at_site = 8;
inline constexpr std::size_t most_forms_on_all_tests = 3;
// Intervals of an effect's range at whose ends its factor is examined for humps. Chosen, not
// measured.
inline constexpr int plausibility_intervals = 32;
// Costs, in log likelihood: times the square of the largest change of friction (as if changes were
// normal with a standard deviation of 50 %: 1/(2 x 0.5^2)), and of a factor that is not finite.
// Chosen, not measured.
inline constexpr double large_change_cost = 2, infinite_factor_cost = 1e6;
// Cost of a hump, in log likelihood, times the range of the factor between tested values beyond
// that at them, in units of the latter: what is tolerated, and the most that counts. Chosen, not
// measured.
inline constexpr double hump_cost = 8, tolerated_hump = 0.3, largest_hump = 10;
// Least range of a factor at tested values in that quotient. Chosen, not measured.
inline constexpr double smallest_tested_range = 1e-6;
// Resamples of whole tests by which rivals are compared with the best. A share of 95 % is then
// known to 1 %. Chosen, not measured.
inline constexpr std::size_t rival_resamples = 500;
// Difference of log restricted likelihood below which rivals are in one set: e^2, or 7 to 1.
// Chosen, not measured.
inline constexpr double clear_lead_of_criterion = 2;

// ---- Judging on unseen tests ----

// Folds of whole tests. Chosen, not measured.
inline constexpr std::size_t most_folds = 10;
// Tests have one setting, and are left out together, if each state differs by less than this, in
// its standard deviations over tests: repeats would predict each other. Chosen, not measured.
inline constexpr double same_setting_std_deviations = 0.25;
// A term is dropped if the score of left-out tests falls by at most this without it, in standard
// errors over tests. Chosen, not measured.
inline constexpr double worth_of_term_std_errors = 1;
// Least standard error of a score: rounding.
inline constexpr double smallest_score_error = 1e-12;
// Degrees of freedom of Student's t in the scores of the regression (per mode) and of the law (per
// test): one test for which a fold's noise is too small does not outweigh all others. Chosen, not
// measured.
inline constexpr double mode_score_t_freedom = 4;
inline constexpr double law_score_t_freedom = 5;
// Largest ratio between law and measurement in an error of a left-out test, either way. Introduced
// because fits of a few folds of a shear cell campaign ended at a law without friction, where
// scores were not numbers. The value is chosen, not measured.
inline constexpr double largest_error_ratio = 1e3;
// Plain weights are used if their error is below this share of the error under the noise model's
// weights: these are better where the law is right, and may spoil a law that is wrong itself. Among
// 75 campaigns with an effect 8 were made worse before effects were compared with the law under its
// better weights, and none of 150 after. The value (0.96 until then) is chosen, not measured.
inline constexpr double plain_weights_share_of_error = 0.98;
// Standard errors below which the 95 % interval of an effect includes "none": the normal quantile.
// Such an effect is removed where all rows weigh alike.
inline constexpr double doubtful_std_errors = 1.96;
// With fewer validation tests, these are searched together with the training tests and
// cross-validation judges: they are too few for a veto, and their information is needed. Chosen
// (before the joint search: 8), not measured.
inline constexpr std::size_t fewest_judging_validation_tests = 20;

// ---- Delivery, verdict and leads ----

// Effects are implausibly good if they leave less than this share of the mean square: R^2 above
// 0.999. Introduced because a torque from which the stress is computed was named as its cause and
// left a millionth of the error. The value is chosen, not measured.
inline constexpr double implausible_share_left = 1e-3;
// p-value below which validation tests differ from training tests as a whole. Chosen, not measured.
inline constexpr double validation_shift_p_value = 1e-3;
// The validation tests hardly vary a column if it spreads less than this share of its spread over
// the training rows. Chosen, not measured.
inline constexpr double small_share_of_spread = 0.2;
// The scatter agrees with repeated tests if it is at most this multiple of their repeatability: few
// repeats determine it poorly, so that a significance test alone would nearly always agree. Chosen,
// not measured.
inline constexpr double repeatability_slack = 1.2;
// Least share of the degrees of freedom that the parameters leave in a bound of the noise, and
// degrees of freedom of repeats from which on they give a repeatability. Chosen, not measured.
inline constexpr double smallest_freedom_left = 0.5, fewest_degrees_of_repeats = 3;
// The scatter between tests lies below this multiple of their variance, plus the least end;
// halvings of that interval, down to rounding. Variance of a gain at least: rounding.
inline constexpr double widest_scatter_ratio = 10, smallest_scatter_end = 1e-12;
inline constexpr int scatter_halvings = 80;
inline constexpr double smallest_gain_variance = 1e-18;
// p-value above which chance is the simplest explanation of a lead. Chosen, not measured.
inline constexpr double chance_p_value = 0.2;
// Change of mu per e-fold of speed from which on a lead's text gives the law's own: rounding.
inline constexpr double smallest_rate_named = 1e-9;
// Channels and outcomes are compared with the residual from this number of tests on. Chosen, not
// measured.
inline constexpr Eigen::Index fewest_tests_for_followers = 5;
// Effect on tau_R for which the necessary number of tests is given (trace --power), as a share.
// Chosen as an example.
inline constexpr double wanted_share_of_tau = 0.02;

// ---- What the design ties to a state ----

// Share of the variance of a state's test means that a column must explain to be tied to it. The
// standard error of the column's effect is then more than (1 - 0.9)^-1/2 = 3 times that of a design
// that crosses the two.
inline constexpr double aliased_share_of_variance = 0.9;
// Largest variation of a setting within a test, as a share of its range. Chosen, not measured.
inline constexpr double held_share_of_range = 1e-3;
// Range of a level's tests, as a share of their mean, that the text gives as one value. Chosen, not
// measured.
inline constexpr double same_value_share_of_mean = 0.05;
// Range of a state's test means, as a share of what a test runs through, from which on the tests
// differ in it. Chosen, not measured.
inline constexpr double apart_share_of_range = 0.1;
// Share of a value by which two significant digits may change it in a text. Chosen, not measured.
inline constexpr double rounded_share_of_value = 0.01;
// Tests below which aliases are not sought. Chosen, not measured.
inline constexpr std::size_t fewest_tests_for_aliases = 4;

// ---- The order of tests ----

// Permutations of the order; they resolve p-values of 0.001.
inline constexpr std::size_t order_permutations = 999;
// Level of the test along the order in units of trace.alpha. Measured as a whole, with earlier
// searches: structure in 4 of 1000 campaigns that lack nothing, at trace.alpha = 0.02.
inline constexpr double order_share_of_alpha = 0.5;
// A structure along the order has a direction if a step or a line leaves less than this share of
// the squares of the tests' gains; half the range of a random walk is explained by a line.
inline constexpr double most_left_by_direction = 0.7;
// Cosines over the order whose squares the test adds up. Chosen, not measured.
inline constexpr int order_test_waves = 4;
// Tests below which their order is not tested. Chosen, not measured.
inline constexpr std::size_t fewest_tests_for_order = 10;
// Standard errors by which neighbours by name are more alike than by chance: the normal quantile of
// 1 %, one-sided.
inline constexpr double drift_std_errors = 2.33;
// Maximum distance of tests that may be alike, as in a batch; nearer ones weigh more. Measured:
// batches of nine show, 97 in place of 92 % of hidden causes along the order are reported.
inline constexpr Eigen::Index largest_batch_distance = 6;
// Slow functions of the order that are removed once a structure is found, at most. Chosen, not
// measured.
inline constexpr int most_order_functions = 12;
// Tests for each of these functions, at least. Chosen, not measured.
inline constexpr std::size_t tests_per_order_function = 5;

// ---- Advice on next tests ----

// Tests of a plan. Chosen, not measured.
inline constexpr std::size_t fewest_advised_tests = 3, most_advised_tests = 6;
// Tests of two settings in turn: two of each. Chosen, not measured.
inline constexpr std::size_t fewest_tests_in_turn = 4;
// Rivals that a plan distinguishes. Chosen, not measured.
inline constexpr std::size_t most_rivals_in_plan = 4;
// Probability with which a plan settles the question: 80 %, the usual power of an experiment.
inline constexpr double wanted_power = 0.8;
// Standard errors of a two-sided test at 5 %: the normal quantile.
inline constexpr double two_sided_std_errors = 1.96;
// No plan is given where more tests would be needed (nobody would run them), or where it succeeds
// with a smaller probability. Chosen, not measured.
inline constexpr double most_tests_needed = 60;
inline constexpr double smallest_power = 0.2;
// A plan with one setting fewer is preferred if it keeps this share of the standardised amplitude.
// Chosen, not measured.
inline constexpr double kept_share_of_amplitude = 0.97;
// Ridge of the parameters, as a share of each one's information: for parameters without any.
// Chosen, not measured.
inline constexpr double information_ridge = 1e-9;
// Relative gain of the determinant for which a test of a plan is exchanged: above rounding, so that
// the exchange ends. Chosen, not measured.
inline constexpr double determinant_gain_that_counts = 1e-6;
// Settings that candidate tests vary: 3^5 combinations of three values. Chosen, not measured.
inline constexpr std::size_t most_varied_settings = 5;
// Rows of a candidate test; more would not change a decision. Chosen, not measured.
inline constexpr std::size_t most_candidate_rows = 200;
// Least range of a setting that was varied, as a share of its mean. Chosen, not measured.
inline constexpr double varied_share_of_mean = 0.02;
// A number is set only to values that tests have if these are few, and tests many per value.
// Chosen, not measured.
inline constexpr std::size_t most_fixed_values = 5, tests_per_fixed_value = 2;
// Width by which the range of the campaign is extended at either end, as a share of it. Chosen, not
// measured.
inline constexpr double range_extension = 0.1;
// Least value of a positive quantity that is extended downwards, as a share of the least one
// tested, and the share of the range by which a candidate's rows may exceed it: rounding of
// settings. Chosen, not measured.
inline constexpr double kept_share_of_least = 0.5, reach_tolerance = 0.01;
// Least amplitude of one test, in standard errors: bounds the number of tests needed.
inline constexpr double smallest_amplitude_of_test = 1e-9;

// ---- Curves for plots ----

// Place of the other inputs of an effect of several, in their ranges from the least value to the
// largest. Chosen, not measured.
inline constexpr double place_of_other_inputs = 0.75;

} // namespace frictab::trace::tuning
