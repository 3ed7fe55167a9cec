// Colyseus in its two uses: a room that passes messages on, and a room that keeps the state of all objects
// and sends its changes as patches.
import { Room, Server, matchMaker } from '@colyseus/core';
import { WebSocketTransport } from '@colyseus/ws-transport';
import { Crowd, Dragged, numbers } from '../colyseus_state.mjs';
import { https_server, tell_port } from './https_server.mjs';

class MessageRoom extends Room {
  autoDispose = false;
  onCreate() {
    this.onMessage('drag', (client, message) => this.broadcast('drag', message, { except: client }));
  }
}

class StateRoom extends Room {
  autoDispose = false;
  state = new Crowd();
  onCreate({ rate }) {
    this.patchRate = 1000 / rate; // as often as clients drag; 50 ms would be the default
    this.onMessage('drag', (client, { id, matrix }) => {
      let object = this.state.objects.get(client.sessionId);
      if (!object) this.state.objects.set(client.sessionId, (object = new Dragged()));
      object.id = id;
      numbers.forEach((name, i) => (object[name] = matrix[i]));
    });
  }
}

const server = https_server();
// No pings: a saturated machine answers them late, and they would end the connections that are measured.
const colyseus = new Server({ transport: new WebSocketTransport({ server, pingInterval: 0 }), greet: false });
colyseus.define('messages', MessageRoom);
colyseus.define('state', StateRoom);
await colyseus.listen(0, '127.0.0.1');
await matchMaker.createRoom('messages', {});
await matchMaker.createRoom('state', { rate: Number(process.argv[3]) });
tell_port(server);
