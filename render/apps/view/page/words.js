// What settings are called on the page.

const orders = {rows: 'row-major', tiles: 'tiled', progressive: 'progressive', frameless: 'frameless'};
const methods = {whitted: 'Whitted', path: 'paths'};
const differences = {none: 'none', color: 'in colour', ulp: 'in ulp of t'};

export const orderName = (order) => orders[order] ?? order;
export const methodName = (method) => methods[method] ?? method;
export const cameraName = (type) => type.replaceAll('_', ' ');
export const differenceName = (difference) => differences[difference] ?? difference;

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
