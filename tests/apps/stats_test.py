"""`icome stats` describes tables, tests them and draws the results. Expected numbers are R 4.2's where not said otherwise."""
import csv
import json
import math
import re
import struct
import unittest

from icome_program import SHARED_MESHES, ProgramTest, run

SHARED = SHARED_MESHES.parent / "stats"
NIST = SHARED / "nist-strd-anova"
R_DATA = SHARED / "r-datasets"

# R's PlantGrowth: weight by group.
PLANTS = {
    "ctrl": (4.17, 5.58, 5.18, 6.11, 4.50, 4.61, 5.17, 4.53, 5.33, 5.14),
    "trt1": (4.81, 4.17, 4.41, 3.59, 5.87, 3.83, 6.03, 4.89, 4.32, 4.69),
    "trt2": (6.31, 5.12, 5.54, 5.50, 5.37, 5.29, 4.92, 6.15, 5.80, 5.26),
}
# R's sleep: hours more of sleep of ten people with two drugs (Student 1908).
SLEEP = ((0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0), (1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4))


def png_size(data):
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    return struct.unpack(">II", data[16:24])


class StatsTest(ProgramTest):
    def plants(self, extra=""):
        rows = "".join(f"{value},{group}\n" for group, values in PLANTS.items() for value in values)
        return self.write("plants.csv", "weight (g),group\n" + rows + extra)

    def sleep(self):
        rows = (f"{value},{drug + 1},{person}\n" for drug in (0, 1) for person, value in enumerate(SLEEP[drug]))
        return self.write("sleep.csv", "extra,drug,person\n" + "".join(rows))

    def answer(self, *arguments):
        return json.loads(self.succeeds("stats", *arguments, "--json").stdout)

    def close(self, actual, expected, digits=9):
        self.assertTrue(math.isclose(actual, expected, rel_tol=10.0 ** -digits, abs_tol=1e-300), f"{actual} {expected}")

    # ------------------------------------------------------------ people within conditions

    # Seven people, four novices and three experts, with three ways of pointing at two targets; invented. Expected
    # numbers are R 4.2's (t.test, aov, p.adjust, pf with noncentrality), as in tests/stats/level_comparisons_test.cpp.
    MIXED = ((1.2, 2.1, 1.9, 3.2, 1.4, 2.9), (1.1, 1.8, 2.2, 3.0, 1.6, 2.5), (1.5, 2.6, 2.4, 4.1, 1.9, 3.0),
             (0.9, 1.9, 1.7, 2.8, 1.2, 2.6), (0.8, 1.2, 1.1, 1.9, 1.3, 1.4), (0.7, 1.5, 1.4, 2.1, 0.9, 1.6),
             (1.0, 1.4, 1.3, 1.6, 1.2, 1.9))

    def mixed(self):
        rows = (f"{person},{'novice' if person < 4 else 'expert'},{('ray', 'hand', 'wim')[i // 2]},"
                f"{('near', 'far')[i % 2]},{value}\n"
                for person, values in enumerate(self.MIXED) for i, value in enumerate(values))
        return self.write("mixed.csv", "person,group,way,target,t\n" + "".join(rows))

    def mixed_answer(self, *arguments):
        return self.answer("anova", self.mixed(), "--response", "t", "--within", "way", "--within", "target", "--factor",
                           "group", "--subject", "person", *arguments)

    def test_within_subject_intervals_stand_beside_plain_ones(self):
        report = self.mixed_answer()
        # R: N <- X - rowMeans(X) + mean(X) of each group; sd * sqrt(6 / 5) / sqrt(n) * qt(.975, n - 1) about the mean
        expected = {("novice", "ray", "near"): (1.04213313142918, 1.30786686857082),
                    ("novice", "hand", "far"): (2.81298169066574, 3.73701830933426),
                    ("expert", "wim", "near"): (0.474529271397774, 1.792137395268892)}
        cells = {(c["levels"]["group"], c["levels"]["way"], c["levels"]["target"]): c for c in report["cells"]}
        self.assertEqual(len(cells), 12)
        for key, (low, high) in expected.items():
            self.close(cells[key]["within_interval"][0], low)
            self.close(cells[key]["within_interval"][1], high)
        self.assertNotEqual(cells[("novice", "ray", "near")]["mean_interval"],
                            cells[("novice", "ray", "near")]["within_interval"])
        text = self.succeeds("stats", "anova", self.folder / "mixed.csv", "--response", "t", "--within", "way",
                             "--within", "target", "--factor", "group", "--subject", "person").stdout
        self.assertIn("within-subject 95 % CI", text)
        self.assertIn("Effect sizes, partial, generalised and omega squared", text)

    def test_effects_within_people_have_intervals(self):
        rows = "".join(f"{person},{('ray', 'hand', 'wim')[way]},{(v[2 * way] + v[2 * way + 1]) / 2}\n"
                       for person, v in enumerate(self.MIXED) for way in range(3))
        report = self.answer("anova", self.write("ways.csv", "person,way,t\n" + rows), "--response", "t", "--within",
                             "way", "--subject", "person")
        (term,) = report["table"]
        for name, value, low, high in (
                ("partial_eta_sq", 0.828753993610224, 0.564515352975144, 0.880205314476658),
                ("generalised_eta_sq", 0.319559325613318, 0.135876617423442, 0.471256605149769),
                ("partial_omega_sq", 0.279892721448260, 0.118771132029773, 0.433090942604504),
                ("omega_sq", 0.279892721448260, 0.118771132029773, 0.433090942604504)):
            self.close(term[name], value)
            self.close(term[name + "_interval"][0], low, 6)
            self.close(term[name + "_interval"][1], high, 6)

    def test_levels_are_compared_after_the_analysis(self):
        report = self.mixed_answer("--post-hoc", "way", "--post-hoc", "group", "--simple", "way")
        way, group = report["post_hoc"]
        self.assertEqual((way["factor"], way["test"], way["adjustment"]), ("way", "paired t-test", "Holm"))
        first = way["comparisons"][0]
        self.assertEqual((first["first"], first["second"]), ("ray", "hand"))
        self.close(first["t"], 6.049193494630824)
        self.close(first["p"], 0.000924042908472241)
        self.close(first["p_adjusted"], 0.001848085816944483)
        self.assertEqual(group["test"], "Welch's t-test")
        self.close(group["comparisons"][0]["p"], 0.0124639764468, 7)
        (simple,) = report["simple_effects"]
        self.assertEqual(len(simple["effects"]), 4)
        there = next(e for e in simple["effects"] if e["at"] == {"target": "near", "group": "novice"})
        self.close(there["f"], 96.3103448275859)
        self.close(there["p"], 0.00184078832820513)
        self.close(there["p_adjusted"], 0.00736315331282053)
        self.close(there["comparisons"][2]["p_adjusted"], 0.00283439365124133)
        text = self.succeeds("stats", "anova", self.folder / "mixed.csv", "--response", "t", "--within", "way",
                             "--within", "target", "--factor", "group", "--subject", "person", "--post-hoc", "way",
                             "--simple", "group").stdout
        self.assertIn("way, averaged over all else: paired t-tests of pairs, after Holm over 3", text)
        self.assertIn("Simple effects of group: Welch's test at each level of the others", text)

    def test_comparisons_say_what_they_need(self):
        file = self.mixed()
        common = ("stats", "anova", file, "--response", "t")
        self.fails(*common, "--factor", "way", "--post-hoc", "way", code=2, saying="--post-hoc goes with --within")
        self.fails(*common, "--within", "way", "--subject", "person", "--post-hoc", "target", code=1,
                   saying="'target' is no factor of this analysis")
        self.fails(*common, "--within", "way", "--subject", "person", "--simple", "way", code=1,
                   saying="there is no other factor")

    def test_levels_stand_as_they_are_told(self):
        rows = "".join(f"{dose},{value}\n" for dose, value in ((10, 1.0), (2, 3.0), (10, 1.5), (2, 3.5), (5, 7), (5, 8)))
        file = self.write("doses.csv", "dose,effect\n" + rows)

        def levels(*arguments):
            report = self.answer("anova", file, "--response", "effect", "--factor", "dose", *arguments)
            return [cell["levels"]["dose"] for cell in report["cells"]]

        self.assertEqual(levels(), ["2", "5", "10"])
        self.assertEqual(levels("--levels", "dose"), ["10", "2", "5"])
        self.assertEqual(levels("--levels", "dose=5,10,2"), ["5", "10", "2"])
        for told, saying in (("dose=5,10", "2 of 3 are named"), ("dose=5,10,3", 'there is no "3"'),
                             ("dose=5,5,10,2", '"5" is there twice'), ("doses=5", "names no factor")):
            self.fails("stats", "anova", file, "--response", "effect", "--factor", "dose", "--levels", told, code=1,
                       saying=saying)
        report = self.answer("ttest", self.sleep(), "--response", "extra", "--factor", "drug", "--levels", "drug=2,1")
        self.close(report["t"], 1.860813, 5)  # of R's sleep with the groups exchanged
        odd = self.write("odd.csv", 'kind,n\n"a,b",1\nö,2\n"a,b",3\nö,5\n')
        report = self.answer("describe", odd, "--column", "n", "--factor", "kind", "--levels", 'kind=ö,"a,b"')
        self.assertEqual([column["name"] for column in report["columns"]], ["ö", "a,b"])

    def test_z_scores_are_a_column(self):
        # R: (x - mean(x)) / sd(x) of 2.5, 3, 4.25, 8
        expected = (-0.7792323356072561, -0.5781401199666739, -0.0754095808652183, 1.4327820364391484)
        file = self.write("z.csv", 'who,"time ""s"""\n"Ann, B.",2.5\nÉva,3\nCy,\nDi,4.25\nEd,8\n')
        out = self.folder / "with-z.csv"
        report = self.answer("describe", file, "--column", 'time "s"', "--z", out)
        self.assertEqual(report["z_columns"], ['z of time "s"'])
        with open(out, encoding="utf-8", newline="") as lines:
            rows = list(csv.DictReader(lines))
        self.assertEqual([row["who"] for row in rows], ["Ann, B.", "Éva", "Cy", "Di", "Ed"])
        self.assertEqual(rows[2]['z of time "s"'], "")
        for row, z in zip([rows[0], rows[1], rows[3], rows[4]], expected):
            self.close(float(row['z of time "s"']), z)
        again = self.answer("describe", out, "--column", 'z of time "s"')
        self.close(again["columns"][0]["sd"], 1.0)
        commas = self.write("commas.csv", "who;x\na;2,5\nb;3\nc;4,25\nd;8\n")
        self.answer("describe", commas, "--z", out)
        self.assertEqual(out.read_text().splitlines()[0], "who;x;z of x")
        self.close(self.answer("describe", out, "--column", "z of x")["columns"][0]["maximum"], expected[3])
        self.fails("stats", "describe", file, "--z", file, code=2, saying="would replace the data")
        self.fails("stats", "describe", file, "--z", file.parent / "." / ".." / file.parent.name / file.name, code=2,
                   saying="would replace the data")
        self.fails("stats", "describe", file, "--z", "z.txt", code=2, saying=".csv nor in .tsv")

    def test_mcnemar_is_without_correction_unless_asked(self):
        # mcnemar.test(matrix(c(30, 12, 5, 40), 2, byrow = TRUE), correct = FALSE), then TRUE; binom.test(12, 17)
        plain = self.answer("mcnemar", "--counts", "30,12/5,40")
        self.close(plain["chi_squared"], 2.882352941176471)
        self.close(plain["p"], 0.0895550744136, 7)
        self.assertFalse(plain["yates"])
        corrected = self.answer("mcnemar", "--counts", "30,12/5,40", "--yates")
        self.close(corrected["chi_squared"], 2.117647058823529)
        self.close(corrected["p"], 0.145610095397, 7)
        self.assertTrue(corrected["yates"])
        for report in (plain, corrected):
            self.close(report["exact_p"], 0.143463134765625)

    # ------------------------------------------------------------ analysis of variance

    def test_anova_keeps_its_contract(self):
        report = self.answer("anova", self.plants(), "--response", "weight (g)", "--factor", "group")
        (term,) = report["table"]
        self.assertEqual(term["term"], "group")
        self.assertEqual(term["df"], 2)
        self.close(term["f"], 4.8460878623801333)
        self.close(term["p"], 0.0159099583256229)
        self.close(term["ss"], 3.7663399999999969)
        self.close(term["ms"], 3.76634 / 2)
        self.close(report["residual"]["ss"], 10.49209)
        self.assertEqual(report["residual"]["df"], 27)
        self.close(report["residual"]["ms"], 10.49209 / 27)
        share = 3.76634 / (3.76634 + 10.49209)
        self.close(term["eta_sq"], share)
        self.close(term["partial_eta_sq"], share)
        self.close(term["omega_sq"], (3.76634 - 2 * 10.49209 / 27) / (3.76634 + 10.49209 + 10.49209 / 27))
        self.assertEqual(report["n"], 30)
        self.assertEqual(report["warnings"], [])
        self.close(report["assumptions"]["shapiro_wilk"]["p"], 0.437898595506217, 6)  # shapiro.test of residuals
        self.close(report["assumptions"]["brown_forsythe"]["f"], 1.11918569487039)  # anova(lm(|x - median| ~ group))
        self.assertEqual([it["levels"]["group"] for it in report["cells"]], list(PLANTS))

    def test_anova_reads_like_a_paper(self):
        text = self.succeeds("stats", "anova", self.plants(), "--response", "weight (g)", "--factor", "group").stdout
        self.assertIn("group: F(2, 27) = 4.85, p = .016, η² = .26, 90 % CI [.03, .43]\n", text)
        self.assertRegex(text, r"\n +df +SS +MS +F +p +η² +ω²\n  group +2 +3\.766 +1\.883 +4\.85 +\.016 +\.26 +\.20\n")
        self.assertRegex(text, r"\n  Residual +27 +10\.492 +0\.389\n")
        self.assertIn("Brown-Forsythe: F(2, 27) = 1.12, p = .341", text)
        self.assertIn("Shapiro-Wilk: W = .966, p = .438", text)

    def test_missing_values_are_left_out_and_told(self):
        table = self.plants(extra="NA,ctrl\n,trt1\n5.0,\n")
        report = self.answer("anova", table, "--response", "weight (g)", "--factor", "group")
        self.close(report["table"][0]["f"], 4.8460878623801333)
        self.assertEqual((report["n"], report["missing"]), (30, 3))
        self.assertTrue(any("3" in warning for warning in report["warnings"]), report["warnings"])

    @unittest.skipUnless(NIST.is_dir(), f"{NIST} is not there")
    def test_nist_reference_sets_need_no_option(self):
        files = sorted(NIST.glob("*.dat"))
        self.assertGreaterEqual(len(files), 5)
        for file in files:
            certified = re.search(r"^Between.*?(\d+) +\S+ +\S+ +(\S+)\s*$", file.read_text(), re.M)
            (term,) = self.answer("anova", file)["table"]
            self.assertEqual(term["df"], int(certified[1]))
            self.close(term["f"], float(certified[2]), 9)

    @unittest.skipUnless(R_DATA.is_dir(), f"{R_DATA} is not there")
    def test_factorial_as_r_has_it(self):
        table = R_DATA / "warpbreaks.csv"
        arguments = ("--response", "breaks", "--factor", "wool", "--factor", "tension")
        terms = {it["term"]: it for it in self.answer("anova", table, *arguments)["table"]}
        for name, f, p in (("wool", 3.76528836111864162, 0.05821297595955957),
                           ("tension", 8.49804664835805035, 0.00069262093671343),
                           ("wool:tension", 4.18906896685105501, 0.02104419072786278)):
            self.close(terms[name]["f"], f)
            self.close(terms[name]["p"], p, 8)

    @unittest.skipUnless(R_DATA.is_dir(), f"{R_DATA} is not there")
    def test_types_of_sums_of_squares_in_unequal_cells(self):
        lines = (R_DATA / "warpbreaks.csv").read_text().splitlines()
        without = {1, 2, 20, 33, 34, 35}
        table = self.write("u.csv", "\n".join(line for i, line in enumerate(lines) if i not in without) + "\n")
        # Type I by anova(lm), III by drop1 with contr.sum; II of wool against the model of tension alone.
        for kind, wool in (("1", 609.1875), ("2", 493.593790664308)):
            terms = self.answer("anova", table, "--response", "breaks", "--factor", "wool", "--factor", "tension",
                                "--type", kind)["table"]
            self.close(terms[0]["ss"], wool)
        terms = self.answer("anova", table, "--response", "breaks", "--factor", "wool", "--factor", "tension",
                            "--type", "3")["table"]
        for term, f in zip(terms, (6.45658147128347, 8.84300372231808, 6.06454404917691)):
            self.close(term["f"], f)

    @unittest.skipUnless(SHARED.is_dir(), f"{SHARED} is not there")
    def test_repeated_measures_as_ez_anova_has_them(self):
        table = SHARED / "anova-rm-test-data.csv"
        terms = self.answer("anova", table, "--response", "DV", "--within", "A", "--within", "B", "--within", "D",
                            "--subject", "id")["table"]
        # DATA.md, from the statsmodels test suite, of all rows.
        expected = {"A": (8.7650709, 0.021087505), "B": (8.4985785, 0.003833921), "D": (20.5076546, 0.002704428),
                    "A:B": (0.8457797, 0.450021759), "A:D": (21.7593382, 0.002301792),
                    "B:D": (6.2416695, 0.011536846), "A:B:D": (5.4253359, 0.018010647)}
        self.assertEqual({it["term"] for it in terms}, set(expected))
        for it in terms:
            self.close(it["f"], expected[it["term"]][0], 7)
            self.close(it["p"], expected[it["term"]][1], 6)
            self.assertEqual(it["sphericity"] is None, it["df"] == 1)
            self.assertEqual(set(it["error"]), {"df", "ss", "ms"})

    def test_welch_beside_the_table(self):
        # oneway.test(weight ~ group, PlantGrowth)
        asked = ("anova", self.plants(), "--response", "weight (g)", "--factor", "group", "--welch")
        report = self.answer(*asked)
        self.close(report["welch"]["f"], 5.180972408113189)
        self.close(report["welch"]["error_df"], 17.128418616644129)
        self.close(report["welch"]["p"], 0.017392821490170001)
        self.assertEqual(len(report["table"]), 1)
        self.assertIn("  group: Welch's F(2, 17.13) = 5.18, p = .017", self.succeeds("stats", *asked).stdout)

    def test_shares_of_repeated_measures_count_subjects_too(self):
        report = self.answer("anova", self.sleep(), "--response", "extra", "--within", "drug", "--subject", "person")
        (term,) = report["table"]
        # R's aov(extra ~ drug + Error(person / drug)): 58.078 between people, 12.482 drug, 6.808 error.
        people = report["between_subjects"]
        self.close(people["ss"], 58.078)
        self.assertEqual(people["df"], 9)
        self.close(report["total_ss"], 77.368)
        self.close(term["eta_sq"], 12.482 / 77.368)
        omega = (12.482 - 6.808 / 9) / (77.368 + 58.078 / 9)
        self.close(term["omega_sq"], omega)
        self.close(term["partial_omega_sq"], omega)

    # ------------------------------------------------------------ two groups, ranks

    def test_cells_of_repeated_measures_are_of_people(self):
        # Person 0 did 20 trials with x, whose mean counts once.
        trials = [(0, "x", 100.0 + i) for i in range(20)] + [(0, "y", 90.0)]
        trials += [(person, level, person + (level == "y")) for person in (1, 2, 3) for level in "xy"]
        table = self.write("trials.csv", "id,w,v\n" + "".join("{},{},{}\n".format(*trial) for trial in trials))
        report = self.answer("anova", table, "--response", "v", "--within", "w", "--subject", "id")
        self.assertEqual([(cell["n"], cell["mean"]) for cell in report["cells"]], [(4, 115.5 / 4), (4, 99.0 / 4)])

    def test_a_matrix_tells_of_missing_values(self):
        table = self.write("holes.csv", "a,b,c\n1,2,3\n2,1,\n3,5,4\n4,4,9\n5,7,\n")
        self.assertIn("3 at least", " ".join(self.answer("pearson", table)["warnings"]))

    def test_t_tests(self):
        table = self.sleep()
        asked = (table, "--response", "extra", "--factor", "drug")
        welch = self.answer("ttest", *asked)
        self.close(welch["t"], -1.8608134674868531)
        self.close(welch["df"], 17.7764735161784984)
        self.close(welch["p"], 0.0793941401873582)
        self.close(welch["interval"][0], -3.3654832307117104)
        self.close(welch["interval"][1], 0.2054832307117102)
        self.close(self.answer("ttest", *asked, "--pooled")["p"], 0.0791867142159382)
        paired = self.answer("ttest", *asked, "--paired", "--subject", "person")
        self.close(paired["t"], -4.06212768338203656)
        self.close(paired["p"], 0.00283289019738427)
        wide = self.write("wide.csv", "a;b\n" + "".join(f"{a};{b}\n" for a, b in zip(*SLEEP)).replace(".", ","))
        self.close(self.answer("ttest", wide, "--column", "a", "--column", "b", "--paired")["t"], -4.06212768338203656)
        one = self.answer("ttest", wide, "--column", "a", "--mean", "0.75")
        self.assertAlmostEqual(one["t"], 0.0, places=12)  # 0.75 is the mean

    def test_rank_tests(self):
        report = self.answer("wilcoxon", self.sleep(), "--response", "extra", "--factor", "drug")
        self.assertEqual((report["u"], report["exact"]), (25.5, False))
        self.close(report["p"], 0.0693275754336266)
        report = self.answer("kruskal", self.plants(), "--response", "weight (g)", "--factor", "group")
        self.close(report["h"], 7.988228749443715)
        self.close(report["p"], 0.018423755731472)
        self.assertEqual(len(report["groups"]), 3)

    @unittest.skipUnless(R_DATA.is_dir(), f"{R_DATA} is not there")
    def test_friedman(self):
        report = self.answer("friedman", R_DATA / "MASS_immer.csv", "--column", "Y1", "--column", "Y2")
        self.close(report["chi_squared"], 10.8)
        self.close(report["p"], 0.00101500094711307)

    # ------------------------------------------------------------ counts

    def test_counts_of_the_thesis(self):
        # 63 of 243 clicks wrong against 16 of 196: P < .001 (thesis, case study of chapter 6).
        report = self.answer("chisq", "--counts", "63,180/16,180")
        self.close(report["chi_squared"], 23.1960111752155)
        self.close(report["p"], 1.46300471280975e-06)
        # Depth perception: 14 better, 7 the same, 1 worse of 22: significant at 5 %.
        report = self.answer("chisq", "--counts", "14,7,1")
        self.close(report["chi_squared"], 11.54545454545454675)
        self.close(report["p"], 0.00311126067644443)
        # Preference: 16 against 6 of 22: significant at 5 %.
        self.assertLess(self.answer("chisq", "--counts", "16,6")["p"], 0.05)
        # The same exact, by binom.test(16, 22): also the sign test of 16 better and 6 worse.
        report = self.answer("binomial", "--counts", "16,6")
        self.close(report["p"], 0.0524787902832031597)
        self.close(report["interval"][0], 0.4977787987336510511)
        self.close(report["share"], 16 / 22)
        greater = self.answer("binomial", "--counts", "14,6", "--share", "0.4", "--alternative", "greater")
        self.close(greater["p"], 0.0064658753520349978)
        fisher = self.answer("fisher", "--counts", "63,180/16,180")
        self.close(fisher["p"], 8.35139245511913e-07, 7)
        self.close(fisher["odds_ratio"], 3.92611837823395, 5)
        mcnemar = self.answer("mcnemar", "--counts", "794,86/150,570", "--yates")
        self.close(mcnemar["chi_squared"], 16.8177966101695)
        self.close(mcnemar["p"], 4.11456228134594e-05)

    @unittest.skipUnless(R_DATA.is_dir(), f"{R_DATA} is not there")
    def test_counts_of_a_table(self):
        report = self.answer("chisq", R_DATA / "HairEyeColor.csv", "--factor", "Hair", "--factor", "Eye", "--weight",
                             "Freq")
        self.close(report["chi_squared"], 138.289841626008)
        self.close(report["p"], 2.32528678709881e-25, 7)
        self.assertEqual(report["columns"], ["Brown", "Blue", "Hazel", "Green"])
        self.assertEqual(report["n"], 592)

    def test_binomial_counts_of_a_table(self):
        table = self.write("asked.csv", "better\n" + "yes\n" * 14 + "no\n" * 6 + "NA\n")
        text = self.succeeds("stats", "binomial", table, "--factor", "better").stdout
        self.assertIn("14 of 20 are yes: share .70, 95 % CI [.46, .88], against 0.5 p = .115\n", text)
        self.fails("stats", "binomial", "--counts", "1,2,3", code=1, saying="two kinds")
        self.fails("stats", "binomial", "--counts", "0,0", code=1, saying="trials")
        self.fails("stats", "binomial", "--counts", "1,2", "--share", "2", code=1, saying="0 to 1")

    def test_before_and_after_may_stand_in_any_order(self):
        table = self.write("change.csv", "before,after\n" + "yes,no\n" * 6 + "no,yes\n" * 2 + "yes,yes\n" * 3)
        report = self.answer("mcnemar", table, "--factor", "before", "--factor", "after")
        self.assertEqual(report["rows"], ["yes", "no"])
        self.assertEqual(report["observed"], [[3, 6], [2, 0]])
        self.close(report["exact_p"], 0.2890625)  # binom.test(2, 8)

    # ------------------------------------------------------------ similarities, pairs, power

    @unittest.skipUnless(R_DATA.is_dir(), f"{R_DATA} is not there")
    def test_correlations(self):
        table = R_DATA / "mtcars.csv"
        report = self.answer("pearson", table, "--column", "mpg", "--column", "wt")
        self.close(report["r"], -8.67659376517228e-01)
        self.close(report["p"], 1.29395870135052e-10, 8)
        self.close(report["interval"][0], -9.33826413284994e-01)
        self.close(report["interval"][1], -7.44087196460113e-01)
        self.close(report["critical_r"], 0.34937, 4)  # qt(.975, 30) / sqrt(30 + qt(.975, 30)^2)
        report = self.answer("spearman", table, "--column", "mpg", "--column", "wt")
        self.close(report["rho"], -8.86422033270298e-01)
        self.close(report["p"], 1.48759485812743e-11, 7)
        matrix = self.answer("pearson", table)
        self.assertEqual(matrix["columns"][:2], ["mpg", "cyl"])
        place = matrix["columns"].index("wt")
        self.close(matrix["r"][0][place], -8.67659376517228e-01)
        self.close(matrix["r"][place][0], -8.67659376517228e-01)
        self.assertEqual(matrix["n"][0][place], 32)

    def test_pairs_after_tukey_and_holm(self):
        asked = (self.plants(), "--response", "weight (g)", "--factor", "group")
        pairs = self.answer("tukey", *asked)["comparisons"]
        self.assertEqual([(it["first"], it["second"]) for it in pairs],
                         [("ctrl", "trt1"), ("ctrl", "trt2"), ("trt1", "trt2")])
        for it, difference, low, high, p in zip(pairs, (-0.371, 0.494, 0.865),
                                                (-1.062216051410459, -0.197216051410460, 0.173783948589541),
                                                (0.320216051410458, 1.185216051410457, 1.556216051410458),
                                                (0.3908711442021247, 0.1979959912997094, 0.0120064239794528)):
            self.close(it["difference"], difference)
            self.close(it["interval"][0], low, 7)
            self.close(it["interval"][1], high, 7)
            self.close(it["p_adjusted"], p, 7)
        pairs = self.answer("tukey", *asked, "--method", "holm")["comparisons"]
        for it, p in zip(pairs, (0.194387880054301, 0.175363350125367, 0.0133777078146164)):
            self.close(it["p_adjusted"], p)

    def test_power(self):
        self.close(self.answer("power", "ttest", "--effect", "1", "--n", "20")["power"], 0.868953027724586, 8)
        report = self.answer("power", "ttest", "--effect", "1", "--power", "0.9")
        self.assertEqual(report["n"], 23)  # power.t.test: 22.02
        self.assertGreaterEqual(report["power"], 0.9)
        self.fails("stats", "power", "ttest", "--effect", "1", code=1, saying="--n")

    def test_describes_with_and_without_outliers(self):
        table = self.write("t.csv", "time\n" + "\n".join(map(str, (4, 5, 5, 6, 6, 6, 7, 7, 8, 30))) + "\n")
        (column,) = self.answer("describe", table)["columns"]
        self.assertEqual((column["n"], column["mean"], column["median"], column["modes"]), (10, 8.4, 6, [6]))
        self.assertEqual([(it["line"], it["value"]) for it in column["outliers"]], [(11, 30)])
        self.assertEqual(column["without_outliers"]["mean"], 6)
        text = self.succeeds("stats", "describe", table).stdout
        self.assertIn("30.00 (line 11, z = 2.8", text)
        self.assertIn("without: n = 9, mean 6.00", text)

    # ------------------------------------------------------------ drawings

    def test_every_kind_of_drawing(self):
        plants = (self.plants(), "--response", "weight (g)", "--factor", "group")
        two = self.write("two.csv", "x,y,a,b,c\n" + "".join(
            f"{i},{i * i},{'uvw'[i % 3]},{'pq'[i // 3 % 2]},{(i * 7) % 5}\n" for i in range(24)))
        factorial = (two, "--response", "x", "--factor", "a", "--factor", "b")
        drawings = [("anova", *plants), ("anova", *plants, "--plot-kind", "bars"), ("anova", *factorial),
                    ("anova", *factorial, "--plot-kind", "box"), ("describe", two), ("ttest", two, "--column", "x",
                    "--column", "y"), ("kruskal", *plants), ("tukey", *plants),
                    ("chisq", two, "--factor", "a", "--factor", "b"), ("chisq", "--counts", "3,4,5"),
                    ("pearson", two, "--column", "x", "--column", "y"), ("spearman", two),
                    ("power", "anova", "--effect", "0.3", "--n", "20", "--groups", "3")]
        for i, arguments in enumerate(drawings):
            out = self.folder / f"{i}.png"
            self.succeeds("stats", *arguments, "--plot", out)
            self.assertEqual(png_size(out.read_bytes()), (1920, 1280))
            self.assertGreater(out.stat().st_size, 15_000, arguments)
        out = self.folder / "plants.svg"
        self.succeeds("stats", "anova", *plants, "--plot", out)
        svg = out.read_text()
        self.assertTrue(svg.startswith("<?xml"))
        self.assertIn('viewBox="0 0 960 640"', svg)
        self.assertTrue(svg.rstrip().endswith("</svg>"))

    def test_drawings_that_cannot_be(self):
        plants = (self.plants(), "--response", "weight (g)", "--factor", "group")
        self.fails("stats", "anova", *plants, "--plot", self.folder / "a.pdf", code=2, saying=".svg")
        self.fails("stats", "anova", *plants, "--plot", self.folder / "no" / "a.png", code=1, saying="a.png")
        self.fails("stats", "anova", *plants, "--plot", self.folder / "a.png", "--plot-kind", "scatter", code=1,
                   saying="box, interaction, bars")
        many = self.write("many.csv", "y,g\n" + "".join(f"{i},{i % 70}\n" for i in range(700)))
        self.fails("stats", "anova", many, "--response", "y", "--factor", "g", "--plot", self.folder / "a.svg", code=1,
                   saying="60 groups")

    # ------------------------------------------------------------ what goes wrong

    def test_errors_name_what_is_wrong(self):
        plants = self.plants()
        anova = ("stats", "anova")
        self.fails(*anova, plants, "--response", "height", "--factor", "group", code=1,
                   saying='there is no column "height"; there are "weight (g)", "group"')
        self.fails(*anova, plants, "--factor", "group", code=1, saying='give --response by name; the columns are')
        self.fails(*anova, plants, "--response", "weight (g)", code=1, saying="--factor")
        self.fails(*anova, plants, "--response", "group", "--factor", "weight (g)", code=1, saying='plants.csv:2: "ctrl"')
        self.fails(*anova, plants, "--response", "weight (g)", "--factor", "weight (g)", code=1, saying="two roles")
        self.fails(*anova, plants, "--response", "weight (g)", "--within", "group", code=1, saying="--subject")
        self.fails(*anova, self.folder / "no.csv", code=1, saying="no.csv")
        self.fails(*anova, self.folder, code=1, saying=str(self.folder))
        self.fails(*anova, self.write("empty.csv", ""), code=1, saying="empty.csv is empty")
        self.fails(*anova, self.write("ragged.csv", "a,b\n1,2\n3\n"), code=1, saying="ragged.csv:3: the row has 1 cell")
        bad = self.write("bad.csv", "y,g\n1,a\ninf,b\n2,b\n")
        self.fails(*anova, bad, "--response", "y", "--factor", "g", code=1, saying='bad.csv:3: "inf" in the column "y"')
        one = self.write("one.csv", "y,g\n1,a\n2,a\n")
        self.fails(*anova, one, "--response", "y", "--factor", "g", code=1, saying="one.csv: ")
        self.fails("stats", "ttest", plants, "--response", "weight (g)", "--factor", "group", code=1, saying="icome stats anova")
        self.fails("stats", "ttest", self.sleep(), "--response", "extra", "--factor", "drug", "--paired", code=1, saying="--subject")
        self.fails("stats", "chisq", "--counts", "3,x", code=1, saying='"x"')
        self.fails("stats", "chisq", "--counts", "3,4/5", code=1, saying="as many counts")

    def test_wrong_usage(self):
        done = self.fails("stats", code=2, saying="say which test: describe, anova")
        self.assertIn("icome stats --help", done.stderr)
        done = self.fails("stats", "anova", code=2, saying="DATA")
        self.assertIn("icome stats anova --help", done.stderr)
        self.fails("stats", "manova", code=2, saying='no test "manova"; choose from describe')
        self.fails("stats", "anova", self.plants(), "--type", "4", code=2, saying="--type")
        sleep = ("stats", "anova", self.sleep(), "--response", "extra")
        # What one person did twice is not from two people: not silently.
        self.fails(*sleep, "--factor", "drug", "--subject", "person", code=2, saying="--subject goes with --within")
        for test in ("ttest", "wilcoxon", "tukey"):
            self.fails("stats", test, self.sleep(), "--response", "extra", "--factor", "drug", "--subject", "person",
                       code=2, saying="--subject goes with --paired")
        for groups in ("2.5", "1e30", "nan", "-1"):
            self.fails("stats", "power", "anova", "--effect", "0.5", "--n", "9", "--groups", groups, code=1,
                       saying="groups")
        for option in ("--welch", "--no-interactions"):
            self.fails(*sleep, "--within", "drug", "--subject", "person", option, code=2, saying="without --within")
        self.fails(*sleep, "--factor", "drug", "--factor", "person", "--welch", code=1, saying="one --factor")
        self.fails("stats", "chisq", code=2, saying="give a table")
        self.fails("stats", "describe", self.plants(), "--confidence", "95", code=2, saying="0.95")
        self.fails("stats", "describe", self.plants(), "--plot-kind", "box", code=2, saying="--plot")

    def test_values_without_spread_do_not_end_it(self):
        table = self.write("flat.csv", "y,g\n1,a\n1,a\n2,b\n2,b\n")
        report = self.answer("anova", table, "--response", "y", "--factor", "g")
        self.assertTrue(report["warnings"])
        self.assertEqual(report["residual"]["ss"], 0)

    def test_nothing_but_missing_values(self):
        table = self.write("none.csv", "y,g,s\nNA,,\n,NA,1\n.,.,.\n")
        for test in ("anova", "ttest", "wilcoxon", "kruskal", "tukey"):
            self.fails("stats", test, table, "--response", "y", "--factor", "g", code=1, saying="none.csv: ")
        for test in ("friedman", "ttest", "wilcoxon", "pearson"):
            paired = () if test in ("friedman", "pearson") else ("--paired",)
            self.fails("stats", test, table, "--column", "y", "--column", "s", *paired, code=1, saying="none.csv: ")
        self.fails("stats", "anova", table, "--response", "y", "--within", "g", "--subject", "s", code=1,
                   saying="none.csv: ")
        for test in ("chisq", "fisher", "mcnemar"):
            self.fails("stats", test, table, "--factor", "g", code=1, saying="none.csv: ")
        self.fails("stats", "describe", table, "--column", "y", code=1, saying="none.csv: ")

    def test_tables_stay_readable(self):
        long = self.write("long.csv", "y,g\n" + "".join(f"{y}e20,{g * 70000}\n" for y, g in ((1, "ä"), (2, "b"), (4, "ä"), (8, "b"))))
        text = self.succeeds("stats", "anova", long, "--response", "y", "--factor", "g").stdout
        self.assertLess(max(map(len, text.splitlines())), 200)
        self.assertIn("ä…", text)
        text = self.succeeds("stats", "ttest", long, "--response", "y", "--factor", "g").stdout
        self.assertIn("difference -2.5e+20", text)

    def test_text_of_any_kind_is_told_as_it_can_be(self):
        file = self.folder / "bytes.csv"
        file.write_bytes(b"y,g\n1,\xff\x1b[31m\n2,\xff\x1b[31m\n4,b\n5,b\n")
        self.fails("stats", "anova", file, "--response", "y", "--factor", "g", code=1, saying="bytes.csv:2: the byte 0xff")
        heading = self.write("heading.csv", 'y\x1b[31m,g\n1,\x1b[1mx\n2,\x1b[1mx\n4,b\n5,b\n')
        for test in ("anova", "ttest", "kruskal", "tukey"):
            done = run("stats", test, heading, "--response", "y\x1b[31m", "--factor", "g")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertNotIn("\x1b", done.stdout)
        level = self.write("level.csv", "y,g\n1,\x1b[31mx\n2,\x1b[31mx\n")
        done = self.fails("stats", "anova", level, "--response", "y", "--factor", "g", code=1, saying="only the level")
        self.assertNotIn("\x1b", done.stderr)

    def test_a_million_rows(self):
        rows = "".join(f"{i * 7919 % 10007},{'abc'[i % 3]}\n" for i in range(1_000_000))
        report = self.answer("anova", self.write("big.csv", "y,g\n" + rows), "--response", "y", "--factor", "g")
        self.assertEqual(report["n"], 1_000_000)

    def test_help_names_every_test_and_option(self):
        text = self.succeeds("stats", "--help").stdout
        for word in ("describe", "anova", "ttest", "wilcoxon", "kruskal", "friedman", "chisq", "fisher", "mcnemar",
                     "binomial", "pearson", "spearman", "tukey", "power", "Exit code", "eta_sq"):
            self.assertIn(word, text)
        text = self.succeeds("stats", "anova", "--help").stdout
        for word in ("--response ", "--factor ", "--within ", "--subject ", "--type ", "--json", "--plot ", "--plot-kind "):
            self.assertIn(word, text)
        self.assertRegex(run("--help").stdout, r"\n  stats +\S")


if __name__ == "__main__":
    unittest.main()
