"""A headless Chromium with software rendering, driven by the DevTools protocol over a pipe; the standard library alone."""

import base64
import json
import os
import subprocess
import tempfile

FLAGS = [
    "--headless=new",
    "--no-sandbox",
    "--hide-scrollbars",
    "--disable-background-networking",
    "--disable-extensions",
    "--no-first-run",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--remote-debugging-pipe",
]


class Browser:
    def __init__(self):
        self.profile = tempfile.TemporaryDirectory()
        ours, theirs = os.pipe(), os.pipe()
        line = f'exec chromium "$@" 3<&{ours[0]} 4>&{theirs[1]}'
        arguments = ["bash", "-c", line, "chromium", *FLAGS, f"--user-data-dir={self.profile.name}"]
        self.process = subprocess.Popen(arguments, pass_fds=[ours[0], theirs[1]], stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        os.close(ours[0]), os.close(theirs[1])
        self.out, self.back = os.fdopen(ours[1], "wb"), os.fdopen(theirs[0], "rb")
        self.count, self.rest = 0, b""

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait()
        self.profile.cleanup()

    def send(self, method, session=None, **parameters):
        self.count += 1
        message = {"id": self.count, "method": method, "params": parameters}
        self.out.write(json.dumps(message | ({"sessionId": session} if session else {})).encode() + b"\0")
        self.out.flush()
        return self.count

    def next(self):
        while b"\0" not in self.rest:
            read = os.read(self.back.fileno(), 1 << 20)
            if not read:
                raise RuntimeError("Chromium is gone")
            self.rest += read
        message, self.rest = self.rest.split(b"\0", 1)
        return json.loads(message)


class Page:
    """A page, its complaints, and the requests that it made."""

    def __init__(self, browser, path, width=1280, height=800, scheme="light", scale=1):
        self.browser, self.session = browser, None
        self.complaints, self.requests = [], []
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.target = target
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=scale, mobile=False)
        self.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
        self.call("Page.navigate", url=f"file://{os.path.abspath(path)}")
        while self.run("document.readyState") != "complete":
            pass
        self.run("lgvi.ready")
        self.frames(2)

    def call(self, method, **parameters):
        number = self.browser.send(method, self.session, **parameters)
        while True:
            message = self.browser.next()
            if message.get("id") == number:
                if "error" in message:
                    raise RuntimeError(f"{method}: {message['error']['message']}")
                return message["result"]
            self.hear(message)

    def hear(self, message):
        method, told = message.get("method"), message.get("params", {})
        if method == "Runtime.exceptionThrown":
            self.complaints.append(told["exceptionDetails"].get("exception", {}).get("description", "an exception"))
        elif method == "Runtime.consoleAPICalled" and told["type"] in ("error", "warning", "assert"):
            self.complaints.append(str(told["args"]))
        elif method == "Log.entryAdded" and told["entry"]["level"] in ("error", "warning"):
            # What software rendering says of itself.
            if "ReadPixels" not in told["entry"]["text"]:
                self.complaints.append(told["entry"]["text"])
        elif method == "Network.requestWillBeSent":
            self.requests.append(told["request"]["url"])

    def run(self, script):
        """The value of an expression; a promise is waited for."""
        result = self.call("Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in result:
            raise RuntimeError(result["exceptionDetails"].get("exception", {}).get("description", script))
        return result["result"].get("value")

    def frames(self, count):
        """Waits for so many frames of the screen."""
        wait = "new Promise((done) => {{ let k = {0}; const f = () => k-- ? requestAnimationFrame(f) : done(true); f(); }})"
        self.run(wait.format(count))

    def picture(self, selector=None):
        """A PNG of the page, or of an element of it."""
        clip = {}
        if selector:
            box = self.run(f"(({{x, y, width, height}}) => ({{x, y, width, height}}))(document.querySelector('{selector}').getBoundingClientRect())")
            clip = {"clip": box | {"scale": 1}}
        return base64.b64decode(self.call("Page.captureScreenshot", format="png", **clip)["data"])

    def close(self):
        self.session = None
        self.call("Target.closeTarget", targetId=self.target)
