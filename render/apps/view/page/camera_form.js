// The fields of the camera.

import {byId, fillSelect, make, onNumber, showValue} from './dom.js';
import {fovLimits, frameOf, keysOf} from './camera.js';
import {cameraName, meanings, plain} from './words.js';

// A number for a field, where it may be edited.
const editable = (number, digits = 6) => plain(Number(number.toPrecision(digits)));

// Keys that are not called by their own names, that say more, or that stay as the scene has them.
const looks = {
  fov: {label: 'Field of view', digits: 4},
  focus: {placeholder: 'what it looks at'},
  fov_axis: {isHidden: true},
};

export class CameraForm {
  constructor(session, gestures) {
    this.session = session;
    byId('camera-type').addEventListener('change', () => this.chooseType());
    byId('fit').addEventListener('click', () => gestures.fitAll());
    byId('reset').addEventListener('click', () => gestures.reset());
    session.on('camera', (camera) => this.show(camera));
    session.on('state', (state) => this.showTypes(state));
  }

  /** A row for each number and each name of this kind of camera. */
  makeRows(camera) {
    this.type = camera.type;
    this.rows = Object.entries(keysOf(camera))
        .filter(([key, {kind}]) => ['number', 'name'].includes(kind) && !looks[key]?.isHidden)
        .map(([key, rule]) => ({key, ...this.makeRow(key, rule)}));
    byId('camera-rows').replaceChildren(...this.rows.map(({row}) => row));
  }

  makeRow(key, rule) {
    const label = looks[key]?.label ?? (key[0].toUpperCase() + key.slice(1)).replaceAll('_', ' ');
    const field = rule.kind === 'name' ? this.makeSelect(key, rule) : this.makeNumber(key, rule);
    field.title = meanings[`camera-${key}`] ?? '';
    let cell = field;
    if (rule.unit) {
      field.setAttribute('aria-label', `${label} in ${rule.unit}`);
      const unit = make('span', {'aria-hidden': 'true', textContent: rule.unit === 'degrees' ? '°' : rule.unit});
      cell = make('span', {className: 'pair'}, ...(key === 'fov' ? [this.makeSlider()] : []), field, unit);
    }
    const htmlFor = (cell.querySelector('input') ?? field).id;
    return {field, row: make('div', {className: 'row'}, make('label', {htmlFor, textContent: label, title: field.title}), cell)};
  }

  makeSelect(key, {names}) {
    const select = make('select', {id: `camera-${key}`},
                        ...names.map((value) => make('option', {value, text: value})));
    select.addEventListener('change', () => this.session.move({[key]: select.value}, false));
    return select;
  }

  makeNumber(key, {low, high, optional}) {
    const input = make('input', {
      id: `camera-${key}`, inputMode: 'decimal', autocomplete: 'off', placeholder: looks[key]?.placeholder,
    });
    onNumber(input, (number) => this.session.move({[key]: number}, false),
             {low: low ?? -Infinity, high: high ?? Infinity, empty: optional ? null : undefined});
    return input;
  }

  // The slider is logarithmic: a degree matters more at 2 than at 100.
  makeSlider() {
    const slider = make('input', {type: 'range', id: 'camera-fov-slider', step: 'any', title: meanings['camera-fov']});
    slider.addEventListener('input', () =>
      this.session.move({fov: Number(Math.exp(slider.value).toPrecision(3))}));
    slider.addEventListener('change', () => this.session.rest());
    return slider;
  }

  chooseType() {
    const type = byId('camera-type').value;
    const changes = {type};
    // A lens that is open far enough for its blur to be seen.
    if (keysOf(changes).aperture) changes.aperture = Number((frameOf(this.session.camera).distance / 60).toPrecision(2));
    this.session.move(changes, false);
  }

  showTypes({choices, camera}) {
    const isFixed = !choices.camera_types.includes(camera.type);
    const types = isFixed ? [camera.type] : choices.camera_types;
    fillSelect(byId('camera-type'), types.map((type) => [type, cameraName(type)]), camera.type);
    byId('camera-type').disabled = isFixed;
  }

  show(camera) {
    if (camera.type !== this.type) this.makeRows(camera);
    byId('camera-type').value = camera.type;
    for (const {key, field, row} of this.rows) {
      const value = camera[key];
      row.hidden = value === undefined;  // until the server has chosen it
      if (row.hidden) continue;
      showValue(field, typeof value === 'number' ? editable(value, looks[key]?.digits) : value ?? '');
      if (key === 'fov') this.showSlider(camera);
    }
    const hasFocus = camera.focus !== undefined;
    byId('click-focus').disabled = !hasFocus;
    byId('focus-hint').hidden = hasFocus;
    if (!hasFocus && byId('click-focus').checked) {
      document.querySelector('#click-mode input[value=rays]').checked = true;
    }
  }

  showSlider(camera) {
    const slider = byId('camera-fov-slider');
    const [low, high] = fovLimits(camera);
    slider.min = Math.log(low);
    slider.max = Math.log(high);
    if (document.activeElement !== slider) slider.value = Math.log(camera.fov);
    slider.setAttribute('aria-valuetext', `${editable(camera.fov, 4)} degrees`);
  }
}
