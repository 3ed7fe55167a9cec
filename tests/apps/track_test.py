"""Runs icome track as a person would: makes frames, tracks them, and reads what it prints and sends."""
import json
import math
import os
import pathlib
import re
import signal
import socket
import struct
import subprocess
import tempfile
import time
import unittest

import png_pixels

PROGRAM = os.environ["ICOME_PROGRAM"]


def run(*arguments, code=0, timeout=300):
    done = subprocess.run([PROGRAM, "track", *map(str, arguments)], capture_output=True, text=True, timeout=timeout)
    if code is not None and done.returncode != code:
        raise AssertionError(f"{arguments}: exit code {done.returncode}, not {code}\n{done.stdout}\n{done.stderr}")
    return done


def osc_text(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode(), (end // 4 + 1) * 4


def osc_message(data):
    """A message by OSC 1.0: address, types, then arguments of types i, f and s."""
    address, at = osc_text(data, 0)
    types, at = osc_text(data, at)
    assert types[0] == ","
    arguments = []
    for kind in types[1:]:
        if kind == "s":
            value, at = osc_text(data, at)
        else:
            value = struct.unpack(">i" if kind == "i" else ">f", data[at:at + 4])[0]
            at += 4
        arguments.append(value)
    assert at == len(data)
    return address, types[1:], arguments


def osc_bundle(data):
    assert data[:8] == b"#bundle\0" and len(data) % 4 == 0
    at, messages = 16, []
    while at < len(data):
        size = struct.unpack(">i", data[at:at + 4])[0]
        messages.append(osc_message(data[at + 4:at + 4 + size]))
        at += 4 + size
    assert at == len(data)
    return messages


class Track(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)
        cls.made = cls.folder / "made"
        run("--synth", cls.made, "--frames", 12, "--triangles", 6, "--hands", "--seed", 3)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def tracked(self, *more, source=None):
        done = run(source or self.made, "--known", self.made / "known.toml", "--view", self.made / "view.toml", "--json", *more)
        return json.loads(done.stdout)

    def test_says_that_nothing_was_found_and_why(self):
        for has_blue, words in [(False, "nothing blue lies on the table"), (True, "other angles or heights")]:
            rows = [bytes([200, 40, 40]) * 160 for _ in range(120)]
            if has_blue:  # a rectangle, which is no triangle of the list
                rows[40:80] = [bytes([200, 40, 40]) * 50 + bytes([30, 60, 200]) * 60 + bytes([200, 40, 40]) * 50] * 40
            picture = self.folder / "plain.png"
            png_pixels.write(picture, rows)
            done = run(picture, "--known", self.made / "known.toml")
            self.assertIn("no triangle of", done.stderr)
            self.assertIn(words, done.stderr)

    def test_made_frames_come_with_their_truth(self):
        truth = json.loads((self.made / "truth.json").read_text())
        self.assertEqual(len(truth["frames"]), 12)
        self.assertEqual(truth["ids"], ["t1", "t2", "t3", "t4", "t5", "t6"])
        self.assertEqual(len(list(self.made.glob("frame*.jpg"))), 12)
        self.assertAlmostEqual(truth["frames"][3]["t"], 0.1)
        again = self.folder / "again"
        run("--synth", again, "--frames", 12, "--triangles", 6, "--hands", "--seed", 3)
        for file in sorted(self.made.iterdir()):
            self.assertEqual(file.read_bytes(), (again / file.name).read_bytes(), file.name)
        self.assertIn("not empty", run("--synth", again, code=1).stderr)

    def test_json_tells_where_triangles_are(self):
        answer = self.tracked()
        truth = json.loads((self.made / "truth.json").read_text())
        self.assertEqual(len(answer["frames"]), 12)
        right = wanted = 0
        for frame, true in zip(answer["frames"], truth["frames"]):
            self.assertAlmostEqual(frame["t"], true["t"], places=6)
            self.assertGreaterEqual(frame["ms"], 0)
            places = {one["id"]: one for one in true["triangles"]}
            wanted += len(places)
            for found in frame["triangles"]:
                self.assertEqual(set(found), {"id", "x_mm", "y_mm", "angle_rad", "confidence"})
                self.assertTrue(0 <= found["confidence"] <= 1)
                own = places[found["id"]]
                off = math.hypot(found["x_mm"] - own["x_mm"], found["y_mm"] - own["y_mm"])
                turn = abs(math.remainder(found["angle_rad"] - own["angle_rad"], 2 * math.pi))
                right += off < 2 and turn < 0.05
        self.assertGreater(right, 0.9 * wanted)

    def test_truth_is_compared(self):
        answer = self.tracked("--truth", self.made / "truth.json")["truth"]
        self.assertGreater(answer["recall"], 0.9)
        self.assertEqual(answer["wanted"], 72)
        self.assertLess(answer["position_rms_mm"], 0.5)
        text = run(self.made, "--known", self.made / "known.toml", "--truth", self.made / "truth.json")
        self.assertIn("Truth: ", text.stdout)
        self.assertIn("the view is that of", text.stderr)
        thesis = self.tracked("--truth", self.made / "truth.json", "--pipeline", "thesis")["truth"]
        self.assertGreater(thesis["recall"], 0.3)

    def test_picture_shows_what_was_found(self):
        out = self.folder / "found.png"
        frame = sorted(self.made.glob("frame*.jpg"))[0]
        done = run(frame, "--known", self.made / "known.toml", "--view", self.made / "view.toml", "--picture", out)
        self.assertIn("x, mm", done.stdout)
        self.assertEqual(struct.unpack(">II", out.read_bytes()[16:24]), (640, 480))

    def test_tuio_says_the_same_as_json(self):
        listener = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        listener.bind(("127.0.0.1", 0))
        listener.settimeout(20)
        answer = self.tracked("--tuio", f"127.0.0.1:{listener.getsockname()[1]}")
        ids = ["t1", "t2", "t3", "t4", "t5", "t6"]
        sessions = {}
        for number, frame in enumerate(answer["frames"]):
            messages = osc_bundle(listener.recv(65536))
            self.assertTrue(all(message[0] == "/tuio/2Dobj" for message in messages))
            self.assertEqual(messages[0][2], ["source", "icome"])
            alive, sets, fseq = messages[1][2], messages[2:-1], messages[-1][2]
            self.assertEqual(alive[0], "alive")
            self.assertEqual(fseq, ["fseq", number + 1])
            self.assertEqual(len(sets), len(frame["triangles"]))
            self.assertEqual(sorted(alive[1:]), sorted(message[2][1] for message in sets))
            for (_, types, values), found in zip(sets, frame["triangles"]):
                self.assertEqual(types, "siiffffffff")
                _, session, kind, x, y, angle = values[:6]
                self.assertEqual(ids[kind], found["id"])
                self.assertEqual(sessions.setdefault(kind, session), session)
                self.assertAlmostEqual(x, found["x_mm"] / 640, places=5)
                self.assertAlmostEqual(y, found["y_mm"] / 480, places=5)
                self.assertAlmostEqual(math.cos(angle), math.cos(-found["angle_rad"]), places=5)
                self.assertAlmostEqual(math.sin(angle), math.sin(-found["angle_rad"]), places=5)
        listener.close()

    def test_calibration_from_made_pictures(self):
        board, view = self.folder / "board", self.folder / "calibrated.toml"
        run("--synth", board, "--board")
        found = json.loads(run(board, "--calibrate", view, "--json").stdout)
        self.assertGreaterEqual(found["sights"], 8)
        self.assertLess(abs(found["table_mm"][0] - 640), 3)
        with_it = json.loads(run(self.made, "--known", self.made / "known.toml", "--view", view, "--json",
                                 "--truth", self.made / "truth.json").stdout)["truth"]
        self.assertGreater(with_it["recall"], 0.9)
        self.assertLess(with_it["position_rms_mm"], 1.0)

    def test_sheet_is_true_to_size(self):
        out = self.folder / "sheet.pdf"
        run("--sheet", out, "--known", self.made / "known.toml")
        data = out.read_bytes()
        self.assertTrue(data.startswith(b"%PDF"))
        width, height = map(float, re.search(rb"/MediaBox \[ 0 0 ([\d.]+) ([\d.]+)", data).groups())
        self.assertAlmostEqual(width, 297 / 25.4 * 72, places=1)
        self.assertAlmostEqual(height, 210 / 25.4 * 72, places=1)

    def test_learning_adds_a_triangle(self):
        one, listed = self.folder / "one", self.folder / "learnt.toml"
        run("--synth", one, "--frames", 4, "--triangles", 1, "--still")
        run(one, "--learn", "--known", listed, "--id", "boat", "--view", one / "view.toml")
        text = listed.read_text()
        self.assertIn('id = "boat"', text)
        self.assertAlmostEqual(float(re.search(r"base_angle_deg = ([\d.]+)", text).group(1)), 70, delta=0.6)
        self.assertIn("already", run(one, "--learn", "--known", listed, "--id", "boat", code=1).stderr)

    def test_colours_are_measured_and_kept_in_the_view(self):
        one = self.folder / "shown"
        run("--synth", one, "--frames", 3, "--triangles", 1, "--still")
        before = (one / "view.toml").read_text()
        answer = json.loads(run(one, "--view", one / "view.toml", "--colours", "--json").stdout)
        self.assertEqual(answer["frames"], 3)
        (table, triangle) = answer["table_rgb"], answer["triangle_rgb"]
        self.assertGreater(table[0], 2 * max(table[1:]))
        self.assertGreater(triangle[2], 2 * triangle[0])
        after = (one / "view.toml").read_text()
        self.assertTrue(after.startswith(before.rstrip()))
        self.assertIn("[colours]", after)
        run(one, "--known", one / "known.toml", "--view", one / "view.toml")
        empty = self.folder / "empty"
        run("--synth", empty, "--frames", 1, "--triangles", 0, "--still")
        told = run(empty, "--view", empty / "view.toml", "--colours", code=1).stderr
        self.assertIn("nothing on it is bluer", told)
        self.assertNotIn("[colours]", (empty / "view.toml").read_text())

    def test_damaged_picture_is_told_and_the_rest_tracked(self):
        damaged = self.folder / "damaged"
        damaged.mkdir()
        for number, file in enumerate(sorted(self.made.glob("frame*.jpg"))[:3]):
            data = file.read_bytes()
            (damaged / file.name).write_bytes(data[:2000] if number == 1 else data)
        done = run(damaged, "--known", self.made / "known.toml", "--view", self.made / "view.toml", "--json")
        self.assertIn("damaged or cut off", done.stderr)
        answer = json.loads(done.stdout)
        self.assertEqual((len(answer["frames"]), answer["damaged"]), (2, 1))

    def test_wrong_use_is_told(self):
        known = self.made / "known.toml"
        bad = self.folder / "bad.toml"
        bad.write_text("[[triangle]]\nid = \"a\"\nbase_angle_deg = 200\nheight_mm = 5\n")
        cases = [(["--known", known], 2, "SOURCE"), ([self.made], 2, "--known"),
                 ([self.made, "--known", bad], 1, "bad.toml:3:18"),
                 (["/dev/video98", "--known", known], 1, "no such camera"),
                 ([self.folder / "none.mp4", "--known", known], 1, "no such file"),
                 ([self.made, "--known", known, "--tuio", "localhost:x"], 1, "port"),
                 ([self.made, "--known", known, "--sheet", "x.pdf"], 2, "takes no SOURCE"),
                 (["--synth", self.folder / "s", "--sheet", "x.pdf"], 2, "one at a time"),
                 (["--synth", self.folder / "s", "--triangles", 900], 1, "find no place"),
                 ([self.made, "--known", known, "--view", bad], 1, "bad.toml")]
        for arguments, code, words in cases:
            self.assertIn(words, run(*arguments, code=code).stderr, arguments)

    def test_frame_sizes_from_one_pixel_up(self):
        tiny = self.folder / "tiny"
        run("--synth", tiny, "--frames", 1, "--triangles", 1, "--size", "1x1", "--quality", 0)
        answer = json.loads(run(tiny, "--known", self.made / "known.toml", "--table", "640x480", "--json").stdout)
        self.assertEqual(answer["frames"][0]["triangles"], [])

    def test_interrupt_ends_a_live_source_with_valid_json(self):
        process = subprocess.Popen(
            [PROGRAM, "track", "gst:videotestsrc is-live=true ! video/x-raw,width=320,height=240", "--known",
             str(self.made / "known.toml"), "--json"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        time.sleep(4)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 0, err)
        self.assertGreater(len(json.loads(out)["frames"]), 0)
        self.assertIn("the table is not red", err)


if __name__ == "__main__":
    unittest.main()
