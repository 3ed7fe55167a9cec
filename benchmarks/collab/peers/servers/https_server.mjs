// What the four servers share: TLS on the loopback, and the line that tells the runner the port.
import { readFileSync } from 'node:fs';
import { createServer } from 'node:https';
import { join } from 'node:path';

const folder = process.argv[2]; // of the key and the certificate that the runner has made

export const https_server = () =>
  createServer({ key: readFileSync(join(folder, 'key.pem')), cert: readFileSync(join(folder, 'cert.pem')) });

/// To be called when `server` listens.
export const tell_port = (server) => console.log(`port ${server.address().port}`);

export const serve = (server) => server.listen(0, '127.0.0.1', () => tell_port(server));

// The runner holds the other end: a runner that was killed leaves no server behind.
process.stdin.on('close', () => process.exit()).resume();
