// Socket.IO: every event goes to all other sockets.
import { Server } from 'socket.io';
import { https_server, serve } from './https_server.mjs';

const server = https_server();
new Server(server, { transports: ['websocket'], serveClient: false }).on('connection', (socket) => {
  socket.on('drag', (id, matrix) => socket.broadcast.emit('drag', id, matrix));
});
serve(server);
