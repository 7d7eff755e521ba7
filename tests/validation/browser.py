# SPDX-License-Identifier: BSL-1.0
"""A headless Chromium driven over the WebDriver protocol, with nothing but urllib."""
import base64
import json
import pathlib
import shutil
import socket
import subprocess
import tempfile
import time
import urllib.error
import urllib.request

# What Chromium needs besides to draw in space (WebGL) where there is no graphics card.
IN_SPACE = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
ELEMENT = "element-6066-11e4-a52e-4f735466cecf"
FLAGS = ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
         "--disable-background-networking", "--disable-component-update", "--disable-sync",
         "--disable-dev-shm-usage", "--force-device-scale-factor=1"]

# The driver is on this machine: no proxy between.
_opener = urllib.request.build_opener(urllib.request.ProxyHandler({}))


def installed():
    return shutil.which("chromedriver") is not None and any(map(shutil.which, ("chromium", "google-chrome")))


def _free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Browser:
    """One browser with a profile of its own; close() ends it and its driver."""

    def __init__(self, flags=()):
        self._profile = tempfile.TemporaryDirectory(prefix="talus-chromium-", ignore_cleanup_errors=True)
        port = _free_port()
        self._base = f"http://127.0.0.1:{port}"
        self._driver = subprocess.Popen(["chromedriver", f"--port={port}"], stdout=subprocess.DEVNULL,
                                        stderr=subprocess.DEVNULL)
        self._session = None
        try:
            self._wait_for_driver()
            binary = next(path for path in map(shutil.which, ("chromium", "google-chrome")) if path)
            arguments = [*FLAGS, *flags, f"--user-data-dir={self._profile.name}"]
            answer = self._send("POST", "/session", {"capabilities": {"alwaysMatch": {
                "browserName": "chrome",
                "goog:chromeOptions": {"binary": binary, "args": arguments},
                "goog:loggingPrefs": {"browser": "ALL", "performance": "ALL"}}}})
            self._session = f"/session/{answer['sessionId']}"
        except BaseException:
            self.close()
            raise

    def _wait_for_driver(self):
        for _ in range(300):
            try:
                if self._send("GET", "/status")["ready"]:
                    return
            except (urllib.error.URLError, ConnectionError):
                time.sleep(0.1)
        raise RuntimeError("chromedriver does not answer")

    def _send(self, method, path, body=None):
        content = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(self._base + path, content, {"Content-Type": "application/json"}, method=method)
        try:
            with _opener.open(request, timeout=120) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as problem:
            value = json.load(problem)["value"]
            raise RuntimeError(f"{method} {path}: {value['error']}: {value['message']}") from problem

    def _call(self, method, path, body=None):
        return self._send(method, self._session + path, body)

    def open(self, url):
        self._call("POST", "/url", {"url": url})

    def run(self, script, *arguments):
        """The value that the body of a function returns in the page."""
        return self._call("POST", "/execute/sync", {"script": script, "args": list(arguments)})

    def wait(self, script, *arguments):
        """The value of `script` once it is true."""
        deadline = time.monotonic() + 30
        while time.monotonic() < deadline:
            value = self.run(script, *arguments)
            if value:
                return value
            time.sleep(0.02)
        raise RuntimeError(f"waited in vain for: {script}")

    def find(self, selector):
        return self._call("POST", "/element", {"using": "css selector", "value": selector})[ELEMENT]

    def click(self, selector):
        self._call("POST", f"/element/{self.find(selector)}/click", {})

    def type(self, selector, text):
        element = self.find(selector)
        self._call("POST", f"/element/{element}/clear", {})
        self._call("POST", f"/element/{element}/value", {"text": text})

    def press(self, *keys):
        """Keys one after the other to what has the focus."""
        actions = [{"type": kind, "value": key} for key in keys for kind in ("keyDown", "keyUp")]
        self._call("POST", "/actions", {"actions": [{"type": "key", "id": "keyboard", "actions": actions}]})

    def hover(self, selector, x=0, y=0):
        """Moves the mouse to an offset from the middle of an element."""
        move = {"type": "pointerMove", "duration": 0, "x": x, "y": y, "origin": {ELEMENT: self.find(selector)}}
        self._call("POST", "/actions", {"actions": [
            {"type": "pointer", "id": "mouse", "parameters": {"pointerType": "mouse"}, "actions": [move]}]})

    def drag(self, selector, x, y):
        """From the middle of an element to an offset from there, with the mouse pressed."""
        origin = {ELEMENT: self.find(selector)}
        steps = [{"type": "pointerMove", "duration": 0, "x": 0, "y": 0, "origin": origin}, {"type": "pointerDown", "button": 0},
                 {"type": "pointerMove", "duration": 60, "x": x, "y": y, "origin": origin}, {"type": "pointerUp", "button": 0}]
        self._call("POST", "/actions", {"actions": [
            {"type": "pointer", "id": "mouse", "parameters": {"pointerType": "mouse"}, "actions": steps}]})

    def wheel(self, selector, amount):
        """Turns the wheel over the middle of an element; downwards if positive."""
        scroll = {"type": "scroll", "x": 0, "y": 0, "deltaX": 0, "deltaY": amount, "duration": 0, "origin": {ELEMENT: self.find(selector)}}
        self._call("POST", "/actions", {"actions": [{"type": "wheel", "id": "wheel", "actions": [scroll]}]})

    def command(self, name, **parameters):
        """A command of the DevTools protocol."""
        return self._call("POST", "/goog/cdp/execute", {"cmd": name, "params": parameters})

    def resize(self, width, height):
        self.command("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1,
                     mobile=False)

    def disconnect(self):
        """From here on no network is there; files of this machine are."""
        self.command("Network.enable")
        self.command("Network.emulateNetworkConditions", offline=True, latency=0, downloadThroughput=0, uploadThroughput=0)

    def prefer(self, scheme):
        self.command("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])

    def style(self, css):
        """Gives every page opened from now on a style sheet more, until what is returned is called."""
        source = f"const added = new CSSStyleSheet(); added.replaceSync({json.dumps(css)}); document.adoptedStyleSheets.push(added);"
        script = self.command("Page.addScriptToEvaluateOnNewDocument", source=source)["identifier"]
        return lambda: self.command("Page.removeScriptToEvaluateOnNewDocument", identifier=script)

    def print_to_pdf(self):
        return base64.b64decode(self._call("POST", "/print", {}))

    def screenshot(self, path, whole=False):
        if whole:
            size = self.command("Page.getLayoutMetrics")["cssContentSize"]
            shot = self.command("Page.captureScreenshot", captureBeyondViewport=True, clip={
                "x": 0, "y": 0, "width": size["width"], "height": min(size["height"], 8000), "scale": 1})["data"]
        else:
            shot = self._call("GET", "/screenshot")
        pathlib.Path(path).write_bytes(base64.b64decode(shot))

    def console(self):
        """Messages of the page since the last call that are errors or warnings."""
        return [entry["message"] for entry in self._call("POST", "/se/log", {"type": "browser"})
                if entry["level"] in ("SEVERE", "WARNING")]

    def requests(self):
        """Addresses asked for since the last call."""
        messages = [json.loads(entry["message"])["message"]
                    for entry in self._call("POST", "/se/log", {"type": "performance"})]
        return [one["params"]["request"]["url"] for one in messages if one["method"] == "Network.requestWillBeSent"]

    def close(self):
        if self._session:
            try:
                self._call("DELETE", "")
            except (RuntimeError, OSError):
                pass
        self._driver.terminate()
        self._driver.wait(20)
        self._profile.cleanup()
