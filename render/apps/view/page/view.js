// Puts the parts of the page together.

import {CameraForm} from './camera_form.js';
import {Connection} from './connection.js';
import {byId, counted, make, refuse, sentence, short} from './dom.js';
import {FrameReader} from './frames.js';
import {Gestures} from './gestures.js';
import {Look} from './look.js';
import {Overlay} from './overlay.js';
import {Panes} from './panes.js';
import {Particles} from './particles.js';
import {Rays} from './rays.js';
import {isLater, Session} from './session.js';
import {Settings} from './settings.js';
import {Share} from './share.js';
import {Timeline} from './timeline.js';
import {meanings} from './words.js';

const links = {
  connecting: 'Connecting …',
  open: 'Connected',
  away: 'The server is away. Trying again …',
  refused: 'The server asks for another token. Open the address that it printed.',
};

const session = new Session();
const panes = new Panes(byId('stage'), session);
const overlay = new Overlay(session, panes);
const rays = new Rays(session, overlay);
const timeline = new Timeline(session);
const gestures = new Gestures(byId('stage'), session, {
  click: (pane, x, y) => clicked(pane.isDifference ? 0 : pane.index, x, y),
  turn: (pane, x, y) => clicked(pane.isDifference ? 0 : pane.index, x, y, 'turn'),
  crosshair: overlay,
  frameStep: (count) => timeline.step(count),
});
new Settings(session, panes);
new CameraForm(session, gestures);
new Particles(session);
new Look(session);
new Share(session);

async function clicked(pane, x, y, mode = document.querySelector('#click-mode input:checked').value) {
  if (mode === 'rays') return rays.pick(pane, x, y);
  let hit;
  try {
    ({hit} = await session.ask({type: 'pick', pane, x, y}, 'picked'));
  } catch (error) {
    return showProblem(error.message);
  }
  if (!hit) return showProblem('Nothing is there.');
  if (mode === 'turn') session.move({look_at: hit.position}, false);
  else session.move({focus: hit.depth}, false);
}

function showLink(kind) {
  const link = byId('link');
  link.dataset.kind = kind;
  link.textContent = links[kind];
  document.body.dataset.link = kind;
  if (kind === 'connecting') session.restart();
  if (kind === 'refused') session.giveUp('the server was started anew');
}

for (const [id, meaning] of Object.entries(meanings)) {
  for (const element of [byId(id), document.querySelector(`label[for=${id}]`)]) {
    if (element) element.title = meaning;
  }
}

document.querySelectorAll('[data-side]').forEach((button) => button.addEventListener('click', () => {
  const {side} = button.dataset;
  gestures.lookFrom(side.at(-1), side.length > 1 ? -1 : 1);
}));
byId('axes').addEventListener('change', () => overlay.draw());
byId('full-screen').hidden = !document.fullscreenEnabled;
byId('full-screen').addEventListener('click', () => byId('stage-area').requestFullscreen());

// Shown until it is closed, or a value that was entered after it is right.
let problemNumber = 0;

function showProblem(text) {
  const close = make('button', {type: 'button', textContent: 'Close'});
  close.addEventListener('click', hideProblem);
  byId('problem').replaceChildren(make('p', {textContent: sentence(text)}), close);
  problemNumber = session.number;
}

function hideProblem() {
  byId('problem').replaceChildren();
}

// The fields of the keys that the server may refuse; `camera.fov` is `camera-fov`.
const fields = {
  size: ['width', 'picture-height'], spp: ['spp'], max_depth: ['max-depth'], range: ['range-low', 'range-high'],
};

let entered = null;  // the field that was used last

function showError({text, key: option}) {
  const key = option?.replace(/^--/, '');
  showProblem(key && !text.includes(key) ? `${key}: ${text}` : text);
  const ids = fields[key] ?? [key?.replace('.', '-')].filter(byId);
  for (const id of ids.includes(entered) ? [entered] : ids) refuse(byId(id), sentence(text));
}

function showScene({scene, version}) {
  const name = scene.path.split(/[\\/]/).pop();
  byId('scene-name').textContent = name;
  byId('scene-name').title = scene.path;
  document.title = `${name} – boule view`;
  const facts = [counted(scene.spheres, 'sphere')];
  if (scene.planes) facts.push(counted(scene.planes, 'plane'));
  if (scene.capsules) facts.push(counted(scene.capsules, 'capsule'));
  if (scene.lights) facts.push(counted(scene.lights, 'light'));
  byId('scene-facts').textContent = facts.join(' · ');
  byId('version').textContent = `boule ${version}`;
  byId('notes-section').hidden = scene.notes.length === 0;
  byId('notes').replaceChildren(...scene.notes.map((note) => make('li', {textContent: sentence(note)})));
}

session.on('state', showScene);
session.on('problem', showProblem);
session.on('hide', () => rays.hide());
session.on('error', showError);
session.on('state', ({number}) => { if (isLater(number, problemNumber)) hideProblem(); });
document.addEventListener('right', ({target}) => {
  entered = target.id;
  hideProblem();
});
session.on('busy', ({text}) => { byId('busy').textContent = text === null ? '' : sentence(text); });

const token = new URLSearchParams(location.search).get('token') ?? '';
let reader;
session.connection = new Connection(token, {
  status: showLink,
  text: (message) => session.receive(message),
  binary: (buffer) => reader.take(buffer),
});
reader = new FrameReader(session.connection, (header, bitmap) => panes.show(header, bitmap));
// For scripts and tests: what the page knows.
window.bouleView = {session, panes, short};
