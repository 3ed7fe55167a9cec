"""Models that move while they are touched, against closed forms in the trace."""
import math
import unittest

from icome_program import ProgramTest, distance, point

TICKS = 2000
STILL = (0.0, 0.0, 0.03)
RAMPED = 600  # ticks, after which forces are whole


class MotionTest(ProgramTest):
    def rest(self, place=STILL, ticks=TICKS):
        """A tip that rests there."""
        return self.path_file([place] * ticks)

    def touched(self, *arguments):
        """The trace of a tip at rest, and the report of the same with --check; nothing is passed."""
        report = self.report(*arguments, "--path", self.rest(), "--check")
        self.assertEqual([report[name] for name in ("pops", "sticks", "silent", "pulls")], [0, 0, 0, 0], arguments)
        return self.trace(*arguments, "--path", self.rest())

    def expect_no_kick(self, rows, most):
        for before, row in zip(rows[RAMPED:], rows[RAMPED + 1:]):
            self.assertLess(distance(point(before, "force"), point(row, "force")), most, row)

    def test_a_box_that_rises_and_falls_takes_the_contact_along(self):
        rows = self.touched("box:0.1x0.1x0.05", "--motion", "0:0,0,0.01*sin(5*t)", "--stiffness", 500)
        touching = 0
        for row in rows[1:]:
            top = 0.025 + 0.01 * math.sin(5.0 * row["t"])
            if top > STILL[2] + 2e-5:
                touching += 1
                self.assertLess(abs(row["scp_z"] - top), 2e-5, row)  # main says where it is every 10 ms
        self.assertGreater(touching, 500)
        self.expect_no_kick(rows, 0.4)  # where the touch begins, damping does: 6 N s/m at 50 mm/s

    def test_a_belt_drags_the_tip_by_friction(self):
        rows = self.touched("box:1x0.1x0.064", "--motion", "0:0.05*t,0,0", "--friction", "0.5,0.5", "--stiffness", 500)
        force = point(rows[-1], "force")
        self.assertGreater(force[0], 0.4 * force[2])
        self.assertGreater(force[2], 0.9)
        self.expect_no_kick(rows, 0.05)

    def test_a_turning_design_carries_its_effects(self):
        script = self.write("d.jsonl", '{"op": "effect", "name": "pull", "force": "point:0,0,0,50,0", '
                                       '"at": [0.04, 0, 0]}\n')
        design = self.folder / "d.icome"
        self.succeeds("edit", "new", "--apply", script, "--out", design)
        rows = self.trace(design, "--motion", "0:0,0,0,0,0,3*t", "--path", self.rest())
        for row in rows[RAMPED:]:
            angle = 3.0 * row["t"]
            held = (0.04 * math.cos(angle), 0.04 * math.sin(angle), 0.0)
            # The tip is on the axis about which the effect's frame turns: it does not move there.
            spring = [50.0 * (held[i] - STILL[i]) for i in range(3)]
            self.assertLess(distance(point(row, "force"), spring), 2e-3, row)
        self.expect_no_kick(rows, 0.02)

    def test_what_is_ill_written_is_refused(self):
        for motion, saying in (("0.1*t,0,0", "number of the MODEL"), ("1:t,0,0", "there is no MODEL 1"),
                               ("0:t,0", "not 2"), ("0:x,0,0", "formula 1 may use t alone"),
                               ("0:0,1/t,0", "formula 2 has no value at t = 0"), ("0:0,0,sin(", "formula 3")):
            self.fails("touch", "sphere:0.05", "--motion", motion, code=2, saying=saying)
        self.fails("touch", "sphere:0.05", "--motion", "0:t,0,0", "--motion", "0:0,t,0", code=2,
                   saying="MODEL 0 has another motion")


if __name__ == "__main__":
    unittest.main()
