// Cameras as the protocol has them: what moves them, and where they show a point. Vectors are arrays
// of three numbers; nothing here changes its arguments.

export const add = (a, b) => a.map((x, i) => x + b[i]);
export const subtract = (a, b) => a.map((x, i) => x - b[i]);
export const scaled = (a, s) => a.map((x) => x * s);
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0],
];
export const length = (a) => Math.hypot(...a);
export const unit = (a) => scaled(a, 1 / length(a));

const radians = (degrees) => degrees * Math.PI / 180;
const narrowest = 1e-4;  // degrees of a long lens
const nearestPole = radians(1);  // between the view and `up`

let kinds = {};  // of cameras, as the server has them

/** Takes the kinds of camera that the server knows. */
export function learnKinds(cameras) { kinds = cameras; }

/** The keys of a kind of camera, and their rules. */
export const keysOf = ({type}) => kinds[type].keys;

/** Where a camera's film shows a point: `flat`, `angle`, `parallel` or `other`. */
export const projectionOf = ({type}) => kinds[type].projection;

const isParallel = (camera) => projectionOf(camera) === 'parallel';
const hasAngles = (camera) => projectionOf(camera) === 'angle';

/** The frame of a camera: `ahead`, `right`, `above`, and the distance to what it looks at. */
export function frameOf(camera) {
  const view = subtract(camera.look_at, camera.eye);
  const distance = length(view);
  const ahead = scaled(view, 1 / distance);
  const right = unit(cross(ahead, camera.up));
  return {ahead, right, above: cross(right, ahead), distance};
}

function rotated(vector, axis, angle) {
  const c = Math.cos(angle);
  const s = Math.sin(angle);
  return add(add(scaled(vector, c), scaled(cross(axis, vector), s)),
             scaled(axis, dot(axis, vector) * (1 - c)));
}

/** Goes around what it looks at: `yaw` to the right and `pitch` upward, in radians. */
export function orbit(camera, yaw, pitch) {
  const up = unit(camera.up);
  const {ahead, right, distance} = frameOf(camera);
  const polar = Math.acos(Math.max(-1, Math.min(1, -dot(ahead, up))));  // of the eye, from `up`
  const wanted = Math.max(nearestPole, Math.min(Math.PI - nearestPole, polar - pitch));
  let back = scaled(ahead, -distance);
  back = rotated(back, right, wanted - polar);
  back = rotated(back, up, yaw);
  return {eye: add(camera.look_at, back)};
}

/** Half of the picture's width and height, at distance 1 or, where rays are parallel, as it is. */
export function halfExtent(camera, [width, height]) {
  if (isParallel(camera)) {
    return [camera.height / 2 * width / height, camera.height / 2];
  }
  const half = radians((camera.fov ?? 40) / 2);
  const reach = hasAngles(camera) ? half : Math.tan(half);
  const axis = camera.fov_axis ?? 'x';
  const spansHeight = axis === 'y' || (axis === 'max' && height > width);
  return spansHeight ? [reach * width / height, reach] : [reach, reach * height / width];
}

/** Moves across the view, by shares of the picture's width and height: what is looked at follows. */
export function pan(camera, size, shareX, shareY) {
  const {right, above, distance} = frameOf(camera);
  const [x, y] = halfExtent(camera, size);
  const depth = isParallel(camera) ? 1 : distance;
  const step = add(scaled(right, -2 * shareX * x * depth), scaled(above, 2 * shareY * y * depth));
  return {eye: add(camera.eye, step), look_at: add(camera.look_at, step)};
}

/** Comes nearer: the distance is multiplied by `factor`; where rays are parallel, the height is. */
export function dolly(camera, factor) {
  if (isParallel(camera)) return {height: camera.height * factor};
  const back = scaled(subtract(camera.eye, camera.look_at), factor);
  const eye = add(camera.look_at, back);
  return length(subtract(eye, camera.look_at)) > 0 ? {eye} : {};
}

/** Sensible limits of `fov` in degrees; what the camera has is among them. */
export function fovLimits(camera) {
  const [low, high] = hasAngles(camera) ? [10, 360] : [1, 170];
  return [Math.min(low, camera.fov), Math.max(high, camera.fov)];
}

/** Sees more (factor above 1) or less. */
export function widen(camera, factor) {
  if (isParallel(camera)) return {height: camera.height * factor};
  if (camera.fov === undefined) return {};
  const [, high] = fovLimits(camera);
  return {fov: Math.max(narrowest, Math.min(high, camera.fov * factor))};
}

/** Shows all of a sphere around the scene, from the direction it is seen from. */
export function fit(camera, {center, radius}, size) {
  const {ahead} = frameOf(camera);
  const margin = 1.05;
  const [x, y] = halfExtent(camera, size);
  let distance = length(subtract(camera.eye, camera.look_at));
  const changes = {look_at: center};
  if (isParallel(camera)) {
    changes.height = 2 * radius * margin * Math.max(1, y / x);
    distance = Math.max(distance, 2 * radius);
  } else if (hasAngles(camera)) {
    distance = radius * margin / Math.sin(Math.min(Math.PI / 2, x, y));
  } else {
    distance = radius * margin / Math.sin(Math.atan(Math.min(x, y)));
  }
  if (camera.focus) changes.focus = null;
  return {...changes, eye: subtract(center, scaled(ahead, distance))};
}

/** Looks from a side, a unit vector, at what it looks at now. `home` is the usual `up`, which would
 * be seen as a point from its own side. */
export function lookFrom(camera, side, home) {
  const {distance} = frameOf(camera);
  const along = dot(side, unit(home));
  let up = home;
  if (Math.abs(along) > 0.99) up = Math.abs(home[1]) > 0.5 ? [0, 0, -Math.sign(along)] : [0, Math.sign(along), 0];
  return {eye: add(camera.look_at, scaled(side, distance)), up};
}

/** Where a point is in the camera's frame: to the right, upward, ahead. */
export function inFrame(camera, point) {
  const {right, above, ahead} = frameOf(camera);
  const from = subtract(point, camera.eye);
  return [dot(from, right), dot(from, above), dot(from, ahead)];
}

/** The pixel, with fractions, that shows a point of the camera's frame, or null where none does.
 * Rays of other projections are not followed: null. */
export function pixelOf(camera, [x, y, z], size) {
  const [halfX, halfY] = halfExtent(camera, size);
  let film;
  if (isParallel(camera)) {
    film = [x / halfX, y / halfY];
  } else if (hasAngles(camera)) {
    const across = Math.hypot(x, y);
    const angle = Math.atan2(across, z);
    film = across === 0 ? [0, 0] : [x / across * angle / halfX, y / across * angle / halfY];
  } else if (projectionOf(camera) !== 'flat' || !(z > 0)) {
    return null;
  } else {
    film = [x / z / halfX, y / z / halfY];
  }
  const pixel = [(film[0] + 1) / 2 * size[0], (1 - film[1]) / 2 * size[1]];
  return pixel.every(Number.isFinite) ? pixel : null;
}
