// Measures other collaboration servers as collab/crowd_figures.cpp measures icome-server: one room, TLS on the
// loopback, every client drags an object; the server is a process of its own, all clients are in this one.
import { execFileSync, spawn } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { createInterface } from 'node:readline';
import { setTimeout as sleep } from 'node:timers/promises';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { Crowd } from './crowd.mjs';

const here = fileURLToPath(new URL('.', import.meta.url));

const kPeers = [
  { name: 'ws', server: 'ws', dialect: 'WsDialect', packages: ['ws'] },
  { name: 'y-websocket', server: 'y_websocket', dialect: 'YDialect', packages: ['@y/websocket-server', 'yjs'] },
  { name: 'colyseus', server: 'colyseus', dialect: 'ColyseusDialect', packages: ['@colyseus/core'] },
  { name: 'colyseus state', server: 'colyseus', dialect: 'ColyseusStateDialect', packages: ['@colyseus/core'] },
  { name: 'socket.io', server: 'socket_io', dialect: 'SocketIoDialect', packages: ['socket.io'] },
];

const settings = read_settings();
const tls = mkdtempSync(join(tmpdir(), 'icome_peers_'));
const children = new Set();
process.on('exit', () => {
  for (const child of children) child.kill('SIGKILL');
  rmSync(tls, { recursive: true, force: true });
});
for (const [signal, code] of [['SIGINT', 130], ['SIGTERM', 143], ['SIGHUP', 129]])
  process.on(signal, () => process.exit(code));

const ticks_a_second = Number(execFileSync('getconf', ['CLK_TCK']));
make_certificate();
const rows = [];
const shares = new Map(); // of a core that the clients used, by row
for (const peer of settings.peers) await measure(peer);
if (settings.json) process.stdout.write(`${JSON.stringify({ rows }, null, 1)}\n`);
else if (rows.length > 0) print_table();
print_saturated();
// All is closed; should a connection still linger, nobody waits for it.
process.exit();

function read_settings() {
  try {
    const { values } = parseArgs({
      options: {
        clients: { type: 'string', default: '10,50,100,200' },
        seconds: { type: 'string', default: '5' },
        rate: { type: 'string', default: '30' },
        only: { type: 'string', default: '' },
        json: { type: 'boolean', default: false },
      },
    });
    const clients = values.clients.split(',').map(Number);
    const seconds = Number(values.seconds), rate = Number(values.rate);
    if (!clients.every((count) => Number.isInteger(count) && count > 1))
      throw new Error('--clients: whole numbers above 1');
    if (!(seconds > 0 && seconds <= 600 && rate > 0 && rate <= 1000))
      throw new Error('--seconds: up to 600; --rate: up to 1000');
    const only = values.only.split(',').filter(Boolean);
    const unknown = only.find((word) => !kPeers.some(({ name }) => name.startsWith(word)));
    if (unknown) throw new Error(`--only: ${unknown} is none of ${kPeers.map(({ name }) => name).join(', ')}`);
    const peers = kPeers.filter(({ name }) => only.length === 0 || only.some((word) => name.startsWith(word)));
    return { clients, seconds, rate, peers, json: values.json };
  } catch (error) {
    console.error(error.message);
    process.exit(2);
  }
}

function make_certificate() {
  const kind = ['-newkey', 'ec', '-pkeyopt', 'ec_paramgen_curve:prime256v1', '-nodes'];
  const files = ['-keyout', join(tls, 'key.pem'), '-out', join(tls, 'cert.pem')];
  const subject = ['-subj', '/CN=localhost', '-addext', 'subjectAltName=IP:127.0.0.1', '-days', '1'];
  execFileSync('openssl', ['req', '-x509', ...kind, ...subject, ...files], { stdio: 'pipe' });
}

/// All rows of a peer; after one that fails, the peer's others are left out and the next peer goes on.
async function measure(peer) {
  try {
    const [own, ...others] = peer.packages;
    const version = [version_of(own), ...others.map((name) => `${name} ${version_of(name)}`)].join(', ');
    const dialects = await import('./dialects.mjs');
    for (const clients of settings.clients)
      rows.push(await row(peer, version, clients, () => new dialects[peer.dialect]()));
  } catch (error) {
    console.error(`${peer.name}: ${error.message}`);
    process.exitCode = 1;
  }
}

function version_of(name) {
  return JSON.parse(readFileSync(join(here, 'node_modules', name, 'package.json'))).version;
}

async function row(peer, version, clients, make_dialect) {
  const server = start_server(peer);
  const crowds = [];
  const dawdles = new AbortController();
  const limit = 20 + 3 * settings.seconds;
  const too_long = sleep(1000 * limit, null, { signal: dawdles.signal }).then(() => {
    throw new Error(`${clients} clients: not done after ${limit} s`);
  });
  // A server that falls tells why, which its connections do not: it is given the time to.
  const failure_of = (crowd) => crowd.failure.catch((why) => sleep(500).then(() => Promise.reject(why)));
  const or_failure = (work, crowd) =>
    Promise.race([work, server.failure, too_long, ...(crowd ? [failure_of(crowd)] : [])]);
  try {
    const address = { port: await or_failure(server.port), ca: readFileSync(join(tls, 'cert.pem')) };
    const enter = async (count) => {
      const crowd = new Crowd(address, make_dialect());
      crowds.push(crowd);
      await or_failure(crowd.join(count), crowd);
      return crowd;
    };
    (await enter(1)).close();
    const memory = memory_of(server.pid);
    const crowd = await enter(clients);
    crowd.work(settings.rate);
    await or_failure(sleep(1000), crowd); // warm
    crowd.take_ways();
    const begin = performance.now(), heard = crowd.heard, used = used_by(server.pid), own = process.cpuUsage();
    await or_failure(sleep(1000 * settings.seconds), crowd);
    const lasted = (performance.now() - begin) / 1000, took = used_by(server.pid) - used;
    const deliveries = crowd.heard - heard, { user, system } = process.cpuUsage(own), ways = crowd.take_ways();
    if (deliveries === 0) throw new Error(`${clients} clients: nothing arrived in ${settings.seconds} s`);
    const figures = {
      peer: peer.name,
      version,
      clients,
      deliveries_a_second: deliveries / lasted,
      server_share: took / lasted,
      server_us: (1e6 * took) / deliveries,
      p50_ms: share_of(ways, 0.5),
      p99_ms: share_of(ways, 0.99),
      server_kb: (memory_of(server.pid) - memory) / clients,
    };
    shares.set(figures, (user + system) / 1e6 / lasted);
    return figures;
  } finally {
    dawdles.abort();
    too_long.catch(() => {});
    for (const crowd of crowds) crowd.close();
    await server.end();
  }
}

/// `port` comes when it listens; `failure` rejects should it end by itself.
function start_server(peer) {
  const child = spawn(process.execPath, [join(here, 'servers', `${peer.server}.mjs`), tls, String(settings.rate)], {
    env: { ...process.env, NODE_ENV: 'production' }, // what it is run with when it is meant
  });
  children.add(child);
  let said = ''; // its last words, for who asks why
  child.stderr.on('data', (text) => (said = (said + text).slice(-2000)));
  const port = new Promise((resolve) =>
    createInterface({ input: child.stdout }).on('line', (line) => {
      const number = /^port (\d+)$/.exec(line)?.[1];
      if (number) resolve(Number(number));
    }));
  const ended = new Promise((resolve) => {
    child.on('error', (error) => resolve(error.message));
    child.on('close', (code, signal) => resolve(`the server has ended (${signal ?? code}): ${said.trim()}`));
  });
  const failure = ended.then((why) => {
    throw new Error(why);
  });
  failure.catch(() => {});
  const end = async () => {
    child.kill('SIGKILL'); // it keeps nothing
    await ended;
    children.delete(child);
  };
  return { pid: child.pid, port, failure, end };
}

/// Processor time so far, of all its threads, s.
function used_by(process_id) {
  const fields = readFileSync(`/proc/${process_id}/stat`, 'utf8').split(') ').at(-1).split(' ');
  return (Number(fields[11]) + Number(fields[12])) / ticks_a_second;
}

/// kB.
function memory_of(process_id) {
  return Number(/^VmRSS:\s+(\d+)/m.exec(readFileSync(`/proc/${process_id}/status`, 'utf8'))[1]);
}

function share_of(sorted, part) {
  return sorted.length === 0 ? 0 : sorted[Math.floor(part * (sorted.length - 1))];
}

function print_table() {
  const name_of = ({ peer, version }) => `${peer} ${version}`;
  const width = Math.max(4, ...rows.map((row) => name_of(row).length));
  const widths = [8, 13, 12, 12, 9, 9, 11];
  const line = (name, cells) =>
    console.log([name.padEnd(width), ...cells.map((cell, i) => cell.padStart(widths[i]))].join(' '));
  console.log(
    `\nOne room, TLS, each client drags an object ${settings.rate} times a second; server and clients share this ` +
      'machine\n');
  line('peer', ['clients', 'deliveries/s', 'server core', 'us/delivery', 'p50 ms', 'p99 ms', 'kB/client']);
  for (const row of rows)
    line(name_of(row), [
      String(row.clients),
      row.deliveries_a_second.toFixed(0),
      `${(100 * row.server_share).toFixed(0)}%`,
      row.server_us.toFixed(2),
      row.p50_ms.toFixed(2),
      row.p99_ms.toFixed(2),
      row.server_kb.toFixed(1),
    ]);
}

/// Names the rows where the server or this process had no time for all that the clients were to say to one
/// another: what did not arrive waits in buffers, so that latencies and memory grow for as long as one measures.
/// More than was said arrives where such a heap is being worked off. A tenth may be missing for other reasons:
/// beats come late, patches hold only the last place of an object.
function print_saturated() {
  const arrived = ({ clients, deliveries_a_second }) =>
    deliveries_a_second / (clients * (clients - 1) * settings.rate);
  const saturated = rows.filter((row) => arrived(row) < 0.9 || arrived(row) > 1.05);
  if (saturated.length === 0) return;
  const print = settings.json ? console.error : console.log; // stdout is the document's
  const percent = (share) => `${(100 * share).toFixed(0)}%`;
  print('\nNot all arrived in its time: the times and kB of these rows are those of a saturated machine');
  for (const row of saturated)
    print(
      `  ${row.peer}, ${row.clients} clients: ${percent(arrived(row))} of what was to arrive (server ` +
        `${percent(row.server_share)} of a core, clients ${percent(shares.get(row))})`);
}
