// A pixel that was picked: what it hit, and Whitted's recursion as an indented list.

import {byId, counted, make, short} from './dom.js';

const kinds = {
  primary: 'Primary ray', reflection: 'Reflection', refraction: 'Refraction', shadow: 'Shadow ray',
};
const openDepth = 4;  // rays with fewer bounces are shown unfolded

/** A colour as numbers: one where its channels are equal. */
export function colorText(color) {
  const [r, g, b] = color.map((channel) => short(channel, 3));
  return r === g && g === b ? r : `${r} ${g} ${b}`;
}

/** What a screen shows of linear light. */
function cssColor(color, exposure) {
  const codes = color.map((channel) => {
    const x = Math.max(0, Math.min(1, channel * 2 ** exposure));
    return Math.round(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055));
  });
  return `rgb(${codes.join(' ')})`;
}

const vectorText = (vector, digits) => vector.map((x) => short(x, digits)).join(', ');

export class Rays {
  constructor(session, overlay) {
    this.session = session;
    this.overlay = overlay;
    byId('draw-rays').addEventListener('change', () => overlay.show(byId('draw-rays').checked));
    const tree = byId('ray-tree');
    for (const event of ['pointerover', 'focusin']) {
      tree.addEventListener(event, ({target}) => overlay.highlight(rayOf(target)));
    }
    for (const event of ['pointerleave', 'focusout']) {
      tree.addEventListener(event, () => overlay.highlight(null));
    }
  }

  /** Asks for the rays of a pixel and shows them. */
  async pick(pane, x, y) {
    let picked;
    try {
      picked = await this.session.ask({type: 'pick', pane, x, y}, 'picked');
    } catch (error) {
      this.session.tell('problem', error.message);
      return null;
    }
    this.show(picked);
    return picked;
  }

  show(picked) {
    this.exposure = this.session.state.settings.exposure;
    byId('rays-section').open = true;
    byId('rays').hidden = false;
    byId('rays-hint').hidden = true;
    this.showHit(picked);
    this.showTree(picked);
    this.overlay.set(picked);
    byId('rays-section').scrollIntoView({block: 'nearest'});
  }

  hide() {
    byId('rays').hidden = true;
    byId('rays-hint').hidden = false;
    this.overlay.set(null);
  }

  showHit({pane, x, y, hit, color}) {
    const isOne = this.session.state.settings.panes.length < 2;
    const facts = [['Pixel', `${x}, ${y}${isOne ? '' : ` of ${'AB'[pane]}`}`]];
    if (hit) {
      const material = hit.material ? ` (${hit.material})` : '';
      facts.push(['Primitive', `${hit.kind} ${hit.primitive}${material}`]);
      facts.push(['t', short(hit.t, 9)]);
      facts.push(['Normal', vectorText(hit.normal, 4)]);
      facts.push(['Point', vectorText(hit.position, 6)]);
      if (hit.kind === 'sphere') facts.push(['Centre', vectorText(hit.center, 6)], ['Radius', short(hit.radius, 6)]);
      if (hit.kind === 'capsule')
        facts.push(['Ends', `${vectorText(hit.a, 6)}, ${vectorText(hit.b, 6)}`], ['Radius', short(hit.radius, 6)]);
    } else {
      facts.push(['Primitive', 'none: the background']);
    }
    const list = facts.flatMap(([name, value]) => [make('dt', {textContent: name}), make('dd', {textContent: value})]);
    list.push(make('dt', {textContent: 'Radiance'}), make('dd', {}, ...this.colorNodes(color)));
    byId('hit').replaceChildren(...list);
  }

  colorNodes(color) {
    const swatch = make('span', {className: 'swatch', 'aria-hidden': 'true'});
    swatch.style.setProperty('--color', cssColor(color, this.exposure));
    return [swatch, colorText(color)];
  }

  showTree({rays}) {
    this.rays = rays;
    this.children = rays.map(() => []);
    rays.forEach((ray, index) => {
      if (ray.parent !== null) this.children[ray.parent].push(index);
    });
    const roots = rays.map((ray, index) => index).filter((index) => rays[index].parent === null);
    const shadows = rays.filter(({kind}) => kind === 'shadow').length;
    const ofThem = shadows > 0 ? `, ${shadows} of them to lights` : '';
    const count = make('p', {className: 'hint', textContent: `${counted(rays.length, 'ray')}${ofThem}.`});
    byId('ray-tree').replaceChildren(count, this.makeList(roots));
  }

  makeList(indices) {
    return make('ul', {}, ...indices.map((index) => this.makeItem(index)));
  }

  // Children of folded rays are made when they are asked for: glass has many.
  makeItem(index) {
    const ray = this.rays[index];
    const item = make('li', {className: `ray ${ray.kind}`});
    item.dataset.ray = index;
    const children = this.children[index];
    if (children.length === 0) {
      item.append(make('div', {className: 'ray-row'}, ...this.makeRow(ray)));
      return item;
    }
    const details = make('details', {}, make('summary', {className: 'ray-row'}, ...this.makeRow(ray)));
    const unfold = () => {
      if (details.open && details.children.length === 1) details.append(this.makeList(children));
    };
    details.addEventListener('toggle', unfold);
    if (ray.depth < openDepth) {
      details.open = true;
      unfold();
    }
    item.append(details);
    return item;
  }

  makeRow(ray) {
    const head = make('span', {className: 'ray-head'},
                      make('span', {className: 'ray-mark', 'aria-hidden': 'true'}),
                      make('b', {textContent: kinds[ray.kind] ?? ray.kind}), ' ', this.goal(ray));
    const facts = make('span', {className: 'ray-facts'});
    const fact = (name, ...value) => facts.append(
        make('span', {className: 'fact'}, make('span', {className: 'fact-name', textContent: name}), ...value), ' ');
    if (ray.t !== null) fact('t', short(ray.t, 6));
    if (ray.kind !== 'primary') fact('weight', colorText(ray.weight));
    if (ray.kind === 'shadow') {
      fact('lets through', ...this.colorNodes(ray.own));
    } else {
      fact('own light', ...this.colorNodes(ray.own));
      fact('result', ...this.colorNodes(ray.returned));
    }
    return [head, facts];
  }

  goal(ray) {
    const met = ray.primitive === null ? null : this.primitiveName(ray);
    if (ray.kind !== 'shadow') return met ? `meets ${met}` : 'meets the background';
    const light = `to light ${ray.light}`;
    if (!ray.blocked) return `${light}: free`;
    return `${light}: blocked${met ? ` by ${met}` : ''}`;
  }

  primitiveName({primitive, material}) {
    const {spheres, planes} = this.session.state.scene;
    const kind = primitive < spheres ? 'sphere' : primitive < spheres + planes ? 'plane' : 'capsule';
    return `${kind} ${primitive}${material ? ` (${material})` : ''}`;
  }
}

function rayOf(target) {
  const item = target.closest('[data-ray]');
  return item ? Number(item.dataset.ray) : null;
}
