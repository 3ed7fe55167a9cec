"""Motions that files bring: told, drawn at a moment, felt while they move, and kept by what is written."""
import json
import math
import unittest

from icome_program import ProgramTest, distance, point
from png_pixels import pixels

TICKS = 2000
STILL = (0.0, 0.03, 0.0)

LIFT = """#VRML V2.0 utf8
DEF lift Transform { translation 0 0 0 children [
  Shape { appearance Appearance { material Material {} } geometry Box { size 0.1 0.05 0.1 } } ] }
DEF clock TimeSensor { cycleInterval 2 loop TRUE }
DEF way PositionInterpolator { key [ 0 0.25 0.75 1 ] keyValue [ 0 0 0  0 0.01 0  0 -0.01 0  0 0 0 ] }
ROUTE clock.fraction_changed TO way.set_fraction
ROUTE way.value_changed TO lift.set_translation
"""

CAROUSEL = """#VRML V2.0 utf8
DEF carousel Transform { children Transform { translation 0.1 0 0 children [
  Shape { appearance Appearance { material Material {} } geometry Sphere { radius 0.04 } } ] } }
DEF clock TimeSensor { cycleInterval 4 loop TRUE }
DEF turn OrientationInterpolator { key [ 0 0.25 0.5 0.75 1 ]
  keyValue [ 0 1 0 0  0 1 0 1.5707963  0 1 0 3.1415927  0 1 0 4.712389  0 1 0 6.2831853 ] }
ROUTE clock.fraction_changed TO turn.set_fraction
ROUTE turn.value_changed TO carousel.set_rotation
"""


def lift_height(time):
    """Of the lift's middle, by its key frames."""
    keys = ((0.0, 0.0), (0.5, 0.01), (1.5, -0.01), (2.0, 0.0))
    time = math.fmod(time, 2.0)
    for (t0, y0), (t1, y1) in zip(keys, keys[1:]):
        if time <= t1:
            return y0 + (y1 - y0) * (time - t0) / (t1 - t0)
    return 0.0


class FileMotionsTest(ProgramTest):
    def motions(self, file):
        return json.loads(self.succeeds("info", file, "--json").stdout)["motions"]

    def rest(self, place=STILL):
        return self.path_file([place] * TICKS)

    def test_info_tells_what_moves(self):
        lift = self.write("lift.wrl", LIFT)
        self.assertEqual(self.motions(lift), {"count": 1, "objects": [
            {"object": "lift", "keys": 4, "seconds": 2.0, "loops": True}]})
        self.assertIn("moves, 2 s again and again", self.succeeds("info", lift).stdout)
        self.assertEqual(self.motions(self.write("still.wrl", "#VRML V2.0 utf8\nShape { geometry Box {} }\n")),
                         {"count": 0, "objects": []})

    def test_all_formats_that_know_motions_keep_them(self):
        told = self.motions(self.write("lift.wrl", LIFT))
        file = self.folder / "lift.wrl"
        for name in ("a.icome", "b.glb", "c.gltf", "d.wrl", "e.icome"):
            out = self.folder / name
            self.succeeds("convert", file, out)
            self.assertEqual(self.motions(out), told, name)
            file = out
        self.succeeds("convert", self.folder / "d.wrl", self.folder / "f.wrl")
        self.assertEqual((self.folder / "d.wrl").read_bytes(), (self.folder / "f.wrl").read_bytes())

    def test_a_clone_moves_as_its_model_does(self):
        lift = self.write("lift.wrl", LIFT)
        script = self.write("a.jsonl", '{"op": "clone", "object": "lift", "name": "second"}\n{"op": "undo"}\n'
                                       '{"op": "redo"}\n')
        out = self.folder / "two.wrl"
        self.succeeds("edit", lift, "--apply", script, "--out", out)
        self.assertEqual([it["object"] for it in self.motions(out)["objects"]], ["lift", "second"])

    def test_a_lift_takes_the_contact_along(self):
        lift = self.write("lift.wrl", LIFT)
        told = self.report(lift, "--path", self.rest(), "--check")
        self.assertEqual([told[name] for name in ("pops", "sticks", "silent", "pulls")], [0, 0, 0, 0])
        rows = self.trace(lift, "--path", self.rest(), "--stiffness", 500)
        touching = 0
        for row in rows[1:]:
            top = 0.025 + lift_height(row["t"])
            if top > STILL[1] + 2e-5:
                touching += 1
                self.assertLess(abs(row["scp_y"] - top), 3e-4, row)  # main says every 10 ms where it is
        self.assertGreater(touching, 300)
        still = self.trace(lift, "--path", self.rest(), "--still")
        self.assertFalse(any(row["touching"] for row in still))

    def test_what_turns_in_a_group_is_felt_where_it_is(self):
        file = self.write("carousel.wrl", CAROUSEL)
        rows = self.trace(file, "--path", self.rest((0.0, 0.0, -0.065)), "--stiffness", 500)
        for row in rows[1:]:
            angle = 0.5 * math.pi * row["t"]
            middle = (0.1 * math.cos(angle), 0.0, -0.1 * math.sin(angle))
            depth = 0.04 - distance(middle, (0.0, 0.0, -0.065))
            if depth > 1e-3:
                self.assertEqual(row["touching"], 1.0, row)
                self.assertLess(abs(distance(point(row, "scp"), middle) - 0.04), 3e-4, row)
            elif depth < -1e-3:
                self.assertEqual(row["touching"], 0.0, row)
        self.assertTrue(any(row["touching"] for row in rows))

    def test_a_motion_of_the_command_line_carries_those_of_the_file(self):
        lift = self.write("lift.wrl", LIFT)
        rows = self.trace(lift, "--motion", "0:0,0.002*t,0", "--path", self.rest(), "--stiffness", 500)
        for row in rows[1:]:
            top = 0.025 + lift_height(row["t"]) + 0.002 * row["t"]
            if top > STILL[1] + 3e-4:
                self.assertLess(abs(row["scp_y"] - top), 3e-4, row)

    def test_a_shot_shows_a_moment(self):
        file = self.write("carousel.wrl", CAROUSEL)
        middles = {}
        for time in (None, 0.0, 1.0, 2.0):
            out = self.folder / f"{time}.png"
            moment = () if time is None else ("--time", time)
            # The viewpoint looks down on a wide square, so that the picture stays where it is.
            view = self.write("seen.wrl", CAROUSEL + "Viewpoint { position 0 1 0 orientation 1 0 0 -1.5707963 }\n")
            self.succeeds("shot", view, out, "--size", "80x80", "--background", "black", *moment)
            middles[time] = self.middle(out)
        self.assertLess(distance(middles[None], middles[0.0]), 0.5)
        self.assertGreater(middles[0.0][0], 42.0)       # on the right
        self.assertLess(middles[1.0][1], 38.0)          # a quarter of a turn on, at the back, which is above
        self.assertLess(abs(middles[1.0][0] - 39.5), 1.5)
        self.assertLess(middles[2.0][0], 38.0)
        self.fails("shot", file, self.folder / "a.png", "--time", "-1", code=2, saying="--time")

    def middle(self, file):
        """Of the pixels that are not black, from the upper left."""
        seen = [(x, y) for y, row in enumerate(pixels(file)[2]) for x, pixel in enumerate(row) if max(pixel[:3]) > 40]
        self.assertGreater(len(seen), 5)
        return tuple(sum(it[i] for it in seen) / len(seen) for i in (0, 1))


if __name__ == "__main__":
    unittest.main()
