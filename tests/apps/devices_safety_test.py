"""What keeps hands safe, as a person would find it: a device that may not push, and readings that cannot be trusted."""
import json
import os
import pathlib
import subprocess
import sys
import threading
import time
import unittest

from icome_program import PROGRAM, ProgramTest, run

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "devices" / "fakes"))
from vrpn_peer import Server

BIN = pathlib.Path(PROGRAM).parent
SAFETY_STOP = ('event {"name":"device-safety-triggered","category":"device","level":"%s",'
               '"data":{"device_family":"inverse","device_id":"049D"},"message":"stall"}')


class SafetyTest(ProgramTest):
    def environment(self, **variables):
        for name, value in variables.items():
            os.environ[name] = str(value)
            self.addCleanup(os.environ.pop, name, None)


class InverseTest(SafetyTest):
    def setUp(self):
        super().setUp()
        self.service = subprocess.Popen([BIN / "icome_fake_inverse_service", "--device", "049D", "--device", "0ABC"],
                                        text=True, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.addCleanup(self.service.communicate)
        ports = json.loads(self.service.stdout.readline())
        self.environment(ICOME_HAPLY=f"127.0.0.1:{ports['port']}",
                         ICOME_HAPLY_OPTIONS=f"events={ports['events_port']} patience=20 connect=20")

    def tell(self, line):
        self.service.stdin.write(line + "\n")
        self.service.stdin.flush()

    def held(self):
        """The strength of the force that the motors hold, N."""
        self.tell("force")
        return sum(it * it for it in json.loads(self.service.stdout.readline())["held"]) ** 0.5

    def wait_until(self, condition, act=lambda: None):
        end = time.monotonic() + 60
        while not condition(self.held()):
            self.assertLess(time.monotonic(), end, "it never came")
            act()
            time.sleep(0.02)

    def push_into_box(self):
        """Out of the box and into it, until its wall is felt."""
        self.tell("aim 0 -0.14 0.24")
        time.sleep(0.3)
        self.tell("aim 0 -0.14 0.204")
        self.wait_until(lambda held: held > 0.5)

    def test_there_is_no_force_while_it_may_not_push_and_people_are_told_once(self):
        with subprocess.Popen([PROGRAM, "touch", "box:0.1x0.02x0.1", "--hand-scale", "1", "--device", "haply",
                               "--seconds", "240", "--json"], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True) as touching:
            self.push_into_box()
            for stop, go_on in (("status 1 0 1", "status 1 1 1"), ("status 0 1 1", "status 1 1 1"),
                                (SAFETY_STOP % "warning", SAFETY_STOP % "info")):
                # An event that comes before its channel is open is not heard.
                self.wait_until(lambda held: held == 0.0, lambda: self.tell(stop))
                time.sleep(0.5)
                self.assertEqual(self.held(), 0.0)
                self.tell(go_on)
                self.wait_until(lambda held: held > 0.5)
                time.sleep(3.5)  # until it has been told for long enough that it is over
            touching.send_signal(2)
            said = touching.communicate(timeout=60)[1]
        for words in ("No force: it has no power", "No force: it is not calibrated", "No force: its safety stop"):
            self.assertEqual(said.count(words), 1, said)
        self.assertEqual(said.count("It gives forces again"), 3, said)
        self.assertIn("icome: Haply Inverse3 049D: No force", said)
        self.assertNotIn("049D: Haply", said)

    def test_a_test_without_power_says_so(self):
        self.tell("status 1 0 1")
        result = run("devices", "test", "haply", "--yes", "--seconds", "0.5", "--json")
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("no power", result.stderr)
        answer = json.loads(result.stdout)
        self.assertIn("No force: it has no power", answer["condition"])
        self.assertIsNone(answer["force"])

    def test_a_loss_during_a_test_is_told_although_it_came_back(self):
        os.environ["ICOME_HAPLY_OPTIONS"] += " patience=0.5"
        with subprocess.Popen([PROGRAM, "devices", "test", "haply", "--seconds", "8", "--json"],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as testing:
            time.sleep(2.5)
            self.tell("plug out")
            time.sleep(1.0)
            self.tell("plug in")
            answer, said = testing.communicate(timeout=120)
        self.assertEqual(testing.returncode, 1, said)
        self.assertIn("it was lost and came back", said)
        self.assertGreater(json.loads(answer)["lost_ticks"], 0)

    def test_a_nearly_flat_motion_is_no_workspace(self):
        with subprocess.Popen([PROGRAM, "devices", "calibrate", "haply", "--seconds", "4"], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True,
                              env={**os.environ, "XDG_CONFIG_HOME": str(self.folder)}) as calibrating:
            for turn in range(200):
                side, end = (-1) ** (turn // 10), (-1) ** (turn // 20)
                self.tell(f"aim {0.04 * side} {-0.14 + 0.0005 * side} {0.2 + 0.04 * end}")
                time.sleep(0.02)
            said = calibrating.communicate(timeout=60)[1]
        self.assertEqual(calibrating.returncode, 1, said)
        self.assertIn("5 mm each are the least", said)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_one_device_is_never_opened_twice(self):
        for names in (("haply:049D", "haply:049d"), ("haply", "haply", "haply")):
            shared = [it for name in names for it in ("--device", name)]
            self.fails("devices", "serve", "--vrpn", "127.0.0.1:0", *shared, code=1,
                       saying="haply:049D is in use by this program already")


class LibraryTest(SafetyTest):
    def setUp(self):
        super().setUp()
        self.environment(ICOME_LIBHD=BIN / "fakes" / "libfake_hd.so", ICOME_LIBDHD=BIN / "fakes" / "libfake_dhd.so")

    def said_while_touching(self, name="hd", model="box:0.2x0.1x0.2", seconds="5"):
        result = run("touch", model, "--hand-scale", "1", "--device", name, "--seconds", seconds, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stderr

    def test_an_uncalibrated_device_does_not_push(self):
        self.environment(FAKE_HD_CALIBRATION="inkwell")
        result = run("devices", "test", "hd", "--yes", "--seconds", "0.5", "--json")
        self.assertEqual(result.returncode, 1)
        self.assertIn("put the stylus into the inkwell", result.stderr)
        self.assertIsNone(json.loads(result.stdout)["force"])

    def test_readings_that_make_no_sense_are_told(self):
        for fault in ("jump", "hostile"):
            self.environment(FAKE_HD_FAULT=fault)
            self.assertIn("Some of its readings make no sense", self.said_while_touching())

    def test_readings_that_stand_still_while_it_pushes_are_told(self):
        self.environment(FAKE_HD_FAULT="frozen", FAKE_HD_CIRCLE_MM="30")
        self.assertIn("No force: what it tells of its place stays the same", self.said_while_touching(model="sphere:0.03"))

    def test_a_test_that_is_moved_says_so(self):
        self.environment(FAKE_DHD_CIRCLE_MM="40")
        result = run("devices", "test", "dhd", "--seconds", "1", "--json")
        self.assertEqual(result.returncode, 1)
        self.assertIn("hold it still", result.stderr)
        self.assertIsNone(json.loads(result.stdout)["noise_um"])

    def test_a_flat_motion_is_no_workspace(self):
        self.environment(FAKE_DHD_CIRCLE_MM="40", XDG_CONFIG_HOME=self.folder)
        result = run("devices", "calibrate", "dhd", "--seconds", "2")
        self.assertEqual(result.returncode, 1)
        self.assertIn("no profile was written", result.stderr)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_an_impossible_profile_is_told_before_the_work(self):
        for variables in ({"HOME": "", "XDG_CONFIG_HOME": ""}, {"XDG_CONFIG_HOME": str(self.write("file", ""))}):
            begin = time.monotonic()
            result = run("devices", "calibrate", "dhd", "--seconds", "60", **variables)
            self.assertEqual(result.returncode, 1)
            self.assertIn("XDG_CONFIG_HOME", result.stderr)
            self.assertLess(time.monotonic() - begin, 50)
        begin = time.monotonic()
        self.fails("devices", "test", "dhd", "--seconds", "60", "--picture", "/nonexistent/x.png", code=1,
                   saying="/nonexistent/x.png")
        self.assertLess(time.monotonic() - begin, 50)

    def test_two_names_of_one_device_are_refused_by_name(self):
        for names, saying in ((("dhd", "dhd:0"), "dhd:0 is in use by this program already"),
                              (("hd", "hd:Left"), "if it is the one that this program uses as hd")):
            shared = [it for name in names for it in ("--device", name)]
            self.fails("devices", "serve", "--vrpn", "127.0.0.1:0", *shared, code=1, saying=saying)

    def test_what_cannot_be_opened_is_not_listed_as_there(self):
        self.environment(ICOME_HD_MODE="x", ICOME_DHD_AXES="x,x,x")
        why = {it["backend"]: it for it in json.loads(self.succeeds("devices", "--json").stdout)["devices"]}
        for backend, variable in (("openhaptics", "ICOME_HD_MODE"), ("forcedimension", "ICOME_DHD_AXES")):
            self.assertFalse(why[backend]["present"])
            self.assertIn(variable, why[backend]["why"])

    def test_a_missing_permission_names_the_rule(self):
        self.environment(FAKE_DHD_DEVICES="0")
        self.fails("devices", "test", "dhd", code=1, saying='ATTR{idVendor}=="1451"')
        self.environment(ICOME_LIBHD="/dev/null")
        self.fails("devices", "test", "hd", code=1, saying="ICOME_LIBHD is set to /dev/null")


class OthersTest(SafetyTest):
    def test_a_tracker_that_falls_silent_is_told(self):
        with Server("Arm", forces=True) as server:
            stop = threading.Event()

            def move_and_stop():
                begin = time.monotonic()
                while not stop.wait(0.002) and time.monotonic() - begin < 30:
                    if time.monotonic() - begin < 3:
                        server.pose((0.001 * (time.monotonic() % 1.0), 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))

            arm = threading.Thread(target=move_and_stop)
            arm.start()
            try:
                result = run("touch", "sphere:0.03", "--hand-scale", "1", "--device", f"vrpn:Arm@127.0.0.1:{server.port}",
                             "--seconds", "6", "--json")
            finally:
                stop.set()
                arm.join()
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stderr.count("it tells nothing new of its place"), 1, result.stderr)

    def test_a_run_touches_with_one_device(self):
        result = run("touch", "sphere:0.03", "--device", "haply", "--device", "dhd")
        self.assertEqual(result.returncode, 2)
        self.assertIn("a run touches with one device", result.stderr)

    def test_who_starts_a_server_is_not_left_waiting(self):
        with open("/dev/full", "w") as full:
            done = subprocess.run([PROGRAM, "devices", "serve", "--vrpn", "127.0.0.1:0", "--json"], stdout=full,
                                  stderr=subprocess.PIPE, text=True, timeout=60)
        self.assertEqual(done.returncode, 1)
        self.assertIn("standard output", done.stderr)


if __name__ == "__main__":
    unittest.main()
