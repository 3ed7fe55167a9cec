"""Operations in the window as people perform them: found by name, their form filled in with the keyboard."""
import functools
import json

from icome_program import run

PLACES = {"[x, y, z]": 3}  # how often Tab goes on within a field of that kind
COLOUR = '[red, green, blue] or "#rrggbb" or name'


@functools.cache
def parameters_of(operation):
    """What the program says that it asks."""
    told = json.loads(run("edit", "--help-ops", operation, "--json").stdout)
    return told["operations"][0]["parameters"]


class Form:
    """The form of an operation, from when it is found by its title until it is applied or left."""

    def __init__(self, desktop, operation, title):
        self.desktop = desktop
        self.parameters = parameters_of(operation)
        desktop.command(title)
        desktop.screen.ask("windowactivate", "--sync", desktop.window)
        self.choice = None
        first = next((it for it in self.asked() if not self.follows_selection(it)), self.asked()[0])
        self.at = self.stop(first["name"])

    @staticmethod
    def follows_selection(parameter):
        return parameter["required"] and parameter["kind"].startswith("object")

    def asked(self):
        """What belongs to the choice that was made first, if any."""
        return [it for it in self.parameters if self.choice is None or self.choice in it.get("only_for", [self.choice])]

    def stop(self, name):
        """Where Tab stops for a parameter."""
        stop = 0
        for it in self.asked():
            if it["name"] == name:
                return stop
            stop += 2 if it["kind"] == COLOUR else PLACES.get(it["kind"], 1)
        raise KeyError(name)

    def go_to(self, stop):
        key = "Tab" if stop > self.at else "shift+Tab"
        if stop != self.at:
            self.desktop.screen.ask("key", "--delay", "1", *[key] * abs(stop - self.at))
        self.at = stop

    def say(self, **said):
        """Types what is said; of several fields, a tuple."""
        for name, text in said.items():
            parameter = next(it for it in self.parameters if it["name"] == name)
            if parameter is self.parameters[0] and parameter.get("choices"):
                self.choice = text
            for i, part in enumerate(text if isinstance(text, tuple) else (text,)):
                self.go_to(self.stop(name) + i)
                if not parameter.get("choices"):
                    self.desktop.key("ctrl+a")
                self.desktop.type(part)
        return self

    def apply(self):
        self.desktop.key("ctrl+Return")

    def cancel(self):
        self.desktop.key("Escape")


def perform(desktop, operation, title, **said):
    Form(desktop, operation, title).say(**said).apply()
