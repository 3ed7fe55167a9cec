"""`icome study run` with simulated people: what is logged, what is refused, and what kills leave."""
import csv
import json
import os
import pathlib
import random
import signal
import subprocess
import time
import unittest

from icome_program import PROGRAM, ProgramTest, run

KILLS = int(os.environ.get("ICOME_STUDY_KILLS", "250"))  # 1,000 take one and a half minutes of a quiet machine
LATEST_KILL = 0.08  # s after the start: a run needs some 20 ms to begin, and a trial about as much; at first


def rows(path):
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file, delimiter="\t"))


def whole_lines(path):
    """The lines of a file that end in a line feed: what was cut off is no row."""
    text = path.read_text(encoding="utf-8") if path.exists() else ""
    return text.split("\n")[:-1]


class StudyRunTest(ProgramTest):
    def study(self, name="small", change=lambda text: text, template="blank"):
        file = self.folder / (name + ".toml")
        self.succeeds("study", "new", file, "--template", template)
        file.write_text(change(file.read_text()))
        return file

    def simulate(self, file, people, *arguments):
        answer = self.succeeds("study", "run", file, "--simulate", people, "--json", *arguments)
        report = json.loads(answer.stdout)
        self.assertTrue(report["simulated"])
        return pathlib.Path(report["folder"])

    def test_simulated_people_do_all_trials_in_balanced_orders(self):
        data = self.simulate(self.study(), 4)
        people = rows(data / "participants.tsv")
        self.assertEqual([one["order"] for one in people], ["old; new", "new; old"] * 2)
        for one in people:
            name = one["participant_id"]
            trials = rows(next((data / name / "beh").glob("*_beh.tsv")))
            measured = [trial for trial in trials if trial["phase"] == "measured"]
            self.assertEqual([trial["technique"] for trial in measured],
                             [level for level in one["order"].split("; ") for _ in range(10)])
            for trial in trials:
                self.assertEqual(trial["completed"], "yes")
                time_of = {key: float(trial[key]) for key in ("time", "approach_time", "homing_time")}
                self.assertAlmostEqual(time_of["time"], time_of["approach_time"] + time_of["homing_time"], places=5)
                trace = (data / name / trial["trace"]).read_text().splitlines()
                first, last = (line.split("\t") for line in (trace[0], trace[-1]))
                self.assertLess(float(first[0]), 0.0)
                self.assertAlmostEqual(float(last[0]), time_of["time"], places=3)
                self.assertAlmostEqual(len(trace), (float(last[0]) - float(first[0])) * 1000 + 1, delta=1)

    def test_trials_that_the_time_limit_ends_are_told(self):
        slow = self.study("hidden", template="menu")
        done = self.succeeds("study", "run", slow, "--simulate", 1, "--json", "--data", self.folder / "all")
        self.assertEqual(json.loads(done.stdout)["ended_by_limit"], 0)
        self.assertNotIn("time limit", done.stderr)
        slow.write_text(slow.read_text().replace("limit = 60", "limit = 1"))
        done = self.succeeds("study", "run", slow, "--simulate", 1, "--json", "--data", self.folder / "few")
        answer = json.loads(done.stdout)
        ended = [trial for table in (self.folder / "few").rglob("*_beh.tsv") for trial in rows(table)
                 if trial["completed"] == "no"]
        self.assertEqual(answer["ended_by_limit"], len(ended))
        self.assertGreater(len(ended), 0)
        self.assertIn(f"{len(ended)} of {answer['trials']} trials were ended by the time limit", done.stderr)

    def test_everything_simulated_is_stamped(self):
        data = self.simulate(self.study(), 1)
        for path in data.rglob("*"):
            # Copies of what the study is are what they are of.
            if path.is_dir() or path.name.startswith(".") or path.name == "study.toml" or "stimuli" in path.parts:
                continue
            self.assertTrue("SIMULATED" in path.read_text() or "SIMULATED" in path.name, path)

    def test_folders_are_as_the_validators_of_bids_want_them(self):
        data = self.simulate(self.study("menu", template="menu"), 2)
        for path in data.rglob("*.tsv"):
            if path.name.endswith("_motion.tsv"):
                about = json.loads(path.with_suffix(".json").read_text())
                self.assertEqual(about["TaskName"], "menu")
                self.assertAlmostEqual(about["SamplingFrequencyEffective"], about["SamplingFrequency"], places=2)
                continue
            about = json.loads(path.with_suffix(".json").read_text())
            self.assertTrue(all(isinstance(member, dict) for member in about.values()), path)
            columns = path.read_text().split("\n")[0].split("\t")
            self.assertEqual(set(columns) - set(about), set(), path)
            if path.parent.name == "phenotype":
                people = [row["participant_id"] for row in rows(path)]
                self.assertEqual(sorted(set(people)), people, path)
        self.succeeds("study", "report", data)
        ignored = (data / ".bidsignore").read_text().split()
        standard = {"dataset_description.json", "participants.tsv", "participants.json", "README"}
        self.assertEqual({path.name for path in data.iterdir() if path.is_file() and path.name[0] != "."} - standard,
                         set(ignored) - {"report.pdf"})

    def test_the_case_studies_run(self):
        for template, people, trials in (("head-tracking", 2, 16), ("menu", 4, 30)):
            data = self.simulate(self.study(template, template=template), people)
            for name in (one["participant_id"] for one in rows(data / "participants.tsv")):
                done = rows(next((data / name / "beh").glob("*_beh.tsv")))
                self.assertEqual(sum(trial["phase"] == "measured" for trial in done), trials)
        groups = [one["group"] for one in rows(data / "participants.tsv")]
        self.assertEqual(sorted(groups), ["click", "click", "push", "push"])

    def test_the_menu_study_is_reported_in_the_form_of_the_thesis(self):
        data = self.simulate(self.study("menu", template="menu"), 4)
        self.assertTrue((data / "stimuli/scenes/colour-menu.toml").is_file())
        found = json.loads(self.succeeds("study", "report", data, "--json").stdout)
        self.assertTrue(found["simulated"])
        groups = {one["participant_id"]: one["group"] for one in rows(data / "participants.tsv")}
        trials = [trial | {"interaction": groups[path.parts[-3]]} for path in data.glob("sub-*/beh/*_beh.tsv")
                  for trial in rows(path) if trial["phase"] == "measured"]
        self.assertEqual(len(trials), 120)
        table = next(table for table in found["thesis"]["tables"] if table["factor"] == "haptics"
                     and table["trials"] == "all" and table.get("only") == {"interaction": "click"})
        for level in ("forces", "none"):
            mine = [trial for trial in trials if trial["interaction"] == "click" and trial["haptics"] == level]
            times = [1000 * float(trial["time"]) for trial in mine]
            row = next(row for row in table["rows"] if row["variable"] == "time")
            self.assertAlmostEqual(row["levels"][level], sum(times) / len(times), places=6)
            wrong = sum(int(trial["errors"]) for trial in mine)
            self.assertEqual(table["choices"]["levels"][level], {"choices": len(mine) + wrong, "wrong": wrong})
        self.assertEqual(len(found["thesis"]["correlations"]), 10)
        page = (data / "report.html").read_text()
        self.assertIn("In the form of the thesis", page)
        for like in ("As tables 6.2 and 6.4", "As table 6.5", "As table 6.3", "As table 6.1"):
            self.assertIn(like, page)

    def test_a_changed_element_is_refused(self):
        file = self.study("menu", template="menu")
        self.simulate(file, 1)
        menu = self.folder / "scenes" / "colour-menu.toml"
        menu.write_text(menu.read_text().replace("push_m = 0.003", "push_m = 0.004"))
        self.fails("study", "run", file, "--simulate", 2, code=1, saying="was another scene")

    def test_more_people_join_those_there_are(self):
        file = self.study()
        data = self.simulate(file, 1)
        before = {path: path.read_bytes() for path in data.rglob("sub-SIMULATED001/*/*")}
        self.simulate(file, 2)
        self.assertEqual(len(rows(data / "participants.tsv")), 2)
        for path, content in before.items():
            self.assertEqual(path.read_bytes(), content)

    def test_a_changed_study_is_refused(self):
        file = self.study()
        self.simulate(file, 1)
        file.write_text(file.read_text().replace("measured = 10", "measured = 11"))
        self.fails("study", "run", file, "--simulate", 1, code=1, saying="before the study file was changed")
        file.write_text("# A remark.\n" + file.read_text().replace("measured = 11", "measured = 10"))
        self.simulate(file, 1)

    def test_a_changed_scene_is_refused(self):
        file = self.study()
        self.simulate(file, 1)
        scene = self.folder / "scenes" / "pointing-room.wrl"
        scene.write_text(scene.read_text().replace("0.06", "0.05"))
        self.fails("study", "run", file, "--simulate", 2, code=1, saying="was another scene")

    def test_what_cannot_be_run_says_why(self):
        head = self.study("head", template="head-tracking")
        for words in ("head-tracking", "--head", "--pointer-only"):
            self.fails("study", "run", head, code=1, saying=words)
        bare = self.study("bare", lambda text: text.replace('target = "target"', 'target = "goal"'))
        self.fails("study", "run", bare, "--simulate", 1, code=1, saying="'goal'")
        (self.folder / "scenes" / "pointing-room.wrl").unlink()
        self.fails("study", "run", bare, "--simulate", 1, code=1, saying="pointing-room.wrl")
        self.fails("study", "run", bare, "--simulate", 0, code=2, saying="--simulate")

    def test_nothing_begins_that_a_scene_would_stop(self):
        pink = self.study("pink", lambda text: text.replace('id = "red"', 'id = "pink"'), template="menu")
        file = self.study()
        (self.folder / "scenes" / "pointing-room.wrl").write_bytes(b"\x00\xff" * 250)
        before = sorted(self.folder.rglob("*"))
        for options in (("--simulate", 1), ("--pointer-only", "--with", "age=30")):
            self.fails("study", "run", pink, *options, code=1, saying="'menu/pink'")
            self.fails("study", "run", file, *options, code=1, saying="pointing-room.wrl")
        self.assertEqual(sorted(self.folder.rglob("*")), before)

    def test_the_pointer_alone_leaves_out_what_is_missing(self):
        head = self.study("head", template="head-tracking")
        data = self.simulate(head, 1, "--pointer-only")
        trials = rows(next((data / "sub-SIMULATED001" / "beh").glob("*_beh.tsv")))
        self.assertEqual({trial["viewpoint"] for trial in trials}, {"fixed"})
        self.fails("study", "run", head, "--simulate", 1, "--data", data, code=1, saying="another folder")

    def test_the_report_is_written_beside_the_data(self):
        data = self.simulate(self.study(), 4)
        self.succeeds("study", "report", data)
        page = (data / "report.html").read_text()
        self.assertIn("<title>SIMULATED: ", page)
        done = self.succeeds("study", "report", data, "--json", "--pdf", data / "report.pdf")
        self.assertEqual(json.loads(done.stdout)["participants"]["complete"], 4)
        self.assertTrue((data / "report.pdf").read_bytes().startswith(b"%PDF-"))
        out = self.folder / "page.HTM"
        self.succeeds("study", "report", data, "--out", out, "--pdf", self.folder / "page.pdf")
        self.assertEqual(out.read_text(), page)

    def test_the_report_never_overwrites_data(self):
        data = self.simulate(self.study(), 1)
        person = data / "sub-SIMULATED001"
        (self.folder / "link.html").symlink_to(data / "participants.tsv")
        (self.folder / "way").symlink_to(data)
        before = {path: path.read_bytes() for path in data.rglob("*") if path.is_file()}
        for out, saying in ((data / "participants.tsv", ".html"), (data / "other.html", "report.html"),
                            (person / "report.html", "report.html"), (data / "beh" / ".." / "x.htm", "report.html"),
                            (self.folder / "link.html", "report.html"), (self.folder / "way" / "x.html", "report.html"),
                            (self.folder / "page", ".html")):
            self.fails("study", "report", data, "--out", out, code=1, saying=saying)
        for pdf, saying in ((data / "study.toml", ".pdf"), (person / "report.pdf", "lies in the study's data"),
                            (data / "other.pdf", "report.pdf"), (self.folder / "page.html", ".pdf")):
            self.fails("study", "report", data, "--pdf", pdf, code=1, saying=saying)
        self.fails("study", "report", f"{data}/", "--out", data / "x.html", code=1, saying="report.html")
        self.assertEqual({path: path.read_bytes() for path in data.rglob("*") if path.is_file()}, before)

    def test_without_a_display_it_says_what_to_do(self):
        file = self.study()
        self.fails("study", "run", file, "--with", "age=30", code=1, saying="display")
        self.fails("study", "resume", file, code=1, saying="begin with icome study run")
        self.assertEqual(list(file.parent.glob("*-data")), [])

    def test_what_simulated_people_do_not_need_is_refused(self):
        file = self.study()
        for option in (("--participant", "7"), ("--with", "age=30"), ("--language", "en"), ("--window",)):
            self.fails("study", "run", file, "--simulate", 1, *option, code=2, saying=option[0])
        self.fails("study", "run", file, "--json", code=2, saying="--simulate")

    def test_what_is_left_out_is_kept_apart(self):
        file = self.study("menu", template="menu")
        self.assertEqual(self.simulate(file, 1).name, "menu-simulated")
        self.assertEqual(self.simulate(file, 1, "--pointer-only").name, "menu-pointer-simulated")

    def test_interrupted_it_goes_on(self):
        file = self.study()
        whole = self.simulate(file, 3)
        data = self.folder / "interrupted"
        command = [PROGRAM, "study", "run", str(file), "--simulate", "3", "--data", str(data)]
        with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process:
            while len(list(data.glob("sub-*/motion/*_motion.tsv"))) < 10:
                time.sleep(0.001)
            process.send_signal(signal.SIGINT)
            self.assertIn("goes on", process.communicate()[1])
        self.assertEqual(process.returncode, 130)
        self.simulate(file, 3, "--data", data)
        self.assert_same_trials(whole, data)

    def assert_same_trials(self, one, other):
        names = sorted(path.relative_to(one) for path in one.glob("sub-*/*/*") if "_events" not in path.name)
        self.assertEqual(names,
                         sorted(path.relative_to(other) for path in other.glob("sub-*/*/*")
                                if "_events" not in path.name))
        for name in names:
            self.assertEqual((one / name).read_bytes(), (other / name).read_bytes(), name)

    def test_kills_lose_at_most_the_trial_that_was_running(self):
        # Some 1,000 trials of one person, so that there is something to kill.
        file = self.study(change=lambda text: text.replace("measured = 10", "measured = 500"))
        whole = self.simulate(file, 1)
        trials = whole_lines(next(whole.glob("sub-*/beh/*_beh.tsv")))
        chance = random.Random(7)
        kills, ended, logged, in_vain, latest, done = 0, 0, 0, 0, LATEST_KILL, 0
        data = self.folder / "killed"
        while kills < KILLS:
            was_killed = self.run_until_killed(file, data, chance.uniform(0.0, latest))
            now = [line for log in data.glob("sub-*/beh/*_beh.tsv") for line in whole_lines(log)]
            # What was on record stays, and is what an undisturbed run has, in its order.
            self.assertGreaterEqual(len(now), done, kills)
            self.assertEqual(now[done:], trials[done:len(now)], kills)
            for line in now[max(done, 1):]:
                trace = data / "sub-SIMULATED001" / line.split("\t")[-2]
                self.assertEqual(trace.read_bytes(), (whole / trace.relative_to(data)).read_bytes(), kills)
            kills += was_killed
            logged += len(now) - done
            in_vain = 0 if len(now) > done or not was_killed else in_vain + 1
            if in_vain == 15:  # the machine is slower than that
                in_vain, latest = 0, 1.5 * latest
            done = len(now)
            if not was_killed:  # it came to its end: the next kills are of one that begins anew
                self.assert_same_trials(whole, data)
                ended += 1
                data, done, in_vain = self.folder / f"killed{ended}", 0, 0
        self.assertGreater(logged, 0.1 * KILLS)  # trials were under way
        self.simulate(file, 1, "--data", data)
        self.assert_same_trials(whole, data)

    def run_until_killed(self, file, data, delay):
        """Runs the study for `delay` seconds; whether it had to be killed then."""
        command = [PROGRAM, "study", "run", str(file), "--simulate", "1", "--data", str(data)]
        with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as process:
            try:
                said = process.communicate(timeout=delay)[1]
                self.assertEqual(process.returncode, 0, said)
                return False
            except subprocess.TimeoutExpired:
                process.kill()
                process.communicate()
                return True


if __name__ == "__main__":
    unittest.main()
