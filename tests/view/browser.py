"""What the tests of the page share: headless Chromium (Debian: chromium-driver, python3-selenium), a
server of `boule view`, and what a hand does. Ends the program with 77 where there is no browser."""

import pathlib
import subprocess
import sys

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.support.ui import Select, WebDriverWait
except ImportError:
    print("python3-selenium is missing")
    sys.exit(77)

DRIVER = pathlib.Path("/usr/bin/chromedriver")
PATIENCE = 120  # seconds after which something hangs; nothing is expected to take long


def need_browser():
    if not DRIVER.exists():
        print("chromium-driver is missing")
        sys.exit(77)


class Server:
    """`boule view` with these arguments, until close(), or for minutes if that never comes."""

    def __init__(self, program, arguments, folder):
        self.process = subprocess.Popen(
            [program, "view", *arguments, "--idle", "5m"], cwd=folder, stdout=subprocess.PIPE, text=True)
        self.url = self.process.stdout.readline().strip()
        if not self.url.startswith("http://"):
            raise RuntimeError(f"boule view printed no address but: {self.url!r}")

    @property
    def port(self):
        return self.url.split(":")[2].split("/")[0]

    def close(self):
        self.process.terminate()
        self.process.wait(PATIENCE)
        self.process.stdout.close()


class Browser:
    """One window, driven as by hand."""

    def __init__(self):
        options = webdriver.ChromeOptions()
        options.binary_location = "/usr/bin/chromium"
        for argument in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--disable-gpu",
                         "--disable-quic", "--no-first-run", "--disable-background-networking",
                         "--disable-component-update", "--disable-sync", "--hide-scrollbars"):
            options.add_argument(argument)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self.driver = webdriver.Chrome(service=Service(str(DRIVER)), options=options)
        self.driver.set_script_timeout(PATIENCE)
        self.resize(1280, 800)

    def close(self):
        self.driver.quit()

    def resize(self, width, height):
        self.cdp("Emulation.setDeviceMetricsOverride", width=width, height=height,
                 deviceScaleFactor=1, mobile=width < 600)
        self.cdp("Emulation.setTouchEmulationEnabled", enabled=width < 600)
        self.script("return new Promise(f => requestAnimationFrame(() => requestAnimationFrame(f)))")

    def scheme(self, name):
        self.cdp("Emulation.setEmulatedMedia",
                 features=[{"name": "prefers-color-scheme", "value": name}])

    def cdp(self, command, **arguments):
        return self.driver.execute_cdp_cmd(command, arguments)

    def script(self, text, *arguments):
        return self.driver.execute_script(text, *arguments)

    def find(self, selector):
        return self.driver.find_element("css selector", selector)

    def wait(self, condition, what):
        """Waits until a JavaScript expression is true; its value."""
        return WebDriverWait(self.driver, PATIENCE, 0.05).until(
            lambda driver: driver.execute_script(f"return {condition}"), f"never came: {what}")

    def open(self, url):
        self.driver.get(url)
        self.rest()

    def rest(self):
        """Waits until all pictures are finished and show what was asked for last."""
        self.wait("""(() => {
            const {session, panes} = window.bouleView ?? {};
            if (!session?.state || session.pending) return false;
            return panes.panes.every(({element, shown}) =>
                element.dataset.finished === 'true' && shown.number >= session.number);
            })()""", "a picture at rest")

    def camera(self):
        return self.script("return structuredClone(bouleView.session.camera)")

    def pixels(self, pane=0):
        """The picture's bytes, RGB row by row."""
        hexadecimal = self.script("""
            const canvas = document.querySelectorAll('.view canvas')[arguments[0]];
            const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
            let text = '';
            for (let i = 0; i < data.length; i += 4)
              text += ((data[i] << 16) + (data[i + 1] << 8) + data[i + 2]).toString(16).padStart(6, '0');
            return text;""", pane)
        return bytes.fromhex(hexadecimal)

    def choose(self, selector, value):
        Select(self.find(selector)).select_by_value(value)

    def center(self, selector=".view"):
        box = self.script("""
            const element = document.querySelector(arguments[0]);
            element.scrollIntoView({block: 'nearest'});
            const box = element.getBoundingClientRect();
            return [box.left + box.width / 2, box.top + box.height / 2];""", selector)
        return box[0], box[1]

    def mouse(self, kind, x, y, button="none", **more):
        self.cdp("Input.dispatchMouseEvent", type=kind, x=x, y=y, button=button,
                 buttons={"none": 0, "left": 1, "right": 2}[button], clickCount=1, **more)

    def drag(self, by_x, by_y, button="left", modifiers=0):
        x, y = self.center()
        self.mouse("mouseMoved", x, y)
        self.mouse("mousePressed", x, y, button, modifiers=modifiers)
        for step in range(1, 5):
            self.mouse("mouseMoved", x + by_x * step / 4, y + by_y * step / 4, button,
                       modifiers=modifiers)
        self.mouse("mouseReleased", x + by_x, y + by_y, button, modifiers=modifiers)

    def click(self, off_x=0, off_y=0, selector=".view"):
        x, y = self.center(selector)
        self.mouse("mousePressed", x + off_x, y + off_y, "left")
        self.mouse("mouseReleased", x + off_x, y + off_y, "left")

    def touch(self, *paths):
        """Fingers that go from the first to the last point of their paths, counted from the middle."""
        x, y = self.center()
        points = [[{"x": x + px, "y": y + py, "id": finger} for finger, (px, py) in enumerate(step)]
                  for step in zip(*paths)]
        self.cdp("Input.dispatchTouchEvent", type="touchStart", touchPoints=points[0])
        for step in points[1:]:
            self.cdp("Input.dispatchTouchEvent", type="touchMove", touchPoints=step)
        self.cdp("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])

    def keys(self, *keys):
        self.script("document.querySelector('.view').focus()")
        self.driver.switch_to.active_element.send_keys(*keys)

    def complaints(self):
        """The console's errors, but that a connection was refused or lost."""
        expected = ("WebSocket connection", "ERR_CONNECTION_REFUSED", "status of 403", "favicon.ico")
        return [entry["message"] for entry in self.driver.get_log("browser")
                if entry["level"] == "SEVERE" and not any(e in entry["message"] for e in expected)]
