"""The trace: its columns, its rows, and that the same input gives the same bytes."""
import math
import unittest

from icome_program import BUNNY, ProgramTest, TRACE_HEADER, length, line, point


def without_times(text):
    return [row.rsplit(",", 1)[0] for row in text.splitlines()]


class TraceTest(ProgramTest):
    def circle(self, count=30000):
        """Round a sphere of 50 mm, wandering from 3 mm outside to 3 mm inside."""
        points = []
        for i in range(count):
            angle, radius = 0.002 * i, 0.05 + 0.003 * math.cos(0.001 * i)
            points.append((radius * math.cos(angle), radius * math.sin(angle), 0.002))
        return points

    def test_header_and_one_row_a_tick(self):
        path = self.path_file(self.circle(20000))
        rows = self.trace("sphere:0.05", "--path", path)
        text = (self.folder / "trace.csv").read_text()
        self.assertEqual(text.splitlines()[0], TRACE_HEADER)
        self.assertEqual(len(rows), 20000)  # more than the program takes down at a time

    def test_times_and_tips_are_those_of_the_path_to_the_last_bit(self):
        points = self.circle(500)
        rows = self.trace("sphere:0.05", "--path", self.path_file(points))
        self.assertEqual([row["t"] for row in rows], [i / 1000.0 for i in range(500)])
        self.assertEqual([point(row, "tip") for row in rows], points)

    def test_moving_surfaces_are_judged_by_the_time_of_the_tick_whenever_a_path_starts(self):
        def rows(start, z):
            return "".join(f"{start + i / 1000},{0.02 + 1e-5 * i},0.01,{z}\n" for i in range(600))

        waves, tide = "z - 0.005*sin(60*x + 6*t)", "z - 0.01*t"
        for formula in (waves, tide):
            for start in (-2.0, 7.5):
                for height in (-0.002, 0.003):
                    path = self.write("moving.csv", "t,x,y,z\n" + rows(start, height))
                    report = self.report("--implicit", formula, "--bounds", "0.2,0.2,0.1", "--path", path, "--check")
                    found = [report[name] for name in ("pops", "sticks", "silent", "pulls")]
                    self.assertEqual(found, [0, 0, 0, 0], (formula, start, height))

    def test_seconds_end_a_path_early(self):
        rows = self.trace("sphere:0.05", "--path", self.path_file(self.circle(500)), "--seconds", "0.2")
        self.assertEqual([row["t"] for row in rows], [i / 1000.0 for i in range(201)])

    def test_untouched_rows_have_the_tip_as_scp_no_force_and_no_object(self):
        rows = self.trace("sphere:0.05", "--path", self.path_file(self.circle()))
        free = [row for row in rows if row["touching"] == 0]
        self.assertTrue(free)
        for row in free:
            self.assertEqual(point(row, "scp"), point(row, "tip"))
            self.assertEqual(row["object"], -1)
        self.assertEqual(length(point(rows[0], "force")), 0.0)

    def test_touched_rows_name_the_object_by_its_place_on_the_command_line(self):
        path = self.path_file(line((0.0, 0.0, 0.06), (0.0, 0.0, 0.049), 200))
        first = self.trace("sphere:0.05", "box:0.01x0.01x0.01", "--path", path)
        second = self.trace("box:0.01x0.01x0.01", "sphere:0.05", "--path", path)
        self.assertEqual((first[-1]["touching"], first[-1]["object"]), (1, 0))
        self.assertEqual((second[-1]["touching"], second[-1]["object"]), (1, 1))

    def test_the_same_input_gives_the_same_bytes(self):
        models = [["sphere:0.05", "--friction", "0.4,0.3", "--radius", "0.002"]]
        if BUNNY.exists():
            models.append([BUNNY, "--up", "y", "--fit", "0.1", "--check"])
        path = self.path_file(self.circle())
        for model in models:
            traces = []
            for name in ("one.csv", "two.csv"):
                self.trace(*model, "--path", path, name=name)
                traces.append(without_times((self.folder / name).read_text()))
            self.assertEqual(traces[0], traces[1])

    def test_ticks_take_the_steps_of_the_path(self):
        # Forces grow with time, not with rows: the same time after the start gives the same force.
        def force_after_a_quarter_second(rate):
            count = int(0.01 * rate)
            points = line((0.0, 0.0, 0.051), (0.0, 0.0, 0.049), count) + [(0.0, 0.0, 0.049)] * int(0.25 * rate)
            row = self.trace("sphere:0.05", "--path", self.path_file(points, rate=rate))[int(0.25 * rate)]
            self.assertAlmostEqual(row["t"], 0.25)
            return row["force_z"]

        self.assertAlmostEqual(force_after_a_quarter_second(2000.0) / force_after_a_quarter_second(1000.0), 1.0,
                               delta=0.01)


if __name__ == "__main__":
    unittest.main()
