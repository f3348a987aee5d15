// Lines around what is seen, fog, and particles that are seen through.

import {accept, byId, fillSelect, onNumber, showValue} from './dom.js';
import {outlineRuleName} from './words.js';

const usualOpacity = 0.2;

export class Look {
  constructor(session) {
    this.session = session;
    byId('look-form').addEventListener('submit', (event) => event.preventDefault());
    onNumber(byId('outline'), (outline) => session.change({outline}), {low: 0, high: 100});
    byId('fog').addEventListener('input', () => session.change({fog: Number(byId('fog').value)}));
    byId('outline-by').addEventListener('change', () => this.change({outline_by: byId('outline-by').value}));
    byId('ghost').addEventListener('input', () => { byId('ghost').dataset.edited = '1'; });
    byId('ghost').addEventListener('change', () => {
      delete byId('ghost').dataset.edited;
      accept(byId('ghost'));
      this.change({ghost: byId('ghost').value.trim()});
    });
    byId('opacity').addEventListener('change', () => this.change({opacity: Number(byId('opacity').value)}));
    byId('opacity').addEventListener('input', () => showShare('opacity', Number(byId('opacity').value)));
    session.on('state', (state) => this.show(state));
  }

  change(look) {
    this.session.flush();
    this.session.sendNumbered({type: 'particles', ...look});
  }

  show({settings, particles, choices}) {
    showValue(byId('outline'), settings.outline);
    if (document.activeElement !== byId('fog')) byId('fog').value = settings.fog;
    showShare('fog', settings.fog);
    const look = particles?.look ?? null;
    for (const id of ['particle-look', 'outline-by-row']) byId(id).hidden = look === null;
    if (look === null) return;
    const rules = [...new Set(['', ...choices.outline_rules, look.outline_by])];
    fillSelect(byId('outline-by'), rules.map((rule) => [rule, outlineRuleName(rule)]), look.outline_by);
    // A text that is refused stays, but only in the page where it was typed.
    const isRefused = byId('ghost').hasAttribute('aria-invalid') && look.ghost === this.ghost &&
        byId('ghost').value.trim() !== look.ghost;
    if (!isRefused) showValue(byId('ghost'), look.ghost);
    this.ghost = look.ghost;
    const opacity = look.opacity ?? usualOpacity;
    byId('opacity').disabled = look.ghost === '';
    if (document.activeElement !== byId('opacity')) byId('opacity').value = opacity;
    showShare('opacity', opacity);
  }
}

function showShare(id, share) {
  byId(`${id}-text`).textContent = share === 0 && id === 'fog' ? 'none' : `${Math.round(100 * share)} %`;
}
