// What is drawn over the pictures: the rays of a pixel where they run in space, and a cross that the
// keyboard moves.

import {add, frameOf, inFrame, length, pixelOf, projectionOf, scaled} from './camera.js';
import {byId, makeSvg} from './dom.js';

const mostRays = 300;
const curveSteps = 24;  // of a straight line where the film shows angles

export class Overlay {
  constructor(session, panes) {
    this.session = session;
    this.panes = panes;
    this.rays = [];
    this.visible = true;
    this.highlighted = null;
    this.cross = null;
    for (const event of ['camera', 'layout']) session.on(event, () => this.draw());
  }

  /** Rays as `picked` has them, or null. */
  set(picked) {
    this.picked = picked;
    this.rays = picked ? picked.rays.slice(0, mostRays) : [];
    this.highlighted = null;
    this.draw();
  }

  show(visible) {
    this.visible = visible;
    this.draw();
  }

  highlight(index) {
    if (this.highlighted === index) return;
    this.highlighted = index;
    this.draw();
  }

  // The cross of the keyboard.

  place(pane) {
    const {size} = this.session.state.settings;
    if (this.cross?.pane !== pane) return size.map((side) => Math.floor(side / 2));
    return this.cross.at;
  }

  move(pane, x, y) {
    const {size} = this.session.state.settings;
    const at = this.place(pane).map((side, axis) => Math.max(0, Math.min(size[axis] - 1, side + [x, y][axis])));
    this.cross = {pane, at};
    this.draw();
  }

  hide() {
    this.cross = null;
    this.session.tell('hide', null);
    this.draw();
  }

  draw() {
    const {camera, state} = this.session;
    if (!camera || !state) return;
    const {size} = state.settings;
    const groups = this.visible ? this.paths(camera, size, state.bounds.radius) : [];
    if (byId('axes').checked) groups.push(...axesOf(camera, size));
    for (const pane of this.panes.panes) {
      pane.overlay.replaceChildren(...groups.map((group) => group.cloneNode(true)));
      if (this.cross?.pane === pane) pane.overlay.append(...crossAt(this.cross.at, size));
    }
  }

  paths(camera, size, reach) {
    const elements = [];
    this.rays.forEach((ray, index) => {
      const points = pathOf(ray, camera, size, reach);
      if (!points) return;
      const d = `M${points.map(([x, y]) => `${x.toFixed(2)} ${y.toFixed(2)}`).join('L')}`;
      const isStrong = index === this.highlighted;
      const classes = `${ray.kind}${isStrong ? ' strong' : ''}`;
      elements.push(makeSvg('path', {d, class: `halo ${classes}`}), makeSvg('path', {d, class: `line ${classes}`}));
    });
    const at = this.picked?.hit && pixelOf(camera, inFrame(camera, this.picked.hit.position), size);
    if (at) elements.push(...ringAt(at, size));
    return elements;
  }
}

function endOf({kind, t, origin, direction}, reach) {
  if (t !== null) return add(origin, scaled(direction, t));
  // A shadow ray that is free ends at its light, one direction away.
  if (kind === 'shadow') return add(origin, direction);
  return add(origin, scaled(direction, 2 * reach / length(direction)));
}

// Pixels along a ray, as far as it is in front of the camera, or null.
function pathOf(ray, camera, size, reach) {
  let from = inFrame(camera, ray.origin);
  let to = inFrame(camera, endOf(ray, reach));
  const mix = (share) => from.map((x, axis) => x + (to[axis] - x) * share);
  if (projectionOf(camera) === 'flat') {
    const near = 1e-3 * Math.max(Math.abs(from[2]), Math.abs(to[2]));
    if (from[2] < near && to[2] < near) return null;
    const meets = (near - from[2]) / (to[2] - from[2]);
    if (from[2] < near) from = mix(meets);
    else if (to[2] < near) to = mix(meets);
  }
  const steps = projectionOf(camera) === 'angle' ? curveSteps : 1;
  const points = [];
  for (let i = 0; i <= steps; i += 1) {
    const point = pixelOf(camera, mix(i / steps), size);
    if (point) points.push(point);
  }
  return points.length > 1 ? points : null;
}

function ringAt([x, y], size) {
  const ring = {cx: x, cy: y, r: 5 * Math.max(1, size[0] / 900)};
  return [makeSvg('circle', {...ring, class: 'halo'}), makeSvg('circle', {...ring, class: 'line'})];
}

// The directions of x, y and z in the lower left corner; the nearest is drawn last.
function axesOf(camera, size) {
  const {right, above, ahead} = frameOf(camera);
  const arm = Math.min(...size) / 14;
  const from = [1.6 * arm, size[1] - 1.6 * arm];
  return ['x', 'y', 'z'].map((name, axis) => ({name, axis})).sort((a, b) => ahead[b.axis] - ahead[a.axis])
      .flatMap(({name, axis}) => {
        const [x, y] = [right[axis] * arm, -above[axis] * arm];
        const d = `M${from[0]} ${from[1]}l${x} ${y}`;
        const text = makeSvg('text', {x: from[0] + 1.3 * x, y: from[1] + 1.3 * y, class: 'axis-name', 'font-size': arm / 2});
        text.textContent = name;
        return [makeSvg('path', {d, class: 'halo'}), makeSvg('path', {d, class: `line axis-${name}`}), text];
      });
}

function crossAt([x, y], size) {
  const arm = size[0] / 50;
  const gap = arm / 4;
  const [cx, cy] = [x + 0.5, y + 0.5];
  const across = `M${cx - arm} ${cy}H${cx - gap}M${cx + gap} ${cy}H${cx + arm}`;
  const d = `${across}M${cx} ${cy - arm}V${cy - gap}M${cx} ${cy + gap}V${cy + arm}`;
  return [makeSvg('path', {d, class: 'halo cross'}), makeSvg('path', {d, class: 'line cross'})];
}
