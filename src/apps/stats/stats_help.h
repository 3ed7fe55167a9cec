#pragma once

namespace icome::apps {

// The words of `icome stats --help` that do not stand beside an option.

constexpr const char* kStatsSummary =
    "Statistics of a table: describe it, test for differences and similarities, draw the result";

constexpr const char* kDescribeSummary =
    "Mean, median, mode, spread, quartiles, skewness, and outliers with and without which all is told";
constexpr const char* kAnovaSummary =
    "Analysis of variance: one-way, factorial, repeated measures and mixed, with its assumptions";
constexpr const char* kTTestSummary = "Compare a mean with a value, two groups, or two values of each person";
constexpr const char* kWilcoxonSummary = "Compare two groups, or two values of each person, by ranks";
constexpr const char* kKruskalSummary = "Compare groups by ranks (Kruskal-Wallis)";
constexpr const char* kFriedmanSummary =
    "Compare what the same people did under several conditions, by ranks";
constexpr const char* kChiSquaredSummary =
    "Counts: spread as expected (one factor), or independent (two factors)?";
constexpr const char* kFisherSummary = "The same of two factors, exact, for small counts";
constexpr const char* kMcNemarSummary =
    "Counts before and after of the same people: do as many change each way?";
constexpr const char* kBinomialSummary =
    "Counts of two kinds: is the first one's share as said? Of better and worse it is the sign test";
constexpr const char* kPearsonSummary =
    "Correlation of two columns with its critical value, or of each with each";
constexpr const char* kSpearmanSummary = "The same of ranks";
constexpr const char* kTukeySummary = "Which groups differ: all pairs after Tukey, or by t-tests after Holm";
constexpr const char* kPowerSummary = "How likely a test finds an effect, or how many people it takes";

constexpr const char* kStatsExamples =
    "Examples:\n"
    "  icome stats describe times.csv --factor interface\n"
    "  icome stats anova times.csv --response \"time (s)\" --factor interface --plot times.svg\n"
    "  icome stats anova times.csv --response \"time (s)\" --factor interface --factor gender --type 3\n"
    "  icome stats anova long.csv --response errors --within condition --subject id --factor gender\n"
    "  icome stats anova long.csv --response errors --within condition --within task --subject id \\\n"
    "      --post-hoc condition --simple condition     which conditions differ, and for each task which\n"
    "  icome stats anova times.csv --response \"time (s)\" --factor dose --levels dose=none,low,high\n"
    "  icome stats describe times.csv --column \"time (s)\" --factor interface --z with-z.csv\n"
    "  icome stats mcnemar --counts 30,12/5,40     12 changed one way, 5 the other; --yates corrects\n"
    "  icome stats anova SmLs01.dat --json         a reference dataset of NIST: its columns are known\n"
    "  icome stats ttest times.csv --response \"time (s)\" --factor interface\n"
    "  icome stats ttest wide.csv --column before --column after --paired\n"
    "  icome stats chisq --counts 63,180/16,180    63 of 243 clicks wrong against 16 of 196\n"
    "  icome stats pearson times.csv --column \"time (s)\" --column errors --plot tradeoff.png\n"
    "  icome stats tukey times.csv --response \"time (s)\" --factor interface\n"
    "  icome stats power ttest --effect 0.5 --power 0.8\n"
    "\n"
    "A table has a row a case and names its columns in the first row: CSV with commas, semicolons (where "
    "2,5\n"
    "is a number) or tabs. Empty cells, NA, NaN and a single point are missing values; what is left out for\n"
    "them is told in the notes. Wherever a column is named, its heading goes letter by letter.\n"
    "\n"
    "JSON: test, warnings, and for\n"
    "  anova     table [{term, df, ss, ms, f, p, eta_sq, partial_eta_sq, partial_eta_sq_interval (90 %),\n"
    "            generalised_eta_sq, omega_sq, partial_omega_sq}], residual {df, ss, ms}, total_ss, n,\n"
    "            missing, type, response, cells [{levels, n, mean, sd, mean_interval}], assumptions\n"
    "            {brown_forsythe and levene {f, df, error_df, p}, shapiro_wilk {w, p, n}}; with --welch\n"
    "            welch {f, df, error_df, p}. With --within between_subjects {df, ss, ms}, subjects, and "
    "each\n"
    "            term has error {df, ss, ms}, sphericity {mauchly_w, p, greenhouse_geisser, huynh_feldt,\n"
    "            lower_bound}, p_greenhouse_geisser and p_huynh_feldt, and the other shares have intervals\n"
    "            too (generalised_eta_sq_interval, omega_sq_interval, partial_omega_sq_interval); cells "
    "have\n"
    "            within_interval; residual is the last term's error.\n"
    "            --post-hoc: post_hoc [{factor, test, adjustment, comparisons [{first, second, difference "
    "(of\n"
    "            the second less the first), t, df, interval, p, p_adjusted, d, d_interval, why}]}];\n"
    "            --simple: simple_effects [{factor, test, adjustment, effects [{at {factor: level}, "
    "subjects,\n"
    "            f, df, error_df, epsilon, p, p_adjusted, eta_sq, comparisons, why}]}]\n"
    "  describe  columns [{name, n, missing, mean, median, modes, sd, variance, minimum, lower_quartile,\n"
    "            upper_quartile, maximum, skewness, excess_kurtosis, standard_error, mean_interval,\n"
    "            outliers [{line, value, z}], without_outliers}]; with --z z_columns, the headings\n"
    "  ttest     t, df, p, difference, standard_error, interval, d, d_interval, groups, assumptions\n"
    "  wilcoxon  u or v, z, p, exact, rank_biserial, ties, zeros, groups\n"
    "  kruskal   h, df, p, epsilon_squared, groups;  friedman  chi_squared, df, p, kendall_w, groups\n"
    "  chisq     chi_squared, df, p, w, cramers_v, observed, expected, residuals\n"
    "  fisher    p, odds_ratio, interval;  mcnemar  chi_squared, df, p, yates, exact_p, odds_ratio\n"
    "  binomial  share, interval, null_share, p\n"
    "  pearson   r, t, df, p, interval, critical_r;  spearman  rho, s, p, exact; of more than two columns\n"
    "            matrices r (or rho), p and n\n"
    "  tukey     comparisons [{first, second, difference, q or t, df, interval, p_adjusted}]\n"
    "  power     effect, alpha, n, power\n"
    "  Numbers have all their digits; null is what is not defined or infinite. It goes to standard output,\n"
    "  all messages to standard error.\n"
    "\n"
    "Exit code: 0 done, 1 something could not be done, 2 wrong usage.";

}  // namespace icome::apps
