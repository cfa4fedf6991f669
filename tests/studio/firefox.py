"""Firefox, steered by its own protocol, and a page of it with what walks need of Playwright's."""

from __future__ import annotations

import json
import socket
import subprocess
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any

from programs import program

PREFERENCES = (
    'user_pref("marionette.port", 0);\nuser_pref("datareporting.policy.dataSubmissionEnabled", false);\n'
    'user_pref("ui.prefersReducedMotion", 1);\n'
)
STARTED_IN = 300
"""Seconds at most, on a machine with much else to do."""


class Firefox:
    """A client of Marionette, by which Firefox is steered: messages of JSON, each behind its length."""

    def __init__(self, port: int) -> None:
        self.socket = socket.create_connection(("127.0.0.1", port))
        self.read = self.socket.makefile("rb")
        self.number = 0
        self._message()
        self.do("WebDriver:NewSession")
        self.do("WebDriver:SetTimeouts", script=1000 * STARTED_IN)

    def _message(self) -> Any:
        digits = b""
        while not digits.endswith(b":"):
            digits += self.read.read(1)
        return json.loads(self.read.read(int(digits[:-1])))

    def do(self, command: str, **values: Any) -> Any:
        self.number += 1
        message = json.dumps([0, self.number, command, values]).encode()
        self.socket.sendall(b"%d:%b" % (len(message), message))
        _, _, error, found = self._message()
        assert error is None, error
        return found

    def close(self) -> None:
        self.read.close()
        self.socket.close()

    def script(self, text: str, *args: Any) -> Any:
        return self.do("WebDriver:ExecuteScript", script=text, args=args)["value"]

    def wait(self, text: str) -> None:
        end = time.monotonic() + STARTED_IN
        while not self.script(text):
            assert time.monotonic() < end, text
            time.sleep(0.1)


@contextmanager
def firefox_in(profile: Path) -> Iterator[Firefox]:
    """A Firefox without a window, with its profile in an empty folder."""
    (profile / "user.js").write_text(PREFERENCES, encoding="utf-8")
    command = [program("firefox-esr"), "--headless", "--marionette", "--no-remote", "--profile", str(profile)]
    running = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        active = profile / "MarionetteActivePort"
        end = time.monotonic() + STARTED_IN
        while not (active.exists() and active.read_text(encoding="utf-8")):
            assert time.monotonic() < end
            time.sleep(0.1)
        with closing(Firefox(int(active.read_text(encoding="utf-8")))) as client:
            yield client
    finally:
        running.terminate()
        running.wait(60)


KEYS = {
    "Enter": "\ue007",
    "Tab": "\ue004",
    "Escape": "\ue00c",
    "PageUp": "\ue00e",
    "End": "\ue010",
    "Home": "\ue011",
    "ArrowLeft": "\ue012",
    "ArrowRight": "\ue014",
}
VISIBLE = (
    "return arguments[0].checkVisibility({ visibilityProperty: true }) && arguments[0].getClientRects().length > 0"
)
ASKED = """const done = arguments[arguments.length - 1];
Promise.resolve(({function})(...[...arguments].slice(0, -1))).then(done, (error) => done(`failed: ${{error}}`));"""


class FirefoxElement:
    """An element of a page."""

    def __init__(self, page: FirefoxPage, reference: Any) -> None:
        self.page, self.reference = page, reference

    def _told(self, script: str, *more: Any) -> Any:
        return self.page.firefox.script(script, self.reference, *more)

    def is_visible(self) -> bool:
        return self._told(VISIBLE)

    def is_enabled(self) -> bool:
        return self._told("return !arguments[0].matches(':disabled')")

    def get_attribute(self, name: str) -> str | None:
        return self._told("return arguments[0].getAttribute(arguments[1])", name)

    def evaluate(self, function: str) -> Any:
        return self._told(f"return ({function})(arguments[0])")

    def focus(self) -> None:
        self._told("arguments[0].focus()")

    def fill(self, text: str) -> None:
        self._told("arguments[0].focus(); arguments[0].select()")
        self.page.keyboard.type(text or "\ue003")

    def press(self, key: str) -> None:
        self.focus()
        self.page.keyboard.press(key)

    def select_option(self, index: int) -> None:
        script = """const [list, k] = arguments;
            list.focus();
            list.selectedIndex = k;
            for (const name of ["input", "change"]) list.dispatchEvent(new Event(name, { bubbles: true }));"""
        self._told(script, index)

    def bounding_box(self) -> dict[str, float]:
        return self._told(
            "const { x, y, width, height } = arguments[0].getBoundingClientRect(); return { x, y, width, height }"
        )


class FirefoxElements:
    """The elements that a selector finds."""

    def __init__(self, page: FirefoxPage, selector: str) -> None:
        self.page, self.selector = page, selector

    def all(self) -> list[FirefoxElement]:
        found = self.page.firefox.do("WebDriver:FindElements", using="css selector", value=self.selector)
        return [FirefoxElement(self.page, reference) for reference in found]


class FirefoxKeyboard:
    def __init__(self, firefox: Firefox) -> None:
        self.firefox = firefox

    def type(self, letters: str) -> None:
        actions = [{"type": way, "value": letter} for letter in letters for way in ("keyDown", "keyUp")]
        self.firefox.do("WebDriver:PerformActions", actions=[{"type": "key", "id": "keys", "actions": actions}])

    def press(self, key: str) -> None:
        self.type(KEYS[key])


class FirefoxMouse:
    def __init__(self, firefox: Firefox) -> None:
        self.firefox, self.at = firefox, (0.0, 0.0)

    def _do(self, actions: list[dict[str, Any]]) -> None:
        mouse = {"type": "pointer", "id": "mouse", "parameters": {"pointerType": "mouse"}, "actions": actions}
        self.firefox.do("WebDriver:PerformActions", actions=[mouse])

    def move(self, x: float, y: float, steps: int = 1) -> None:
        """Within the window: Firefox knows no other places."""
        wide, high = self.firefox.script("return [innerWidth, innerHeight]")
        to = (min(max(x, 0.0), wide - 1.0), min(max(y, 0.0), high - 1.0))
        for k in range(1, steps + 1):
            on = [round(a + (b - a) * k / steps) for a, b in zip(self.at, to, strict=True)]
            self._do([{"type": "pointerMove", "x": on[0], "y": on[1], "duration": 0, "origin": "viewport"}])
        self.at = to

    def down(self) -> None:
        self._do([{"type": "pointerDown", "button": 0}])

    def up(self) -> None:
        self._do([{"type": "pointerUp", "button": 0}])


class FirefoxPage:
    """The one page of a Firefox, as far as a walk needs it."""

    def __init__(self, firefox: Firefox) -> None:
        self.firefox = firefox
        self.keyboard, self.mouse = FirefoxKeyboard(firefox), FirefoxMouse(firefox)
        firefox.do("WebDriver:SetWindowRect", width=1440, height=1000)

    def goto(self, url: str) -> None:
        self.firefox.do("WebDriver:Navigate", url="about:blank")
        self.firefox.do("WebDriver:Navigate", url=url)

    def close(self) -> None:
        """What it kept is forgotten; the window serves the next one."""
        self.firefox.script("localStorage.clear()")

    def reload(self) -> None:
        self.firefox.do("WebDriver:Refresh")

    def locator(self, selector: str) -> FirefoxElements:
        return FirefoxElements(self, selector)

    def evaluate(self, function: str) -> Any:
        script = ASKED.format(function=function)
        return self.firefox.do("WebDriver:ExecuteAsyncScript", script=script, args=[])["value"]

    def wait_for_function(self, function: str) -> None:
        self.firefox.wait(f"return Boolean(({function})())")

    def wait_for_timeout(self, ms: float) -> None:
        time.sleep(ms / 1000)
