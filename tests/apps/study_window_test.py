"""`icome study run` with a person: pages, questions and trials by keys and mouse, to the end, and what goes wrong."""
import json
import os
import shutil
import signal
import subprocess
import time
import unittest
import wave

from desktop_program import DesktopTest, wait_for
from icome_program import PROGRAM, ProgramTest

STUDY = """
name = "tiny"
languages = ["en", "nl"]
title = { en = "A ball", nl = "Een bal" }
needs = ["pointer"]
goal = { en = "We look at balls.", nl = "We bekijken ballen." }
consent = { en = "You may stop at any time.", nl = "U mag altijd stoppen." }

[[independent]]
id = "technique"
name = { en = "Technique", nl = "Techniek" }
kind = "within"
levels = [
  { id = "old", name = { en = "Old", nl = "Oud" } },
  { id = "new", name = { en = "New", nl = "Nieuw" } },
]

[[dependent]]
id = "time"
name = { en = "Time", nl = "Tijd" }
type = "ratio"
values = "continuous"
unit = "s"
better = "lower"
from = "time"

[[hypotheses]]
id = "faster"
text = { en = "New is faster.", nl = "Nieuw is sneller." }
dependent = "time"
factor = "technique"
expected = "new < old"
test = "ttest"

[task]
target = "ball"
start = [0.0, 0.0, 0.12]

[trials]
measured = 2
hold = 0.2
beep = true
rest = 600
scenes = [{ id = "ball", file = "ball.wrl" }]

[[questionnaires]]
id = "you"
title = { en = "About you", nl = "Over u" }
when = "before"

[[questionnaires.items]]
id = "age"
kind = "number"
text = { en = "How old are you?", nl = "Hoe oud bent u?" }
least = 16
most = 99

[[questionnaires.items]]
id = "hand"
kind = "choice"
text = { en = "Which hand do you write with?", nl = "Met welke hand schrijft u?" }
choices = [
  { id = "left", name = { en = "The left", nl = "De linker" } },
  { id = "right", name = { en = "The right", nl = "De rechter" } },
]
"""
# Seen from the front: the ball in the middle of the scene.
BALL = """#VRML V2.0 utf8
DEF ball Transform { children Shape {
  appearance Appearance { material Material { diffuseColor 0.02 0.27 0.24 } }
  geometry Sphere { radius 0.05 } } }
"""
# Sound goes into a file: what is played can be looked at, and no machine needs an output.
SOUND = 'pcm.!default {{ type file slave.pcm "null" file "{}" format "raw" }}\n'
BEEP = 7200  # samples


def is_ink(red, green, blue):
    return max(red, green, blue) < 80


class StudyWindowTest(DesktopTest):
    def setUp(self):
        super().setUp()
        self.study = self.folder / "tiny.toml"
        self.study.write_text(STUDY)
        (self.folder / "ball.wrl").write_text(BALL)
        self.sound = self.folder / "sound.raw"
        (self.home / ".asoundrc").write_text(SOUND.format(self.sound))

    def run_study(self, *arguments, task="run", **options):
        desktop = self.start("study", task, self.study, *arguments, **options)
        desktop.window = desktop.find_window("ICOME")
        self.screen.ask("windowfocus", "--sync", desktop.window)
        return desktop

    def rows(self, kind):
        """Of the person's table of that kind, without its heading; nothing before it is there."""
        found = list(self.folder.glob(f"tiny-data/sub-*/beh/*_{kind}.tsv"))
        return found[0].read_text().splitlines()[1:] if found else []

    def key_until(self, desktop, kind, count, *keys):
        """Keys that add rows to a table, until it has so many."""
        desktop.key(*keys)
        wait_for(f"{count} rows of {kind} (there are {self.rows(kind)})", lambda: len(self.rows(kind)) >= count)

    def answer(self, desktop):
        """From the beginning to before the first condition's page."""
        self.key_until(desktop, "events", 2, "Return")
        desktop.type("33")
        self.key_until(desktop, "events", 4, "Tab", "2", "Return")
        self.key_until(desktop, "events", 5, "Return")

    def reach_until(self, desktop, what, condition):
        """Moves the hand into the ball, away from the eye, until a condition holds."""
        def reach():
            # Where the scene was: the last step may have been the one, and the scene be gone.
            self.screen.ask("click", "--repeat", 4, "--delay", 20, 4)
            # Another step might begin the next trial's way.
            latest = time.monotonic() + 0.4
            while not condition() and time.monotonic() < latest:
                time.sleep(0.02)
            return condition()
        wait_for(what, reach)

    def touch(self, desktop, count):
        """Does a trial: there are so many then."""
        self.reach_until(desktop, f"{count} trials", lambda: len(self.rows("beh")) >= count)

    def test_a_person_is_led_to_the_end(self):
        desktop = self.run_study()
        self.keep(desktop, "study-consent")
        self.key_until(desktop, "events", 2, "Return")
        time.sleep(0.5)  # the page is on the screen
        self.keep(desktop, "study-questions")
        desktop.key("Return")  # which only goes to the next question, as this one needs an answer
        desktop.key("Return")
        desktop.type("33")
        desktop.key("Tab")
        self.key_until(desktop, "events", 4, "2", "Return")
        self.key_until(desktop, "events", 5, "Return")
        self.key_until(desktop, "events", 6, "Return")
        self.touch(desktop, 1)
        self.touch(desktop, 2)
        self.keep(desktop, "study-rest")
        desktop.key("Return")  # not before the break is over
        self.key_until(desktop, "events", 7, "ctrl+shift+n", "Return")
        self.key_until(desktop, "events", 8, "Return")
        self.touch(desktop, 3)
        self.touch(desktop, 4)
        wait_for("the end", lambda: len(self.rows("events")) >= 9)
        self.keep(desktop, "study-thanks")
        desktop.key("Return")
        self.assertEqual(desktop.wait_end(), 0, desktop.printed())
        self.assertIn("is through", desktop.printed())
        answers = "\n".join(self.rows("events"))
        self.assertRegex(answers, r"you\.age\t33\b")
        self.assertRegex(answers, r"you\.hand\tright\b")

    @unittest.skipUnless(shutil.which("espeak-ng"), "espeak-ng, which speaks here, is not installed")
    def test_a_study_may_have_things_chosen_by_voice(self):
        self.study.write_text(STUDY.replace('needs = ["pointer"]', 'needs = ["pointer", "speech"]'))
        said, all_of_it = self.folder / "said.wav", self.folder / "all.wav"
        subprocess.run(["espeak-ng", "-v", "en-us", "-w", said, "select the ball"], check=True)
        with wave.open(str(said)) as one, wave.open(str(all_of_it), "wb") as many:
            many.setparams(one.getparams())
            sentence = one.readframes(one.getnframes())
            many.writeframes(100 * (bytes(2 * 2 * one.getframerate()) + sentence))  # after two seconds each time
        desktop = self.run_study("--microphone", all_of_it)
        self.answer(desktop)
        self.key_until(desktop, "events", 6, "Return")
        # Loading what recognises speech takes seconds of a processor, and others may need it too.
        wait_for("two trials", lambda: len(self.rows("beh")) >= 2, patience=300)
        spoken = [row.split("\t") for row in self.rows("events") if "\tsaid\t" in row]
        self.assertIn(["select the ball", "ball"], [row[4:6] for row in spoken])
        desktop.process.send_signal(signal.SIGTERM)
        self.assertEqual(desktop.wait_end(), 3, desktop.printed())

    def test_the_start_is_heard(self):
        desktop = self.run_study()
        self.answer(desktop)
        self.key_until(desktop, "events", 6, "Return")
        self.touch(desktop, 1)
        self.assertGreaterEqual(self.sound.stat().st_size, 2 * BEEP)

    def test_who_is_interrupted_goes_on_where_it_was(self):
        desktop = self.run_study("--language", "nl")
        self.answer(desktop)
        self.key_until(desktop, "events", 6, "Return")
        self.touch(desktop, 1)
        desktop.key("Escape")
        self.keep(desktop, "study-interrupt")
        desktop.key("shift+Tab", "Return")
        self.assertEqual(desktop.wait_end(), 3, desktop.printed())
        self.assertIn("study resume", desktop.printed())
        self.assertEqual(len(self.rows("beh")), 1)
        desktop = self.run_study(task="resume")
        self.touch(desktop, 2)
        desktop.process.send_signal(signal.SIGTERM)
        self.assertEqual(desktop.wait_end(), 3, desktop.printed())
        self.assertEqual(len(self.rows("beh")), 2)

    def test_going_on_after_all_begins_the_trial_again(self):
        desktop = self.run_study()
        self.answer(desktop)
        self.key_until(desktop, "events", 6, "Return")
        desktop.key("Escape", "Return")
        self.touch(desktop, 1)

    def test_who_does_not_agree_is_let_go(self):
        desktop = self.run_study()
        desktop.key("shift+Tab", "Return")
        self.keep(desktop, "study-declined")
        desktop.key("Return")
        self.assertEqual(desktop.wait_end(), 3, desktop.printed())
        self.assertEqual([row.split("\t")[2] for row in self.rows("events")], ["session", "declined"])
        self.assertIn("did not agree", desktop.printed())

    def test_the_device_that_touches_is_noted_with_the_data(self):
        desktop = self.run_study("--device", "Novint Falcon")
        desktop.key("shift+Tab", "Return", "Return")
        self.assertEqual(desktop.wait_end(), 3, desktop.printed())
        kind, _, name = self.rows("events")[0].split("\t")[2:5]
        self.assertEqual((kind, name), ("session", "Novint Falcon"))

    def test_without_its_device_nobody_takes_part(self):
        desktop = self.start("study", "run", self.study, "--device", "nonesuch")
        self.assertEqual(desktop.wait_end(), 1, desktop.printed())
        self.assertIn("--device", desktop.printed())
        self.assertFalse((self.folder / "tiny-data").exists())

    def test_a_scene_that_is_gone_is_told_and_tried_again(self):
        desktop = self.run_study()
        self.answer(desktop)
        away = (self.folder / "ball.wrl").rename(self.folder / "away.wrl")
        self.key_until(desktop, "events", 6, "Return")
        wait_for("the reason", lambda: "ball.wrl" in desktop.printed())
        self.keep(desktop, "study-trouble")
        away.rename(self.folder / "ball.wrl")
        desktop.key("Return")
        self.touch(desktop, 1)

    def test_a_full_disk_loses_nothing(self):
        disk = self.small_disk("tiny-data", "512k")
        desktop = self.run_study()
        self.answer(desktop)
        self.key_until(desktop, "events", 6, "Return")
        filler = self.fill(disk)
        self.reach_until(desktop, "the reason", lambda: "tiny-data" in desktop.printed())
        self.keep(desktop, "study-full-disk")
        self.assertEqual(self.rows("beh"), [])
        filler.unlink()
        desktop.key("Return")
        wait_for("the trial that was done", lambda: len(self.rows("beh")) == 1)

    def test_without_opengl_the_reason_is_seen(self):
        bad = {"LIBGL_DRIVERS_PATH": "/nonexistent"}
        desktop = self.run_study(environment=bad)
        self.answer(desktop)
        self.key_until(desktop, "events", 6, "Return")
        left, top, width, height = desktop.place()
        middle = (left + width // 3, top + height // 2, width // 3, height // 5)
        wait_for("the reason", lambda: self.screen.picture().part(*middle).share(is_ink) > 0.01)
        self.keep(desktop, "study-no-opengl")
        desktop.key("Escape", "shift+Tab", "Return")
        self.assertEqual(desktop.wait_end(), 3, desktop.printed())

    def test_closing_the_window_asks(self):
        desktop = self.run_study()
        desktop.quit()
        desktop.key("Return")
        self.key_until(desktop, "events", 2, "Return")
        desktop.quit()
        desktop.key("shift+Tab", "Return")
        self.assertEqual(desktop.wait_end(), 3, desktop.printed())

    def test_among_simulated_people_nobody_takes_part(self):
        subprocess.run([PROGRAM, "study", "run", self.study, "--simulate", "1"], check=True, capture_output=True)
        desktop = self.start("study", "run", self.study, "--data", self.folder / "tiny-simulated")
        self.assertEqual(desktop.wait_end(), 1, desktop.printed())
        self.assertIn("holds simulated data", desktop.printed())


MENU_STUDY = """
name = "menu"
languages = ["en", "nl"]
title = {{ en = "Menus", nl = "Menu's" }}
needs = ["pointer", "haptic-menu"]
consent = {{ en = "You may stop at any time.", nl = "U mag altijd stoppen." }}

[[dependent]]
id = "time"
name = {{ en = "Time", nl = "Tijd" }}
type = "ratio"
unit = "s"
from = "time"

[[independent]]
id = "way"
name = {{ en = "Way", nl = "Manier" }}
kind = "within"
levels = [
  {{ id = "click", name = {{ en = "Click", nl = "Klik" }}, select = "click" }},
  {{ id = "push", name = {{ en = "Push", nl = "Duw" }}, select = "push", forces = false }},
]

[task]
target = "menu/Red"
wrong = "menu/*"
start = [0.0, 0.0, 0.1]

[trials]
measured = 1
hold = 0.2
scenes = [{{ id = "room", file = "room.wrl", element = {{ id = "menu", file = "menu.toml", centre = [{}, {}, 0] }} }}]
"""
MENU = """languages = ["en", "nl"]
title = { en = "Colour", nl = "Kleur" }
text_m = 0.006
[[item]]
name = "Blue"
text = { en = "Blue", nl = "Blauw" }
icon = "#2b5fc7"
[[item]]
name = "Red"
text = { en = "Red", nl = "Rood" }
icon = "#d62f2f"
"""
ROOM = """#VRML V2.0 utf8
DEF floor Transform { translation 0 -0.06 0 children Shape {
  appearance Appearance { material Material { diffuseColor 0.55 0.58 0.63 } }
  geometry Box { size 0.2 0.005 0.15 } } }
"""


class StudyMenuTest(DesktopTest):
    """A menu that lies in the scene of a study, chosen from with the hand that the mouse drives."""

    def setUp(self):
        super().setUp()
        (self.folder / "room.wrl").write_text(ROOM)
        (self.folder / "menu.toml").write_text(MENU)
        laid = json.loads(subprocess.run([PROGRAM, "menu", self.folder / "menu.toml", "--json"], check=True,
                                         capture_output=True, text=True).stdout)
        red = next(item["centre"] for item in laid["items"] if item["name"] == "Red")
        # The eye is before the scene and a quarter as far above it; the hand goes away along that way.
        self.study = self.folder / "menu-study.toml"
        self.study.write_text(MENU_STUDY.format(-red[0], -red[1] - 0.25 * 0.1))

    def rows(self, kind):
        found = list(self.folder.glob(f"menu-study-data/sub-*/beh/*_{kind}.tsv"))
        return found[0].read_text().splitlines() if found else []

    def trial(self, count, choose):
        """Goes away from the eye until the trial is over, choosing at each step."""
        def reach():
            self.screen.ask("click", 4)
            choose()
            latest = time.monotonic() + 0.2
            while len(self.rows("beh")) <= count and time.monotonic() < latest:
                time.sleep(0.02)
            return len(self.rows("beh")) > count
        wait_for(f"{count} trials", reach)
        names, values = self.rows("beh")[0].split("\t"), self.rows("beh")[count].split("\t")
        return dict(zip(names, values))

    def read_on(self, desktop, events):
        desktop.key("Return")
        wait_for(f"{events} events: {self.rows('events')}", lambda: len(self.rows("events")) > events)

    def test_a_person_clicks_and_pushes_items(self):
        desktop = self.start("study", "run", self.study, "--language", "nl")
        desktop.window = desktop.find_window("ICOME")
        self.screen.ask("windowfocus", "--sync", desktop.window)
        self.read_on(desktop, 2)  # consent
        self.read_on(desktop, 3)  # the first condition
        time.sleep(1.5)  # the hand is held at the start
        self.keep(desktop, "study-menu-faded")
        steps = []

        def click():
            steps.append(1)
            if len(steps) > 12:  # near enough for the item to be lit and the menu to be opaque
                time.sleep(0.5)
                self.keep(desktop, f"study-menu-{len(steps)}")
            self.screen.ask("click", 1)
        clicked = self.trial(1, click)
        self.assertEqual((clicked["way"], clicked["completed"]), ("click", "yes"), clicked)
        self.assertEqual(int(clicked["errors"]), 0)
        self.assertLess(float(clicked["approach_time"]), float(clicked["time"]))
        self.read_on(desktop, 4)
        time.sleep(1.5)
        pushed = self.trial(2, lambda: None)
        self.assertEqual((pushed["way"], pushed["completed"]), ("push", "yes"), pushed)
        self.assertEqual(int(pushed["errors"]), 0)
        traces = sorted(self.folder.glob("menu-study-data/sub-*/motion/*_motion.tsv"))
        for trace, deepest in zip(traces, (0.02, -0.003)):
            last = trace.read_text().splitlines()[-1].split("\t")
            about = json.loads(trace.with_suffix(".json").read_text())
            self.assertEqual(about["Touched"][int(last[-1])], "menu/Red")  # chosen
            self.assertEqual(last[-1], last[-2])  # and lit
            self.assertLess(float(last[3]), deepest)


class NoDisplayTest(ProgramTest):
    def test_there_is_none(self):
        bare = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM")}
        self.write("ball.wrl", BALL)
        study = self.write("tiny.toml", STUDY)
        done = subprocess.run([PROGRAM, "study", "run", study], capture_output=True, text=True, timeout=120, env=bare)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("There is no display", done.stderr)
        self.assertIn("icome study run --simulate", done.stderr)


if __name__ == "__main__":
    unittest.main()
