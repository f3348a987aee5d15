// What settings are called on the page.

const orders = {rows: 'row-major', tiles: 'tiled', progressive: 'progressive', frameless: 'frameless'};
const methods = {whitted: 'Whitted', path: 'paths'};
const differences = {none: 'none', color: 'in colour', ulp: 'in ulp of t'};

export const orderName = (order) => orders[order] ?? order;
export const methodName = (method) => methods[method] ?? method;
export const cameraName = (type) => type.replaceAll('_', ' ');
export const differenceName = (difference) => differences[difference] ?? difference;

const outlineRules = {
  '': 'by the style', object: 'every ball', depth: 'what lies clearly behind', kind: 'each kind',
  molecule: 'each molecule', chain: 'each chain', residue: 'each residue',
};
export const outlineRuleName = (rule) => outlineRules[rule] ?? rule;

/** What a control does, by its id: shown where the mouse rests, and read to those who do not see. */
export const meanings = {
  color: 'What decides the colour of a particle: its element, or a number that the file has for it.',
  map: 'The colours from the least number to the greatest.',
  'range-low': 'Particles with this number, or less, have the first colour.',
  'range-high': 'Particles with this number, or more, have the last colour.',
  'range-data': 'Takes the range that nearly all particles of the file are in.',
  outline: 'How wide the dark lines around things are, in pixels. 0: no lines.',
  fog: 'The farther away something is, the more it fades into the background.',
  'outline-by': 'What a dark line goes around. Between things of one group there is none.',
  ghost: 'Which particles you see through, such as: chain != \'L\', or: type == 2 && z > 5. Empty: none.',
  opacity: 'How much a ghost hides of what is behind it.',
  compare: 'A second picture beside the first one. They differ in what you choose here.',
  order: 'Which pixel is rendered when. Slow the speed down to see it.',
  solver: 'How a ray finds the sphere that it meets. Robust is right always, fast nearly always.',
  method: 'Whitted: sharp shadows, mirrors and glass. Paths: also the light that goes from thing to thing.',
  shadow_epsilon: 'How a shadow ray leaves the surface that it starts on. Exact needs no help; the others are the usual tricks.',
  difference: 'A third picture: where the two differ, and by how much.',
  pace: 'Slows rendering down, so that you can watch.',
  'camera-type': 'How the camera turns directions into places in the picture.',
  'camera-fov': 'How wide the camera sees. A small angle from far away makes flat pictures, as a telephoto lens does.',
  'camera-focus': 'How far away things are sharp. Empty: what the camera looks at.',
  'camera-aperture': 'How wide the lens is open. A wider one blurs what is nearer or farther than the focus.',
  'camera-height': 'How much of the scene is in the picture from bottom to top.',
  fit: 'Moves the camera so that everything is in the picture.',
  reset: 'Goes back to the first camera.',
  'full-screen': 'Shows the pictures alone. Esc brings the page back.',
  axes: 'Shows which way x, y and z go.',
  width: 'Of the picture, in pixels.',
  'picture-height': 'Of the picture, in pixels.',
  'size-window': 'Renders as many pixels as the window shows.',
  'size-scene': 'Renders as many pixels as at the beginning.',
  spp: 'How many rays go through each pixel. More make edges smoother and shadows less grainy, and take longer.',
  'max-depth': 'How often light may be mirrored or go through glass on its way.',
  exposure: 'Makes the picture brighter or darker. A stop doubles the light.',
  'copy-toml': 'The camera, to be put into a scene file.',
  'copy-command': 'The command that renders this picture without the page.',
  'save-format': 'The kind of the file.',
  save: 'Renders the picture at full quality, and downloads it. You may go on meanwhile.',
  'stop-saving': 'The picture is not saved.',
  play: 'Shows one frame after the other.',
};

/** 0.0001 as 1e-4, as it is typed. */
export const plain = (number) => {
  const magnitude = Math.abs(number);
  return magnitude !== 0 && magnitude < 0.01 ? number.toExponential().replace('e+', 'e') : String(number);
};

export function epsilonName(epsilon) {
  if (epsilon === null) return 'exact';
  return epsilon === 'none' ? 'none' : `ε = ${plain(epsilon)}`;
}

function remedyName(epsilon) {
  return epsilon === 'none' ? 'no remedy' : epsilon === null ? 'exact shadows' : epsilonName(epsilon);
}

/** A pane's settings in a few words. With another pane, only those that differ from its. */
export function paneText(pane, other = null) {
  const words = {
    order: orderName(pane.order),
    solver: pane.solver,
    method: methodName(pane.method),
    shadow_epsilon: remedyName(pane.shadow_epsilon),
  };
  const keys = Object.keys(words).filter((key) => other ? pane[key] !== other[key] :
    key !== 'shadow_epsilon' || pane.shadow_epsilon !== null);
  return keys.map((key) => words[key]).join(' · ');
}

export function paceName(pace) {
  if (pace === 0) return 'as fast as it can';
  return `${String(pace).replace(/\B(?=(\d{3})+$)/g, '\u202f')} pixels a second`;
}
