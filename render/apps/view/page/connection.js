// The WebSocket: connects, connects again, hands on what comes.

const longestWait = 5000;  // milliseconds between attempts

export class Connection {
  /** Handlers: `status(kind)` with kind connecting, open, away or refused; `text(message)`;
   * `binary(buffer)`. */
  constructor(token, handlers) {
    this.token = token;
    this.handlers = handlers;
    this.wait = 1000;
    this.connect();
  }

  connect() {
    clearTimeout(this.timer);
    this.handlers.status('connecting');
    const scheme = location.protocol === 'https:' ? 'wss' : 'ws';
    const socket = new WebSocket(`${scheme}://${location.host}/socket?token=${encodeURIComponent(this.token)}`);
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => {
      this.wait = 1000;
      this.handlers.status('open');
    };
    socket.onmessage = ({data}) => {
      if (typeof data === 'string') this.handlers.text(JSON.parse(data));
      else this.handlers.binary(data);
    };
    socket.onclose = () => this.closed();
    this.socket = socket;
  }

  /** Sends a message, or drops it where nobody listens: whether somebody does. */
  send(message) {
    const isOpen = this.socket.readyState === WebSocket.OPEN;
    if (isOpen) this.socket.send(JSON.stringify(message));
    return isOpen;
  }

  async closed() {
    const refused = await this.isRefused();
    this.handlers.status(refused ? 'refused' : 'away');
    if (refused) return;
    this.timer = setTimeout(() => this.connect(), this.wait);
    this.wait = Math.min(longestWait, this.wait * 1.5);
  }

  // A socket does not tell why it was refused; the page's own address does.
  async isRefused() {
    try {
      const answer = await fetch(`/?token=${encodeURIComponent(this.token)}`, {method: 'HEAD'});
      return answer.status === 403;
    } catch {
      return false;
    }
  }
}
