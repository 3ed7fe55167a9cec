"""icome listen at a microphone: a sink of PulseAudio that plays to nobody is one."""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

PROGRAM = os.environ["ICOME_PROGRAM"]
NEEDED = ("pulseaudio", "pactl", "paplay", "espeak-ng")
PATIENCE = 120  # s


def wait_for(what, condition):
    end = time.monotonic() + PATIENCE
    while not (answer := condition()):
        if time.monotonic() > end:
            raise AssertionError(f"waited in vain for {what}")
        time.sleep(0.05)
    return answer


class MicrophoneTest(unittest.TestCase):
    def setUp(self):
        missing = [it for it in NEEDED if shutil.which(it) is None]
        if missing:
            self.skipTest(f"{', '.join(missing)} not there: tools/install-packages test")
        # A short path: the name of a socket is at most 107 bytes long.
        self.folder = tempfile.TemporaryDirectory(prefix="mic-", dir="/tmp")
        self.at = pathlib.Path(self.folder.name)
        self.addCleanup(self.folder.cleanup)
        (self.at / ".asoundrc").write_text("pcm.!default pulse\nctl.!default pulse\n")
        self.environment = dict(os.environ, HOME=str(self.at), XDG_RUNTIME_DIR=str(self.at),
                                XDG_CONFIG_HOME=str(self.at / "config"))
        for name in ("PULSE_SERVER", "DISPLAY"):
            self.environment.pop(name, None)
        self.start_sound()
        self.addCleanup(self.ask, "pulseaudio", "--kill", may_fail=True)

    def ask(self, *words, may_fail=False):
        done = subprocess.run(words, capture_output=True, text=True, env=self.environment, timeout=PATIENCE)
        if done.returncode != 0 and not may_fail:
            raise AssertionError(f"{words}: {done.stderr}")
        return done.returncode == 0

    def start_sound(self):
        started = self.ask("pulseaudio", "-n", "--daemonize=yes", "--exit-idle-time=-1",
                           "--load=module-native-protocol-unix", "--load=module-null-sink sink_name=ears", may_fail=True)
        if not started or not self.ask("pactl", "set-default-source", "ears.monitor", may_fail=True):
            self.skipTest("PulseAudio does not start here")

    def say(self, sentence):
        recording = self.at / "said.wav"
        self.ask("espeak-ng", "-v", "en-us", "-w", str(recording), sentence)
        self.ask("paplay", str(recording))

    def test_what_is_said_is_done_also_after_the_microphone_was_lost(self):
        out, errors = self.at / "out.jsonl", self.at / "errors"
        with out.open("w") as answers, errors.open("w") as told:
            listening = subprocess.Popen([PROGRAM, "listen", "--json", "--apply", "--out", "heard.icome"], stdout=answers,
                                         stderr=told, env=self.environment, cwd=self.at)
        self.addCleanup(listening.kill)

        def heard():
            return [json.loads(line) for line in out.read_text().splitlines(keepends=True) if line.endswith("\n")]

        def times_told(what):
            return errors.read_text().count(what)

        wait_for("listening", lambda: times_told("listening"))
        self.say("create a small red sphere")
        wait_for("the sphere", lambda: heard() and heard()[0]["accepted"])
        self.assertEqual(heard()[0]["heard"], "create a small red sphere")
        self.ask("pulseaudio", "--kill")
        wait_for("the loss", lambda: times_told("lost"))
        self.start_sound()
        wait_for("listening again", lambda: times_told("listening") == 2)
        self.say("undo that")
        wait_for("the undo", lambda: len(heard()) == 2)
        self.assertEqual(heard()[1]["heard"], "undo that")
        listening.send_signal(signal.SIGINT)
        self.assertEqual(listening.wait(PATIENCE), 0)
        self.assertTrue((self.at / "heard.icome").exists())


if __name__ == "__main__":
    unittest.main()
