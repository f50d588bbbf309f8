"""The page of a render in a real browser: page_test.py ANTIPODE. Waits for what has to come, however long it takes on a busy
machine; nothing is measured in seconds."""
import base64
import pathlib
import re
import subprocess
import sys
import tempfile
import time
import unittest

sys.dont_write_bytecode = True
from browser import Browser  # noqa: E402

ANTIPODE = sys.argv.pop(1) if len(sys.argv) > 1 else "antipode"
ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SKIPPED = 77
PATIENCE = 240

# Shares of pixels: of the canvas that are anything but the page's ground, and how many colours there are.
PAINTED = """(id => {
  const canvas = document.getElementById(id), {data} = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  const colours = new Set();
  let lit = 0;
  for (let i = 0; i < data.length; i += 4)
    if (data[i + 3] > 0 && data[i] + data[i + 1] + data[i + 2] > 24) { ++lit; colours.add(data[i] << 16 | data[i + 1] << 8 | data[i + 2]); }
  return {lit: lit / (data.length / 4), colours: colours.size};
})"""


class Render:
    """A render in a folder of its own, with its page on a port of the system's choice."""

    def __init__(self, folder, *options):
        self.log = folder / "log"
        with open(self.log, "wb") as log:
            self.process = subprocess.Popen(
                [ANTIPODE, "render", str(ROOT / "scenes/veach_mis.textproto"), "--width", "96", "--height", "64", "--view", "0",
                 "-o", "out.exr", *options], cwd=folder, stdout=log, stderr=log)
        end = time.monotonic() + PATIENCE
        while not (found := re.search(r"seen live at (http://\S+)", self.log.read_text())):
            if self.process.poll() is not None or time.monotonic() > end:
                raise RuntimeError("It does not come up: " + self.log.read_text())
            time.sleep(0.05)
        self.address = found[1]

    def end(self):
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()


class Page(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self.addCleanup(place.cleanup)
        self.folder = pathlib.Path(place.name)

    def render(self, *options):
        render = Render(self.folder, *options)
        self.addCleanup(render.end)
        return render

    def browse(self, address, width=1280, height=800, mobile=False):
        browser = Browser(self.folder / "profile", width, height, mobile, PATIENCE)
        self.addCleanup(browser.close)
        browser.open(address)
        return browser

    def test_shows_the_render_and_ends_it(self):
        render = self.render("--time", "3000", "--layers", "emitter-hit,next-event,connection,merge,splat")
        browser = self.browse(render.address)
        # The picture, in more than a few colours.
        browser.until("shown.picture")
        browser.until(PAINTED + "('picture').colours > 200")
        self.assertGreater(browser.value(PAINTED + "('picture').lit"), 0.3)
        # It converges: other pictures follow, of more iterations.
        before = browser.value("shown.picture.iterations")
        browser.until(f"shown.picture.iterations > {before}")
        # The error, its plot and what limits it.
        browser.until("latest.history.length >= 3")
        self.assertRegex(browser.until("document.getElementById('percent').textContent"), r"^[\d.]+ %$")
        self.assertGreater(browser.until(PAINTED + "('plot').colours"), 10)
        self.assertTrue(browser.value("document.getElementById('limit').textContent"))
        # Who renders, and at what.
        self.assertIn("local", browser.value("document.getElementById('nodes').textContent"))
        browser.until("document.querySelectorAll('.stage-line').length >= 3")
        # Each technique alone adds up to no more than all, and none of them to nothing.
        mean = "shown.picture.halves.reduce((sum, h) => sum + halfValue[h], 0)"
        all_of_them = browser.value(mean)
        for button in range(5):
            browser.value(f"document.querySelectorAll('#techniques button')[{button}].click()")
        browser.until("shown.picture.bits === 0")
        self.assertEqual(browser.value(mean), 0)
        browser.value("document.querySelectorAll('#techniques button')[1].click()")
        browser.until("shown.picture.bits === 2")
        self.assertLess(0, browser.value(mean))
        self.assertLess(browser.value(mean), all_of_them * 1.2)
        # Exposure is applied here: a stop more is brighter.
        grey = "(() => { develop(); const s = shown.surface, {data} = s.getContext('2d').getImageData(0, 0, s.width, s.height); return data.reduce((a, b) => a + b, 0); })()"
        browser.value("shown.fixed = 0")
        dim = browser.value(grey)
        browser.value("shown.fixed = 1")
        self.assertGreater(browser.value(grey), dim)
        # Written now, and it goes on.
        self.assertFalse((self.folder / "out.exr").exists())
        browser.until("!document.getElementById('write').disabled")
        browser.value("document.getElementById('write').click()")
        end = time.monotonic() + PATIENCE
        while not (self.folder / "out.png").exists() and time.monotonic() < end:
            time.sleep(0.1)
        self.assertTrue((self.folder / "out.exr").exists())
        self.assertIsNone(render.process.poll())
        # Finished now: its files are written, and the page says so.
        (self.folder / "out.exr").unlink()
        browser.until("!document.getElementById('finish').disabled")
        browser.value("document.getElementById('finish').click()")
        self.assertEqual(render.process.wait(PATIENCE), 0, render.log.read_text())
        self.assertTrue((self.folder / "out.exr").exists())
        self.assertIn("stopped because its page asked for it", render.log.read_text())
        self.assertIn("Wrote out.exr and out.png.", browser.until("latest.done && document.getElementById('notes').textContent"))
        self.assertEqual(browser.complaints, [])

    def test_shows_the_film_s_own_tone_curve(self):
        render = self.render("--time", "3000", "--exposure", "0.5", "--technique", "pt")
        browser = self.browse(render.address)
        browser.until("shown.picture && !document.getElementById('finish').disabled")
        browser.value("document.getElementById('finish').click()")
        browser.until("latest.done && shown.picture.iterations === latest.iterations")
        self.assertEqual(render.process.wait(PATIENCE), 0, render.log.read_text())
        shown = browser.value("(() => { const s = shown.surface; return [...s.getContext('2d').getImageData(0, 0, s.width, s.height).data]; })()")
        # The PNG that the render wrote, as the browser reads it.
        png = base64.b64encode((self.folder / "out.png").read_bytes()).decode()
        browser.open("about:blank")
        written = browser.value(
            "(async () => { const image = new Image(); image.src = 'data:image/png;base64,%s'; await image.decode(); const c = document.createElement('canvas');"
            "c.width = image.width; c.height = image.height; const p = c.getContext('2d'); p.drawImage(image, 0, 0);"
            "return [...p.getImageData(0, 0, c.width, c.height).data]; })()" % png)
        self.assertEqual(len(shown), len(written))
        apart = [abs(a - b) for a, b in zip(shown, written)]
        # Halves have 11 bits, so that a step of 8 bits may fall the other way.
        self.assertLessEqual(max(apart), 1)
        self.assertLess(sum(map(bool, apart)), 0.1 * len(apart))

    def test_asks_for_the_token_and_takes_it_from_its_address(self):
        secret = self.folder / "token"
        secret.write_text("9f2c7be1538d4a60c1e7f0b3a2d4968e\n")
        secret.chmod(0o600)
        render = self.render("--time", "3000", "--view-token", str(secret))
        self.assertTrue(render.address.endswith("/#TOKEN"), render.address)
        address = render.address.removesuffix("#TOKEN")
        browser = self.browse(address)
        browser.until("document.getElementById('phase').textContent.includes('token')")
        self.assertIsNone(browser.value("latest"))
        browser.open("about:blank")
        browser.open(address + "#" + secret.read_text().strip())
        browser.until("shown.picture")
        browser.until("!document.getElementById('finish').disabled")
        browser.value("document.getElementById('finish').click()")
        self.assertEqual(render.process.wait(PATIENCE), 0, render.log.read_text())

    def test_fits_a_phone(self):
        render = self.render("--time", "3000")
        browser = self.browse(render.address, 390, 844, mobile=True)
        browser.until("latest?.error && shown.picture")
        self.assertLessEqual(browser.value("document.documentElement.scrollWidth"), 390)
        self.assertGreater(browser.value(PAINTED + "('picture').lit"), 0.1)
        self.assertEqual(browser.complaints, [])


if __name__ == "__main__":
    if not Browser.program():
        print("There is no Chromium on this machine: the page is not opened.")
        sys.exit(SKIPPED)
    unittest.main()
