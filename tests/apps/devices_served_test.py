"""Devices over the network and through fakes: `icome devices serve`, and the back-ends as a person would use them."""
import json
import os
import pathlib
import signal
import socket
import subprocess
import sys
import threading
import time
import unittest

from icome_program import PROGRAM, ProgramTest, run

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "devices" / "fakes"))
from vrpn_peer import Client, Server  # an independent speaker of VRPN, written from the facts

FAKES = pathlib.Path(PROGRAM).parent / "fakes"


class Serving:
    """`icome devices serve` on a free port, for as long as a `with` lasts."""

    def __init__(self, *arguments):
        self.process = subprocess.Popen([PROGRAM, "devices", "serve", "--vrpn", "127.0.0.1:0", "--json", *arguments],
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.said = json.loads(self.process.stdout.readline())
        self.host, port = self.said["listening"].rsplit(":", 1)
        self.port = int(port)

    def end(self, how=signal.SIGTERM):
        """Ends it as systemd or, by SIGINT, Ctrl-C would; gives the exit code."""
        self.process.send_signal(how)
        return self.process.wait(timeout=60)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.kill()
        self.process.communicate()


class ServedTest(ProgramTest):
    def test_it_says_where_it_listens_and_ends_when_asked(self):
        with Serving() as serving:
            self.assertEqual(set(serving.said), {"listening", "names"})
            self.assertEqual(serving.said["names"], ["Pointer0"])
            self.assertEqual(serving.end(), 0)
        with Serving() as serving:
            self.assertEqual(serving.end(signal.SIGINT), 0)

    def test_a_program_of_others_sees_the_hand_move(self):
        with Serving() as serving:
            client = Client(serving.host, serving.port, "Pointer0")
            self.addCleanup(client.close)
            first = client.wait_for("vrpn_Tracker Pos_Quat")
            client.wait_for("vrpn_Tracker Pos_Quat", lambda now: abs(now[2] - first[2]) > 0.001)

    def test_a_plane_of_others_stops_the_hand(self):
        with Serving() as serving:
            client = Client(serving.host, serving.port, "Pointer0")
            self.addCleanup(client.close)
            client.wait_for("vrpn_Tracker Pos_Quat")
            client.send_plane((0.0, 1.0, 0.0, 0.0), 0.3)
            client.wait_for("vrpn_ForceDevice Force", lambda force: force[1] > 0.1)

    def test_planes_of_others_push_as_strongly_as_they_say(self):
        """A normal that is not of length 1: the floor is at y = 0.008, and its spring 0.1 N/mm."""
        self.assertFelt(lambda client: client.send_plane((0.0, 2.0, 0.0, -0.016), 0.1),
                        lambda x, y, z: (0.0, 100.0 * max(0.0, 0.008 - y), 0.0))

    def test_fields_of_others_push_as_strongly_as_they_say(self):
        jacobian = (-20.0, 5.0, 0.0, 10.0, -30.0, 0.0, 15.0, 0.0, 0.0)
        self.assertFelt(lambda client: client.send_field((0.005, 0.0, 0.0), (0.1, 0.0, 0.05), jacobian, 1.0),
                        lambda x, y, z: (0.1 - 20.0 * (x - 0.005) + 5.0 * y, 10.0 * (x - 0.005) - 30.0 * y,
                                         0.05 + 15.0 * (x - 0.005)))

    def assertFelt(self, ask, expected):
        """Asks for a force; the one that is told behind each pose is the one that is expected there."""
        with Serving() as serving:
            client = Client(serving.host, serving.port, "Pointer0")
            self.addCleanup(client.close)
            ask(client)
            # All forces grow softly at first, and a change comes a little later than it was asked for.
            client.wait_for("vrpn_ForceDevice Force", lambda force: max(map(abs, force)) > 0.1)
            begin = time.monotonic()
            strongest = 0.0
            while time.monotonic() - begin < 4.5:  # a whole round
                position = client.wait_for("vrpn_Tracker Pos_Quat")[2:5]
                force = client.wait_for("vrpn_ForceDevice Force")
                if time.monotonic() - begin < 1.0:
                    continue
                for told, wanted in zip(force, expected(*position)):
                    self.assertAlmostEqual(told, wanted, delta=1e-4)
                strongest = max(strongest, *map(abs, force))
            self.assertGreater(strongest, 0.3)

    def test_several_devices_have_names_of_their_own(self):
        with Serving("--device", "simulated", "--device", "Touch") as serving:
            self.assertEqual(serving.said["names"], ["Pointer0", "Pointer1"])

    def test_one_icome_measures_the_device_of_another(self):
        """The hand goes round, which a test at rest must notice."""
        with Serving() as serving:
            result = run("devices", "test", f"vrpn:Pointer0@{serving.host}:{serving.port}", "--seconds", "2", "--json")
        self.assertEqual(result.returncode, 1)
        self.assertIn("hold it still", result.stderr)
        answer = json.loads(result.stdout)
        self.assertGreater(answer["readings"], 20)
        self.assertGreater(answer["moved_at_rest_mm"], 15.0)
        self.assertIsNone(answer["noise_um"])

    def test_a_server_of_others_is_touched_with(self):
        with Server("Tracker0") as server:
            server.pose((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))
            report = self.report("sphere:0.03", "--device", f"vrpn:Tracker0@127.0.0.1:{server.port}", "--seconds", "0.5")
        self.assertGreater(report["ticks"], 10)

    def test_who_touches_is_told_when_the_device_is_gone(self):
        with Serving() as serving:
            place = f"vrpn:Pointer0@{serving.host}:{serving.port}"
            with subprocess.Popen([PROGRAM, "touch", "box:0.2x0.2x0.2", "--hand-scale", "1", "--device", place,
                                   "--seconds", "8", "--json"],
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as touching:
                time.sleep(4)
                serving.end()
                answer, said = touching.communicate(timeout=120)
        self.assertEqual(touching.returncode, 1, said)
        self.assertIn("is lost", said)
        self.assertIn("was not there at the end", said)
        report = json.loads(answer)
        self.assertGreater(report["lost_ticks"], 100)
        self.assertLess(report["touch_fraction"], 0.99)

    def test_a_test_ends_when_the_device_is_gone(self):
        with Serving() as serving:
            place = f"vrpn:Pointer0@{serving.host}:{serving.port}"
            with subprocess.Popen([PROGRAM, "devices", "test", place, "--seconds", "60", "--json"],
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as testing:
                time.sleep(3)
                serving.end()
                answer, said = testing.communicate(timeout=60)
        self.assertEqual(testing.returncode, 1, said)
        self.assertIn("is lost", said)
        self.assertLess(json.loads(answer)["seconds"], 50)

    # An arm whose x points right, y away from the user and z up, and which counts in mm: its place (10, 20, 30) is
    # (0.010, 0.030, -0.020) m by ours, and a push upwards, by ours along y, is one along its z.
    ARM = "?axes=x,z,-y&scale=0.001&profile=touch&unit=1000&forces="

    def pushed(self, forces, kind):
        """What an arm of others, which stands still, is asked for by a test with forces up to 0.5 N."""
        with Server("Arm", forces=True) as server:
            stop = threading.Event()

            def stand():
                odd = False
                while not stop.wait(0.001):
                    odd = not odd  # no hand is quite still
                    server.pose((10.0 + 1e-6 * odd, 20.0, 30.0), (0.0, 0.0, 0.0, 1.0))

            arm = threading.Thread(target=stand)
            arm.start()
            try:
                self.succeeds("devices", "test", f"vrpn:Arm@127.0.0.1:{server.port}{self.ARM}{forces}", "--seconds", "0.5",
                              "--yes", "--json")
            finally:
                stop.set()
                arm.join()
            return [values for heard, values in server.heard if heard == kind]

    def test_planes_go_out_in_the_axes_and_unit_of_the_server(self):
        planes = [plane for plane in self.pushed("planes", "vrpn_ForceDevice Plane") if any(plane[:3])]
        self.assertTrue(planes)
        spring = 0.55  # N/mm: a Touch renders 550 N/m, and unit=1000 says what a spring of 1 is
        deepest = 0.0
        for x, y, z, offset, stiffness, *_ in planes:
            self.assertAlmostEqual(x, 0.0, places=6)
            self.assertAlmostEqual(y, 0.0, places=6)
            self.assertAlmostEqual(abs(z), 1.0, places=6)
            self.assertAlmostEqual(stiffness, spring, places=6)
            # The tip is at z = 30 mm; the plane lies so far before it that its spring gives the force.
            force = spring * (-offset - 30.0 * z)
            self.assertGreater(force, -1e-5)
            self.assertLess(force, 0.501)
            deepest = max(deepest, force)
        self.assertGreater(deepest, 0.05)

    def test_fields_go_out_in_the_axes_and_unit_of_the_server(self):
        fields = [field for field in self.pushed("fields", "vrpn_ForceDevice Force_Field") if any(field[3:6])]
        self.assertTrue(fields)
        for field in fields:
            for told, wanted in zip(field[:3], (10.0, 20.0, 30.0)):
                self.assertAlmostEqual(told, wanted, places=4)
            self.assertAlmostEqual(field[3], 0.0, places=6)
            self.assertAlmostEqual(field[4], 0.0, places=6)
            self.assertEqual(field[6:15], (0.0,) * 9)
            self.assertAlmostEqual(field[15], 20.0, places=4)  # 20 mm
        self.assertGreater(max(field[5] for field in fields), 0.05)
        self.assertLess(max(abs(field[5]) for field in fields), 0.501)

    def test_an_impossible_place_is_told(self):
        for place in ("nowhere", "127.0.0.1", "127.0.0.1:99999", "127.0.0.1:abc", ":3883", "::1:3883"):
            self.fails("devices", "serve", "--vrpn", place, code=2, saying="HOST:PORT")
        for place, saying in (("[::1]:3883", "IPv6"), ("192.0.2.1:0", "no such address")):
            self.fails("devices", "serve", "--vrpn", place, code=1, saying=saying)
        self.fails("devices", "serve", "--vrpn", "127.0.0.1:0", "--device", "nothing", code=1, saying="nothing")
        with Serving() as serving:
            self.fails("devices", "serve", "--vrpn", f"127.0.0.1:{serving.port}", code=1, saying=str(serving.port))


class FakeLibrariesTest(ProgramTest):
    """Libraries with the makers' interfaces and a physical model behind them; no real device is there."""

    def setUp(self):
        super().setUp()
        for name, library in (("ICOME_LIBHD", "libfake_hd.so"), ("ICOME_LIBDHD", "libfake_dhd.so")):
            os.environ[name] = str(FAKES / library)
            self.addCleanup(os.environ.pop, name)

    def test_they_are_listed_and_named_as_fakes(self):
        found = {it["backend"]: it for it in json.loads(self.succeeds("devices", "--json").stdout)["devices"]
                 if it["present"]}
        for back_end in ("openhaptics", "forcedimension"):
            self.assertIn("fake", found[back_end]["why"])

    def test_each_is_tested_and_touched_with(self):
        for name in ("hd", "dhd"):
            answer = json.loads(self.succeeds("devices", "test", name, "--seconds", "0.5", "--yes", "--json").stdout)
            self.assertGreater(answer["force"]["moved_mm"], 0.1)
            report = self.report("sphere:0.03", "--device", name, "--seconds", "1")
            self.assertGreater(report["touch_fraction"], 0.1, "the hand rests in the middle of the sphere")
            self.assertLessEqual(report["max_force_n"], 12.0 if name == "dhd" else 3.3)

    def test_a_library_that_is_none_is_told_with_its_path(self):
        os.environ["ICOME_LIBHD"] = str(self.write("libHD.so", "this is no library"))
        self.fails("devices", "test", "hd", code=1, saying="libHD.so")


class FakeServiceTest(ProgramTest):
    """A fake of Haply's Inverse Service, which is a program of its own."""

    def setUp(self):
        super().setUp()
        self.service = subprocess.Popen([pathlib.Path(PROGRAM).parent / "icome_fake_inverse_service"], text=True,
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.addCleanup(self.service.communicate)
        ports = json.loads(self.service.stdout.readline())
        for name, value in (("ICOME_HAPLY", f"127.0.0.1:{ports['port']}"),
                            ("ICOME_HAPLY_OPTIONS", f"events={ports['events_port']}")):
            os.environ[name] = value
            self.addCleanup(os.environ.pop, name)

    def test_it_is_listed(self):
        found = [it for it in json.loads(self.succeeds("devices", "--json").stdout)["devices"] if it["backend"] == "haply"]
        self.assertTrue(found[0]["present"])
        self.assertTrue(found[0]["name"].startswith("haply"))

    def test_it_is_tested_and_touched_with(self):
        answer = json.loads(self.succeeds("devices", "test", "haply", "--seconds", "0.5", "--yes", "--json").stdout)
        self.assertGreater(answer["force"]["moved_mm"], 0.1)
        self.service.stdin.write("aim 0 -0.14 0.2\n")
        self.service.stdin.flush()
        report = self.report("sphere:0.03", "--device", "haply", "--seconds", "1.5")
        self.assertGreater(report["touch_fraction"], 0.1)
        self.assertLessEqual(report["max_force_n"], 5.0 * 3 ** 0.5)

    def test_an_answer_without_end_is_left(self):
        """Whatever it is asked, this one goes on for ever."""
        def flood(connection):
            with connection:
                try:
                    connection.recv(1000)
                    connection.sendall(b"HTTP/1.1 200 OK\r\nContent-Length: 1099511627776\r\n\r\n")
                    while True:
                        connection.sendall(bytes(100_000))
                except OSError:
                    pass  # the other side has had enough

        def serve():
            try:
                while True:
                    threading.Thread(target=flood, args=(listener.accept()[0],), daemon=True).start()
            except OSError:
                pass  # the test is over

        listener = socket.create_server(("127.0.0.1", 0))
        self.addCleanup(listener.close)
        threading.Thread(target=serve, daemon=True).start()
        os.environ["ICOME_HAPLY"] = "127.0.0.1:" + str(listener.getsockname()[1])
        self.fails("devices", "test", "haply", code=1, saying="Inverse Service")

    def test_without_it_people_are_told_what_to_start(self):
        os.environ["ICOME_HAPLY"] = "127.0.0.1:9"
        self.fails("devices", "test", "haply", code=1, saying="Inverse Service")


if __name__ == "__main__":
    unittest.main()
