// y-websocket's own server: a Y.Doc that every update is applied to, then sent to all, its sender too.
import { setupWSConnection } from '@y/websocket-server/utils';
import { WebSocketServer } from 'ws';
import { https_server, serve } from './https_server.mjs';

const server = https_server();
new WebSocketServer({ server }).on('connection', setupWSConnection);
serve(server);
