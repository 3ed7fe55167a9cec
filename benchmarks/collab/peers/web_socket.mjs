// A WebSocket client over TLS that costs as little as JavaScript allows, so that the server is what is
// measured: frames are read where TLS left them, and none is copied unless it came in parts.
import { randomBytes } from 'node:crypto';
import { connect } from 'node:tls';

const kContinuation = 0, kText = 1, kBinary = 2, kClose = 8, kPing = 9;

export class WebSocket {
  #socket;
  #rest = Buffer.alloc(0); // a frame that has come in part
  #is_open = false;
  #events;

  /// `address` is {port, ca}; `events` has opened(), heard(bytes, start, end) and ended(why).
  constructor(address, path, events) {
    this.#events = events;
    this.#socket = connect({ host: '127.0.0.1', ...address }, () => {
      this.#socket.setNoDelay(true);
      this.#socket.write(
        `GET ${path} HTTP/1.1\r\nHost: 127.0.0.1:${address.port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n` +
          `Sec-WebSocket-Key: ${randomBytes(16).toString('base64')}\r\nSec-WebSocket-Version: 13\r\n\r\n`);
    });
    this.#socket.on('data', (bytes) => this.#read(bytes));
    this.#socket.on('error', (error) => this.#end(error.message));
    this.#socket.on('close', () => this.#end('the server has closed the connection'));
  }

  send(message) {
    if (typeof message === 'string') this.#write(kText, Buffer.from(message));
    else this.#write(kBinary, message);
  }

  close() {
    this.#events = null;
    this.#socket.destroy();
  }

  #end(why) {
    this.#events?.ended(why);
    this.close();
  }

  #write(kind, payload) {
    const size = payload.length, head = size < 126 ? 2 : 4;
    if (size > 65535) throw new Error('a message of more than 64 KiB');
    const frame = Buffer.allocUnsafe(head + 4 + size);
    frame[0] = 0x80 | kind;
    frame[1] = 0x80 | (head === 2 ? size : 126);
    if (head === 4) frame.writeUInt16BE(size, 2);
    frame.writeUInt32BE(Math.floor(Math.random() * 2 ** 32), head); // the mask
    for (let i = 0, body = head + 4; i < size; ++i) frame[body + i] = payload[i] ^ frame[head + (i & 3)];
    this.#socket.write(frame);
  }

  #read(bytes) {
    if (this.#rest.length > 0) bytes = Buffer.concat([this.#rest, bytes]);
    let at = this.#is_open ? 0 : this.#read_answer(bytes);
    while (this.#is_open && this.#events) {
      if (bytes.length - at < 2) break;
      let start = at + 2, size = bytes[at + 1];
      if (size === 126) {
        if (bytes.length - at < 4) break;
        size = bytes.readUInt16BE(at + 2);
        start = at + 4;
      } else if (size === 127) {
        if (bytes.length - at < 10) break;
        size = Number(bytes.readBigUInt64BE(at + 2));
        start = at + 10;
      }
      if (bytes.length - start < size) break;
      this.#hear(bytes, at, start, start + size);
      at = start + size;
    }
    // A copy: the rest would otherwise keep all of a large piece alive.
    this.#rest = at < bytes.length ? Buffer.from(bytes.subarray(at)) : Buffer.alloc(0);
  }

  #hear(bytes, at, start, end) {
    const kind = bytes[at] & 15, is_whole = bytes[at] >= 0x80;
    if (kind === kPing) this.#write(10, bytes.subarray(start, end));
    else if (kind === kClose) this.#end(`the server said goodbye: ${bytes.toString('utf8', start + 2, end)}`);
    else if (!is_whole || kind === kContinuation) this.#end('a message in parts');
    else if (kind === kText || kind === kBinary) this.#events.heard(bytes, start, end);
  }

  /// Reads the answer to the upgrade; gives where it ends, or 0 if not all of it has come.
  #read_answer(bytes) {
    const end = bytes.indexOf('\r\n\r\n');
    if (end < 0) return 0;
    const line = bytes.toString('latin1', 0, bytes.indexOf('\r\n'));
    if (!line.includes(' 101 ')) {
      this.#end(`no upgrade: ${line}`);
      return 0;
    }
    this.#is_open = true;
    this.#events.opened();
    return end + 4;
  }
}
