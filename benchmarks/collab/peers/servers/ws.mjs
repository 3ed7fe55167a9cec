// The broadcast server of the ws manual: whatever a client says goes to all others.
import { WebSocket, WebSocketServer } from 'ws';
import { https_server, serve } from './https_server.mjs';

const server = https_server();
const sockets = new WebSocketServer({ server });
sockets.on('connection', (socket) => {
  socket.on('error', console.error);
  socket.on('message', (data, is_binary) => {
    for (const other of sockets.clients)
      if (other !== socket && other.readyState === WebSocket.OPEN) other.send(data, { binary: is_binary });
  });
});
serve(server);
