"""A headless Chromium on the end of a pipe: its DevTools protocol, as far as a page's test needs it."""
import base64
import fcntl
import json
import os
import select
import shutil
import subprocess
import time


class Browser:
    """One page. All waits are bounded by `patience` seconds; what the console says is collected in `complaints`."""

    def __init__(self, profile, width, height, mobile=False, patience=240):
        self.patience, self.answers, self.complaints, self.rest, self.last = patience, {}, [], b"", 0
        to_browser, self.out = self.pipe()
        self.into, from_browser = self.pipe()
        # The protocol speaks on descriptors 3 and 4.
        places = f"exec 3<&{to_browser} 4>&{from_browser} {to_browser}<&- {from_browser}>&-; exec \"$@\""
        self.process = subprocess.Popen(
            ["bash", "-c", places, "bash", self.program(), "--headless", "--no-sandbox", "--disable-gpu", "--remote-debugging-pipe",
             "--disable-dev-shm-usage", "--no-first-run", f"--user-data-dir={profile}", "about:blank"],
            pass_fds=(to_browser, from_browser), env=os.environ | {"HOME": str(profile)},
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)
        self.session = None
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log"):
            self.call(domain + ".enable")
        self.call("Page.bringToFront")
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=2, mobile=mobile)

    @staticmethod
    def pipe():
        """Descriptors well above those that the protocol wants."""
        ends = os.pipe()
        high = [fcntl.fcntl(end, fcntl.F_DUPFD_CLOEXEC, 20) for end in ends]
        for end in ends:
            os.close(end)
        return high

    @staticmethod
    def program():
        return shutil.which("chromium")

    def call(self, method, **parameters):
        self.last += 1
        message = {"id": self.last, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.out, json.dumps(message).encode() + b"\0")
        end = time.monotonic() + self.patience
        while self.last not in self.answers:
            self.listen(end - time.monotonic())
        answer = self.answers.pop(self.last)
        if "error" in answer:
            raise RuntimeError(f"{method}: {answer['error']['message']}")
        return answer["result"]

    def listen(self, seconds):
        ready, _, _ = select.select([self.into], [], [], max(seconds, 0))
        piece = os.read(self.into, 1 << 20) if ready else b""
        if not piece:
            raise TimeoutError("The browser is silent." if not ready else "The browser has gone.")
        *messages, self.rest = (self.rest + piece).split(b"\0")
        for message in map(json.loads, messages):
            if "id" in message:
                self.answers[message["id"]] = message
            elif message["method"] == "Runtime.exceptionThrown":
                details = message["params"]["exceptionDetails"]
                self.complaints.append(details.get("exception", {}).get("description", details["text"]))
            elif message["method"] == "Log.entryAdded":
                entry = message["params"]["entry"]
                # Warnings are of how probes read canvases.
                if entry["level"] == "error":
                    self.complaints.append(f"{entry['text']} {entry.get('url', '')}")
            elif message["method"] == "Runtime.consoleAPICalled":
                self.complaints.append(str(message["params"]["args"]))

    def open(self, address):
        self.call("Page.navigate", url=address)

    def value(self, expression):
        result = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            raise RuntimeError(result["exceptionDetails"].get("exception", {}).get("description", "an exception"))
        return result["result"].get("value")

    def until(self, expression):
        """The expression's value once it is true. It may throw before: the page may still be loading."""
        end = time.monotonic() + self.patience
        while True:
            found = self.value(f"(() => {{ try {{ return {expression}; }} catch {{ return null; }} }})()")
            if found:
                return found
            if time.monotonic() > end:
                raise TimeoutError(f"The page never came to: {expression}")
            time.sleep(0.2)

    def screenshot(self, path):
        data = self.call("Page.captureScreenshot", format="png")["data"]
        path.write_bytes(base64.b64decode(data))

    def close(self):
        try:
            self.session = None
            self.call("Browser.close")
        except (OSError, TimeoutError):
            pass
        try:
            self.process.wait(20)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        os.close(self.out)
        os.close(self.into)
