"""icome say, voice and listen: sentences by text and by sound, as a person and a script call them."""

import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest
import wave

PROGRAM = os.environ["ICOME_PROGRAM"]
SHARED = pathlib.Path(__file__).resolve().parents[3] / "shared" / "data" / "speech"


class Speech(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.at = pathlib.Path(self.folder.name)
        self.addCleanup(self.folder.cleanup)

    def run_icome(self, *arguments, text=None):
        environment = dict(os.environ, XDG_CONFIG_HOME=str(self.at / "config"))
        return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, input=text, cwd=self.at,
                              env=environment, timeout=300)

    def say(self, *arguments, text=None):
        done = self.run_icome("say", "--json", *arguments, text=text)
        self.assertEqual(done.returncode, 0, done.stderr)
        return [json.loads(line) for line in done.stdout.splitlines()]

    def objects(self, file):
        done = self.run_icome("info", file, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)["objects"]

    def test_sentences_make_a_design_that_later_ones_know(self):
        answers = self.say("create a small red sphere", "a large green box right of it", "name it seat",
                           "--out", "a.wrl")
        self.assertEqual([it["accepted"] for it in answers], [True] * 3)
        self.assertEqual(answers[0]["intent"]["op"], "create")
        self.assertEqual(answers[0]["objects"], ["sphere"])
        self.assertEqual(answers[1]["operations"][0]["size"], [0.2, 0.2, 0.2])
        again = self.say("--design", "a.wrl", "select the seat", "make it yellow", "--out", "a.wrl")
        self.assertEqual(again[1]["objects"], ["seat"])
        told = self.say("--design", "a.wrl", "how many yellow boxes are there")
        self.assertEqual(told[0]["reply"], "1.")

    def test_the_operations_told_do_the_same_in_a_script(self):
        answers = self.say("three blue cones", "make them red", "put the left one there", "--pointer", "1,2,3",
                           "--out", "said.icome")
        self.assertFalse(answers[2]["accepted"])
        script = "\n".join(json.dumps(line) for it in answers for line in it["operations"])
        (self.at / "script.jsonl").write_text(script)
        done = self.run_icome("edit", "new", "--apply", "script.jsonl", "--out", "done.icome")
        self.assertEqual(done.returncode, 0, done.stderr)
        figures = [json.loads(self.run_icome("info", name, "--json").stdout) for name in ("said.icome", "done.icome")]
        self.assertEqual(figures[0]["bounds"], figures[1]["bounds"])
        self.assertEqual(figures[0]["objects"], figures[1]["objects"])

    def test_what_is_refused_changes_nothing_and_is_no_failure(self):
        answers = self.say("make me a coffee", "delete the red cone", "", "--out", "a.wrl")
        self.assertEqual([it["accepted"] for it in answers], [False] * 3)
        self.assertIn("coffee", answers[0]["reply"])
        self.assertIsNone(answers[0]["intent"])
        self.assertEqual(self.objects("a.wrl"), 0)

    def test_questions_name_their_candidates(self):
        answers = self.say(text="a cone\na cone right of it\n\ndelete the cone\nthe right one\n")
        self.assertEqual(answers[2]["state"], "asked")
        self.assertEqual(answers[2]["candidates"], ["cone", "cone 2"])
        self.assertEqual(answers[3]["intent"]["objects"], ["cone 2"])

    def test_own_words_are_kept_for_later(self):
        self.say("a brown box", "call this colour copper")
        answers = self.say("a copper sphere")
        self.assertEqual(answers[0]["operations"][1]["colour"], "#8b4513")
        self.assertIn("copper", (self.at / "config" / "icome" / "words.toml").read_text())
        self.say("forget copper")
        self.assertFalse(self.say("a copper sphere")[0]["accepted"])

    def test_wrong_usage_and_files_are_told(self):
        for arguments, told in [(["say", "--pointer", "1,2", "a box"], "no hand"),
                                (["say", "--design", "no.wrl", "a box"], "no.wrl"),
                                (["say", "a box", "--out", "a.xyz"], "a.xyz"),
                                (["say", "--vocabulary", "no.toml", "a box"], "no.toml"),
                                (["listen", "no.wav"], "no.wav"),
                                (["voice", "--check", "no.toml"], "no.toml")]:
            done = self.run_icome(*arguments)
            self.assertEqual(done.returncode, 1, arguments)
            self.assertIn(told, done.stderr)
        for arguments in [["voice"], ["listen", ""], ["listen", "--microphone", ""]]:
            self.assertEqual(self.run_icome(*arguments).returncode, 2, arguments)
        with wave.open(str(self.at / "none.wav"), "wb") as empty:
            empty.setparams((1, 2, 16000, 0, "NONE", ""))
        done = self.run_icome("listen", "--json", "none.wav")
        self.assertEqual(done.returncode, 1)
        self.assertIn("none.wav: there is no sound in it", done.stderr)

    def test_a_vocabulary_of_ones_own(self):
        (self.at / "own.toml").write_text('[words.shape]\n"tile|tiles" = "box"\n[[command]]\nname = "soften"\n'
                                          'say = ["soften <objects>"]\nop = "feel"\n'
                                          'with = { objects = "<objects>", stiffness = 300 }\n')
        done = self.run_icome("voice", "--check", "own.toml")
        self.assertEqual(done.returncode, 0, done.stderr)
        answers = self.say("--vocabulary", "own.toml", "two tiles", "soften the tiles")
        self.assertEqual(answers[1]["intent"], {"op": "feel", "objects": ["box", "box 2"], "stiffness": 300})
        (self.at / "own.toml").write_text('[words.colour]\nteal = "greenish"\n')
        done = self.run_icome("voice", "--check", "own.toml", "--json")
        self.assertEqual(done.returncode, 1)
        self.assertIn("own.toml:2:8", json.loads(done.stdout)["problems"][0])
        (self.at / "own.toml").write_text('[words.colour]\nteal = "greenish"\n"" = "#008080"\n')
        done = self.run_icome("voice", "--check", "own.toml", "--json")
        problems = json.loads(done.stdout)["problems"]
        self.assertEqual(len(problems), 2, problems)
        self.assertIn("own.toml:3:", problems[1])
        (self.at / "own.toml").write_text('[words.colour]\n"★" = "#ff0000"\n', encoding="utf-8")
        done = self.run_icome("voice", "--check", "own.toml", "--json")
        self.assertEqual(done.returncode, 1)
        self.assertIn("nobody can be heard to say: ★", json.loads(done.stdout)["problems"][0])

    def test_every_listed_sentence_can_be_said(self):
        self.say("a red box", "name it seat", "a blue cone", "--out", "a.icome")
        done = self.run_icome("voice", "--list", "--design", "a.icome", "--json")
        listed = [sentence for command in json.loads(done.stdout)["commands"] for sentence in command["sentences"]]
        self.assertGreater(len(listed), 50)
        # Each by itself, as what one does may be in another's way.
        refused = [it for it in listed[::4] if not self.say("--design", "a.icome", it)[0]["accepted"]]
        self.assertEqual(refused, [])

    @unittest.skipUnless(SHARED.is_dir(), "the shared recordings are not there")
    def test_people_are_heard_to_say_yes_and_no(self):
        files = [str(SHARED / "speech_commands" / f"{word}_{i}.wav") for word in ("yes", "no") for i in (1, 2)]
        done = self.run_icome("listen", "--json", *files)
        self.assertEqual(done.returncode, 0, done.stderr)
        heard = [json.loads(line) for line in done.stdout.splitlines()]
        self.assertEqual([it["heard"] for it in heard], ["yes", "yes", "no", "no"])
        for it in heard:
            self.assertEqual(it["state"], "refused")  # there is no question
            self.assertGreater(it["end_s"], it["begin_s"])
            self.assertLess(it["score"], 0)

    @unittest.skipUnless(shutil.which("espeak-ng"), "espeak-ng, which speaks here, is not installed")
    def test_a_voice_makes_a_design(self):
        said = ["create a small red sphere", "put a large blue box left of the sphere", "delete the sphere",
                "he does not like the music", "undo"]
        files = [f"{i}.wav" for i in range(len(said))]
        for file, sentence in zip(files, said):
            subprocess.run(["espeak-ng", "-v", "en-us", "-w", str(self.at / file), sentence], check=True)
        done = self.run_icome("listen", "--json", "--apply", "--out", "heard.icome", *files)
        self.assertEqual(done.returncode, 0, done.stderr)
        heard = [json.loads(line) for line in done.stdout.splitlines()]
        self.assertEqual([it["heard"] for it in heard if it["accepted"]], said[:3] + said[4:])
        self.assertEqual(self.say("--design", "heard.icome", "how many things are there")[0]["reply"], "2.")

    @unittest.skipUnless(SHARED.is_dir(), "the shared recordings are not there")
    def test_silence_says_nothing(self):
        done = self.run_icome("listen", "--json", str(SHARED / "silence_1000ms.wav"))
        self.assertEqual((done.returncode, done.stdout), (0, ""))


if __name__ == "__main__":
    unittest.main()
