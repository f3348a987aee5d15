#!/usr/bin/python3
"""page_test.py BOULE SCENES: the page of `boule view` by mouse, keyboard and touch, and whether its
pictures are those of `boule render`. Exit code 77: no browser here."""

import math
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import unittest

import browser as hands
from selenium.webdriver.common.keys import Keys

PROGRAM, SCENES = sys.argv[1], pathlib.Path(sys.argv[2])
SIZE = "256x144"


def distance(a, b):
    return math.dist(a, b)


def pixels_of(path):
    """The bytes RGB of a PPM picture."""
    data = path.read_bytes()
    return data[re.match(rb"P6\s+\d+\s+\d+\s+255\s", data).end():]


def scene_with(camera):
    """first_light.toml with another [camera], as somebody would paste it."""
    text = (SCENES / "first_light.toml").read_text()
    before, rest = text.split("[camera]\n")
    return before + camera.rstrip() + "\n\n" + rest[rest.index("\n[") + 1:]


# Whether what has the focus has an outline, and whether it is not covered.
FOCUS = """
const focused = document.activeElement;
const {outlineStyle, outlineWidth} = getComputedStyle(focused);
const {left, top, width, height} = focused.getBoundingClientRect();
const there = document.elementFromPoint(left + width / 2, top + height / 2);
return [outlineStyle !== 'none' && outlineWidth !== '0px',
        there !== null && (focused.contains(there) || there.contains(focused))];
"""


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.browser = hands.Browser()
        cls.server = hands.Server(
            PROGRAM, ["first_light.toml", "--size", SIZE, "--spp", "2"], SCENES)

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.server.close()
        cls.folder.cleanup()

    def setUp(self):
        self.browser.resize(1280, 800)
        self.browser.open(self.server.url)
        if self.browser.script("return bouleView.session.state.settings.panes.length") > 1:
            self.browser.choose("#compare", "")
        self.browser.find("#reset").click()
        self.browser.rest()

    def tearDown(self):
        self.assertEqual(self.browser.complaints(), [])

    def moved(self, act):
        """The camera before and after; the picture has to be another one."""
        before, old = self.browser.camera(), self.browser.pixels()
        act()
        self.browser.rest()
        after = self.browser.camera()
        self.assertNotEqual(before, after)
        self.assertNotEqual(old, self.browser.pixels())
        return before, after

    def picture_of_command(self, expected):
        """The bytes RGB of what the copied command line renders; it has these words."""
        self.browser.find("#copy-command").click()
        words = shlex.split(self.browser.wait(
            "(text => text.startsWith('boule') && text)(document.querySelector('#copied-text').value)",
            "the command line"))
        at = words.index(expected[0]) if expected else 0
        self.assertEqual(words[at:at + len(expected)], expected)
        path = pathlib.Path(self.folder.name) / "command.ppm"
        words[words.index("-o") + 1] = str(path)
        subprocess.run([PROGRAM, *words[1:], "-q"], cwd=SCENES, check=True)
        return pixels_of(path)

    def expect_orbit(self, before, after):
        self.assertEqual(before["look_at"], after["look_at"])
        self.assertNotEqual(before["eye"], after["eye"])
        self.assertAlmostEqual(distance(before["eye"], before["look_at"]),
                               distance(after["eye"], after["look_at"]), 9)

    def expect_pan(self, before, after):
        shift = [b - a for a, b in zip(before["eye"], after["eye"])]
        self.assertGreater(math.hypot(*shift), 0)
        for a, b, step in zip(before["look_at"], after["look_at"], shift):
            self.assertAlmostEqual(b - a, step, 9)

    def expect_dolly(self, before, after, nearer):
        self.assertEqual(before["look_at"], after["look_at"])
        ratio = distance(after["eye"], after["look_at"]) / distance(before["eye"], before["look_at"])
        self.assertEqual(ratio < 1, nearer)
        for axis in range(3):
            self.assertAlmostEqual(after["eye"][axis] - after["look_at"][axis],
                                   ratio * (before["eye"][axis] - before["look_at"][axis]), 9)

    def test_mouse_moves_the_camera(self):
        browser = self.browser
        before, after = self.moved(lambda: browser.drag(80, 0))
        self.expect_orbit(before, after)
        self.assertAlmostEqual(before["eye"][1], after["eye"][1], 9)
        self.expect_pan(*self.moved(lambda: browser.drag(40, 20, "right")))
        self.expect_pan(*self.moved(lambda: browser.drag(-40, 20, modifiers=8)))
        x, y = browser.center()
        self.expect_dolly(*self.moved(
            lambda: browser.mouse("mouseWheel", x, y, deltaX=0, deltaY=-120)), nearer=True)

    def test_keys_move_the_camera(self):
        browser = self.browser
        self.expect_orbit(*self.moved(lambda: browser.keys(Keys.ARROW_LEFT, Keys.ARROW_UP)))
        self.expect_pan(*self.moved(lambda: browser.keys(Keys.SHIFT + Keys.ARROW_RIGHT)))
        self.expect_dolly(*self.moved(lambda: browser.keys("+")), nearer=True)
        self.expect_dolly(*self.moved(lambda: browser.keys("-")), nearer=False)
        before, after = self.moved(lambda: browser.keys("]"))
        self.assertGreater(after["fov"], before["fov"])
        self.moved(lambda: browser.keys("f"))
        self.assertEqual(browser.camera()["look_at"],
                         browser.script("return bouleView.session.state.bounds.center"))
        browser.open(self.server.url)  # what was at the beginning is known to a page that comes later
        browser.keys("r")
        browser.rest()
        self.assertEqual(browser.camera()["eye"], [0.6, 2.3, 11.5])

    def test_touch_moves_the_camera(self):
        browser = self.browser
        browser.resize(390, 844)
        self.expect_orbit(*self.moved(lambda: browser.touch([(0, 0), (20, 0), (60, 10)])))
        self.expect_dolly(*self.moved(lambda: browser.touch(
            [(-20, 0), (-40, 0), (-60, 0)], [(20, 0), (40, 0), (60, 0)])), nearer=True)
        self.expect_pan(*self.moved(lambda: browser.touch(
            [(-20, 0), (-20, 20), (-20, 40)], [(20, 0), (20, 20), (20, 40)])))

    def test_the_keyboard_reaches_everything_and_leaves_it(self):
        for width, height, back in ((1280, 800, False), (390, 844, True)):
            with self.subTest(width=width):
                self.browser.resize(width, height)
                self.check_keyboard(self.browser, back)

    def check_keyboard(self, browser, back):
        """Tab, or back Shift and Tab, go from one control to the next, each of which shows that it
        has the focus and lies under nothing else."""
        expected = browser.script("""
            const reach = 'a[href], button, input, select, summary, textarea, [tabindex="0"]';
            const found = [...document.querySelectorAll(reach)]
                .filter(e => e.checkVisibility({contentVisibilityAuto: true}) && !e.disabled)
                .filter(e => e.type !== 'radio' || e.checked);
            return arguments[0] ? found.reverse() : found;""", back)
        forth, return_key = Keys.TAB, Keys.SHIFT + Keys.TAB
        if back:
            forth, return_key = return_key, forth
        browser.script("arguments[0].focus()", expected[1])
        expected[1].send_keys(return_key)
        for element in expected:
            focused = browser.driver.switch_to.active_element
            self.assertEqual(focused, element, focused.get_attribute("outerHTML"))
            self.assertEqual(browser.script(FOCUS), [True, True], focused.get_attribute("outerHTML"))
            focused.send_keys(forth)
        left = browser.driver.switch_to.active_element  # a headless window begins again, backwards
        self.assertEqual(left.tag_name, "summary" if back else "body")

    def test_resting_picture_matches_render(self):
        browser = self.browser
        browser.drag(90, 35)
        browser.rest()
        shown = browser.pixels()
        browser.find("#copy-toml").click()
        toml = browser.wait("document.querySelector('#copied-text').value", "the camera as TOML")
        self.assertIn("[camera]", toml)
        path = pathlib.Path(self.folder.name) / "copied.toml"
        path.write_text(scene_with(toml))
        picture = path.with_suffix(".ppm")
        subprocess.run([PROGRAM, "render", path, "-o", picture, "--size", SIZE, "--spp", "2", "-q"],
                       check=True)
        self.assertEqual(shown, pixels_of(picture))

        self.assertEqual(shown, self.picture_of_command([]))

    def test_saves_the_picture(self):
        browser = self.browser
        browser.cdp("Browser.setDownloadBehavior", behavior="allow", downloadPath=self.folder.name)
        browser.find("#save").click()
        name = browser.wait("document.querySelector('#saved a')?.textContent", "the saved picture")
        self.assertEqual(name, "first_light.png")
        same = browser.script("""
            return fetch(document.querySelector('#saved a').href).then(a => a.blob())
                .then(b => createImageBitmap(b, {colorSpaceConversion: 'none'})).then(bitmap => {
                  const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
                  const context = canvas.getContext('2d');
                  context.drawImage(bitmap, 0, 0);
                  const shown = document.querySelector('.view canvas').getContext('2d');
                  const size = [0, 0, bitmap.width, bitmap.height];
                  const [a, b] = [context, shown].map(c => c.getImageData(...size).data);
                  return bitmap.width > 0 && a.every((code, i) => code === b[i]);
                })""")
        self.assertTrue(same)

    def test_a_lost_connection_keeps_the_save(self):
        browser = self.browser
        browser.script("""
            const {session} = bouleView;
            session.on('saving', ({share}) => {
              window.lastShare = share;
              window.least = Math.min(window.least ?? 1, share);
            });
            session.ask({type: 'save', pane: 0, format: 'png', spp: 500}, 'saved')
                .then(({url}) => { window.end = url; }, ({message}) => { window.end = message; });""")
        share = browser.wait("window.lastShare", "a picture that is being saved")
        browser.script("delete window.least; bouleView.session.connection.socket.close()")
        self.assertRegex(browser.wait("window.end", "the saved picture"), "^/picture/")
        self.assertGreaterEqual(browser.script("return window.least ?? 1"), share)

    def test_a_lost_save_can_be_stopped(self):
        browser = self.browser
        browser.script("""
            const reject = ({message}) => { window.end = message; };
            bouleView.session.waiting.set(5, {type: 'saved', reject});
            bouleView.session.stopSaving();""")
        self.assertEqual(browser.wait("window.end", "the end"), "you save no such picture")

    def test_orders_change_and_panes_agree(self):
        browser = self.browser
        finished = browser.pixels()
        for order in ("rows", "tiles", "frameless", "progressive"):
            browser.choose("#order-0", f'"{order}"')
            browser.wait(f"bouleView.session.state.settings.panes[0].order === '{order}'", order)
            browser.rest()
            self.assertEqual(browser.pixels(), finished)
        browser.choose("#compare", "order")
        browser.wait("bouleView.session.state.settings.panes.length === 2", "two panes")
        browser.drag(50, 20)
        browser.rest()
        orders = browser.script("return bouleView.session.state.settings.panes.map(p => p.order)")
        self.assertEqual(orders, ["rows", "frameless"])
        self.assertEqual(browser.pixels(0), browser.pixels(1))
        self.assertNotEqual(browser.pixels(0), finished)

    def test_epsilon_and_difference_show(self):
        browser = self.browser
        browser.choose("#compare", "shadow_epsilon")
        browser.wait("bouleView.session.state.settings.panes.length === 2", "two panes")
        browser.choose("#shadow_epsilon-1", '"none"')
        browser.choose("#difference", "color")
        browser.wait("bouleView.panes.panes.length === 3 &&"
                     "bouleView.session.state.settings.panes[1].shadow_epsilon === 'none'",
                     "a difference")
        browser.rest()
        a, b, difference = (browser.pixels(pane) for pane in range(3))
        self.assertNotEqual(a, b)
        for at in range(0, len(a), 3):
            self.assertEqual(a[at:at + 3] != b[at:at + 3], any(difference[at:at + 3]), at)
        browser.choose("#share-pane", "1")
        self.assertEqual(b, self.picture_of_command(["--shadow-epsilon", "none"]))

    def test_a_pixel_shows_its_rays(self):
        browser = self.browser
        browser.click()
        browser.wait("document.querySelectorAll('#ray-tree li').length > 1", "a tree of rays")
        facts = browser.find("#hit").text
        for word in ("Pixel", "Primitive", "sphere 0", "Normal", "Radiance"):
            self.assertIn(word, facts)
        tree = browser.find("#ray-tree").text
        for word in ("Primary ray", "Reflection", "Shadow ray", "to light", "weight", "result"):
            self.assertIn(word, tree)
        self.assertTrue(browser.script("return document.querySelector('.overlay path') !== null"))
        browser.keys("l", "k", Keys.ENTER)
        browser.wait("document.querySelector('#hit').textContent.includes('129, 73')",
                     "the pixel of the cross")
        browser.keys(Keys.ESCAPE)
        self.assertFalse(browser.find("#rays").is_displayed())

    def test_sides_and_pivot(self):
        """Looks from each side of the axes; a double click turns around the point that is hit."""
        browser = self.browser
        up = browser.camera()["up"]
        for side, axis, sign in (("x", 0, 1), ("-z", 2, -1), ("y", 1, 1)):
            before, after = self.moved(
                lambda side=side: browser.find(f"[data-side='{side}']").click())
            back = [e - a for e, a in zip(after["eye"], after["look_at"])]
            far = distance(before["eye"], before["look_at"])
            self.assertEqual(before["look_at"], after["look_at"])
            self.assertAlmostEqual(back[axis], sign * far, 9)
            self.assertNotEqual(after["up"] == up, side == "y")
        self.moved(lambda: browser.keys("x"))
        self.moved(lambda: browser.keys("r"))
        home = browser.camera()
        x, y = browser.center()
        browser.click()
        browser.wait("document.querySelectorAll('#ray-tree li').length > 1", "a tree of rays")
        pixel = re.match(r"Pixel(\d+), (\d+)", browser.script("return document.querySelector('#hit').textContent"))
        point = browser.script(
            "return bouleView.session.ask({type: 'pick', pane: 0, x: arguments[0], y: arguments[1]}, 'picked')"
            ".then(({hit}) => hit.position)", *map(int, pixel.groups()))
        for count in (1, 2):
            for kind in ("mousePressed", "mouseReleased"):
                browser.cdp("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left",
                            clickCount=count)
        browser.wait(f"bouleView.session.camera.look_at[1] !== {home['look_at'][1]!r}", "a pivot")
        self.assertEqual(browser.camera()["look_at"], point)

    def test_axes_show_and_go(self):
        browser = self.browser
        self.assertEqual(browser.script(
            "return [...document.querySelectorAll('.axis-name')].map(e => e.textContent).sort().join('')"), "xyz")
        browser.find("#axes").click()
        self.assertEqual(browser.script("return document.querySelectorAll('.axis-name').length"), 0)
        browser.find("#axes").click()

    def test_captions_are_words(self):
        self.assertEqual(self.browser.script(
            "return import('./panes.js').then(({sampleText}) => [sampleText(0.107, 16), sampleText(3.26, 16), sampleText(1, 1)])"),
            ["10 % of the pixels", "3.2 of 16 samples a pixel", "1 of 1 sample a pixel"])

    def test_click_sets_lens_focus(self):
        browser = self.browser
        self.assertFalse(browser.find("#click-focus").is_enabled())
        browser.choose("#camera-type", "thin_lens")
        browser.wait("bouleView.session.camera.focus !== undefined", "a thin lens")
        browser.find("#click-focus").click()
        browser.click()
        browser.wait("typeof bouleView.session.camera.focus === 'number'", "a focus")
        browser.rest()
        camera = browser.camera()
        self.assertLess(camera["focus"], distance(camera["eye"], camera["look_at"]))

    def test_an_unknown_camera_gets_its_rows(self):
        browser = self.browser
        browser.script("""
            const state = structuredClone(bouleView.session.state);
            state.choices.camera_types.push('two_eyes');
            state.choices.cameras.two_eyes = {projection: 'other', keys: {
              eye: {kind: 'point'}, up: {kind: 'direction'},
              eye_turn: {kind: 'number', low: -5, high: 5, unit: 'degrees', optional: true},
              shown: {kind: 'name', names: ['left', 'right']}}};
            state.number = bouleView.session.number;
            Object.assign(state.camera, {type: 'two_eyes', eye_turn: 2.5, shown: 'right'});
            bouleView.session.take(state);""")
        labels = browser.script("""
            return [...document.querySelectorAll('#camera-section .row label')].map(e => e.textContent)""")
        self.assertEqual(labels, ["Kind", "Eye turn", "Shown"])
        self.assertEqual(browser.find("#camera-type").get_attribute("value"), "two_eyes")
        self.assertEqual(browser.find("#camera-eye_turn").get_attribute("value"), "2.5")
        self.assertEqual(browser.find("#camera-shown").get_attribute("value"), "right")
        self.enter("#camera-eye_turn", "6")
        self.assertEqual(browser.find("#camera-eye_turn-wrong").text,
                         "Expected a number from -5 to 5, or nothing.")
        browser.choose("#camera-shown", "left")
        self.assertEqual(browser.camera()["shown"], "left")

    def test_an_error_is_a_sentence(self):
        browser = self.browser
        browser.script("bouleView.session.change({size: [0, 5]})")
        text = browser.wait("document.querySelector('#problem p')?.textContent", "an error")
        self.assertRegex(text, r"^[A-Zs].*\.$")
        browser.find("#problem button").click()
        self.assertEqual(browser.find("#problem").text, "")

    def enter(self, selector, text):
        field = self.browser.find(selector)
        field.clear()
        field.send_keys(text, Keys.ENTER)

    def test_refused_fields_keep_words_until_right(self):
        browser = self.browser
        browser.choose("#camera-type", "thin_lens")
        browser.wait("bouleView.session.camera.focus !== undefined", "a thin lens")
        browser.choose("#shadow_epsilon-0", "other")
        fields = browser.script("""
            return [...document.querySelectorAll('#panel input[inputmode]')]
                .filter((field) => field.offsetParent !== null).map((field) => field.id);""")
        for name in ("camera-fov", "camera-aperture", "camera-focus", "width", "picture-height", "spp", "max-depth",
                     "own-epsilon-0"):
            self.assertIn(name, fields)
        for name in fields:
            self.enter(f"#{name}", "x")
            words = browser.find(f"#{name}-wrong")
            self.assertTrue(words.is_displayed(), name)
            self.assertRegex(words.text, r"^Expected a (whole )?number.*\.$")
            field = browser.find(f"#{name}")
            self.assertEqual(field.get_attribute("aria-invalid"), "true")
            self.assertEqual(field.get_attribute("aria-errormessage"), f"{name}-wrong")
        self.assertEqual(browser.find("#spp-wrong").text, "Expected a whole number of 1 or more.")
        for spp in ("3", "2"):
            self.enter("#spp", spp)
            browser.wait(f"bouleView.session.state.settings.spp === {spp}", "other samples")
            browser.rest()
            self.assertEqual(browser.driver.find_elements("css selector", "#spp-wrong"), [])
        browser.wait("!document.querySelector('.wrong, [aria-invalid]')", "that the state is shown")

    def test_alert_goes_when_value_is_right(self):
        browser = self.browser
        for name, wrong, right, key in (("width", "1000000", "256", "size[0]"),
                                        ("spp", "99999999999", "2", "spp"),
                                        ("camera-fov", "180", "40", None)):
            self.enter(f"#{name}", wrong)
            text = browser.wait("document.querySelector('#problem p')?.textContent", "an alert")
            words = browser.find(f"#{name}-wrong").text
            self.assertRegex(words, r"^(Expected|Must be) .*\.$")
            self.assertIn(words[1:], text)
            self.enter(f"#{name}", right)
            browser.wait("!document.querySelector('#problem p')", "that the alert goes")
            self.assertEqual(browser.driver.find_elements("css selector", ".wrong, [aria-invalid]"), [])
            if key:
                browser.wait(f"bouleView.session.state.settings.{key} === {right}", "the right value")
        self.assertEqual(browser.complaints(), [])

    def test_a_drag_whose_capture_is_lost_ends(self):
        browser = self.browser
        browser.script("""document.querySelector('.view').addEventListener(
            'pointerdown', ({pointerId}) => { window.pressed = pointerId; }, {once: true});""")
        x, y = browser.center()
        browser.mouse("mouseMoved", x, y)
        browser.mouse("mousePressed", x, y, "left")
        browser.mouse("mouseMoved", x + 40, y, "left")
        moved = browser.camera()
        browser.script("document.querySelector('.view').releasePointerCapture(window.pressed)")
        browser.mouse("mouseMoved", x + 41, y, "left")  # the capture ends with the next event
        browser.rest()
        ended = browser.camera()
        browser.mouse("mouseMoved", x + 90, y, "left")
        browser.mouse("mouseMoved", x + 140, y, "left")
        browser.rest()
        self.assertEqual(browser.camera(), ended)
        self.assertEqual(moved["look_at"], ended["look_at"])
        browser.mouse("mouseReleased", x + 140, y, "left")
        browser.drag(30, 0)
        browser.rest()
        self.assertNotEqual(browser.camera(), ended)

    def test_a_wrong_token_is_refused(self):
        self.browser.driver.get(self.server.url[:-3] + "xyz")
        self.assertIn("token", self.browser.find("body").text)
        self.assertEqual(self.browser.driver.find_elements("css selector", "canvas"), [])

    def test_two_pages_steer_one_camera(self):
        browser = self.browser
        driver = browser.driver
        first = driver.current_window_handle
        driver.switch_to.new_window("tab")
        second = driver.current_window_handle
        try:
            browser.open(self.server.url)
            for moving, watching, eye in [(second, first, [0, 2, 7]), (first, second, [1, 3, 6])]:
                driver.switch_to.window(moving)
                browser.script("bouleView.session.move({eye: arguments[0]}, true); bouleView.session.rest()", eye)
                browser.rest()
                pixels = browser.pixels()
                driver.switch_to.window(watching)
                browser.wait(f"bouleView.session.camera.eye[1] === {eye[1]}", "the other page's camera")
                browser.rest()
                self.assertEqual(browser.camera()["eye"], eye)
                self.assertEqual(browser.pixels(), pixels)
        finally:
            driver.switch_to.window(second)
            driver.close()
            driver.switch_to.window(first)

    def test_tells_when_the_server_returns(self):
        browser = self.browser
        server = hands.Server(PROGRAM, ["first_light.toml", "--size", "64x36"], SCENES)
        try:
            browser.open(server.url)
        finally:
            server.close()
        browser.wait("document.body.dataset.link === 'away'", "that the server is away")
        self.assertIn("away", browser.find("#link").text)
        again = hands.Server(PROGRAM, ["first_light.toml", "--port", server.port], SCENES)
        try:
            browser.wait("document.body.dataset.link === 'refused'", "that the token is another one")
        finally:
            again.close()
        self.assertIn("token", browser.find("#link").text)


class Series(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = hands.Browser()
        cls.server = hands.Server(
            PROGRAM, ["wave.xyz", "--quick", "--size", "160x120", "--frames", "0-9"], SCENES)

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.server.close()

    def test_time_line_and_colors(self):
        browser = self.browser
        browser.open(self.server.url)
        first = browser.pixels()
        slider = browser.find("#frame")
        self.assertTrue(slider.is_displayed())
        slider.send_keys(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT, Keys.ARROW_RIGHT)
        browser.wait("bouleView.session.state.series.frame === 3", "frame 3")
        browser.rest()
        third = browser.pixels()
        self.assertNotEqual(first, third)
        self.assertIn("3 of 9", browser.find("#frame-text").text)

        browser.choose("#color", "vz")
        browser.wait("bouleView.session.state.particles.colors?.title === 'vz'", "colours by vz")
        browser.rest()
        colored = browser.pixels()
        self.assertNotEqual(third, colored)
        self.assertEqual(len(browser.find("#legend").find_elements("css selector", ".legend-bar")), 1)
        high = browser.find("#range-high")
        high.clear()
        high.send_keys("100", Keys.ENTER)
        browser.wait("bouleView.session.state.particles.look.range?.[1] === 100", "a range")
        browser.rest()
        self.assertNotEqual(colored, browser.pixels())

        browser.find("#play").click()
        browser.wait("bouleView.session.state.series.frame > 4", "that it plays")
        browser.find("#play").click()
        self.assertEqual(browser.find("#play").text, "Play")
        self.assertEqual(browser.complaints(), [])


    def test_lines_fog_and_ghosts(self):
        browser = self.browser
        browser.open(self.server.url)
        browser.script("bouleView.session.move({fov: 4}, false)")  # tiny balls have no lines
        browser.rest()
        looks = [browser.pixels()]

        def expect_another(condition, what):
            browser.wait(condition, what)
            browser.rest()
            self.assertTrue(browser.pixels() not in looks, what)
            looks.append(browser.pixels())

        def enter(field, text):
            browser.find(field).send_keys(Keys.CONTROL, "a", Keys.NULL, Keys.BACKSPACE, text, Keys.ENTER)

        self.assertFalse(browser.find("#opacity").is_enabled())
        enter("#ghost", "x > 10")
        expect_another("bouleView.session.state.particles.look.ghost === 'x > 10'", "ghosts")
        browser.find("#opacity").send_keys(Keys.ARROW_RIGHT)
        expect_another("bouleView.session.state.particles.look.opacity === 0.25", "an opacity")
        self.assertEqual(browser.find("#opacity-text").text, "25 %")
        enter("#outline", "4")
        expect_another("bouleView.session.state.settings.outline === 4", "lines")
        browser.find("#fog").send_keys(Keys.END)
        expect_another("bouleView.session.state.settings.fog === 1", "fog")

        enter("#ghost", "x >")
        browser.wait("document.querySelector('#ghost-wrong')?.textContent", "what is wrong")
        enter("#ghost", "")
        browser.wait("bouleView.session.state.particles.look.ghost === ''", "no ghosts")
        browser.wait("document.querySelector('#ghost-wrong') === null", "that it is right")
        browser.wait("!document.querySelector('#problem p')", "that all is well")
        # What another page has typed is no fault of the text here.
        browser.script("bouleView.session.sendNumbered({type: 'particles', ghost: 'x >'})")
        browser.wait("document.querySelector('#problem p')?.textContent", "what is wrong elsewhere")
        browser.wait("document.querySelector('#ghost-wrong') === null", "that nothing is wrong here")
        browser.find("#reset").click()
        browser.rest()
        self.assertEqual(browser.complaints(), [])

    def test_controls_say_what_they_do(self):
        browser = self.browser
        browser.open(self.server.url)
        controls = browser.script("""
            return [...document.querySelectorAll('#panel :is(select, input:not([type=radio]), button[id])')]
                .filter(one => !one.closest('[hidden]')).map(one => [one.id, one.title])""")
        self.assertGreater(len(controls), 20)
        self.assertEqual([name for name, title in controls if not title], [])


if __name__ == "__main__":
    hands.need_browser()
    unittest.main(argv=sys.argv[:1], verbosity=2)
