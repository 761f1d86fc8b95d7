# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
"""Headless browsers for the tests of pages: Chromium by its DevTools protocol, Firefox by WebDriver BiDi, both over a
WebSocket written here, so that Python's standard library is enough."""
import base64
import json
import os
import shutil
import signal
import socket
import struct
import subprocess
import tempfile
import threading
import time
import urllib.request
from urllib.parse import urlparse


class WebSocket:
    """The client's side of RFC 6455: text messages, no extensions."""

    def __init__(self, url, timeout):
        parts = urlparse(url)
        self.socket = socket.create_connection((parts.hostname, parts.port), timeout)
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall(
            (f"GET {parts.path} HTTP/1.1\r\nHost: {parts.netloc}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
             f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n").encode())
        head = b""
        while b"\r\n\r\n" not in head:
            head += self.read(1)
        if b" 101 " not in head.split(b"\r\n")[0]:
            raise OSError("no WebSocket: " + head.decode(errors="replace"))

    def read(self, count):
        parts = []
        while count > 0:
            part = self.socket.recv(min(count, 1 << 20))
            if not part:
                raise OSError("the browser closed the connection")
            parts.append(part)
            count -= len(part)
        return b"".join(parts)

    def frame(self, opcode, payload):
        size = len(payload)
        head = bytes([0x80 | opcode])
        if size < 126:
            head += bytes([0x80 | size])
        elif size < 1 << 16:
            head += bytes([0x80 | 126]) + struct.pack(">H", size)
        else:
            head += bytes([0x80 | 127]) + struct.pack(">Q", size)
        mask = os.urandom(4)
        self.socket.sendall(head + mask + bytes(b ^ mask[i % 4] for i, b in enumerate(payload)))

    def send(self, text):
        self.frame(1, text.encode())

    def receive(self):
        message = b""
        while True:
            first, second = self.read(2)
            size = second & 127
            if size == 126:
                size = struct.unpack(">H", self.read(2))[0]
            elif size == 127:
                size = struct.unpack(">Q", self.read(8))[0]
            payload = self.read(size)
            if first & 15 == 9:
                self.frame(10, payload)
                continue
            if first & 15 == 8:
                raise OSError("the browser closed the connection")
            message += payload
            if first & 128:
                return message.decode()

    def close(self):
        self.socket.close()


class Browser:
    """Common to both: the process, calls with answers, and the faults that the page reported."""

    program = ""
    has_dark = True  # can show the page as if the user had asked for dark colours

    def __init__(self, timeout=120):
        self.timeout = timeout
        self.faults = []
        self.requests = []
        self.number = 0
        self.folder = tempfile.mkdtemp(prefix="odosplat-browser-")
        self.display = None
        self.process = subprocess.Popen(self.command(), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                        errors="replace", start_new_session=True, env=self.environment())
        self.output = []
        self.reader = threading.Thread(target=self.read_output, daemon=True)
        self.reader.start()
        try:
            self.connection = self.connect()
            self.begin()
        except BaseException:
            self.close()
            raise

    def environment(self):
        return dict(os.environ)

    def read_output(self):
        for line in self.process.stdout:
            self.output.append(line)

    def address(self, words):
        """The address after these words in what the browser prints."""
        end = time.time() + self.timeout
        while time.time() < end and self.process.poll() is None:
            for line in list(self.output):
                if words in line:
                    return line.split(words)[1].strip()
            time.sleep(0.05)
        raise OSError(f"{self.program} did not start:\n" + "".join(self.output[-20:]))

    def call(self, method, **parameters):
        self.number += 1
        self.connection.send(json.dumps({"id": self.number, "method": method, "params": parameters, **self.extra()}))
        while True:
            message = json.loads(self.connection.receive())
            if message.get("id") == self.number:
                if message.get("error"):
                    raise OSError(f"{method}: {message}"[:1000])
                return message.get("result", {})
            if "method" in message:
                self.heard(message["method"], message.get("params", {}))

    def extra(self):
        return {}

    def wait_until(self, expression):
        """Waits until the JavaScript expression is true."""
        end = time.time() + self.timeout
        while time.time() < end:
            if self.evaluate(expression):
                return
            time.sleep(0.1)
        raise TimeoutError(expression[:200])

    def close(self):
        if getattr(self, "connection", None):
            self.connection.close()
        try:
            os.killpg(self.process.pid, signal.SIGTERM)
            self.process.wait(10)
        except (ProcessLookupError, subprocess.TimeoutExpired):
            if self.process.poll() is None:
                os.killpg(self.process.pid, signal.SIGKILL)
                self.process.wait()
        if self.display:
            self.display.terminate()
            self.display.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


class Chromium(Browser):
    program = "chromium"

    def command(self):
        return [self.program, "--headless=new", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                "--no-sandbox", "--no-first-run", "--disable-extensions", "--disable-background-networking",
                "--hide-scrollbars", f"--user-data-dir={self.folder}", "--remote-debugging-port=0", "about:blank"]

    def connect(self):
        base = urlparse(self.address("DevTools listening on "))
        with urllib.request.urlopen(f"http://{base.netloc}/json/list", timeout=self.timeout) as answer:
            pages = [page for page in json.load(answer) if page["type"] == "page"]
        return WebSocket(pages[0]["webSocketDebuggerUrl"], self.timeout)

    def begin(self):
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(domain + ".enable")

    def heard(self, method, parameters):
        if method == "Runtime.exceptionThrown":
            self.faults.append(str(parameters["exceptionDetails"].get("exception", parameters)))
        elif method == "Runtime.consoleAPICalled" and parameters["type"] in ("error", "warning", "assert"):
            self.faults.append(str([value.get("value", value) for value in parameters["args"]]))
        elif method == "Log.entryAdded" and parameters["entry"]["level"] in ("error", "warning"):
            self.faults.append(parameters["entry"]["text"])
        elif method == "Network.requestWillBeSent":
            self.requests.append(parameters["request"]["url"])

    def resize(self, width, height, scale=1, dark=False, touch=False):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=scale, mobile=touch)
        self.call("Emulation.setTouchEmulationEnabled", enabled=touch)
        self.call("Emulation.setEmulatedMedia",
                  features=[{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}])

    def preload(self, script):
        """Runs before the scripts of every page that is opened from now on."""
        self.call("Page.addScriptToEvaluateOnNewDocument", source=script)

    def open(self, url):
        self.call("Page.navigate", url=url)
        self.wait_until("document.readyState === 'complete'")

    def evaluate(self, expression):
        answer = self.call("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in answer:
            raise OSError(f"{expression[:200]}: {answer['exceptionDetails']}"[:1000])
        return answer["result"].get("value")

    def screenshot(self):
        return base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"])


class Firefox(Browser):
    program = "firefox-esr"
    has_dark = False

    def command(self):
        with open(os.path.join(self.folder, "user.js"), "w", encoding="utf-8") as preferences:
            preferences.write('user_pref("remote.active-protocols", 1);\n'
                              'user_pref("webgl.force-enabled", true);\n'
                              'user_pref("browser.shell.checkDefaultBrowser", false);\n'
                              'user_pref("datareporting.policy.dataSubmissionEnabled", false);\n'
                              'user_pref("app.normandy.enabled", false);\n'
                              'user_pref("network.captive-portal-service.enabled", false);\n')
        return [self.program, "--headless", "--no-remote", "--profile", self.folder, "--remote-debugging-port", "0",
                "about:blank"]

    def environment(self):
        """Without an X server Firefox has no WebGL, not even in software: a virtual one is started."""
        variables = dict(os.environ)
        if "DISPLAY" not in variables and shutil.which("Xvfb"):
            read, write = os.pipe()
            self.display = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1400x1000x24"],
                                            pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            os.close(write)
            with os.fdopen(read) as number:
                variables["DISPLAY"] = ":" + number.readline().strip()
        return variables

    def connect(self):
        return WebSocket(self.address("WebDriver BiDi listening on ") + "/session", self.timeout)

    def begin(self):
        self.call("session.new", capabilities={})
        self.call("session.subscribe", events=["log.entryAdded", "network.beforeRequestSent"])
        self.context = self.call("browsingContext.getTree")["contexts"][0]["context"]

    def heard(self, method, parameters):
        if method == "log.entryAdded" and parameters["level"] in ("error", "warn"):
            self.faults.append(parameters["text"])
        elif method == "network.beforeRequestSent" and parameters.get("context") == self.context:
            self.requests.append(parameters["request"]["url"])

    def resize(self, width, height, scale=1, dark=False, touch=False):
        if dark:
            raise ValueError("Firefox shows its own colours")
        self.call("browsingContext.setViewport", context=self.context, viewport={"width": width, "height": height},
                  devicePixelRatio=scale)

    def preload(self, script):
        self.call("script.addPreloadScript", functionDeclaration="() => {" + script + "}")

    def open(self, url):
        self.call("browsingContext.navigate", context=self.context, url=url, wait="complete")

    def evaluate(self, expression):
        answer = self.call("script.evaluate", expression=expression, target={"context": self.context}, awaitPromise=True)
        if answer["type"] == "exception":
            raise OSError(f"{expression[:200]}: {answer['exceptionDetails']['text']}"[:1000])
        return answer["result"].get("value")

    def screenshot(self):
        return base64.b64decode(self.call("browsingContext.captureScreenshot", context=self.context)["data"])


def available():
    """The kinds of browsers that are installed."""
    return [kind for kind in (Chromium, Firefox) if shutil.which(kind.program)]
