// Mouse, touch and keyboard on the pictures become movements of the camera.

import {dolly, fit, lookFrom, orbit, pan, widen} from './camera.js';

const wheelStep = 0.0015;   // of the logarithm of the distance, for a pixel of the wheel
const linePixels = 32;      // of a wheel that counts lines
const keyAngle = Math.PI / 36;
const keyShare = 0.02;
const keyFactor = 1.1;
const stillness = {mouse: 4, pen: 6, touch: 10};  // pixels that a click may move
const restAfter = 150;      // milliseconds after the last turn of the wheel

export class Gestures {
  /** `click(pane, x, y)` is called with a pixel of the full size; `crosshair` moves the cross. */
  constructor(stage, session, {click, turn, crosshair, frameStep}) {
    this.session = session;
    this.click = click;
    this.turn = turn;
    this.crosshair = crosshair;
    this.frameStep = frameStep;
    this.pointers = new Map();
    this.pinchStart = null;
    this.clicked = null;  // the pixel of the last click
    stage.addEventListener('pointerdown', (event) => this.down(event));
    stage.addEventListener('pointermove', (event) => this.moved(event));
    stage.addEventListener('pointerup', (event) => this.up(event, true));
    // A capture ends after each pointerup, too, and alone where an element or another program takes it.
    for (const end of ['pointercancel', 'lostpointercapture']) {
      stage.addEventListener(end, (event) => this.up(event, false));
    }
    stage.addEventListener('dblclick', (event) => {
      const view = event.target.closest('.view');
      if (view && this.clicked) turn(view.pane, ...this.clicked);  // mouse events have whole numbers
    });
    stage.addEventListener('wheel', (event) => this.wheel(event), {passive: false});
    stage.addEventListener('contextmenu', (event) => {
      if (event.target.closest('.view')) event.preventDefault();
    });
    stage.addEventListener('keydown', (event) => this.key(event));
    stage.addEventListener('keyup', () => session.rest());
  }

  get size() { return this.session.state.settings.size; }

  down(event) {
    const view = event.target.closest('.view');
    if (!view || !this.session.camera) return;
    view.setPointerCapture(event.pointerId);
    view.focus({preventScroll: true});
    event.preventDefault();
    if (this.pointers.size === 0) {
      this.view = view;
      this.isClick = event.button === 0;
      this.start = [event.clientX, event.clientY];
      this.pans = event.button !== 0 || event.shiftKey;
    }
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
    if (this.pointers.size === 2) {
      this.isClick = false;
      this.pinchStart = {camera: structuredClone(this.session.camera), ...this.twoFingers()};
    }
  }

  moved(event) {
    const before = this.pointers.get(event.pointerId);
    if (!before) return;
    const now = [event.clientX, event.clientY];
    if (this.isClick) {
      const still = stillness[event.pointerType] ?? stillness.mouse;
      if (Math.hypot(now[0] - this.start[0], now[1] - this.start[1]) < still) return;
      this.isClick = false;
    }
    this.pointers.set(event.pointerId, now);
    if (this.pinchStart) this.pinch();
    else this.drag(now[0] - before[0], now[1] - before[1]);
  }

  /** Where the middle of two fingers is, and how far they are apart. */
  twoFingers() {
    const [[ax, ay], [bx, by]] = [...this.pointers.values()];
    return {middle: [(ax + bx) / 2, (ay + by) / 2], apart: Math.max(1, Math.hypot(ax - bx, ay - by))};
  }

  drag(x, y) {
    const {width, height} = this.view.getBoundingClientRect();
    const {camera} = this.session;
    if (this.pans) this.session.move(pan(camera, this.size, x / width, y / height));
    else this.session.move(orbit(camera, -x / width * Math.PI, y / width * Math.PI));
  }

  // Counted from where the fingers began, so that steps leave no rest.
  pinch() {
    if (this.pointers.size !== 2) return;
    const {width, height} = this.view.getBoundingClientRect();
    const {camera, middle, apart} = this.pinchStart;
    const now = this.twoFingers();
    const panned = pan(camera, this.size, (now.middle[0] - middle[0]) / width, (now.middle[1] - middle[1]) / height);
    this.session.move({...panned, ...dolly({...camera, ...panned}, apart / now.apart)});
  }

  up(event, isComplete) {
    if (!this.pointers.delete(event.pointerId) || this.pointers.size > 0) return;
    this.pinchStart = null;
    this.session.rest();
    if (!isComplete || !this.isClick) return;
    this.clicked = this.pixelAt(this.view, event);
    this.click(this.view.pane, ...this.clicked);
  }

  /** The pixel of the full size that an event is at. */
  pixelAt(view, event) {
    const box = view.getBoundingClientRect();
    const shares = [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
    return this.size.map((side, axis) => Math.max(0, Math.min(side - 1, Math.floor(shares[axis] * side))));
  }

  wheel(event) {
    if (!event.target.closest('.view') || !this.session.camera) return;
    event.preventDefault();
    const pixels = event.deltaY * (event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? 1 : linePixels);
    const strength = event.ctrlKey ? 6 : 1;  // a pinch on a touchpad comes in small steps
    const step = Math.max(-0.5, Math.min(0.5, pixels * wheelStep * strength));
    this.session.move(dolly(this.session.camera, Math.exp(step)));
    clearTimeout(this.wheelEnds);
    this.wheelEnds = setTimeout(() => this.session.rest(), restAfter);
  }

  key(event) {
    const view = event.target.closest('.view');
    if (!view || !this.session.camera || event.ctrlKey || event.metaKey || event.altKey) return;
    if (this.moveByKey(event) || this.actByKey(event, view)) event.preventDefault();
  }

  moveByKey({key, shiftKey}) {
    const {camera} = this.session;
    const arrows = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};
    let changes;
    if (arrows[key] && shiftKey) {
      changes = pan(camera, this.size, ...arrows[key].map((step) => step * keyShare));
    } else if (arrows[key]) {
      changes = orbit(camera, -arrows[key][0] * keyAngle, arrows[key][1] * keyAngle);
    } else {
      const factors = {
        '+': () => dolly(camera, 1 / keyFactor), '=': () => dolly(camera, 1 / keyFactor),
        '-': () => dolly(camera, keyFactor), '_': () => dolly(camera, keyFactor),
        '[': () => widen(camera, 1 / keyFactor), ']': () => widen(camera, keyFactor),
      };
      changes = factors[key]?.();
    }
    if (changes) this.session.move(changes);
    return Boolean(changes);
  }

  actByKey({key, shiftKey}, view) {
    const far = shiftKey ? 20 : 1;
    const cross = {i: [0, -1], j: [-1, 0], k: [0, 1], l: [1, 0]}[key.toLowerCase()];
    if (cross) this.crosshair.move(view.pane, cross[0] * far, cross[1] * far);
    else if (key === 'Enter') this.click(view.pane, ...this.crosshair.place(view.pane));
    else if (key === 'Escape') this.crosshair.hide();
    else if (key === 'f' || key === 'F') this.fitAll();
    else if (key === 'r' || key === 'R') this.reset();
    else if (key === 't' || key === 'T') this.turn(view.pane, ...this.crosshair.place(view.pane));
    else if ('xyzXYZ'.includes(key)) this.lookFrom(key.toLowerCase(), shiftKey ? -1 : 1);
    else if (key === ',') this.frameStep(-1);
    else if (key === '.') this.frameStep(1);
    else return false;
    return true;
  }

  fitAll() {
    const {session} = this;
    session.move(fit(session.camera, session.state.bounds, this.size), false);
  }

  /** Looks from the side of an axis. */
  lookFrom(axis, sign) {
    const {session} = this;
    const side = ['x', 'y', 'z'].map((name) => (name === axis ? sign : 0));
    session.move(lookFrom(session.camera, side, session.startCamera.up), false);
  }

  reset() {
    this.session.move(structuredClone(this.session.startCamera), false);
  }
}
