"""Runs icome animate as a person would: makes projects by script, renders and records them."""
import fcntl
import gzip
import json
import math
import os
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile
import time
import tomllib
import unittest

import png_pixels

PROGRAM = os.environ["ICOME_PROGRAM"]
EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "data" / "cutout"


def run(*arguments, code=0, cwd=None, stdin=None):
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=300, cwd=cwd,
                          input=stdin)
    if code is not None and done.returncode != code:
        raise AssertionError(f"{arguments}: exit code {done.returncode}, not {code}\n{done.stdout}\n{done.stderr}")
    return done


def animate(*arguments, **others):
    return run("animate", *arguments, **others)


def animate_json(*arguments, **others):
    return json.loads(animate(*arguments, "--json", **others).stdout)


def cell_in(project, name):
    """The table of a cell in the text of a project, as another reader of TOML has it."""
    with open(project, "rb") as file:
        content = tomllib.load(file)
    return next(cell for layer in content["layer"] for cell in layer["cell"] if cell["name"] == name)


def value_at(keys, frame):
    """The value of keys with straight ways, worked out here once more."""
    before = [key for key in keys if key[0] <= frame]
    after = [key for key in keys if key[0] > frame]
    if not before:
        return keys[0][1]
    if not after or (len(before[-1]) > 2 and before[-1][2] == "hold"):
        return before[-1][1]
    (x0, y0), (x1, y1) = before[-1][:2], after[0][:2]
    return y0 + (y1 - y0) * (frame - x0) / (x1 - x0)


SQUARE = ('<svg xmlns="http://www.w3.org/2000/svg" width="40" height="20">'
          '<rect width="40" height="20" fill="#ff0000"/></svg>')


class Animate(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "square.svg").write_text(SQUARE)

    def script(self, *commands):
        (self.folder / "edits.jsonl").write_text("".join(json.dumps(command) + "\n" for command in commands))
        return self.folder / "edits.jsonl"

    def small_project(self):
        script = self.script(
            {"op": "stage", "width": 200, "height": 100, "rate": 12, "length": 12, "background": "#0000ff"},
            {"op": "add-cell", "pictures": "square.svg", "place": [50, 50]},
            {"op": "key", "cell": "square", "frame": 0, "x": 50}, {"op": "key", "cell": "square", "frame": 10, "x": 150})
        animate("new", "--apply", script, "--save", "small.cutout", cwd=self.folder)
        return self.folder / "small.cutout"

    def test_makes_a_project_by_script_and_tells_what_is_in_it(self):
        project = self.small_project()
        told = animate_json(project)
        self.assertEqual([told["width"], told["height"], told["rate"], told["frames"]], [200, 100, 12, 12])
        self.assertEqual(told["layers"][0]["cells"][0]["name"], "square")
        self.assertEqual(told["layers"][0]["cells"][0]["keys"], 2)
        self.assertEqual(told["missing"], [])
        self.assertIn("square", animate(project).stdout)

    def test_pictures_are_found_from_wherever_it_runs_and_is_saved(self):
        project = self.small_project()
        self.assertEqual(cell_in(project, "square")["pictures"], ["square.svg"])
        (self.folder / "below").mkdir()
        copy = self.folder / "below" / "copy.cutout"
        animate(project, "--save", copy, cwd="/")
        self.assertEqual(cell_in(copy, "square")["pictures"], ["../square.svg"])
        self.assertEqual(animate_json(copy)["missing"], [])
        script = self.script({"op": "add-cell", "pictures": "square.svg"})
        animate("new", "--apply", script, "--save", self.folder / "other.cutout", cwd="/")
        self.assertEqual(animate_json(self.folder / "other.cutout")["missing"], [])

    def test_draws_what_the_keys_say(self):
        project = self.small_project()
        animate(project, "--out", self.folder / "shot%02d.png")
        self.assertEqual(len(list(self.folder.glob("shot*.png"))), 12)
        for frame in (0, 3, 10, 11):
            _, _, rows = png_pixels.pixels(self.folder / f"shot{frame:02}.png")
            middle = value_at([(0, 50), (10, 150)], frame)
            for x in range(2, 200, 5):
                expected = (255, 0, 0) if abs(x + 0.5 - middle) < 19 else (0, 0, 255)
                if 19 <= abs(x + 0.5 - middle) <= 21:
                    continue
                self.assertEqual(rows[50][x][:3], expected, (frame, x))

    def test_packed_svg_is_drawn_as_the_plain_one(self):
        (self.folder / "packed.svgz").write_bytes(gzip.compress(SQUARE.encode()))
        pictures = []
        for name in ("square.svg", "packed.svgz"):
            script = self.script({"op": "stage", "width": 60, "height": 40}, {"op": "add-cell", "pictures": name})
            animate("new", "--apply", script, "--save", "one.cutout", cwd=self.folder)
            animate("one.cutout", "--frames", "0-0", "--out", "one.png", cwd=self.folder)
            pictures.append((self.folder / "one.png").read_bytes())
        self.assertEqual(*pictures)
        (self.folder / "packed.svgz").write_bytes(gzip.compress(SQUARE.encode())[:-20])
        told = animate("one.cutout", "--out", "two.png", "--frames", "0-0", cwd=self.folder, code=1)
        self.assertIn("packed.svgz", told.stderr)

    def test_gives_the_same_bytes_each_time(self):
        project = self.small_project()
        names = ["a.png", "a.svg"] + (["a.mp4", "a.gif", "a.webm", "a.apng"] if shutil.which("ffmpeg") else [])
        for name in names:
            bytes_ = []
            for turn in "12":
                out = self.folder / turn / name
                out.parent.mkdir(exist_ok=True)
                frames = ["--frames", "4-4"] if name.endswith((".png", ".svg")) else []
                animate(project, "--out", out, *frames)
                bytes_.append(out.read_bytes())
            self.assertEqual(bytes_[0], bytes_[1], name)

    @unittest.skipUnless(shutil.which("ffprobe"), "ffmpeg is not installed: no film to look at")
    def test_writes_films_of_all_frames(self):
        project = self.small_project()
        for ending in ("mp4", "webm", "gif", "apng"):
            out = self.folder / f"film.{ending}"
            written = animate_json(project, "--out", out)["written"]
            self.assertEqual([written["first"], written["last"]], [0, 11])
            told = json.loads(subprocess.run(
                ["ffprobe", "-v", "error", "-count_frames", "-show_streams", "-of", "json", out],
                capture_output=True, text=True, check=True).stdout)["streams"][0]
            self.assertEqual((told["width"], told["height"], int(told["nb_read_frames"])), (200, 100, 12), ending)

    def test_says_what_is_missing_for_a_film_without_ffmpeg(self):
        project = self.small_project()
        done = subprocess.run([PROGRAM, "animate", str(project), "--out", str(self.folder / "a.mp4")],
                              capture_output=True, text=True, env={**os.environ, "PATH": "/nowhere"})
        self.assertEqual(done.returncode, 1)
        self.assertIn("apt install ffmpeg", done.stderr)
        self.assertFalse((self.folder / "a.mp4").exists())

    def test_a_wrong_line_is_named_and_nothing_written(self):
        script = self.script({"op": "add-cell", "pictures": "square.svg"}, {"op": "key", "cell": "circle", "frame": 0})
        done = animate("new", "--apply", script, "--save", "new.cutout", cwd=self.folder, code=1)
        self.assertIn("edits.jsonl:2: key: there is no cell 'circle'", done.stderr)
        self.assertFalse((self.folder / "new.cutout").exists())

    def test_tells_missing_and_damaged_pictures(self):
        project = self.small_project()
        (self.folder / "square.svg").write_bytes(b"\x89PNG\r\n\x1a\nnothing")
        told = animate_json(project)
        self.assertEqual([one["file"] for one in told["missing"]], ["square.svg"])
        (self.folder / "square.svg").unlink()
        self.assertIn("square.svg", animate(project).stderr)
        animate(project, "--out", self.folder / "a.png", "--frames", "0", code=1)
        self.assertTrue((self.folder / "a.png").is_file())

    def test_wrong_files_and_frames_get_a_sentence(self):
        project = self.small_project()
        for arguments, words in [
            (["nowhere.cutout"], "nowhere.cutout"),
            ([project, "--out", self.folder / "a.bmp"], "a.bmp"),
            ([project, "--out", self.folder / "a.png", "--frames", "5-3"], "--frames is 5-3"),
            ([project, "--out", self.folder / "a.png", "--frames", "0-12"], "the last frame is 11"),
            ([project, "--out", self.folder / "no" / "where" / "a.mp4"], "where"),
            ([self.folder / "square.svg"], "square.svg:1"),
        ]:
            done = animate(*arguments, code=1)
            self.assertIn(words, done.stderr)
            self.assertEqual(done.stdout, "")
        text = project.read_text().replace("width = 200", "width = nan")
        project.write_text(text)
        line = text[:text.index("width = nan")].count("\n") + 1
        self.assertIn(f"small.cutout:{line}:", animate(project, code=1).stderr)

    def test_takes_up_a_journal_that_a_crash_left(self):
        project = self.small_project()
        journal = self.folder / ".small.cutout.journal"
        sum_ = 0xcbf29ce484222325
        for byte in project.read_bytes():
            sum_ = (sum_ ^ byte) * 0x100000001b3 % 2**64
        journal.write_text(f"# Edits of a cut-out animation since it was saved; from {sum_:016x}\n"
                           'edit = [{ do = "smooth_hands", smooth = true }]\nedit = [{ do = "smoo')
        told = animate_json(project)
        self.assertEqual(told["recovered"], 1)
        self.assertTrue(any("line 3 is damaged" in note for note in told["notes"]))

    def test_nothing_is_written_over_what_it_is_made_of(self):
        project = self.small_project()
        before = (self.folder / "square.svg").read_bytes()
        done = animate(project, "--out", self.folder / "square.svg", "--frames", 0, code=1)
        self.assertIn("is a file that the animation is made of", done.stderr)
        self.assertEqual((self.folder / "square.svg").read_bytes(), before)
        self.assertIn(".cutout", animate(project, "--save", self.folder / "keep.png", code=1).stderr)
        self.assertFalse((self.folder / "keep.png").exists())

    def test_hostile_projects_are_refused(self):
        for text, words in [("", "cutout is missing"), ("cutout = 1\nx" + ".a" * 50_000 + " = 1\n", ":2: a key has"),
                            ("cutout = 1\n[a" + ".a" * 50_000 + "]\n", ":2: a key has")]:
            (self.folder / "bad.cutout").write_text(text)
            self.assertIn(words, animate(self.folder / "bad.cutout", code=1).stderr)
        dots = self.folder / "dots.cutout"
        dots.write_text('cutout = 1\nmarks = [[0, "' + "." * 500 + '"]]  # ' + "." * 500 + "\n")
        self.assertEqual(animate_json(dots)["marks"][0]["text"], "." * 500)

    def test_a_sound_that_is_missing_is_told(self):
        script = self.script({"op": "sound", "file": "gone.wav"})
        done = animate("new", "--apply", script, "--save", "sound.cutout", cwd=self.folder, code=1)
        self.assertIn("edits.jsonl:1: sound: gone.wav", done.stderr)
        self.assertFalse((self.folder / "sound.cutout").exists())
        (self.folder / "sound.cutout").write_text('cutout = 1\n[sound]\nfile = "gone.wav"\n')
        self.assertEqual([it["file"] for it in animate_json(self.folder / "sound.cutout")["missing"]], ["gone.wav"])

    def test_frames_need_no_sound_and_films_that_lack_it_are_told(self):
        project = self.small_project()
        project.write_text(project.read_text() + '\n[sound]\nfile = "gone.wav"\n')
        done = animate(project, "--out", self.folder / "a.png", "--frames", "0")
        self.assertEqual(done.stderr, "")
        if shutil.which("ffmpeg"):
            done = animate(project, "--out", self.folder / "a.mp4", code=1)
            self.assertIn("The film is silent: gone.wav", done.stderr)
            self.assertTrue((self.folder / "a.mp4").is_file())

    def test_what_is_open_in_a_window_is_not_saved_over(self):
        project = self.small_project()
        before = project.read_bytes()
        with (self.folder / ".small.cutout.journal").open("w") as journal:
            fcntl.flock(journal, fcntl.LOCK_EX)
            done = animate(project, "--apply", self.script({"op": "mark", "frame": 3, "text": "a"}), "--save", project,
                           code=1)
        self.assertIn("small.cutout: is open in a window", done.stderr)
        self.assertEqual(project.read_bytes(), before)

    def test_both_examples_are_whole(self):
        for name in ("boat", "walk"):
            told = animate_json(EXAMPLES / name / f"{name}.cutout")
            self.assertEqual(told["missing"], [])
            made = self.folder / name
            shutil.copytree(EXAMPLES / name, made)
            animate("new", "--apply", f"{name}.jsonl", "--save", f"{name}.cutout", cwd=made)
            self.assertEqual((made / f"{name}.cutout").read_text(), (EXAMPLES / name / f"{name}.cutout").read_text())
            animate(EXAMPLES / name / f"{name}.cutout", "--out", self.folder / "a.png", "--frames", "5", "--scale", 0.5)
            width, height, _ = png_pixels.pixels(self.folder / "a.png")
            self.assertEqual((width, height), (640, 360))

    def test_lists_its_tools(self):
        tools = {tool["name"] for tool in json.loads(animate("--help-tools", "--json").stdout)["tools"]}
        self.assertTrue({"key", "join", "chain", "map", "import", "undo"} <= tools)
        self.assertIn("degrees", animate("--help-tools", "key").stdout)
        self.assertIn("did you mean 'key'", animate("--help-tools", "kee", code=1).stderr)

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed: nothing to interrupt")
    def test_ctrl_c_leaves_nothing_half_written(self):
        script = self.script({"op": "stage", "width": 1920, "height": 1080, "length": 20000},
                             {"op": "add-cell", "pictures": "square.svg"})
        animate("new", "--apply", script, "--save", "long.cutout", cwd=self.folder)
        for name in ("long.mp4", "long/"):
            before = sorted(self.folder.iterdir())
            program = subprocess.Popen([PROGRAM, "animate", "long.cutout", "--out", name], cwd=self.folder,
                                       stderr=subprocess.PIPE, text=True)
            time.sleep(1.5)
            program.send_signal(signal.SIGINT)
            _, error = program.communicate(timeout=20)
            self.assertEqual(program.returncode, 130, error)
            self.assertEqual(sorted(self.folder.iterdir()), before)


class Record(unittest.TestCase):
    """Triangles of made frames move cells, as their truth says."""

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        run("track", "--synth", cls.folder / "made", "--frames", 50, "--triangles", 3, "--seed", 5)
        cls.truth = json.loads((cls.folder / "made" / "truth.json").read_text())
        (cls.folder / "square.svg").write_text(SQUARE)

    def record(self, *commands, known="made/known.toml", more=()):
        script = self.folder / "edits.jsonl"
        commands = [{"op": "stage", "width": 1280, "height": 960, "rate": 30, "length": 50},
                    {"op": "add-cell", "name": "a", "pictures": "square.svg", "place": [600, 400], "angle": 10},
                    {"op": "add-cell", "name": "b", "pictures": "square.svg", "place": [100, 100]}, *commands]
        script.write_text("".join(json.dumps(command) + "\n" for command in commands))
        told = json.loads(animate("new", "--apply", script, "--record", "made", "--known", known,
                                  "--save", "out.cutout", "--thin", 0, "--json", *more, cwd=self.folder).stdout)
        return told, self.folder / "out.cutout"

    def true_poses(self, id_):
        """Frame, x, y (mm) and angle (rad) of a triangle, in the frames where it is."""
        poses = []
        for number, frame in enumerate(self.truth["frames"]):
            for triangle in frame["triangles"]:
                if triangle["id"] == id_:
                    poses.append((number, triangle["x_mm"], triangle["y_mm"], triangle["angle_rad"]))
        return poses

    def test_absolute_cells_are_where_triangles_are(self):
        told, project = self.record({"op": "map", "triangle": "t1", "cell": "a"})
        self.assertEqual(told["recorded"]["frames"], 50)
        cell = cell_in(project, "a")
        for frame, x, y, angle in self.true_poses("t1")[2:]:
            self.assertLess(abs(value_at(cell["keys"]["x"], frame) - 2 * x), 1.0, frame)
            self.assertLess(abs(value_at(cell["keys"]["y"], frame) - 2 * y), 1.0, frame)
            turn = value_at(cell["keys"]["angle"], frame) - (math.degrees(angle) - 90)
            self.assertLess(abs((turn + 180) % 360 - 180), 1.0, frame)
        steps = [b[1] - a[1] for a, b in zip(cell["keys"]["angle"], cell["keys"]["angle"][1:])]
        self.assertLess(max(map(abs, steps)), 90, "angles are not wrapped")
        self.assertNotIn("keys", cell_in(project, "b"))

    def test_relative_cells_go_as_far_as_triangles(self):
        _, project = self.record({"op": "map", "triangle": "t2", "cell": "a", "mode": "relative"})
        cell = cell_in(project, "a")
        poses = self.true_poses("t2")
        first = cell["keys"]["x"][0][0]
        start = next(pose for pose in poses if pose[0] == first)
        for frame, x, y, _ in poses[first:]:
            self.assertLess(abs(value_at(cell["keys"]["x"], frame) - 600 - 2 * (x - start[1])), 1.5, frame)
            self.assertLess(abs(value_at(cell["keys"]["y"], frame) - 400 - 2 * (y - start[2])), 1.5, frame)

    def test_an_axis_keeps_the_cell_on_it(self):
        _, project = self.record({"op": "map", "triangle": "t1", "cell": "a"},
                                 {"op": "axis", "cell": "a", "direction": 0})
        cell = cell_in(project, "a")
        ys = {round(key[1], 6) for key in cell["keys"].get("y", [[0, cell["y"]]])}
        self.assertEqual(ys, {400})
        for frame, x, _, _ in self.true_poses("t1")[2:]:
            self.assertLess(abs(value_at(cell["keys"]["x"], frame) - 2 * x), 1.0, frame)

    def test_overdub_goes_over_one_layer_only(self):
        _, project = self.record({"op": "map", "triangle": "t1", "cell": "a"}, {"op": "add-layer", "name": "front"},
                                 {"op": "move-cell", "cell": "b", "layer": "front"},
                                 {"op": "map", "triangle": "t2", "cell": "b"}, more=["--layer", "front"])
        self.assertNotIn("keys", cell_in(project, "a"))
        self.assertIn("keys", cell_in(project, "b"))

    def test_a_list_that_names_cells_needs_no_mapping(self):
        known = self.folder / "named.toml"
        text = (self.folder / "made" / "known.toml").read_text()
        known.write_text(re.sub(r'(id = "t1"\n)', r'\1cell = "a"\n', text))
        _, project = self.record(known=known)
        self.assertIn("keys", cell_in(project, "a"))

    def slow_source(self, end=""):
        """The made frames at 25 a second, over and over."""
        return (f"gst:multifilesrc location={self.folder}/made/frame%06d.jpg start-index=0 stop-index=9 loop=true "
                f"caps=image/jpeg,framerate=25/1 ! jpegdec ! videoconvert ! identity sync=true {end}").strip()

    def begin_recording(self, source):
        script = self.folder / "edits.jsonl"
        script.write_text('{"op": "stage", "length": 100000}\n{"op": "add-cell", "name": "a", "pictures": "square.svg"}\n'
                          '{"op": "map", "triangle": "t1", "cell": "a"}\n')
        (self.folder / "kept.cutout").unlink(missing_ok=True)
        return subprocess.Popen([PROGRAM, "animate", "new", "--apply", script, "--record", source, "--known",
                                 "made/known.toml", "--view", "made/view.toml", "--save", "kept.cutout", "--json"],
                                cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def test_a_recording_is_kept_when_its_terminal_is_closed(self):
        for end in (signal.SIGHUP, signal.SIGINT, signal.SIGTERM):
            with self.begin_recording(self.slow_source()) as recording:
                time.sleep(4)
                recording.send_signal(end)
                told = json.loads(recording.communicate(timeout=120)[0])
                self.assertEqual(recording.returncode, 0)
            self.assertFalse((self.folder / ".kept.cutout.journal").exists())
            self.assertGreater(told["recorded"]["frames"], 0)
            self.assertIn("keys", cell_in(self.folder / "kept.cutout", "a"))

    def test_a_recording_outlives_a_kill(self):
        with self.begin_recording(self.slow_source()) as recording:
            journal = self.folder / ".kept.cutout.journal"
            for _ in range(1200):
                if journal.exists() and journal.read_text().count("\n") >= 3:
                    break
                time.sleep(0.05)
            recording.kill()
            recording.communicate()
        told = animate_json(self.folder / "kept.cutout")
        self.assertEqual(told["recovered"], 1)
        animate(self.folder / "kept.cutout", "--save", self.folder / "recovered.cutout")
        keys = cell_in(self.folder / "recovered.cutout", "a")["keys"]["x"]
        self.assertGreater(keys[-1][0] - keys[0][0], 24)  # frames: two parts of a second each at least

    def test_a_source_that_breaks_off_is_told_and_what_came_is_kept(self):
        with self.begin_recording(self.slow_source("error-after=20")) as recording:
            told = json.loads(recording.communicate(timeout=120)[0])
            self.assertEqual(recording.returncode, 1)
        self.assertGreater(told["recorded"]["frames"], 5)
        self.assertIn("keys", cell_in(self.folder / "kept.cutout", "a"))

    def test_says_what_is_wrong(self):
        script = self.folder / "edits.jsonl"
        known = ["--known", "made/known.toml"]
        cell = '{"op": "add-cell", "name": "a", "pictures": "square.svg"}\n'
        mapping = '{"op": "map", "triangle": "t1", "cell": "a"}\n'
        for lines, arguments, words in [(cell, ["--record", "made"], "--known"),
                                        (cell + mapping, ["--record", "nowhere", *known], "nowhere"),
                                        (cell, ["--record", "made", *known], "no triangle moves a cell"),
                                        (cell, ["--record", "made", *known, "--layer", "x"], "no layer 'x'")]:
            script.write_text(lines)
            done = animate("new", "--apply", script, "--save", "x.cutout", *arguments, cwd=self.folder, code=1)
            self.assertIn(words, done.stderr)
        done = animate("new", "--apply", script, "--record", "made", *known, cwd=self.folder, code=1)
        self.assertIn("--record needs --save", done.stderr)
        script.write_text(cell + mapping + '{"op": "stage", "length": 20}\n')
        record = ["new", "--apply", script, "--record", "made", *known]
        done = animate(*record, "--save", "x.cutout", "--from", 20, cwd=self.folder, code=1)
        self.assertIn("--from is 20, but the last frame is 19", done.stderr)
        done = animate(*record, "--save", "no/x.cutout", cwd=self.folder, code=1)
        self.assertIn("no", done.stderr)
        self.assertEqual(list(self.folder.glob("*x.cutout*")), [], "nothing was recorded")
        told = json.loads(animate(*record, "--save", "x.cutout", "--json", cwd=self.folder).stdout)
        self.assertIn("ended with the animation, at frame 19", told["notes"][0])

    def test_a_recording_is_rescued_where_its_file_cannot_be_written_any_more(self):
        with self.begin_recording(self.slow_source()) as recording:
            for _ in range(1200):
                if (self.folder / ".kept.cutout.journal").exists():
                    break
                time.sleep(0.05)
            kept = self.folder / "kept.cutout"
            kept.unlink()
            kept.mkdir()  # no file can take its name now
            time.sleep(1)
            recording.send_signal(signal.SIGINT)
            said = recording.communicate(timeout=120)[1]
            self.assertEqual(recording.returncode, 1)
        kept.rmdir()
        rescued = pathlib.Path(re.search(r"the recording was saved as (\S+) in its place", said)[1])
        self.assertIn("keys", cell_in(rescued, "a"))
        rescued.unlink()


if __name__ == "__main__":
    unittest.main()
