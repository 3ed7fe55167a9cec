// The state of Colyseus's state room, which the server writes and the clients read.
import { schema } from '@colyseus/schema';

/// The numbers of a matrix; the last is the time it was sent.
export const numbers = ['xx', 'xy', 'xz', 'yx', 'yy', 'yz', 'zx', 'zy', 'zz', 'x', 'y', 'time'];

export const Dragged = schema({ id: 'number', ...Object.fromEntries(numbers.map((name) => [name, 'float64'])) });
export const Crowd = schema({ objects: { map: Dragged } });
