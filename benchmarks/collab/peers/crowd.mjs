// Clients that cost little: each says and hears all that a client of the peer does, but keeps no world, and
// drags one object. All run in one thread.
import { WebSocket } from './web_socket.mjs';

const kSampled = 16; // of so many messages one is asked when its drags were sent

export class Crowd {
  heard = 0; // drags of others, counted once for each client they came to
  #fail;
  /// Rejects when a connection has ended.
  failure = new Promise((_, reject) => (this.#fail = reject));
  #address;
  #dialect;
  #clients = [];
  #messages = 0;
  #ways = [];
  #beats;

  constructor(address, dialect) {
    this.#address = address;
    this.#dialect = dialect;
    this.failure.catch(() => {}); // also told when nobody waits for it
  }

  async join(count) {
    const at_once = 10;
    while (this.#clients.length < count)
      await Promise.all(
        Array.from({ length: Math.min(at_once, count - this.#clients.length) }, () => this.#join_one()));
  }

  async #join_one() {
    const client = { number: this.#clients.length + 1, next: 0 };
    this.#clients.push(client);
    const dialect = this.#dialect, path = await dialect.path(this.#address);
    await new Promise((resolve) => {
      let is_joined = false;
      const join = () => {
        is_joined = true;
        resolve();
      };
      const say = (message) => client.socket.send(message);
      client.socket = new WebSocket(this.#address, path, {
        opened: () => {
          if (dialect.greeting) say(dialect.greeting);
          if (!dialect.joined) join();
        },
        heard: (bytes, start, end) => {
          if (is_joined || !dialect.joined) this.#hear(client, bytes, start, end, say);
          else if (dialect.joined(bytes, start, end, say)) join();
          else dialect.other(bytes, start, end, say);
        },
        ended: (why) => this.#fail(new Error(`a connection has ended: ${why}`)),
      });
    });
  }

  #hear(client, bytes, start, end, say) {
    const updates = this.#dialect.updates(bytes, start, end, client);
    if (updates === 0) return this.#dialect.other(bytes, start, end, say);
    this.heard += updates;
    if (++this.#messages % kSampled !== 0) return;
    const now = performance.now();
    for (const sent of this.#dialect.times(bytes, start, end, client)) this.#ways.push(now - sent);
  }

  /// From now on each client drags its object, `rate` times a second.
  work(rate) {
    const gap = 1000 / rate, begin = performance.now();
    this.#clients.forEach((client, i) => (client.next = begin + (gap * i) / this.#clients.length)); // spread
    this.#beats = setInterval(() => {
      for (const client of this.#clients) {
        const now = performance.now();
        if (now < client.next) continue;
        client.next = Math.max(client.next + gap, now);
        client.socket.send(this.#dialect.drag(client, matrix_at(now)));
      }
    }, 1);
  }

  /// The ways since this was last called, ms, sorted.
  take_ways() {
    return Float64Array.from(this.#ways.splice(0)).sort();
  }

  close() {
    clearInterval(this.#beats);
    for (const client of this.#clients) client.socket?.close();
  }
}

/// Twelve numbers in place of a 3x4 matrix, all of them long as text, as they are in a real drag. The last one
/// is the time.
function matrix_at(time) {
  const c = Math.cos(time), s = Math.sin(time), a = 0.8 * c, b = 0.6 * s;
  return [c, s * 0.8, s * 0.6, -s, a, 0.6 * c, b, a * s, c * c, a * b, s * s, time];
}
