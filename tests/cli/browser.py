"""A headless Chromium that tells what a page does: what it fetches, what it complains of, where things are.

It is spoken to in its DevTools protocol, through the two pipes that --remote-debugging-pipe asks for: messages in JSON,
each ended by a zero byte."""

import base64
import fcntl
import json
import os
import shutil
import subprocess
import tempfile
import time

from riesel_command import PATIENCE

PROGRAM = shutil.which("chromium") or shutil.which("chromium-browser")


class Browser:
    """Has one page. To be closed."""

    def __init__(self):
        self._profile = tempfile.TemporaryDirectory(prefix="riesel-chromium-",
                                                    ignore_cleanup_errors=True)
        to_browser, self._commands = os.pipe()
        self._answers, from_browser = os.pipe()
        reading, writing = (fcntl.fcntl(pipe, fcntl.F_DUPFD, 10) for pipe in (to_browser, from_browser))
        # The browser reads from descriptor 3 and writes to descriptor 4.
        self._process = subprocess.Popen(
            ["bash", "-c", f'exec "$@" 3<&{reading} 4>&{writing}', "bash", PROGRAM,
             "--headless=new", "--no-sandbox", "--disable-gpu", "--remote-debugging-pipe",
             "--disable-background-networking", "--no-first-run", "--disable-dev-shm-usage",
             "--hide-scrollbars", f"--user-data-dir={self._profile.name}", "about:blank"],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            pass_fds=(reading, writing))
        for pipe in (to_browser, from_browser, reading, writing):
            os.close(pipe)
        os.set_blocking(self._answers, False)
        self._number, self._unread, self._session, self.events = 0, b"", None, []
        target = next(t for t in self._call("Target.getTargets")["targetInfos"]
                      if t["type"] == "page")
        self._session = self._call("Target.attachToTarget", targetId=target["targetId"],
                                   flatten=True)["sessionId"]
        for domain in ("Page", "Network", "Log", "Runtime"):
            self._call(f"{domain}.enable")

    def close(self):
        """It ends itself and its helpers, which write to the profile to the last."""
        try:
            os.write(self._commands, b'{"id": 0, "method": "Browser.close"}\0')
            self._process.wait(timeout=PATIENCE)
        except (OSError, subprocess.TimeoutExpired):
            self._process.kill()
            self._process.wait()
        os.close(self._commands)
        os.close(self._answers)
        self._profile.cleanup()

    def show(self, path, width=1000, dark=False):
        """Loads a file into a window of this width (px)."""
        self.events.clear()
        self._call("Emulation.setDeviceMetricsOverride", width=width, height=800,
                   deviceScaleFactor=1, mobile=False)
        self._call("Emulation.setEmulatedMedia", features=[
            {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}])
        self._call("Page.navigate", url=path.as_uri())
        self._wait_for(lambda message: message.get("method") == "Page.loadEventFired")

    def value_of(self, expression):
        """What a JavaScript expression gives, as JSON has it."""
        answer = self._call("Runtime.evaluate", expression=f"JSON.stringify({expression})")
        if "exceptionDetails" in answer:
            raise AssertionError(answer["exceptionDetails"])
        return json.loads(answer["result"]["value"])

    def screenshot(self):
        """PNG of the whole page."""
        return base64.b64decode(self._call("Page.captureScreenshot",
                                           captureBeyondViewport=True)["data"])

    def complaints(self):
        """Of the page since it was loaded: messages to the console, of whatever kind."""
        return [event["params"] for event in self.events
                if event.get("method") in ("Log.entryAdded", "Runtime.consoleAPICalled",
                                           "Runtime.exceptionThrown")]

    def requests(self):
        """The addresses that were asked for since then, the page's own among them."""
        return [event["params"]["request"]["url"] for event in self.events
                if event.get("method") == "Network.requestWillBeSent"]

    def _call(self, method, **parameters):
        self._number += 1
        message = {"id": self._number, "method": method, "params": parameters}
        if self._session:
            message["sessionId"] = self._session
        os.write(self._commands, json.dumps(message).encode() + b"\0")
        number = self._number
        answer = self._wait_for(lambda message: message.get("id") == number)
        if "error" in answer:
            raise AssertionError(f"{method}: {answer['error']}")
        return answer["result"]

    def _wait_for(self, is_it):
        """The next message of which that is true; events on the way, it included, are kept."""
        end = time.monotonic() + PATIENCE
        while True:
            message = self._next_message(end)
            if "method" in message:
                self.events.append(message)
            if is_it(message):
                return message

    def _next_message(self, end):
        while b"\0" not in self._unread:
            if self._process.poll() is not None or time.monotonic() > end:
                raise AssertionError("the browser does not answer")
            try:
                self._unread += os.read(self._answers, 1 << 20)
            except BlockingIOError:
                time.sleep(0.01)
        message, self._unread = self._unread.split(b"\0", 1)
        return json.loads(message)
