// The controls of the panes and of the picture's quality.

import {byId, fillSelect, make, onNumber, showValue} from './dom.js';
import {differenceName, epsilonName, meanings, methodName, orderName, paceName, plain} from './words.js';

const rows = [
  {key: 'order', label: 'Order', choices: 'orders', name: orderName},
  {key: 'solver', label: 'Solver', choices: 'solvers', name: (solver) => solver},
  {key: 'method', label: 'Method', choices: 'methods', name: methodName},
  {key: 'shadow_epsilon', label: 'Shadows', choices: 'shadow_epsilons', name: epsilonName},
];

// What is shown beside the first pane, the first of them that differs from it.
const beside = {
  order: ['frameless', 'rows'],
  solver: ['fast', 'robust'],
  method: ['path', 'whitted'],
  shadow_epsilon: ['none', null],
};
const first = {shadow_epsilon: null, solver: 'robust', order: 'rows'};

export class Settings {
  constructor(session, panes) {
    this.session = session;
    this.panes = panes;
    this.selects = [];
    this.comparison = null;
    byId('compare').addEventListener('change', () => this.compare(byId('compare').value));
    byId('difference').addEventListener('change',
                                        () => session.change({difference: byId('difference').value}));
    byId('pace').addEventListener('change', () => session.change({pace: Number(byId('pace').value)}));
    this.listenToQuality();
    session.on('state', (state) => this.show(state));
  }

  listenToQuality() {
    const {session} = this;
    const side = (axis) => (value) => {
      const size = [...session.state.settings.size];
      size[axis] = value;
      session.change({size});
    };
    onNumber(byId('width'), side(0), {low: 1, whole: true});
    onNumber(byId('picture-height'), side(1), {low: 1, whole: true});
    onNumber(byId('spp'), (spp) => session.change({spp}), {low: 1, whole: true});
    onNumber(byId('max-depth'), (depth) => session.change({max_depth: depth}), {low: 0, whole: true});
    byId('exposure').addEventListener('input',
                                      () => session.change({exposure: Number(byId('exposure').value)}));
    byId('size-window').addEventListener('click', () => session.change({size: this.panes.shownSize()}));
    byId('size-scene').addEventListener('click', () => session.change({size: session.startSize}));
  }

  /** Two panes that differ in one setting, or one pane. */
  compare(key) {
    const [pane] = this.session.state.settings.panes;
    this.comparison = key;
    if (key === '') return this.session.change({panes: [pane], difference: 'none'});
    const one = key in first ? {...pane, [key]: first[key]} : pane;
    const other = beside[key].find((value) => value !== one[key]);
    this.session.change({panes: [one, {...one, [key]: other}]});
  }

  changePane(index, key, value) {
    const panes = structuredClone(this.session.state.settings.panes);
    panes[index][key] = value;
    this.session.change({panes});
  }

  show(state) {
    const {settings, choices} = state;
    this.showTable(state);
    this.showComparison(settings.panes);
    byId('difference-row').hidden = settings.panes.length < 2;
    fillSelect(byId('difference'), choices.differences.map((kind) => [kind, differenceName(kind)]),
               settings.difference);
    const paces = [...new Set([...choices.paces, settings.pace])];
    fillSelect(byId('pace'), paces.map((pace) => [String(pace), paceName(pace)]), String(settings.pace));
    showValue(byId('width'), settings.size[0]);
    showValue(byId('picture-height'), settings.size[1]);
    showValue(byId('spp'), settings.spp);
    showValue(byId('max-depth'), settings.max_depth);
    if (document.activeElement !== byId('exposure')) byId('exposure').value = settings.exposure;
    const stops = settings.exposure;
    byId('exposure-text').textContent = `${stops > 0 ? '+' : ''}${String(stops).replace('-', '−')} stops`;
  }

  showComparison(panes) {
    const differing = panes.length < 2 ? [] : rows.filter(({key}) => panes[0][key] !== panes[1][key]);
    let shown = differing.length === 1 ? differing[0].key : 'own';
    if (panes.length < 2) shown = '';
    byId('compare').querySelector('[value=own]').hidden = shown !== 'own';
    byId('compare').value = shown;
  }

  showTable(state) {
    const {panes} = state.settings;
    if (this.selects.length !== panes.length) this.makeTable(panes.length);
    panes.forEach((pane, index) => {
      for (const row of rows) {
        const values = [...state.choices[row.choices]];
        if (!values.includes(pane[row.key])) values.push(pane[row.key]);
        const pairs = values.map((value) => [JSON.stringify(value), row.name(value)]);
        if (row.key === 'shadow_epsilon') pairs.push(['other', 'other ε …']);
        fillSelect(this.selects[index][row.key], pairs, JSON.stringify(pane[row.key]));
      }
      const own = byId(`own-epsilon-${index}`);
      if (document.activeElement === own) return;
      own.hidden = true;
      showValue(own, '');
    });
  }

  makeTable(count) {
    const letters = ['A', 'B'];
    const table = make('table', {className: count > 1 ? 'pane-table two' : 'pane-table'});
    if (count > 1) {
      table.append(make('thead', {}, make('tr', {}, make('td'),
          ...letters.map((letter) => make('th', {scope: 'col', textContent: letter})))));
    }
    const body = make('tbody');
    this.selects = Array.from({length: count}, () => ({}));
    for (const row of rows) {
      const line = make('tr', {}, make('th', {scope: 'row', textContent: row.label, title: meanings[row.key]}));
      for (let index = 0; index < count; index += 1) line.append(this.makeCell(row, index, count));
      body.append(line);
    }
    table.append(body);
    byId('pane-table').replaceChildren(table);
  }

  makeCell(row, index, count) {
    const of = count > 1 ? ` of picture ${'AB'[index]}` : '';
    const select = make('select', {
      'aria-label': row.label + of, id: `${row.key}-${index}`, title: meanings[row.key],
    });
    this.selects[index][row.key] = select;
    const cell = make('td', {}, select);
    if (row.key !== 'shadow_epsilon') {
      select.addEventListener('change', () => this.changePane(index, row.key, JSON.parse(select.value)));
      return cell;
    }
    const own = make('input', {
      'aria-label': `Epsilon${of}`, id: `own-epsilon-${index}`, inputMode: 'decimal', autocomplete: 'off', hidden: true,
    });
    onNumber(own, (epsilon) => this.changePane(index, row.key, epsilon), {low: 0});
    select.addEventListener('change', () => {
      own.hidden = select.value !== 'other';
      if (own.hidden) return this.changePane(index, row.key, JSON.parse(select.value));
      const now = this.session.state.settings.panes[index].shadow_epsilon;
      own.value = typeof now === 'number' ? plain(now) : '';
      own.focus();
    });
    cell.append(own);
    return cell;
  }
}
