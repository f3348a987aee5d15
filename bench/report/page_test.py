#!/usr/bin/python3
"""page_test.py PAGE: drives the report in headless Chromium (Debian: chromium-driver,
python3-selenium), at desktop and phone width, light and dark. No console errors, no request leaves
the page, nothing is wider than the window, texts of a chart do not overlap, pictures are whole,
and what is pointed at shows its values. Exit code 77: no browser here. --shots DIR keeps pictures
of it."""

import json
import pathlib
import sys

try:
    from selenium import webdriver
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.chrome.service import Service
except ImportError:
    sys.exit(77)

OVERLAPS = """
const found = [];
for (const chart of document.querySelectorAll('figure > svg.chart')) {
  const shown = [...chart.querySelectorAll('text')].filter(t => t.getClientRects().length > 0);
  const texts = shown.map(t => [t, t.getBoundingClientRect()]);
  const page = chart.getBoundingClientRect();
  texts.forEach(([a, p], i) => {
    if (p.left < page.left - 1 || p.right > page.right + 1 ||
        p.top < page.top - 1 || p.bottom > page.bottom + 1)
      found.push('cut: ' + a.textContent);
    texts.slice(i + 1).forEach(([b, q]) => {
      if (p.left < q.right - 1 && q.left < p.right - 1 && p.top < q.bottom - 1 && q.top < p.bottom - 1)
        found.push(a.textContent + ' / ' + b.textContent);
    });
  });
}
return found;
"""


BROKEN = """
return [...document.images].filter(image => image.naturalWidth === 0).map(image => 'broken: ' + image.alt);
"""


def open_browser(width, dark):
    options = webdriver.ChromeOptions()
    options.binary_location = "/usr/bin/chromium"
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic",
                     "--no-first-run", "--disable-background-networking",
                     "--disable-component-update", "--disable-sync", "--hide-scrollbars"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    browser = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
        "width": width, "height": 900, "deviceScaleFactor": 1, "mobile": width < 600})
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [
        {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}]})
    return browser


def requests_of(browser):
    for entry in browser.get_log("performance"):
        message = json.loads(entry["message"])["message"]
        if message["method"] == "Network.requestWillBeSent":
            yield message["params"]["request"]["url"]


def check_tips(browser, problems):
    marks = browser.find_elements("css selector", "[data-tip]")
    if len(marks) < 50:
        problems.append(f"only {len(marks)} marks have values")
    for mark in marks[:: max(1, len(marks) // 12)]:
        browser.execute_async_script("""
            arguments[0].scrollIntoView({block: 'center'});
            requestAnimationFrame(() => requestAnimationFrame(arguments[1]));""", mark)
        browser.execute_cdp_cmd("Input.dispatchMouseEvent", {"type": "mouseMoved", "x": 1, "y": 1})
        ActionChains(browser).move_to_element(mark).perform()
        tip = browser.find_element("id", "tip")
        if not tip.is_displayed() or not any(c.isdigit() for c in tip.text):
            problems.append("no value where one points at " + mark.get_attribute("data-tip"))


def check(page, width, dark, shots):
    problems = []
    browser = open_browser(width, dark)
    try:
        browser.get(page.as_uri())
        if browser.execute_script("return document.documentElement.scrollWidth") > width:
            problems.append("wider than the window")
        problems += browser.execute_script(OVERLAPS)
        problems += browser.execute_script(BROKEN)
        if shots:
            height = browser.execute_script("return document.documentElement.scrollHeight")
            browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
                "width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600})
            browser.save_screenshot(f"{shots}/{width}-{'dark' if dark else 'light'}.png")
            browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
                "width": width, "height": 900, "deviceScaleFactor": 1, "mobile": width < 600})
        check_tips(browser, problems)
        problems += [entry["message"] for entry in browser.get_log("browser")]
        problems += ["asks for " + url for url in requests_of(browser)
                     if not url.startswith(("file://" + str(page), "data:"))]
    finally:
        browser.quit()
    return [f"{width} {'dark' if dark else 'light'}: {problem}" for problem in problems]


def main():
    page = pathlib.Path(sys.argv[1]).resolve()
    shots = sys.argv[3] if len(sys.argv) > 3 and sys.argv[2] == "--shots" else None
    if not pathlib.Path("/usr/bin/chromedriver").exists():
        return 77
    problems = [problem for width in (1280, 360) for dark in (False, True)
                for problem in check(page, width, dark, shots)]
    print("\n".join(problems) if problems else "the page is in order")
    return 1 if problems else 0


sys.exit(main())
