"""`icome techniques` ranks interaction techniques by simulated people."""
import json
import unittest

from icome_program import ProgramTest, run

NAMES = {"virtual hand", "Go-Go", "ray pointer", "spotlight", "world in miniature", "look-at"}
SHORT = ("--users", "2", "--trials", "4")


class TechniquesTest(ProgramTest):
    def measured(self, *arguments):
        return json.loads(self.succeeds("techniques", *SHORT, "--json", *arguments).stdout)

    def test_one_document_with_every_technique(self):
        report = self.measured()
        self.assertEqual(set(report), {"assumptions", "techniques"})
        self.assertEqual({it["name"] for it in report["techniques"]}, NAMES)
        for technique in report["techniques"]:
            self.assertGreater(technique["movement_time_s"], 0.3)
            self.assertTrue(0 <= technique["error_rate"] <= 1)
            self.assertGreater(technique["throughput_bits_per_s"], 0)
            self.assertEqual(set(technique["regression"]), {"a_s", "b_s_per_bit", "r_squared"})
            conditions = technique["conditions"]
            self.assertEqual(len(conditions), 27)
            reached = [it for it in conditions if it["reachable"]]
            self.assertEqual(technique["conditions_reached"], len(reached))
            for it in conditions:
                self.assertEqual(it["movement_time_s"] is None, not it["reachable"])
            mean = sum(it["movement_time_s"] for it in reached) / len(reached)
            self.assertAlmostEqual(technique["movement_time_s"], mean, places=9)
        scores = [it["score_bits_per_s"] for it in report["techniques"]]
        self.assertEqual(scores, sorted(scores, reverse=True))

    def test_menus_are_compared_by_kind_items_choice_and_feel(self):
        report = json.loads(self.succeeds("techniques", "--menus", "--users", "2", "--trials", "2", "--json").stdout)
        self.assertEqual(set(report), {"assumptions", "conditions"})
        self.assertIn("no study of people", report["assumptions"]["notice"])
        rows = report["conditions"]
        self.assertEqual({(it["menu"], it["items"], it["choose"], it["feel"]) for it in rows},
                         {(menu, items, choose, feel) for menu in ("list", "pie", "daisy") for items in (5, 12, 40)
                          for choose in ("click", "push") for feel in ("none", "well", "recess", "groove")})
        for it in rows:
            self.assertTrue(0.5 < it["time_s"] <= 11)
            self.assertTrue(0 <= it["error_rate"] <= 1)
            self.assertGreaterEqual(it["movements"], 1)
        self.fails("techniques", "--menus", "--users", "0", code=2, saying="1 to 1000")

    def test_every_assumption_has_its_source_and_simulation_is_said(self):
        assumptions = self.measured()["assumptions"]
        self.assertIn("no study of people", assumptions["notice"])
        self.assertEqual((assumptions["users"], assumptions["trials_per_condition"], assumptions["seed"]), (2, 4, 1))
        self.assertGreater(len(assumptions["person"]), 15)
        for it in assumptions["person"]:
            self.assertTrue(it["name"] and it["source"])
            self.assertIsInstance(it["value"], float)

    def test_the_same_seed_gives_the_same_bytes(self):
        texts = [self.succeeds("techniques", *SHORT, "--json", "--seed", seed).stdout for seed in "334"]
        self.assertEqual(texts[0], texts[1])
        self.assertNotEqual(texts[0], texts[2])

    def test_people_get_a_ranking_that_says_what_it_is(self):
        text = self.succeeds("techniques", *SHORT).stdout
        for name in NAMES:
            self.assertIn(name, text)
        self.assertIn("no study of people", text)
        self.assertRegex(text, r"\n 1  \S.*\n 2  \S")
        self.assertIn("2 simulated people, 4 movements each in 27 conditions", text)

    def test_draws_a_picture(self):
        out = self.folder / "techniques.png"
        self.succeeds("techniques", *SHORT, "--picture", out)
        data = out.read_bytes()
        self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
        self.assertGreater(len(data), 50_000)

    def test_wrong_usage(self):
        for users in ("0", "-1", "1001"):
            self.fails("techniques", "--users", users, code=2, saying="people")
        self.fails("techniques", "--trials", "1", code=2, saying="movements")
        self.fails("techniques", "--users", "many", code=2, saying="--users")
        self.fails("techniques", "--seed", "-3", code=2, saying="--seed")
        self.fails("techniques", *SHORT, "--picture", self.folder / "no" / "out.png", code=1, saying="out.png")

    def test_help_names_every_option(self):
        text = self.succeeds("techniques", "--help").stdout
        for word in ("--users ", "--trials ", "--seed ", "--json", "--picture ", "Exit code", "simulat"):
            self.assertIn(word, text)
        self.assertRegex(run("--help").stdout, r"\n  techniques +\S")


if __name__ == "__main__":
    unittest.main()
