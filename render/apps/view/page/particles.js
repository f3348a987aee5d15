// Colours of particles: by what, by which map, over which range, and what they mean.

import {byId, fillSelect, make, onNumber, short, showValue} from './dom.js';
import {plain} from './words.js';

export class Particles {
  constructor(session) {
    this.session = session;
    byId('particles-form').addEventListener('submit', (event) => event.preventDefault());
    byId('color').addEventListener('change',
                                   () => this.change({color: byId('color').value, range: null}));
    byId('map').addEventListener('change', () => this.change({map: byId('map').value}));
    byId('range-data').addEventListener('click', () => this.change({range: null}));
    onNumber(byId('range-low'), (low) => this.setEnd(0, low));
    onNumber(byId('range-high'), (high) => this.setEnd(1, high));
    session.on('state', ({particles, choices}) => this.show(particles, choices));
  }

  change(look) {
    this.session.flush();
    this.session.sendNumbered({type: 'particles', ...look});
  }

  setEnd(end, value) {
    const range = [...this.shownRange];
    range[end] = value;
    this.change({range});
  }

  show(particles, choices) {
    byId('particles-section').hidden = particles === null;
    if (particles === null) return;
    const {look, columns, colors} = particles;
    byId('particles-form').hidden = look === null;
    if (look !== null) this.showLook(look, columns, colors, choices);
    showLegend(byId('legend'), colors);
  }

  showLook(look, columns, colors, choices) {
    const names = [...new Set([...choices.colors, ...columns.map(({name}) => name), look.color])];
    const texts = {element: 'element or type', '': 'default'};
    fillSelect(byId('color'), names.map((name) => [name, texts[name] ?? name]), look.color);
    const maps = choices.maps.includes(look.map) ? choices.maps : [...choices.maps, look.map];
    fillSelect(byId('map'), maps.map((map) => [map, texts[map] ?? map]), look.map);
    const isScale = colors?.kind === 'scale';
    this.shownRange = look.range ?? colors?.range ?? [0, 1];
    for (const id of ['map', 'range-low', 'range-high', 'range-data']) byId(id).disabled = !isScale;
    showValue(byId('range-low'), isScale ? plain(this.shownRange[0]) : '');
    showValue(byId('range-high'), isScale ? plain(this.shownRange[1]) : '');
  }
}

function showLegend(element, colors) {
  element.replaceChildren();
  if (!colors) return;
  if (colors.title) element.append(make('p', {className: 'legend-title', textContent: colors.title}));
  if (colors.kind === 'scale') {
    const bar = make('div', {className: 'legend-bar'});
    bar.style.setProperty('--stops', colors.stops.join(', '));
    const [low, high] = colors.range;
    const ticks = make('div', {className: 'legend-ticks'},
                       ...[low, (low + high) / 2, high].map((value) => make('span', {textContent: short(value)})));
    element.append(bar, ticks);
    return;
  }
  const list = make('ul', {className: 'legend-list'});
  for (const {name, color} of colors.items) {
    const swatch = make('span', {className: 'swatch', 'aria-hidden': 'true'});
    swatch.style.setProperty('--color', color);
    list.append(make('li', {}, swatch, name));
  }
  element.append(list);
}
