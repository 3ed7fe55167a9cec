// What a client of each peer says and hears inside its WebSocket. A crowd has one dialect, for all its clients.
//
//   path(address)                        where to connect to; may ask the server first
//   greeting                             said when the connection is open, where there is one
//   joined(bytes, start, end, say)       is this the message by which a client takes part? Where there is no such
//                                        message, it does so once the connection is open.
//   drag(client, matrix)                 the message that a client has moved its object
//   updates(bytes, start, end, client)   how many drags of others have come with this message
//   times(bytes, start, end, client)     when those were sent; asked of a sample only
//   other(bytes, start, end, say)        hears the messages without drags
import { Packr } from '@colyseus/msgpackr';
import { Decoder } from '@colyseus/schema';
import { request } from 'node:https';
import * as Y from 'yjs';
import { Crowd } from './colyseus_state.mjs';

/// The id and the matrix as bytes: what a program that cares for speed sends through a bare WebSocket.
export class WsDialect {
  path = () => '/';
  drag = (client, matrix) => Buffer.from(new Float64Array([client.number, ...matrix]).buffer);
  updates = () => 1;
  times = (bytes, start, end) => [bytes.readDoubleLE(end - 8)];
}

/// Sync messages. Each client has a Y.Doc for what it changes; what others change is counted, not applied.
export class YDialect {
  path = () => '/crowd';

  drag(client, matrix) {
    if (!client.doc) {
      client.doc = new Y.Doc();
      client.doc.clientID = this.#author(client);
      client.doc.on('update', (update) => (client.update = update));
    }
    // Bytes: an array of numbers would be larger and slower.
    client.doc.getMap('objects').set(`${client.number}`, new Uint8Array(new Float64Array(matrix).buffer));
    const size = client.update.length;
    return Buffer.concat([Buffer.from([0, 2, (size & 127) | 128, size >> 7]), client.update]); // sync, update
  }

  updates(bytes, start, end, client) {
    if (bytes[start] !== 0 || bytes[start + 1] !== 2) return 0;
    // After the counts of clients and of items, one each: the author. The server sends to the sender too.
    const at = this.#update(bytes, start) + 2, author = (bytes[at] & 127) | (bytes[at + 1] << 7);
    return author === this.#author(client) ? 0 : 1;
  }
  times(bytes, start, end) {
    const matrix = Y.decodeUpdate(bytes.subarray(this.#update(bytes, start), end)).structs[0].content.content;
    return [Buffer.from(matrix).readDoubleLE(matrix.length - 8)];
  }
  other() {}

  #author = (client) => 1000 + client.number; // two bytes in an update
  #update(bytes, start) {
    let at = start + 2;
    while (bytes[at] & 128) ++at; // its size
    return at + 1;
  }
}

/// JSON events. Numbers as text cost less here than bytes: an event with bytes is two WebSocket messages, and
/// the server then frames it for each client anew.
export class SocketIoDialect {
  path = () => '/socket.io/?EIO=4&transport=websocket';
  greeting = '40';
  joined = (bytes, start, end) => bytes.toString('latin1', start, end).startsWith('40');
  drag = (client, matrix) => `42${JSON.stringify(['drag', client.number, matrix])}`;
  updates = (bytes, start) => (bytes[start] === 0x34 && bytes[start + 1] === 0x32 ? 1 : 0); // "42"
  times = (bytes, start, end) => [JSON.parse(bytes.toString('latin1', start + 2, end))[2].at(-1)];
  other(bytes, start, end, say) {
    if (bytes[start] === 0x32) say('3'); // ping
  }
}

const kJoinRoom = 10, kRoomData = 13, kRoomState = 14, kRoomStatePatch = 15;
const packr = new Packr({ useRecords: false });
const drag_head = Buffer.from([kRoomData, 0xa4, ...Buffer.from('drag')]);

/// msgpack messages in a room that broadcasts them.
export class ColyseusDialect {
  room = 'messages';

  async path(address) {
    const seat = await post(address, `/matchmake/join/${this.room}`);
    if (seat.error) throw new Error(seat.error);
    return `/${seat.room.processId}/${seat.room.roomId}?sessionId=${seat.sessionId}`;
  }
  joined(bytes, start, end, say) {
    if (bytes[start] !== kJoinRoom) return false;
    say(Buffer.from([kJoinRoom]));
    return true;
  }
  drag = (client, matrix) => Buffer.concat([drag_head, packr.pack({ id: client.number, matrix })]);
  updates(bytes, start) {
    return bytes[start] === kRoomData ? 1 : 0;
  }
  times(bytes, start, end) {
    return [packr.unpack(bytes.subarray(start + drag_head.length, end)).matrix.at(-1)];
  }
  other() {}
}

/// The same messages in a room that keeps state: what comes back are patches, each with the last place of every
/// object that has moved since the patch before. All clients get the same patches, so each is decoded once.
export class ColyseusStateDialect extends ColyseusDialect {
  room = 'state';
  #decoder = new Decoder(new Crowd());
  #patches = []; // for each, the time of every object in it, by the object's id

  updates(bytes, start, end, client) {
    if (bytes[start] !== kRoomStatePatch) return 0;
    client.patches ??= 0;
    if (client.patches === this.#patches.length) {
      const changes = this.#decoder.decode(Buffer.from(bytes.subarray(start + 1, end)));
      const times = changes.filter(({ field }) => field === 'time').map(({ ref, value }) => [ref.id, value]);
      this.#patches.push(new Map(times));
    }
    client.patch = this.#patches[client.patches++];
    return client.patch.size - (client.patch.has(client.number) ? 1 : 0);
  }
  times = (bytes, start, end, client) =>
    [...client.patch].filter(([id]) => id !== client.number).map(([, time]) => time);
  other(bytes, start, end) {
    // Empty, but it numbers what the patches speak of.
    if (bytes[start] === kRoomState) this.#decoder.decode(Buffer.from(bytes.subarray(start + 1, end)));
  }
}

function post(address, path) {
  return new Promise((resolve, reject) => {
    const asking = request({ host: '127.0.0.1', ...address, path, method: 'POST' }, async (answer) => {
      try {
        let text = '';
        for await (const part of answer) text += part;
        resolve(JSON.parse(text));
      } catch (error) {
        reject(error);
      }
    });
    asking.on('error', reject).end('{}');
  });
}
