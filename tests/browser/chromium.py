"""Chromium without a window, driven by its DevTools protocol through a pipe. Python's own library is enough."""

import base64
import json
import os
import select
import shutil
import subprocess
import tempfile
import time

PROGRAM = next((path for path in map(shutil.which, ("chromium", "chromium-browser", "google-chrome")) if path), None)


class Chromium:
    """A browser with one page. Collects what pages complain of and what they ask for."""

    def __init__(self):
        self.complaints = []
        self.requests = []
        self._number = 0
        self._bytes = b""
        self._profile = tempfile.mkdtemp(prefix="stereobench_chromium_")
        to_browser, self._to = os.pipe()
        self._from, from_browser = os.pipe()

        def take_descriptors():  # the protocol wants 3 and 4
            os.dup2(os.dup(to_browser), 3)
            os.dup2(os.dup(from_browser), 4)

        # The two may be 3 or 4 themselves: copies far away are moved in place.
        to_browser, from_browser = self._far(to_browser), self._far(from_browser)
        self._process = subprocess.Popen(
            [PROGRAM, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--remote-debugging-pipe",
             f"--user-data-dir={self._profile}"],
            preexec_fn=take_descriptors, close_fds=False, stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)
        target = self._send("Target.createTarget", {"url": "about:blank"}, None)["targetId"]
        self._session = self._send("Target.attachToTarget", {"targetId": target, "flatten": True}, None)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.send(f"{domain}.enable")

    @staticmethod
    def _far(descriptor):
        import fcntl
        far = fcntl.fcntl(descriptor, fcntl.F_DUPFD, 20)
        os.close(descriptor)
        return far

    def close(self):
        try:
            self._send("Browser.close", {}, None)
        except RuntimeError:
            pass
        self._process.wait(timeout=30)
        shutil.rmtree(self._profile, ignore_errors=True)

    def send(self, method, **parameters):
        return self._send(method, parameters, self._session)

    def _send(self, method, parameters, session):
        self._number += 1
        message = {"id": self._number, "method": method, "params": parameters}
        if session:
            message["sessionId"] = session
        os.write(self._to, json.dumps(message).encode() + b"\0")
        while True:
            answer = self._receive()
            if answer.get("id") != self._number:
                continue
            if "error" in answer:
                raise RuntimeError(f"{method}: {answer['error']['message']}")
            return answer["result"]

    def _receive(self, timeout_s=60.0):
        while b"\0" not in self._bytes:
            if not select.select([self._from], [], [], timeout_s)[0]:
                raise RuntimeError("chromium does not answer")
            read = os.read(self._from, 1 << 20)
            if not read:
                raise RuntimeError("chromium has ended")
            self._bytes += read
        line, self._bytes = self._bytes.split(b"\0", 1)
        message = json.loads(line)
        self._note(message)
        return message

    def _note(self, message):
        method, parameters = message.get("method"), message.get("params", {})
        if method == "Runtime.exceptionThrown":
            details = parameters["exceptionDetails"]
            self.complaints.append(details.get("exception", {}).get("description", details["text"]))
        if method == "Runtime.consoleAPICalled" and parameters["type"] in ("error", "warning", "assert"):
            self.complaints.append(" ".join(str(argument.get("value")) for argument in parameters["args"]))
        if method == "Log.entryAdded" and parameters["entry"]["level"] in ("error", "warning"):
            self.complaints.append(parameters["entry"]["text"])
        if method == "Network.requestWillBeSent" and not parameters["request"]["url"].startswith("data:"):
            self.requests.append(parameters["request"]["url"])
        if method == "Page.loadEventFired":
            self._loaded = True

    def open(self, url, width=1200, height=900, dark=False, media=""):
        """Opens a page, and waits until it has loaded and painted."""
        self.send("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
        self.send("Emulation.setEmulatedMedia", media=media,
                  features=[{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}])
        self.complaints, self.requests, self._loaded = [], [], False
        self.send("Page.navigate", url=url)
        deadline = time.monotonic() + 60.0
        while not self._loaded and time.monotonic() < deadline:
            self._receive()
        self.settle()

    def settle(self):
        """Waits for two frames: what scripts have changed is drawn."""
        self.value("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))")

    def value(self, expression):
        """The value of an expression of the page's script."""
        answer = self.send("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(answer["exceptionDetails"].get("exception", {}).get("description", expression))
        return answer["result"].get("value")

    def press(self, key, code=0):
        for kind in ("keyDown", "keyUp"):
            self.send("Input.dispatchKeyEvent", type=kind, key=key, code=key, windowsVirtualKeyCode=code)
        self.settle()

    def click(self, selector):
        """A click of the mouse in the middle of the first element that fits."""
        place = self.value(f"""(() => {{
          const found = document.querySelector({json.dumps(selector)});
          found.scrollIntoView({{block: 'center'}});
          const box = found.getBoundingClientRect();
          return [box.x + box.width / 2, box.y + box.height / 2];
        }})()""")
        for kind in ("mousePressed", "mouseReleased"):
            self.send("Input.dispatchMouseEvent", type=kind, x=place[0], y=place[1], button="left", clickCount=1)
        self.settle()

    def picture(self, file, whole=True):
        """Writes a PNG of the page."""
        shot = self.send("Page.captureScreenshot", format="png", captureBeyondViewport=whole)
        with open(file, "wb") as out:
            out.write(base64.b64decode(shot["data"]))

    def pdf(self, file):
        with open(file, "wb") as out:
            out.write(base64.b64decode(self.send("Page.printToPDF", printBackground=True)["data"]))
