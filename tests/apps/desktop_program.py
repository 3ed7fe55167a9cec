"""Runs the desktop on a display in memory, with a window manager, and gives it hands and eyes.

Nothing waits by the clock: each step waits until what it is for can be seen, for a minute and a half at most."""
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

from icome_program import PROGRAM
from screen_picture import Picture
from x_windows import Windows

PATIENCE = 90.0  # s, on a machine that is busy with other things
NEEDED = ("Xvfb", "openbox", "xdotool")


def wait_for(what, condition, patience=PATIENCE):
    """Asks until the answer is something true, and gives it."""
    end = time.monotonic() + patience
    while True:
        answer = condition()
        if answer:
            return answer
        if time.monotonic() > end:
            raise AssertionError(f"waited {patience:.0f} s in vain: {what}")
        time.sleep(0.05)


class Screen:
    """An X display in memory."""

    def __init__(self, width, height):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="icome-screen-"))
        read, write = os.pipe()
        self._server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", f"{width}x{height}x24", "-fbdir", str(self.folder),
             "-nolisten", "tcp", "-noreset"], pass_fds=(write,), stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as line:
            number = line.readline().strip()
        if not number:
            raise AssertionError("Xvfb did not start")
        self.display = ":" + number
        self.environment = dict(os.environ, DISPLAY=self.display)
        self.environment.pop("WAYLAND_DISPLAY", None)
        home = self.folder / "manager"
        home.mkdir()
        self._manager = subprocess.Popen(["openbox", "--sm-disable"], stderr=subprocess.DEVNULL,
                                         env=dict(self.environment, HOME=str(home)))
        wait_for("the window manager", lambda: self.ask("get_num_desktops", may_fail=True))
        self.windows = Windows(self.display)

    def close(self):
        self.windows.close()
        for process in (self._manager, self._server):
            process.terminate()
            process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def ask(self, *words, may_fail=False):
        done = subprocess.run(["xdotool", *map(str, words)], capture_output=True, text=True, env=self.environment)
        if done.returncode != 0 and not may_fail:
            raise AssertionError(f"xdotool {words}: {done.stderr}")
        return done.stdout.strip() if done.returncode == 0 else ""

    def picture(self):
        return Picture.of_xwd((self.folder / "Xvfb_screen0").read_bytes())


class MainThreadWatch(threading.Thread):
    """Sees how long the main thread of a process works without a pause: the most processor time, s, between two looks
    at which it had slept in between. Other work on the machine does not count."""

    def __init__(self, pid):
        super().__init__(daemon=True)
        self._task = pathlib.Path(f"/proc/{pid}/task/{pid}")
        self._over = threading.Event()
        self._since = None
        self.longest = 0.0
        self.start()

    def run(self):
        while not self._over.wait(0.01):
            try:
                sleeps = re.search(r"^voluntary_ctxt_switches:\s*(\d+)", (self._task / "status").read_text(), re.M)[1]
                fields = (self._task / "stat").read_text().rpartition(")")[2].split()
            except OSError:
                return
            busy = (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
            if self._since is None or self._since[0] != sleeps:
                self._since = (sleeps, busy)
            self.longest = max(self.longest, busy - self._since[1])

    def end(self):
        self._over.set()
        self.join()
        return self.longest


# Shaders are compiled once, not in each home: that takes a second of a processor each time.
SHADERS = os.environ.get("MESA_SHADER_CACHE_DIR") or os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache"


class Desktop:
    """The program with its window. Its home is a folder of the test's own, but for compiled shaders."""

    def __init__(self, screen, home, *arguments, environment=None, before=()):
        self.screen = screen
        mine = {"HOME": home, "XDG_CONFIG_HOME": home / "config", "XDG_DATA_HOME": home / "data",
                "XDG_CACHE_HOME": home / "cache", "XDG_STATE_HOME": home / "state", "XDG_RUNTIME_DIR": home / "run",
                "MESA_SHADER_CACHE_DIR": SHADERS, "LIBGL_ALWAYS_SOFTWARE": "1",
                "DBUS_SESSION_BUS_ADDRESS": "disabled:", "QT_QPA_PLATFORM": "xcb"}
        (home / "run").mkdir(parents=True, exist_ok=True, mode=0o700)
        self.log = home / "log.txt"
        with self.log.open("ab") as log:
            self.process = subprocess.Popen(
                [*before, PROGRAM, *map(str, arguments)], stdin=subprocess.DEVNULL, stdout=log, stderr=log,
                env={**screen.environment, **{k: str(v) for k, v in mine.items()}, **(environment or {})})
        self.window = None

    # Where things are.

    def printed(self):
        return self.log.read_text(errors="replace")

    def is_running(self):
        return self.process.poll() is None

    def check_running(self):
        if not self.is_running():
            raise AssertionError(f"the program ended with {self.process.returncode}: {self.printed()}")

    def find_window(self, title="ICOME"):
        """Waits for the window with that in its title."""
        def look():
            self.check_running()
            found = self.screen.ask("search", "--onlyvisible", "--name", title, may_fail=True)
            return found.split()[-1] if found else None
        return int(wait_for(f"a window called {title}", look))

    def open(self):
        self.window = self.find_window()
        self.screen.ask("windowactivate", "--sync", self.window)
        return self

    def title(self):
        return self.screen.ask("getwindowname", self.window, may_fail=True)

    def wait_title(self, pattern):
        """Waits for a title that the pattern fits; the design is there then."""
        def look():
            self.check_running()
            return re.search(pattern, self.title())
        return wait_for(f"a title like {pattern} (it is {self.title()!r})", look)

    def place(self):
        return self.screen.windows.place(self.window)

    def scene_place(self):
        """Where the scene is on the screen: the largest window within the window."""
        def look():
            self.check_running()
            windows = self.screen.windows
            inner = [windows.place(it) for it in windows.below(self.window)[1:]]
            inner = [it for it in inner if it and it[2] > 100 and it[3] > 100]
            return max(inner, key=lambda it: it[2] * it[3], default=None)
        return wait_for("the scene", look)

    def scene(self):
        return self.screen.picture().part(*self.scene_place())

    def whole(self):
        return self.screen.picture().part(*self.place())

    def wait_scene(self, what, condition):
        """Waits for a picture of the scene of which the condition holds, and gives the picture. The condition is
        asked of pictures only, and once of each: looking takes processor time from the program that draws."""
        last = None

        def look():
            nonlocal last
            picture = self.scene()
            if last and picture.planes == last.planes:
                return None
            last = picture
            return picture if condition(picture) else None
        return wait_for(what, look)

    def settled_scene(self):
        """The scene when it has not changed for so long that slow drawing cannot be why."""
        last = [self.scene(), time.monotonic()]

        def look():
            picture = self.scene()
            if picture.planes != last[0].planes:
                last[:] = [picture, time.monotonic()]
            return time.monotonic() - last[1] > 2.0 and picture
        return wait_for("a scene at rest", look)

    # Hands.

    def key(self, *keys):
        for key in keys:
            self.screen.ask("key", key)

    def type(self, text):
        self.screen.ask("type", "--delay", "5", "--", text)

    def command(self, words, look=None):
        """By its name in the palette; `look` is called when the words are there. Keys go to whatever window has the
        focus, so each step waits for the palette to have it, and to be gone."""
        title = "Find a Command"
        self.screen.ask("windowactivate", "--sync", self.window)
        self.key("ctrl+shift+p")
        self.screen.ask("windowactivate", "--sync", self.find_window(title))
        self.type(words)
        if look:
            look()
        self.key("Return")
        wait_for("the palette to close",
                 lambda: not self.screen.ask("search", "--onlyvisible", "--name", title, may_fail=True))

    def _at(self, place):
        left, top, _, _ = self.scene_place()
        return round(left + place[0]), round(top + place[1])

    def point(self, place):
        """Moves the mouse to a place in the scene."""
        self.screen.ask("mousemove", "--sync", *self._at(place))

    def press(self, place, button=1):
        self.screen.ask("mousemove", *self._at(place), "mousedown", button)

    def release(self, button=1):
        self.screen.ask("mouseup", button)

    def click(self, place, button=1):
        self.screen.ask("mousemove", *self._at(place), "click", button)

    def drag(self, begin, end, button=1, steps=8):
        self.press(begin, button)
        for i in range(1, steps + 1):
            self.screen.ask("mousemove", *self._at([a + (b - a) * i / steps for a, b in zip(begin, end)]))
        self.release(button)

    # How it ends.

    def quit(self):
        """As the cross in the title bar does."""
        self.screen.windows.ask_to_close(self.window)

    def wait_end(self, patience=PATIENCE):
        wait_for("the end of the program", lambda: not self.is_running(), patience)
        return self.process.returncode

    def kill(self):
        self.process.send_signal(signal.SIGKILL)
        self.process.wait()


class DesktopTest(unittest.TestCase):
    """Tests on one screen that they share, each with a folder of its own."""

    SIZE = (1280, 800)
    PICTURES = os.environ.get("ICOME_DESKTOP_PICTURES")  # a folder to keep screenshots in

    @classmethod
    def setUpClass(cls):
        missing = [it for it in NEEDED if shutil.which(it) is None]
        if missing:
            raise unittest.SkipTest(f"{', '.join(missing)} not there: tools/install-packages test")
        cls.screen = Screen(*cls.SIZE)

    @classmethod
    def tearDownClass(cls):
        cls.screen.close()

    def run(self, result=None):
        """Once more, on another screen, where it fails: keys and clicks of a hand that runs on a clock of its own now
        and then meet a window that a busy machine has stopped. What is wrong with the program fails twice."""
        tried = unittest.TestResult()
        super().run(tried)
        if tried.wasSuccessful() and not tried.skipped:
            result.startTest(self)
            result.addSuccess(self)
            result.stopTest(self)
            return result
        for _, what in tried.failures + tried.errors:
            print(f"{self.id()} failed and is tried once more:\n{what}", file=sys.stderr)
        if not tried.skipped:
            self.tearDownClass()
            self.setUpClass()
        return super().run(result)

    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="icome-", ignore_cleanup_errors=True)
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        self.home = self.folder / "home"
        self.home.mkdir()

    def start(self, *arguments, **options):
        desktop = Desktop(self.screen, self.home, *arguments, **options)
        self.addCleanup(self.clear_away, desktop)
        return desktop

    def small_disk(self, name, size):
        """A folder of the test's on a disk of its own, of a size such as "256k"."""
        disk = self.folder / name
        disk.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", disk],
                          stderr=subprocess.DEVNULL).returncode != 0:
            self.skipTest("only root can make a disk that is full soon")
        self.addCleanup(subprocess.run, ["umount", "-l", disk])
        return disk

    @staticmethod
    def fill(disk):
        """Fills it with a file; gives the file."""
        filler = disk / "filler"
        with filler.open("wb", buffering=0) as file:
            try:
                while file.write(b"\0" * 4096):
                    pass
            except OSError:
                pass
        return filler

    def clear_away(self, desktop):
        if desktop.is_running():
            self.keep(desktop, "last-of-" + self.id().rsplit(".", maxsplit=1)[-1])
            desktop.kill()

    def keep(self, desktop, name):
        """Keeps a screenshot for people to look at."""
        if self.PICTURES:
            pathlib.Path(self.PICTURES).mkdir(parents=True, exist_ok=True)
            desktop.screen.picture().save(pathlib.Path(self.PICTURES) / f"{name}.png")


# What the things of the demo design look like, in any light that it is seen in.

def is_clay(red, green, blue):
    return red > 150 and green < 0.74 * red and 0.4 * red < blue < 0.68 * red


def is_rubber(red, green, blue):
    return green > 55 and green > 1.6 * red and blue > 1.4 * red and blue < 1.25 * green


def is_water(red, green, blue):
    return blue > 90 and blue > 1.3 * green and blue > 2.2 * red


DEMO = pathlib.Path(__file__).resolve().parents[2] / "data" / "demo.wrl"
BANNER_MARKS = {"error": ((0xff, 0x6b, 0x61), (0xd1, 0x2f, 0x2a)), "news": ((0xff, 0x96, 0x2b), (0xd9, 0x6a, 0x00)),
                "warning": ((0xf2, 0xc1, 0x4b), (0xb0, 0x78, 0x00))}


def shows_banner(desktop, kind):
    """Is there a message of this kind above the scene? It has a coloured edge, in one of the themes' colours."""
    left, top, _, _ = desktop.scene_place()
    at = desktop.place()
    strip = desktop.screen.picture().part(left, at[1], 12, max(1, top - at[1]))
    return any(strip.longest_column(colour) >= 16 for colour in BANNER_MARKS[kind])
