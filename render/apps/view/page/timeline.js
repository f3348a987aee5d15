// The time line of a series.

import {byId, short} from './dom.js';
import {isLater} from './session.js';

const shortestFrame = 100;  // milliseconds that a frame is shown at least
const longestWait = 600;    // milliseconds after which a frame's first look is enough

export class Timeline {
  constructor(session) {
    this.session = session;
    this.playing = false;
    this.number = null;  // of the frame that is waited for
    byId('timeline').addEventListener('submit', (event) => event.preventDefault());
    byId('frame').addEventListener('input', () => this.goTo(Number(byId('frame').value)));
    byId('play').addEventListener('click', () => this.play(!this.playing));
    session.on('state', ({series}) => this.show(series));
    session.on('shown', (header) => this.shown(header));
  }

  goTo(frame) {
    this.wanted = frame;
    this.asked = performance.now();
    this.number = this.session.sendNumbered({type: 'frame', frame});
    this.showText({...this.session.state.series, frame, time: undefined});
  }

  /** So many frames on, around the ends when playing. */
  step(count, around = false) {
    const {series} = this.session.state;
    if (!series) return;
    const next = (this.wanted ?? series.frame) + count * series.step;
    const {first, last} = series;
    if (next > last) this.goTo(around ? first : last);
    else this.goTo(Math.max(first, next));
  }

  play(on) {
    this.playing = on;
    byId('play').textContent = on ? 'Pause' : 'Play';
    byId('play').setAttribute('aria-pressed', String(on));
    if (on) this.step(1, true);
  }

  // The next frame follows once this one is finished, or was looked at for a while.
  shown(header) {
    if (!this.playing || this.number === null || header.pane !== 0) return;
    if (isLater(this.number, header.number)) return;
    const age = performance.now() - this.asked;
    if (!header.finished && age < longestWait) return;
    this.number = null;
    setTimeout(() => { if (this.playing) this.step(1, true); }, Math.max(0, shortestFrame - age));
  }

  show(series) {
    byId('timeline').hidden = series === null;
    if (series === null) return;
    const slider = byId('frame');
    Object.assign(slider, {min: series.first, max: series.last, step: series.step});
    if (this.wanted === series.frame || document.activeElement !== slider) slider.value = series.frame;
    this.wanted = series.frame;
    this.showText(series);
  }

  showText({frame, last, time}) {
    const when = time === null || time === undefined ? '' : ` · t = ${short(time, 6)}`;
    byId('frame-text').textContent = `${frame} of ${last}${when}`;
    byId('frame').setAttribute('aria-valuetext', `frame ${frame}${when}`);
  }
}
