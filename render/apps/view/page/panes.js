// The pictures: one or two panes and their difference, as large as there is room.

import {counted, grouped, make, makeSvg, short} from './dom.js';
import {paneText} from './words.js';

const names = ['A', 'B'];
const gap = 12;  // pixels between pictures, as in view.css

/** How many columns and which width make `count` pictures largest. */
export function arrange(count, width, height, aspect, caption, sideBySide) {
  let best = {columns: 1, width: 0};
  for (let columns = 1; columns <= Math.min(2, count); columns += 1) {
    if (sideBySide && count > 1 && columns === 1) continue;
    const rows = Math.ceil(count / columns);
    const across = (width - gap * (columns - 1)) / columns;
    const down = (height - gap * (rows - 1)) / rows - caption;
    const fits = Math.max(80, Math.floor(Math.min(across, down * aspect)));
    if (fits > best.width) best = {columns, width: Math.min(fits, Math.floor(across))};
  }
  return best;
}

/** How far a picture is: "11 % of the pixels", "3 of 16 samples a pixel". */
export function sampleText(done, all) {
  if (done < 1) return `${Math.floor(100 * done)} % of the pixels`;
  return `${short(Math.floor(10 * done) / 10, 3)} of ${counted(all, 'sample')} a pixel`;
}

class Pane {
  constructor(index) {
    this.index = index;
    this.canvas = make('canvas', {width: 16, height: 9, 'aria-hidden': 'true'});
    this.overlay = makeSvg('svg', {class: 'overlay', 'aria-hidden': 'true'});
    this.view = make('div', {
      className: 'view', tabIndex: 0, role: 'application', 'aria-roledescription': 'picture',
    }, this.canvas);
    this.view.append(this.overlay);
    this.view.pane = this;
    this.bar = make('div', {className: 'bar'});
    this.title = make('span', {className: 'pane-title'});
    this.figures = make('span', {className: 'pane-figures'});
    this.legend = make('div', {className: 'difference-legend'});
    this.caption = make('figcaption', {}, this.title, this.figures, this.legend);
    this.element = make('figure', {className: 'pane'}, this.view, this.bar, this.caption);
    this.shown = null;
  }

  /** Draws a frame over the whole picture; a pixel of it may stand for several. */
  show(header, bitmap, [width, height]) {
    const {canvas} = this;
    if (canvas.width !== width || canvas.height !== height) {
      canvas.width = width;
      canvas.height = height;
    }
    this.context ??= canvas.getContext('2d', {alpha: false});
    this.context.imageSmoothingEnabled = false;
    this.context.drawImage(bitmap, 0, 0, bitmap.width * header.scale, bitmap.height * header.scale);
    this.shown = header;
    const {finished, moving, scale, number} = header;
    Object.assign(this.element.dataset, {finished, moving, scale, number, shown: header.frame});
    this.bar.style.setProperty('--share', header.share);
  }
}

export class Panes {
  constructor(stage, session) {
    this.stage = stage;
    this.session = session;
    this.panes = [];
    session.on('state', (state) => this.update(state));
    session.on('statistics', (message) => this.showStatistics(message));
    new ResizeObserver(() => this.layOut()).observe(stage);
    // On a phone the pictures stay at the top: what has the focus must not be below them.
    new ResizeObserver(([area]) => {
      const height = area.borderBoxSize[0].blockSize;
      document.documentElement.style.setProperty('--covered', `${height}px`);
    }).observe(stage.parentElement);
    window.addEventListener('resize', () => this.layOut());
  }

  update(state) {
    const {settings} = state;
    const count = settings.panes.length + (settings.difference === 'none' ? 0 : 1);
    while (this.panes.length > count) this.panes.pop().element.remove();
    while (this.panes.length < count) {
      const pane = new Pane(this.panes.length);
      this.panes.push(pane);
      this.stage.append(pane.element);
    }
    this.panes.forEach((pane, index) => this.label(pane, index, state));
    this.layOut();
  }

  label(pane, index, state) {
    const {panes, difference} = state.settings;
    const isDifference = index >= panes.length;
    const name = isDifference ? 'Difference' : panes.length > 1 ? names[index] : '';
    const text = isDifference ? state.difference_colors?.title ?? difference : paneText(panes[index]);
    const brief = isDifference ? '' : paneText(panes[index], panes[1 - index]);
    pane.isDifference = isDifference;
    // On a phone two panes show beside each other only how they differ.
    const words = brief ? [make('span', {className: 'wide', textContent: text}),
                           make('span', {className: 'narrow', textContent: brief})] : [text];
    pane.title.replaceChildren(...(name ? [make('b', {textContent: name}), ' '] : []), ...words);
    pane.view.setAttribute('aria-label', `${['Picture', name].filter(Boolean).join(' ')}: ${text}. Arrow keys orbit.`);
    pane.view.setAttribute('aria-describedby', 'rays-hint');
    pane.element.classList.toggle('difference', isDifference);
    if (isDifference) pane.figures.textContent = '';
    pane.legend.replaceChildren();
    if (isDifference) drawDifferenceLegend(pane.legend, state.difference_colors);
  }

  showStatistics({panes, difference}) {
    panes.forEach((figures, index) => {
      const pane = this.panes[index];
      if (!pane || pane.isDifference) return;
      const {spp} = this.session.state.settings;
      const parts = [sampleText(figures.spp, spp)];
      if (figures.mrays_per_s > 0) parts.push(`${short(figures.mrays_per_s, 3)} million rays a second`);
      parts.push(`${short(figures.seconds, 2)} s`);
      if (figures.scale > 1) parts.push(`1 pixel for ${figures.scale} x ${figures.scale}`);
      pane.figures.textContent = parts.join(' · ');
      pane.bar.style.setProperty('--share', figures.share);
      pane.element.dataset.done = figures.done;
    });
    if (this.panes[0].caption.offsetHeight !== this.captionHeight) this.layOut();
    const last = this.panes.at(-1);
    if (last?.isDifference) last.figures.textContent = difference ? this.differenceText(difference) : '';
  }

  differenceText({pixels, largest}) {
    if (pixels === 0) return 'no pixel differs';
    const unit = this.session.state.settings.difference === 'ulp' ? 'ulp' : 'of 255';
    const most = largest > 0 ? `, by at most ${short(largest, 6)} ${unit}` : '';
    return `${grouped(pixels)} ${pixels === 1 ? 'pixel differs' : 'pixels differ'}${most}`;
  }

  /** Shows a frame where it belongs. */
  show(header, bitmap) {
    const pane = header.pane === 2 ? this.panes.find((one) => one.isDifference) : this.panes[header.pane];
    const {size} = this.session.state.settings;
    // A frame from before the size was changed is of no use.
    const fits = size.every((side, axis) => Math.ceil(side / header.scale) === [header.width, header.height][axis]);
    if (pane && fits && pane.isDifference === (header.pane === 2)) {
      pane.show(header, bitmap, size);
      this.session.tell('shown', header);
    }
  }

  layOut() {
    const state = this.session.state;
    if (!state) return;
    const [width, height] = state.settings.size;
    const area = this.stage.parentElement;
    const isNarrow = matchMedia('(max-width: 820px)').matches;
    const room = isNarrow && !document.fullscreenElement ? innerHeight * (this.panes.length > 1 ? 0.58 : 0.5) : this.stage.clientHeight;
    this.captionHeight = this.panes[0].caption.offsetHeight;
    const {columns, width: paneWidth} = arrange(
        this.panes.length, this.stage.clientWidth, room, width / height, this.captionHeight + 8, !isNarrow);
    this.stage.style.setProperty('--columns', columns);
    this.stage.style.setProperty('--pane-width', `${paneWidth}px`);
    this.stage.style.setProperty('--aspect', `${width} / ${height}`);
    this.paneWidth = paneWidth;
    area.classList.toggle('enlarged', paneWidth >= 1.5 * width);
    for (const pane of this.panes) pane.overlay.setAttribute('viewBox', `0 0 ${width} ${height}`);
    this.session.tell('layout', null);
  }

  /** The size of picture that is shown pixel for pixel. */
  shownSize() {
    const {size, max} = {size: this.session.state.settings.size, max: this.session.state.choices.max_size};
    const ratio = this.paneWidth * devicePixelRatio / size[0];
    return size.map((side, axis) => Math.max(1, Math.min(max[axis], Math.round(side * ratio))));
  }
}

function drawDifferenceLegend(element, colors) {
  if (!colors) return;
  const steps = colors.stops.map((color, index) => ({color, label: colors.labels[index]}));
  if (colors.other) steps.push(colors.other);
  for (const {color, label} of steps) {
    const swatch = make('span', {className: 'swatch', 'aria-hidden': 'true'});
    swatch.style.setProperty('--color', color);
    element.append(make('span', {className: 'difference-step'}, swatch, label));
  }
}
