// What can be taken away: the camera as TOML, the command line, the picture.

import {byId, fillSelect, make, sentence} from './dom.js';

const formats = {png: 'PNG', jpg: 'JPEG', jpeg: 'JPEG', exr: 'EXR (unclamped light)', ppm: 'PPM', tif: 'TIFF'};

export class Share {
  constructor(session) {
    this.session = session;
    byId('copy-toml').addEventListener('click', () => this.copy('camera', 'Camera as TOML'));
    byId('copy-command').addEventListener('click', () => this.copy('command', 'Command line'));
    byId('save').addEventListener('click', () => this.save());
    byId('stop-saving').addEventListener('click', () => session.stopSaving());
    window.addEventListener('resize', () => fitHeight(byId('copied-text')));
    session.on('saving', ({share}) => { byId('saving-share').value = share; });
    session.on('state', ({settings, choices}) => {
      byId('share-pane-row').hidden = settings.panes.length < 2;
      const pairs = choices.formats.map((format) => [format, formats[format] ?? format]);
      fillSelect(byId('save-format'), pairs, byId('save-format').value || choices.formats[0]);
    });
  }

  get pane() {
    const {panes} = this.session.state.settings;
    return Math.min(panes.length - 1, Number(byId('share-pane').value));
  }

  async copy(what, label) {
    let texts;
    try {
      texts = await this.session.ask({type: 'texts', pane: this.pane}, 'texts');
    } catch (error) {
      return this.session.tell('problem', error.message);
    }
    if (!texts[what]) return this.session.tell('problem', 'This camera has no command line; its TOML has all of it.');
    const area = byId('copied-text');
    area.value = texts[what];
    byId('copied').hidden = false;
    fitHeight(area);
    const isCopied = await toClipboard(area);
    byId('copied-label').textContent = `${label}${isCopied ? ', copied' : ': copy it from here'}`;
  }

  async save() {
    byId('save').disabled = true;
    byId('saving').hidden = false;
    byId('saving-share').value = 0;
    byId('saved').textContent = 'Rendering at full quality.';
    try {
      const {url, name} = await this.session.ask(
          {type: 'save', pane: this.pane, format: byId('save-format').value}, 'saved');
      const link = make('a', {href: url, download: name, textContent: name});
      byId('saved').replaceChildren('Saved as ', link, '.');
      link.click();
    } catch (error) {
      byId('saved').textContent = sentence(error.message);
    }
    byId('save').disabled = false;
    byId('saving').hidden = true;
  }
}

// All lines of the text show, wrapped as they are.
function fitHeight(area) {
  area.style.height = 'auto';
  area.style.height = `${area.scrollHeight + area.offsetHeight - area.clientHeight}px`;
}

// Only pages of this machine, or by https, may use the clipboard; the old way is left to the others.
async function toClipboard(area) {
  try {
    await navigator.clipboard.writeText(area.value);
    return true;
  } catch {
    const before = document.activeElement;
    area.select();
    const isCopied = document.execCommand('copy');
    before?.focus();
    return isCopied;
  }
}
