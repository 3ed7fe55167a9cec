"""icome head: the movement of the view of a recorded motion of a head, judged by mathematics written here."""
import csv
import json
import math
import pathlib
import random
import unittest

from icome_program import ProgramTest, SHARED_MESHES
from png_pixels import pixels, write

CASCADE = pathlib.Path("/usr/share/opencv4/haarcascades/haarcascade_frontalface_default.xml")  # of opencv-data
SHARED_MOTION = SHARED_MESHES.parent / "motion"
MOVES = [(0.12, 1.5, 0.22, 0.5), (0.05, 3.0, 0.22, 0.1), (0.02, 1.0, 0.22, 0.1)]  # m, of table 5.4
TURNS = [(5, 0.5, 45, 0.1), (5, 0.8, 45, 0.1), (5, 0.2, 45, 0.1)]  # degrees


def transferred(x, knees):
    knee1, slope1, knee2, slope2 = knees
    size = abs(x)
    if size < knee1:
        size = size * size / knee1
    elif size < knee2:
        size = knee1 + slope1 * (size - knee1)
    else:
        size = knee1 + slope1 * (knee2 - knee1) + slope2 * (size - knee2)
    return math.copysign(size, x)


# Quaternions are (x, y, z, w).

def product(a, b):
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz)


def inverse(q):
    return (-q[0], -q[1], -q[2], q[3])


def unit(q):
    size = math.sqrt(sum(part * part for part in q))
    return tuple(part / size for part in q)


def about(axis, angle):
    return tuple(math.sin(angle / 2) * (i == axis) for i in range(3)) + (math.cos(angle / 2),)


def turned(q, v):
    return product(product(q, (*v, 0.0)), inverse(q))[:3]


def mean_rotation(rotations):
    """The rotation with the least squared chordal distances to those near it: where the sum of w (x, y, z) of the
    differences is zero, as the squared distance is 8 - 8 w^2."""
    mean = rotations[-1]
    for _ in range(50):
        step = [0.0, 0.0, 0.0]
        for q in rotations:
            x, y, z, w = product(inverse(mean), q)
            for i, part in enumerate((x, y, z)):
                step[i] += 2.0 * w * part / len(rotations)
        mean = unit(product(mean, (step[0] / 2, step[1] / 2, step[2] / 2, 1.0)))
    return mean


def expected_view(samples):
    """The view's movement for each sample (place, quaternion)."""
    rest_place, rest_turn = samples[0]
    for i in range(len(samples)):
        last = samples[max(0, i - 4):i + 1]
        place = [sum(sample[0][k] for sample in last) / len(last) for k in range(3)]
        q = mean_rotation([sample[1] for sample in last])
        moves = turned(inverse(rest_turn), [place[k] - rest_place[k] for k in range(3)])
        x, y, z, w = product(inverse(rest_turn), q)
        # R = Ry(a) Rx(b) Rz(c), whose third column is (sin a cos b, -sin b, cos a cos b).
        b = math.asin(max(-1.0, min(1.0, 2 * (w * x - y * z))))
        a = math.atan2(2 * (x * z + w * y), 1 - 2 * (x * x + y * y))
        c = math.atan2(2 * (x * y + w * z), 1 - 2 * (x * x + z * z))
        turns = [math.radians(transferred(math.degrees(angle), knees)) for angle, knees in zip((b, a, c), TURNS)]
        yield ([transferred(move, knees) for move, knees in zip(moves, MOVES)],
               product(product(about(1, turns[1]), about(0, turns[0])), about(2, turns[2])))


class HeadTest(ProgramTest):
    def view(self, trace, *options):
        out = self.folder / "view.csv"
        self.succeeds("head", trace, "--out", out, *options)
        with out.open(newline="") as lines:
            return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(lines)]

    def judge(self, samples, rows):
        self.assertEqual(len(rows), len(samples))
        for row, (moves, turn) in zip(rows, expected_view(samples)):
            for key, move in zip("xyz", moves):
                self.assertAlmostEqual(row[key], move, delta=1e-9)
            same = abs(sum(a * b for a, b in zip(turn, (row["qx"], row["qy"], row["qz"], row["qw"]))))
            self.assertGreater(same, 1 - 1e-9)

    def test_the_first_pose_is_at_rest_and_others_follow_the_table(self):
        chance = random.Random(4)
        place, turn = (0.3, 1.2, -0.5), unit((0.1, 0.9, -0.2, 0.4))
        samples, way = [(place, turn)], [0.0] * 6
        for _ in range(400):
            way = [0.98 * part + chance.gauss(0.0, 0.02) for part in way]
            q = product(turn, product(product(about(1, 3 * way[4]), about(0, 3 * way[3])), about(2, 3 * way[5])))
            samples.append(([place[k] + way[k] for k in range(3)], q))
        rows = (f"{i / 60!r} {' '.join(map(repr, place))} {' '.join(map(repr, q))}"
                for i, (place, q) in enumerate(samples))
        trace = self.write("trace.txt", "# t x y z qx qy qz qw\n" + "\n".join(rows) + "\n")
        view = self.view(trace)
        self.assertEqual([view[0][key] for key in "xyz"], [0, 0, 0])
        self.assertEqual(view[0]["qw"], 1)
        self.judge(samples, view)

    def test_a_recorded_motion(self):
        trace = SHARED_MOTION / "handheld_freiburg1_xyz_6dof.txt"
        if not trace.exists():
            self.skipTest(f"the shared data is not here: {trace}")
        rows = [list(map(float, row.split())) for row in trace.read_text().splitlines() if not row.startswith("#")]
        self.judge([(row[1:4], unit(row[4:])) for row in rows], self.view(trace))
        report = json.loads(self.succeeds("head", trace, "--out", self.folder / "again.csv", "--json").stdout)
        self.assertEqual(report["samples"], 3000)
        self.assertAlmostEqual(report["seconds"], rows[-1][0] - rows[0][0])
        self.assertGreater(min(report["head"]["move_m"]), 0.05)

    def test_a_table_of_ones_own(self):
        trace = self.write("trace.csv", "t,x,y,z,qx,qy,qz,qw\n" +
                           "".join(f"{i},{0.3 * (i > 0)},0,0,0,0,0,1\n" for i in range(10)))
        self.assertAlmostEqual(self.view(trace)[-1]["x"], 0.31)
        table = self.folder / "mine.toml"
        table.write_text(self.succeeds("head", "--print-table").stdout)
        self.assertAlmostEqual(self.view(trace, "--table", table)[-1]["x"], 0.31)
        table.write_text("[move_x]\nslope1 = 1\nslope2 = 0\n")
        self.assertAlmostEqual(self.view(trace, "--table", table)[-1]["x"], 0.22)

    def test_without_a_filter_the_view_is_not_behind(self):
        rows = "".join(f"{i / 100!r} {0.2 + 0.002 * i!r} 0 0 0 0 0 1\n" for i in range(100))
        trace = self.write("walk.txt", "0 0 0 0 0 0 0 1\n" + rows)
        table = self.write("ones.toml", "[move_x]\nknee1_m = 0\nslope1 = 1\nslope2 = 1\n")
        last = 0.2 + 0.002 * 99
        self.assertAlmostEqual(self.view(trace, "--table", table, "--filter", "none")[-1]["x"], last)
        self.assertAlmostEqual(self.view(trace, "--table", table)[-1]["x"], last - 2 * 0.002)
        ahead = self.view(trace, "--table", table, "--predict-ms", "50")[-1]["x"]
        self.assertAlmostEqual(ahead, last - 2 * 0.002 + 0.05 * 0.2)
        steady = self.view(trace, "--table", table, "--filter", "one-euro")[-1]["x"]
        self.assertTrue(last - 0.02 < steady < last)

    def test_filters_are_compared(self):
        chance = random.Random(7)
        noise = 0.0003
        rows = []
        for i in range(3000):
            t = i / 100
            x = 0 if t < 20 else 0.1 * math.sin(2 * math.pi * 0.7 * (t - 20))
            rows.append(" ".join(repr(part) for part in (t, x + chance.gauss(0, noise), chance.gauss(0, noise),
                                                         chance.gauss(0, noise), 0, 0, 0, 1)))
        trace = self.write("sway.txt", "\n".join(rows))
        report = json.loads(self.succeeds("head", trace, "--compare", "--predict-ms", "20", "--json").stdout)
        self.assertEqual(report["samples"], 3000)
        scores = {(row["filter"], row["predict_ms"]): row for row in report["filters"]}
        self.assertEqual(set(scores), {(name, ms) for name in ("none", "mean", "one-euro") for ms in (0, 20)})
        none, mean = scores["none", 0], scores["mean", 0]
        self.assertAlmostEqual(none["jitter_mm"], 1000 * noise * math.sqrt(3), delta=0.06)
        self.assertAlmostEqual(mean["jitter_mm"], none["jitter_mm"] / math.sqrt(5), delta=0.04)
        self.assertAlmostEqual(mean["lag_move_ms"], 20, delta=1.5)
        self.assertAlmostEqual(scores["mean", 20]["lag_move_ms"], 0, delta=2.5)
        self.assertIsNone(mean["lag_turn_ms"])
        table = self.succeeds("head", trace, "--compare").stdout
        self.assertIn("one-euro", table)
        self.assertLessEqual(max(map(len, table.splitlines()[1:])), 100)
        self.fails("head", trace, "--compare", "--out", self.folder / "o.csv", code=2, saying="--out")
        self.fails("head", "--compare", code=2, saying="TRACE")
        self.fails("head", trace, "--compare", "--filter", "median", code=2, saying="median")

    def frames(self, name, places):
        """A folder of pictures of a green ball of 40 mm at places (x, y, z) in m of the user's axes, by a camera with a
        focal length of the picture's width."""
        folder = self.folder / name
        folder.mkdir()
        width, height = 320, 240
        for number, place in enumerate(places):
            rows = []
            for v in range(height):
                row = bytearray()
                for u in range(width):
                    inside = 0.0
                    if place:
                        x, y, z = place
                        radius = 0.02 / z * width
                        centre = width / 2 - x / z * width, height / 2 - y / z * width
                        gap = radius - math.dist((u + 0.5, v + 0.5), centre)
                        inside = min(1.0, max(0.0, gap + 0.5))
                    row += bytes(round((1 - inside) * grey + inside * green)
                                 for grey, green in zip((120, 115, 110), (20, 180, 40)))
                rows.append(bytes(row))
            write(folder / f"{number}.png", rows)
        return folder

    def test_a_camera_is_calibrated_and_tells_places(self):
        still = self.frames("still", [(0.0, 0.0, 0.6)] * 4)
        camera = self.folder / "camera.toml"
        marker = f"camera-marker:{still}?colour=#14b428&size=40"
        report = json.loads(self.succeeds("head", "--calibrate", marker, "--distance-m", "0.6", "--out", camera,
                                          "--json").stdout)
        self.assertEqual((report["pictures"], report["found"]), (4, 4))
        self.assertAlmostEqual(report["focal_widths"], 1.0, delta=0.02)
        places = [(0.0, 0.0, 0.6), (0.08, 0.0, 0.6), (-0.05, 0.06, 0.5), None, (0.1, -0.1, 0.8)]
        trace = self.folder / "trace.txt"
        told = self.succeeds("head", "--record", f"camera-marker:{self.frames('moves', places)}?calibration={camera}",
                             "--out", trace)
        self.assertIn("found in 4 of 5 pictures", told.stdout)
        rows = [list(map(float, row.split())) for row in trace.read_text().splitlines() if not row.startswith("#")]
        for row, place in zip(rows, filter(None, places)):
            for found, true, slack in zip(row[1:4], place, (0.003, 0.003, 0.03)):
                self.assertAlmostEqual(found, true, delta=slack)
        self.view(trace)  # it is a motion as any other

    def test_a_face_is_found(self):
        """The face of a scanned head, drawn by our own renderer, at places in a grey picture. Skipped where it is not
        there, or Debian's cascade is not."""
        mesh = SHARED_MESHES / "anatomy" / "face.obj"
        if not mesh.exists():
            self.skipTest(f"the shared data is not here: {mesh}")
        if not CASCADE.exists():
            self.skipTest("the package opencv-data is not installed")
        drawn = self.folder / "face.png"
        sizes = {}
        for side in (100, 160):
            self.succeeds("shot", mesh, drawn, "--up", "z", "--view", "front", "--size", f"{side}x{side}",
                          "--background", "#808080")
            sizes[side] = pixels(drawn)[2]
        folder = self.folder / "faces"
        folder.mkdir()
        places = [(60, 30, 100), (160, 30, 100), (60, 80, 100), (120, 50, 160)]
        for number, (left, top, side) in enumerate(places):
            rows = [bytearray(b"\x80\x80\x80" * 320) for _ in range(240)]
            for y, row in enumerate(sizes[side]):
                rows[top + y][3 * left:3 * (left + side)] = b"".join(bytes(pixel[:3]) for pixel in row)
            write(folder / f"{number}.png", [bytes(row) for row in rows])
        trace = self.folder / "faces.txt"
        report = json.loads(self.succeeds("head", "--record", f"camera:{folder}?field=60", "--out", trace,
                                          "--json").stdout)
        self.assertEqual((report["pictures"], report["found"]), (4, 4))
        first, right, low, near = (list(map(float, row.split()))[1:4] for row in trace.read_text().splitlines()[1:])
        # To the picture's right is to the user's left.
        metres = first[2] / (320 * 0.5 / math.tan(math.radians(30)))  # of a pixel at the face
        self.assertAlmostEqual(right[0] - first[0], -100 * metres, delta=4 * metres)
        self.assertAlmostEqual(right[1] - first[1], 0, delta=4 * metres)
        self.assertAlmostEqual(low[1] - first[1], -50 * metres, delta=4 * metres)
        self.assertAlmostEqual(near[2] / first[2], 100 / 160, delta=0.06)

    def test_cameras_that_cannot_be_used_are_told(self):
        out = self.folder / "camera.toml"
        self.fails("head", "--calibrate", "camera-marker:/no/such", "--out", out, code=1, saying="/no/such")
        self.fails("head", "--calibrate", "vrpn:Head", "--out", out, code=1, saying="camera-marker")
        self.fails("head", "--record", "camera-marker?colour=grey", "--out", out, code=1, saying="is no colour")
        empty = self.frames("empty", [None] * 3)
        self.fails("head", "--record", f"camera-marker:{empty}", "--out", out, code=1, saying="nothing was found")
        self.fails("head", "--calibrate", f"camera-marker:{empty}", "--out", out, code=1, saying="in 0 of 3 pictures")
        self.assertFalse(out.exists())
        self.fails("head", "--calibrate", "camera", code=2, saying="--out")

    def test_what_is_wrong_is_named_and_loses_nothing(self):
        out = self.write("view.csv", "mine")
        bad = self.write("bad.txt", "0 0 0 0 0 0 0 1\n1 0 0 nan 0 0 0 1\n")
        self.fails("head", bad, "--out", out, code=1, saying="bad.txt:2: nan is no finite number")
        self.fails("head", self.folder / "none.txt", "--out", out, code=1, saying="none.txt")
        good = self.write("good.txt", "0 0 0 0 0 0 0 1\n")
        table = self.write("table.toml", "[move_q]\n")
        self.fails("head", good, "--out", out, "--table", table, code=1, saying="table.toml:1:")
        self.fails("head", good, code=2, saying="--out")
        self.fails("head", good, "--out", good, code=1, saying="is the recording itself")
        self.assertEqual(good.read_text(), "0 0 0 0 0 0 0 1\n")
        self.fails("head", code=2, saying="TRACE")
        self.assertEqual(out.read_text(), "mine")


if __name__ == "__main__":
    unittest.main()
