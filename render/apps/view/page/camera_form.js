// The fields of the camera.

import {byId, fillSelect, onNumber, showValue} from './dom.js';
import {fovLimits, frameOf} from './camera.js';
import {cameraName, plain} from './words.js';

// A number for a field, where it may be edited.
const editable = (number, digits = 6) => plain(Number(number.toPrecision(digits)));

export class CameraForm {
  constructor(session, gestures) {
    this.session = session;
    byId('camera-type').addEventListener('change', () => this.chooseType());
    byId('fov').addEventListener('input', () => session.move({fov: this.fovOf(Number(byId('fov').value))}));
    byId('fov').addEventListener('change', () => session.rest());
    onNumber(byId('fov-number'), (fov) => session.move({fov}, false), {low: 0.01, high: 360});
    onNumber(byId('height'), (height) => session.move({height}, false), {low: 0});
    onNumber(byId('aperture'), (aperture) => session.move({aperture}, false), {low: 0});
    onNumber(byId('focus'), (focus) => session.move({focus}, false), {low: 0, empty: null});
    byId('fit').addEventListener('click', () => gestures.fitAll());
    byId('reset').addEventListener('click', () => gestures.reset());
    session.on('camera', (camera) => this.show(camera));
    session.on('state', (state) => this.showTypes(state));
  }

  // The slider is logarithmic: a degree matters more at 2 than at 100.
  fovOf(position) { return Number(Math.exp(position).toPrecision(3)); }

  chooseType() {
    const type = byId('camera-type').value;
    const changes = {type};
    // A lens that is open far enough for its blur to be seen.
    if (type === 'thin_lens') changes.aperture = Number((frameOf(this.session.camera).distance / 60).toPrecision(2));
    this.session.move(changes, false);
  }

  showTypes({choices, camera}) {
    const types = camera.type === 'lens' ? ['lens'] : choices.camera_types;
    fillSelect(byId('camera-type'), types.map((type) => [type, cameraName(type)]), camera.type);
    byId('camera-type').disabled = camera.type === 'lens';
  }

  show(camera) {
    for (const row of document.querySelectorAll('#camera-section [data-key]')) {
      row.hidden = camera[row.dataset.key] === undefined;
    }
    byId('camera-type').value = camera.type;
    if (camera.fov !== undefined) this.showFov(camera);
    if (camera.height !== undefined) showValue(byId('height'), editable(camera.height));
    if (camera.aperture !== undefined) showValue(byId('aperture'), editable(camera.aperture));
    const hasFocus = camera.focus !== undefined;
    if (hasFocus) showValue(byId('focus'), camera.focus === null ? '' : editable(camera.focus));
    byId('click-focus').disabled = !hasFocus;
    byId('focus-hint').hidden = hasFocus;
    if (!hasFocus && byId('click-focus').checked) {
      document.querySelector('#click-mode input[value=rays]').checked = true;
    }
  }

  showFov(camera) {
    const [low, high] = fovLimits(camera);
    const slider = byId('fov');
    slider.min = Math.log(low);
    slider.max = Math.log(high);
    if (document.activeElement !== slider) slider.value = Math.log(camera.fov);
    slider.setAttribute('aria-valuetext', `${editable(camera.fov, 4)} degrees`);
    showValue(byId('fov-number'), editable(camera.fov, 4));
  }
}
