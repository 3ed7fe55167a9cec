"""Effects and textures that the command line switches on, against closed forms in the trace."""
import math
import unittest

from icome_program import ProgramTest, distance, length, line, point

FAR = "sphere:0.001"  # a model that none of the paths below comes near
START = (0.05, 0.02, 0.03)
AWAY = (0.07, -0.01, 0.06)
RAMPED = 600  # ticks, after which forces are whole
LEAST_DAMPING = 2.0 * 100.0 * 0.001  # N s/m, 2 K dt: what a spring of 100 N/m gets at 1 kHz where less is asked for


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def scaled(a, factor):
    return tuple(factor * x for x in a)


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


class EffectsTest(ProgramTest):
    def slow_path(self, start=START, end=AWAY):
        """Rests until forces have grown, then goes at 50 mm/s."""
        return [start] * RAMPED + line(start, end, int(distance(start, end) / 0.05 * 1000))

    def expect_forces(self, effect, expected, points=None, tolerance=1e-9):
        """The trace's force after the ramp is expected(tip, velocity, time); velocity is the path's own."""
        rows = self.trace(FAR, "--device", "omega.x", "--path", self.path_file(points or self.slow_path()), "--effect",
                          effect)
        felt = 0.0
        for before, row in zip(rows[RAMPED:], rows[RAMPED + 1:]):
            tip = point(row, "tip")
            velocity = scaled(minus(tip, point(before, "tip")), 1000.0)
            force = point(row, "force")
            felt = max(felt, length(force))
            self.assertLess(distance(force, expected(tip, velocity, row["t"])), tolerance, (effect, row))
        self.assertGreater(felt, 0.02, effect)

    def test_what_effects_push_is_no_fault_of_the_contact(self):
        path = self.path_file(line((0, 0, 0.06), (0, 0, 0.048), 400) + [(0, 0, 0.048)] * 400)
        for options in (["--effect", "constant:0,0,-5"], ["--effect", "point:0,0,0,100"],
                        ["--texture", "bumps:0.009,0.02"]):
            report = self.report("sphere:0.05", "--path", path, "--check", *options)
            counted = {name: report[name] for name in ("pops", "sticks", "silent", "pulls")}
            self.assertEqual(set(counted.values()), {0}, (options, counted))

    def test_what_no_tick_could_feel_is_refused(self):
        curve = "curve:" + ";".join(f"0,0,{0.001 * i}" for i in range(1001))
        field = "field:" + "+".join(f"sin({i}*x)" for i in range(1, 500)) + ",0,0"
        for effect, reason in ((curve, "1001 points; 1000 are the most"), (field, "1000 are the most")):
            self.fails("touch", FAR, "--effect", effect, code=2, saying=reason)

    def test_point_spring(self):
        self.expect_forces("point:0.05,0.02,0.04,100,0",
                           lambda tip, v, t: minus(scaled(minus((0.05, 0.02, 0.04), tip), 100.0),
                                                   scaled(v, LEAST_DAMPING)), tolerance=1e-6)

    def test_line_spring_leaves_the_line_free(self):
        def expected(tip, velocity, t):
            force = minus(scaled(minus((0.05, 0.02, 0.04), tip), 100.0), scaled(velocity, LEAST_DAMPING))
            along = (0.6, 0.8, 0.0)
            return minus(force, scaled(along, dot(force, along)))
        self.expect_forces("line:0.05,0.02,0.04,3,4,0,100,0", expected, tolerance=1e-6)

    def test_plane_spring_holds_across_and_damps_across(self):
        # 2 K dt of damping at least: 0.2 N s/m here, which 3 exceeds.
        self.expect_forces("plane:0,0,0.04,0,0,2,100,3",
                           lambda tip, v, t: (0.0, 0.0, 100.0 * (0.04 - tip[2]) - 3.0 * v[2]), tolerance=1e-6)

    def test_curve_spring_holds_at_the_nearest_point_of_all_segments(self):
        corners = [(0.05, 0.0, 0.03), (0.05, 0.05, 0.03), (0.08, 0.05, 0.06)]

        def nearest(tip):
            best = corners[0]
            for a, b in zip(corners, corners[1:]):
                for i in range(201):  # by sampling, independent of the program's projection
                    candidate = tuple(x + (y - x) * i / 200.0 for x, y in zip(a, b))
                    if distance(candidate, tip) < distance(best, tip):
                        best = candidate
            return best
        text = ";".join(",".join(map(str, corner)) for corner in corners)
        # Samples lie 0.25 mm apart: at most half of that off along the curve. Damping is 10 mN here.
        self.expect_forces(f"curve:{text};100,0", lambda tip, v, t: scaled(minus(nearest(tip), tip), 100.0),
                           tolerance=100.0 * 0.5 * 2.5e-4 + 0.01)

    def test_viscous(self):
        self.expect_forces("viscous:2", lambda tip, v, t: scaled(v, -2.0), tolerance=1e-6)

    def test_dry_friction_slides_against_the_way(self):
        points = [START] * RAMPED + line(START, AWAY, 2000)
        rows = self.trace(FAR, "--device", "omega.x", "--path", self.path_file(points), "--effect", "friction:0.5,0.4")
        way = minus(AWAY, START)
        sliding = rows[-500:]  # 0.4 mm of the anchor's spring are long stretched
        for row in sliding:
            self.assertLess(distance(point(row, "force"), scaled(way, -0.4 / length(way))), 1e-6)
        self.assertAlmostEqual(max(length(point(row, "force")) for row in rows), 0.5, delta=0.02)

    def test_inertia_resists_acceleration(self):
        # 0.02 sin(10 t) along x, after resting: slow against the low-pass at 50 Hz, so F is near -m a.
        points = [(0.05, 0.0, 0.03)] * RAMPED + [(0.05 + 0.02 * math.sin(0.01 * i) ** 2, 0.0, 0.03) for i in range(1500)]
        rows = self.trace(FAR, "--device", "omega.x", "--path", self.path_file(points), "--effect", "inertia:0.1")
        for i in range(200, 1400):
            acceleration = 0.02 * 2.0 * 100.0 * math.cos(0.02 * i)
            self.assertAlmostEqual(rows[RAMPED + i]["force_x"], -0.1 * acceleration, delta=0.06)
        self.assertGreater(max(abs(row["force_x"]) for row in rows), 0.35)

    def test_well_pulls_most_with_the_force_that_was_named(self):
        def expected(tip, velocity, t):
            off = minus((0.05, 0.02, 0.03), tip)
            r = length(off)
            k = 1.5 * 25.0 * math.sqrt(5.0) / (16.0 * 0.02)
            return scaled(off, k * (1.0 - (r / 0.02) ** 2) ** 2) if r < 0.02 else (0.0, 0.0, 0.0)
        points = [START] * RAMPED + line(START, (0.05, 0.02, 0.06), 600)
        self.expect_forces("well:0.05,0.02,0.03,0.02,1.5", expected, points, tolerance=0.05)
        rows = self.trace(FAR, "--device", "omega.x", "--path", self.path_file(points), "--effect",
                          "well:0.05,0.02,0.03,0.02,1.5")
        self.assertAlmostEqual(max(length(point(row, "force")) for row in rows), 1.5, delta=0.03)

    def test_recess_pushes_inwards_between_floor_and_rim(self):
        def expected(tip, velocity, t):
            r = math.hypot(tip[0], tip[1])
            inside = 0.01 < r < 0.02
            push = math.sin(math.pi * (r - 0.01) / 0.01) ** 2 if inside else 0.0
            return (-push * tip[0] / r, -push * tip[1] / r, 0.0)
        start, end = (0.005, 0.001, 0.03), (0.03, 0.006, 0.05)
        points = [start] * RAMPED + line(start, end, 800)
        self.expect_forces("recess:0,0,0,0,0,3,0.01,0.02,1", expected, points, tolerance=0.05)

    def test_constant(self):
        self.expect_forces("constant:0.3,0,-0.5", lambda tip, v, t: (0.3, 0.0, -0.5))

    def test_field_of_place_and_time(self):
        self.expect_forces("field:-5*y,min(5*x,0.2),0.2*sin(6*t)",
                           lambda tip, v, t: (-5.0 * tip[1], min(5.0 * tip[0], 0.2), 0.2 * math.sin(6.0 * t)))

    def test_effects_add_up_and_are_reported(self):
        effects = ["--effect", "constant:0.3,0,0", "--effect", "constant:0,0,-0.5"]
        path = self.path_file([START] * 700)
        rows = self.trace(FAR, "--device", "omega.x", "--path", path, *effects)
        self.assertLess(distance(point(rows[-1], "force"), (0.3, 0.0, -0.5)), 1e-9)
        report = self.report(FAR, "--path", path, *effects)
        self.assertEqual(report["effects"], ["constant:0.3,0,0", "constant:0,0,-0.5"])
        self.assertIsNone(report["texture"])
        self.assertIn("constant:0,0,-0.5", self.succeeds("touch", FAR, "--path", path, *effects).stdout)

    def test_ridges_have_the_depth_and_spacing_that_were_named(self):
        # Pressed 2 mm into the plane: K (d + h) upwards, tilted by the slope, as on a height field.
        depth, spacing, stiffness = 0.0005, 0.004, 500.0
        at = [(0.00001 * i, 0.0, -0.002) for i in range(1200)]
        points = line((0.0, 0.0, 0.001), (0.0, 0.0, -0.002), 200) + [(0.0, 0.0, -0.002)] * RAMPED + at
        rows = self.trace("plane", "--device", "omega.x", "--stiffness", stiffness, "--path", self.path_file(points),
                          "--texture", f"ridges:{depth},{spacing}")[-len(at) + 5:]
        for row in rows:
            phase = 2.0 * math.pi * row["tip_x"] / spacing
            pressed = stiffness * (0.002 + 0.5 * depth * (math.cos(phase) - 1.0))
            slope = -0.5 * depth * 2.0 * math.pi / spacing * math.sin(phase)
            self.assertAlmostEqual(row["force_z"], pressed, delta=0.02)
            self.assertAlmostEqual(row["force_x"], -pressed * slope, delta=0.02)

    def test_what_is_capped_is_told(self):
        path = self.path_file([START] * 10)
        device = ["--device", "omega.x", "--path", path]  # 100 g: K dt^2/m <= 0.1 at 1 kHz is 10 kN/m
        self.assertEqual(self.report(FAR, *device, "--stiffness", 5000, "--effect", "point:0,0,0,4000")["capped"], [])
        done = self.succeeds("touch", FAR, *device, "--stiffness", 20000)
        self.assertIn("stiffness 20000 N/m is felt as 10000 N/m, the most that is stable on this device at 1000 Hz",
                      done.stderr)

    def test_surface_and_effects_share_what_is_stable(self):
        # Surface, spring and damper could each alone take all of the device: each gets a third.
        path = self.path_file([START] * 10)
        report = self.report(FAR, "--device", "omega.x", "--path", path, "--stiffness", 20000,
                             "--effect", "point:0,0,0,50000", "--effect", "viscous:60")
        self.assertEqual(len(report["capped"]), 3)
        self.assertIn("stiffness 20000 N/m is felt as 3333.33 N/m", report["capped"][0])
        self.assertIn("effect point:0,0,0,50000: stiffness 50000 N/m is felt as 3333.33 N/m", report["capped"][1])
        self.assertIn("damping 60 N s/m is felt as 16.6667 N s/m", report["capped"][2])

    def test_many_capped_effects_are_told_in_few_lines(self):
        path = self.path_file([START] * 10)
        effects = [text for i in range(100) for text in ("--effect", f"point:0,0,{0.001 * i:g},50000")]
        done = self.succeeds("touch", FAR, "--device", "omega.x", "--path", path, *effects)
        self.assertLessEqual(done.stderr.count("\n"), 6)
        self.assertIn("96 more are felt softer", done.stderr)
        self.assertEqual(len(self.report(FAR, "--device", "omega.x", "--path", path, *effects)["capped"]), 101)

    def test_eight_dampers_do_not_rattle(self):
        # To and fro at 1 Hz with a hand that is read in steps of 20 um: what the dampers do is -B v with the sum of
        # what is stable, 50 N s/m on 100 g, and never more than that of the fastest step.
        points = [tuple(round(x / 2e-5) * 2e-5 for x in (0.05 + 0.02 * math.sin(0.002 * math.pi * i), 0.0, 0.03))
                  for i in range(2000)]
        rows = self.trace(FAR, "--device", "omega.x", "--path", self.path_file([points[0]] * RAMPED + points),
                          *["--effect", "viscous:50"] * 8)
        for before, row in zip(rows[RAMPED:], rows[RAMPED + 1:]):
            speed = (row["tip_x"] - before["tip_x"]) * 1000.0
            self.assertLess(abs(row["force_x"]), 50.0 * abs(speed) + 1e-6)

    def test_a_direction_turns_the_ridges(self):
        points = line((0.0, 0.0, 0.001), (0.0, 0.0, -0.002), 200) + [(0.0, 0.0, -0.002)] * RAMPED
        points += [(0.00001 * i, 0.0, -0.002) for i in range(500)]
        path = self.path_file(points)
        across = self.trace("plane", "--path", path, "--texture", "ridges:0.0005,0.002")
        along = self.trace("plane", "--path", path, "--texture", "ridges:0.0005,0.002,0,1,0")
        self.assertGreater(max(abs(row["force_x"]) for row in across), 0.1)
        self.assertLess(max(abs(row["force_x"]) for row in along), 1e-9)

    def test_combinations_give_a_force_that_the_device_can_give(self):
        well, recess = "well:0.05,0.02,0.03,0.02,1.5", "recess:0.05,0.02,0.03,0,0,1,0.0005,0.01,1"
        push = self.path_file([START] * RAMPED + line(START, (0.052, 0.02, 0.03), 100))
        ridged = ["box:0.2x0.2x0.06", "--texture", "ridges:0.0005,0.002", "--motion", "0:0.01*sin(3*t),0,0"]
        for model, effects in (([FAR], [well, recess]), (ridged, [well, recess]), (ridged, ["viscous:2", well]),
                               ([FAR], ["inertia:5", "point:0.05,0.02,0.03,1e6", "viscous:1000"]),
                               ([FAR], ["friction:0.5,0.4", "viscous:5", "inertia:0.5"]),
                               ([FAR], ["point:1e6,0,0,1e6"]), ([FAR], ["curve:0,0,0;0,0,0", well]),
                               ([FAR], ["constant:1000,0,0", "constant:-1000,0,0", "viscous:2"]),
                               ([FAR], ["field:1/(x-0.05),0,0", "constant:0.1,0,0"]),
                               ([FAR], ["point:0.05,0.02,0.03"] * 1000)):
            options = [option for text in effects for option in ("--effect", text)]
            rows = self.trace(*model, "--device", "omega.x", "--path", push, *options)
            lengths = [length(point(row, "force")) for row in rows]
            self.assertTrue(all(math.isfinite(it) for it in lengths), effects[:3])
            self.assertLessEqual(max(lengths), 12.0, effects[:3])  # an omega.x's peak
            self.assertGreater(max(lengths), 0.01, effects[:3])

    def test_the_help_lists_every_effect_and_its_examples_work(self):
        text = self.succeeds("touch", "--help").stdout
        examples = [row.split("such as ")[1] for row in text.splitlines() if "      such as " in row]
        kinds = {example.split(":")[0] for example in examples}
        self.assertEqual(kinds, {"point", "line", "plane", "curve", "viscous", "friction", "inertia", "well", "recess",
                                 "constant", "field"})
        path = self.path_file([START] * 10)
        for example in examples:
            self.report(FAR, "--path", path, "--effect", example)

    def test_what_is_wrong_is_named_with_its_place(self):
        for effect, saying in [("well:0,0,x,0.01,1.5", "number 3 (Z m) is \"x\""),
                               ("well:0,0,0.05,0.01", "number 5 (FORCE) is missing"),
                               ("viscous:-1", "number 1 (DAMPING) is -1"),
                               ("viscous:nan", "number 1 (DAMPING N s/m) is \"nan\""),
                               ("viscous:1,2", "not 2"),
                               ("viscous", "number 1 (DAMPING) is missing"),
                               ("", "no effect \"\""),
                               ("magnet:1", "no effect \"magnet\""),
                               ("constant:inf,0,0", "number 1 (FX N) is \"inf\""),
                               ("point:1e400,0,0", "number 1 (X m) is \"1e400\""),
                               ("well:0,0,0,0,1", "number 4 (RADIUS) is 0"),
                               ("well:0,0,0,0.01,-1", "number 5 (FORCE) is -1"),
                               ("recess:0,0,0,0,0,1,0.01,0.01,1", "RIM"),
                               ("field:1/0,0,0", "formula 1"),
                               ("line:0,0,0,0,0,0", "numbers 4 to 6"),
                               ("friction:0.3,0.4", "STATIC"),
                               ("recess:0,0,0,0,0,1,0.02,0.01,1", "RIM"),
                               ("curve:0,0,0;1,2,x", "point 2: number 3 (Z m)"),
                               ("curve:0,0,0", "it has one point"),
                               ("curve:0,0,0;300,2", "it has one point"),
                               ("field:x,y", "three formulas"),
                               ("field:x,y,z+", "formula 3"),
                               ("wel:1", "did you mean 'well'?"),
                               ("x" * 5000, "x" * 60 + "...")]:
            done = self.fails("touch", FAR, "--effect", "viscous:1", "--effect", effect, code=2, saying=saying)
            self.assertIn(f'--effect "{effect[:60]}', done.stderr)
            self.assertLess(len(done.stderr), 1000)
            self.assertNotIn("?.", done.stderr)
        for texture, saying in [("ridges:1", "number 1 (DEPTH) is 1"), ("ridges:0.002,0.002", "SPACING"),
                                ("ridges:0.0005,0.002,0,0,0", "direction"), ("sand", "no texture \"sand\"")]:
            self.fails("touch", FAR, "--texture", texture, code=2, saying=saying)


if __name__ == "__main__":
    unittest.main()
