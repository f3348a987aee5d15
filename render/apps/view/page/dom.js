// Small helpers for elements of the page.

/** The element with an id. */
export const byId = (id) => document.getElementById(id);

/** Makes an element. Properties that are no properties of elements become attributes. */
export function make(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (value === undefined || value === null) continue;
    if (name in element) element[name] = value;
    else element.setAttribute(name, value);
  }
  element.append(...children);
  return element;
}

const svgSpace = 'http://www.w3.org/2000/svg';

/** Makes an SVG element. */
export function makeSvg(tag, attributes = {}) {
  const element = document.createElementNS(svgSpace, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  return element;
}

/** Fills a select with [value, text] pairs, unless it has them already, and chooses one. */
export function fillSelect(select, pairs, chosen) {
  const have = [...select.options].map((option) => [option.value, option.text]);
  if (JSON.stringify(have) !== JSON.stringify(pairs)) {
    select.replaceChildren(...pairs.map(([value, text]) => make('option', {value, text})));
  }
  select.value = chosen;
}

/** Marks a field whose value is refused, and says why below it. */
export function refuse(input, words) {
  const id = `${input.id}-wrong`;
  const note = byId(id) ?? make('p', {id, className: 'wrong', role: 'alert'});
  note.textContent = words;
  (input.closest('.row') ?? input).after(note);
  input.setAttribute('aria-invalid', 'true');
  input.setAttribute('aria-errormessage', id);
}

/** Takes that back: the value is right. */
export function accept(input) {
  byId(`${input.id}-wrong`)?.remove();
  for (const name of ['aria-invalid', 'aria-errormessage']) input.removeAttribute(name);
}

/** Shows a value in a field, unless somebody is typing there. */
export function showValue(input, value) {
  if (document.activeElement === input && input.dataset.edited) return;
  input.value = value;
  accept(input);
}

// "Expected a whole number of 1 or more."
function expectation({low, high, whole, empty}) {
  const noun = whole ? 'a whole number' : 'a number';
  let limits = '';
  if (Number.isFinite(low)) limits = Number.isFinite(high) ? ` from ${low} to ${high}` : ` of ${low} or more`;
  return `Expected ${noun}${limits}${empty === undefined ? '' : ', or nothing'}.`;
}

/** Calls `use` with the number that was typed into a field, once it is complete. A text that is no
 * number within the limits is refused; `empty` stands for no text. */
export function onNumber(input, use, {low = -Infinity, high = Infinity, whole = false, empty} = {}) {
  input.addEventListener('input', () => { input.dataset.edited = '1'; });
  input.addEventListener('change', () => {
    delete input.dataset.edited;
    const text = input.value.trim().replace(',', '.');
    const value = text === '' ? empty : Number(text);
    const right = value === empty ||
        (Number.isFinite(value) && value >= low && value <= high && (!whole || Number.isInteger(value)));
    if (!right || value === undefined) return refuse(input, expectation({low, high, whole, empty}));
    accept(input);
    input.dispatchEvent(new CustomEvent('right', {bubbles: true}));
    use(value);
  });
}

/** A number as a reader wants it: so many digits that count, no needless zeros. */
export function short(number, digits = 4) {
  if (number === null || number === undefined) return '–';
  if (!Number.isFinite(number)) return String(number);
  const magnitude = Math.abs(number);
  if (magnitude !== 0 && (magnitude < 1e-4 || magnitude >= 1e7)) {
    return number.toExponential(digits - 1).replace(/\.?0+e/, 'e').replace('e+', 'e').replace('-', '−');
  }
  const text = String(Number(number.toPrecision(digits)));
  return text.replace('-', '−');
}

/** 1234567 as 1 234 567, with narrow spaces. */
export const grouped = (count) => String(count).replace(/\B(?=(\d{3})+$)/g, '\u202f');

/** "1 sphere", "12 spheres". */
export const counted = (count, noun, nouns = `${noun}s`) => `${grouped(count)} ${count === 1 ? noun : nouns}`;

/** A sentence: begins with a capital, ends with a full stop. */
export function sentence(text) {
  const trimmed = text.trim();
  if (trimmed === '') return '';
  return trimmed[0].toUpperCase() + trimmed.slice(1) + (/[.!?]$/.test(trimmed) ? '' : '.');
}
