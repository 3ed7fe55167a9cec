// Asks Paper.js and perfect-freehand what the benchmark wants to know of them; README.md tells how.
import { readFileSync, writeFileSync } from 'node:fs';
import paper from 'paper/dist/paper-core.js';
import { getStroke } from 'perfect-freehand';

const kRepeats = 5; // of which the fastest counts

/// Each line as numbers.
const rows_of = (file) =>
  readFileSync(file, 'utf8').split('\n').filter((line) => line).map((line) => line.split(' ').map(Number));

/// Samples [x, y, pressure] of each stroke.
const strokes_of = (file) =>
  rows_of(file).map((row) => Array.from({ length: row.length / 3 }, (_, i) => row.slice(3 * i, 3 * i + 3)));

function simplified(points, tolerance) {
  const path = new paper.Path({ segments: points, insert: false });
  path.simplify(tolerance);
  return path;
}

const scaled = (stroke, scale) => stroke.map(([x, y]) => [x * scale, y * scale]);

/// The control points, in mm, of all cubics.
function cubics_of(path, scale) {
  return path.curves.flatMap(({ points }) => points.flatMap(({ x, y }) => [x / scale, y / scale]));
}

function write_curves(strokes, requests, out) {
  const lines = requests.map(([stroke, scale, tolerance]) =>
    cubics_of(simplified(scaled(strokes[stroke], scale), tolerance), scale).join(' '));
  writeFileSync(out, lines.join('\n') + '\n');
}

function microseconds(work) {
  const begin = performance.now();
  work();
  return 1000 * (performance.now() - begin);
}

/// The work of a program that shows a fitted curve while it is drawn.
function print_refits(strokes, scale, tolerance) {
  for (const stroke of strokes.map((samples) => scaled(samples, scale))) {
    for (let count = 2; count <= stroke.length; ++count) {
      const points = stroke.slice(0, count);
      console.log(count, microseconds(() => simplified(points, tolerance)));
    }
  }
}

function print_outlines(strokes, size, thinning) {
  const options = { size, thinning, smoothing: 0.5, streamline: 0, simulatePressure: false, last: true };
  for (const stroke of strokes) {
    let points = 0;
    const times = Array.from({ length: kRepeats }, () =>
      microseconds(() => (points = getStroke(stroke, options).length)));
    console.log(points, Math.min(...times));
  }
}

const [what, file, ...rest] = process.argv.slice(2);
paper.setup(new paper.Size(1, 1));
const strokes = strokes_of(file);
if (what === 'curves') write_curves(strokes, rows_of(rest[0]), rest[1]);
if (what === 'refit') print_refits(strokes, ...rest.map(Number));
if (what === 'outline') print_outlines(strokes, ...rest.map(Number));
