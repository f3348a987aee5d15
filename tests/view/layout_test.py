#!/usr/bin/python3
"""layout_test.py BOULE SCENES [AXE]: the page of `boule view` at desktop and phone width. Without AXE:
no text is cut and nothing is wider than the window. With AXE, axe-core's axe.min.js: it finds
nothing against WCAG AA, light and dark. Exit code 77: no browser, or no such file.
BOULE_SHOTS=DIR keeps pictures of it."""

import os
import pathlib
import sys
import unittest

import browser as hands

PROGRAM, SCENES = sys.argv[1], pathlib.Path(sys.argv[2])
AXE = pathlib.Path(sys.argv[3]) if len(sys.argv) > 3 else None
SHOTS = os.environ.get("BOULE_SHOTS")
WINDOWS = {1280: 800, 390: 844} if AXE else {1280: 800, 390: 844, 320: 640}  # 320: WCAG's reflow

# A text is cut if what holds it has less room than it needs, or ends beyond the window. A select
# shows its chosen option beside an arrow; its own width says nothing about it.
CUT = """
const found = [];
const shown = [...document.body.querySelectorAll('*')].filter(e => e.checkVisibility());
const measure = document.createElement('canvas').getContext('2d');
for (const e of shown) {
  if (e.closest('.hidden-label, svg')) continue;
  const ownText = [...e.childNodes].some(n => n.nodeType === 3 && n.textContent.trim());
  const style = getComputedStyle(e);
  if (e.tagName === 'SELECT') {
    measure.font = style.font;
    const arrow = 18;
    const room = e.clientWidth - parseFloat(style.paddingLeft) - parseFloat(style.paddingRight) - arrow;
    const text = e.selectedOptions[0]?.text ?? '';
    if (measure.measureText(text).width > room) found.push('select: ' + text);
  } else if (ownText || e.matches('input, textarea')) {
    if (style.display !== 'inline' && e.scrollWidth > e.clientWidth + 1)
      found.push('cut: ' + (e.textContent || e.value));
    if (e.tagName === 'TEXTAREA' && e.scrollHeight > e.clientHeight + 1) found.push('cut: ' + e.value);
    for (const box of e.getClientRects())
      if (box.left < -0.5 || box.right > innerWidth + 0.5) found.push('outside: ' + (e.textContent || e.id));
  }
}
if (document.documentElement.scrollWidth > innerWidth) found.push('the page is wider than the window');
return found;
"""

AXE_RUN = """
return axe.run(document, {runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice']})
    .then(({violations, passes}) => ({passes: passes.length, violations: violations.map(
        v => v.id + ': ' + v.help + ' ' + v.nodes.map(n => n.target.join(' ')).join(', '))}));
"""


class Layout(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = hands.Browser()

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()

    def look(self, name):
        """At every width, and in every scheme."""
        for width, height in WINDOWS.items():
            self.browser.resize(width, height)
            if not AXE:
                with self.subTest(page=name, width=width):
                    self.assertEqual(self.browser.script(CUT), [])
            for scheme in ("light", "dark"):
                self.browser.scheme(scheme)
                if SHOTS:
                    self.browser.driver.save_screenshot(f"{SHOTS}/{name}-{width}-{scheme}.png")
                if AXE:
                    with self.subTest(page=name, width=width, scheme=scheme):
                        self.check_by_axe()
        self.browser.resize(1280, 800)

    def check_by_axe(self):
        if not self.browser.script("return 'axe' in window"):
            self.browser.script(AXE.read_text())
        result = self.browser.script(AXE_RUN)
        self.assertGreater(result["passes"], 20)
        self.assertEqual(result["violations"], [])

    def test_a_scene(self):
        browser = self.browser
        server = hands.Server(
            PROGRAM, ["false_shadows.toml", "--size", "320x180", "--spp", "2"], SCENES)
        try:
            browser.open(server.url)
            for section in ("keys-section", "quality-section"):
                browser.script(f"document.querySelector('#{section}').open = true")
            self.look("one")
            browser.choose("#compare", "shadow_epsilon")
            browser.wait("bouleView.session.state.settings.panes.length === 2", "two panes")
            browser.choose("#difference", "color")
            browser.wait("bouleView.panes.panes.length === 3", "a difference")
            browser.rest()
            self.look("two")
            browser.click()
            browser.wait("document.querySelectorAll('#ray-tree li').length > 1", "rays")
            browser.find("#copy-toml").click()
            browser.wait("document.querySelector('#copied-text').value", "the camera as TOML")
            browser.script("bouleView.session.change({size: [0, 5]})")
            browser.wait("document.querySelector('#problem p')", "an error")
            self.look("rays")
        finally:
            server.close()

    def test_a_series(self):
        browser = self.browser
        server = hands.Server(
            PROGRAM, ["wave.xyz", "--quick", "--size", "320x240", "--color", "vz", "--frames", "0-9"],
            SCENES)
        try:
            browser.open(server.url)
            self.look("series")
        finally:
            server.close()


if __name__ == "__main__":
    hands.need_browser()
    if AXE and not AXE.exists():
        print(f"axe-core is missing: {AXE}")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1], verbosity=2)
