// What the page knows of the server: its state, the camera, and what was asked for.

import {learnKinds} from './camera.js';

/** Whether a number of a message comes after another one. They go round: 0 follows the largest. */
export const isLater = (a, b) => ((a - b) | 0) > 0;

export class Session {
  constructor() {
    this.state = null;
    this.camera = null;
    this.number = null;        // the last number that was sent or came; null before the first state
    this.cameraNumber = null;  // the last one of a camera
    this.startCamera = null;
    this.startSize = null;
    this.listeners = new Map();
    this.isMoving = false;
    this.waiting = new Map();  // id -> what to do with the answer
    [this.id] = crypto.getRandomValues(new Uint32Array(1));  // another one than other pages have
    this.pending = null;  // a camera that waits for the next picture of the screen
  }

  on(event, listener) {
    if (!this.listeners.has(event)) this.listeners.set(event, []);
    this.listeners.get(event).push(listener);
  }

  tell(event, value) {
    for (const listener of this.listeners.get(event) ?? []) listener(value);
  }

  /** Takes a message of the server. */
  receive(message) {
    if (message.type === 'state') return this.take(message);
    if (message.type === 'camera') return this.takeCamera(message);
    if (!this.answer(message)) this.tell(message.type, message);
  }

  /** Hands an answer, or an error, to who asked; whether somebody did. */
  answer(message) {
    const isError = message.type === 'error';
    for (const [id, {type, resolve, reject}] of this.waiting) {
      if (message.id !== id || (!isError && message.type !== type)) continue;
      this.waiting.delete(id);
      if (isError) reject(new Error(message.text));
      else resolve(message);
      return true;
    }
    return isError && message.about === 'stop_saving';  // what is over already
  }

  take(state) {
    const isFirst = this.state === null || this.state.scene.path !== state.scene.path;
    this.state = state;
    learnKinds(state.choices.cameras);
    if (isFirst) {
      this.startCamera = structuredClone(state.start?.camera ?? state.camera);
      this.startSize = state.start?.size ?? state.settings.size;
    }
    if (isFirst) this.camera = null;
    const isBack = this.number === null;
    if (isBack) this.number = this.cameraNumber = state.number;
    this.takeCamera(state);
    this.tell('state', state);
    // The server knows by the id that it was asked before.
    if (isBack) this.waiting.forEach(({message}) => this.connection.send(message));
  }

  /** Takes the camera of the server, which another page may have moved. One from before our last is old,
   * and while we move it ours counts. */
  takeCamera({number, camera}) {
    if (isLater(number, this.number)) this.number = number;  // all pages count on from the latest
    if (this.camera && (isLater(this.cameraNumber, number) || this.pending || this.isMoving)) return;
    this.camera = structuredClone(camera);
    this.tell('camera', this.camera);
  }

  /** A connection began: the numbers count from what the server shows. A picture that is being saved
   * is still wanted. */
  restart() {
    this.camera = null;
    this.pending = null;
    this.isMoving = false;
    this.number = this.cameraNumber = null;
    this.giveUp('the connection was lost', (type) => type !== 'saved');
  }

  /** No answer is waited for any more, of these types. */
  giveUp(why, isOver = () => true) {
    for (const [id, {type, reject}] of this.waiting) {
      if (!isOver(type)) continue;
      this.waiting.delete(id);
      reject(new Error(why));
    }
  }

  /** The picture that is being saved is not wanted any more. */
  stopSaving() {
    for (const [id, {type}] of this.waiting) {
      if (type !== 'saved' || this.connection.send({type: 'stop_saving', id})) continue;
      this.giveUp('stopped', (asked) => asked === 'saved');  // the server hears of it by hearing nothing
    }
  }

  /** Sends a message with the next number, which it returns. */
  sendNumbered(message) {
    this.number = (this.number + 1) >>> 0;
    this.connection.send({...message, number: this.number});
    return this.number;
  }

  /** Changes keys of the camera. Many changes between two pictures of the screen are one message. */
  move(changes, moving = true) {
    if (!this.camera) return;
    Object.assign(this.camera, changes);
    const isWaiting = this.pending !== null;
    this.pending = {...this.pending, ...changes};
    this.isMoving = moving;
    this.tell('camera', this.camera);
    if (!isWaiting) requestAnimationFrame(() => this.flush());
  }

  /** Nothing moves any more: the picture may come to rest. */
  rest() {
    if (!this.camera || (!this.isMoving && !this.pending)) return;
    this.isMoving = false;
    this.flush(true);
  }

  flush(even = false) {
    if (!this.pending && !even) return;
    const camera = this.pending ?? {eye: this.camera.eye};
    this.pending = null;
    this.cameraNumber = this.sendNumbered({type: 'camera', camera, moving: this.isMoving});
  }

  /** Changes settings as the state has them. */
  change(settings) {
    this.flush();
    return this.sendNumbered({type: 'settings', ...settings});
  }

  /** Sends a message that is answered by one of the type `answer`: a promise of it. */
  ask(message, answer) {
    this.flush();
    this.id = (this.id + 1) >>> 0;
    const {id} = this;
    // The server answers the newest question of a kind.
    for (const [old, {type}] of this.waiting) if (type === answer) this.waiting.delete(old);
    return new Promise((resolve, reject) => {
      this.waiting.set(id, {type: answer, resolve, reject, message: {...message, id}});
      this.connection.send({...message, id});
    });
  }
}
