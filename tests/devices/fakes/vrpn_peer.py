#!/usr/bin/env python3
"""A VRPN client and server of their own, with nothing but the standard library: judges of devices/vrpn.

Written from the wire as stock programs speak it, not from our code. All in metres, newtons and seconds.

    client = Client("127.0.0.1", 3883, "Pointer0")
    client.wait_for("vrpn_Tracker Pos_Quat")      # -> Message
    client.send_plane((0, 1, 0, 0), spring=0.5)

    with Server("Tracker0", forces=True) as server:
        server.pose((0, 0.1, 0), (0, 0, 0, 1))
        server.wait_for("vrpn_ForceDevice Plane")

From the command line, for people:

    vrpn_peer.py watch 127.0.0.1 3883 Pointer0    # tells what comes, a line for each kind and second
    vrpn_peer.py serve 3883 Tracker0              # a tracker that goes round once in two seconds
"""

import collections
import math
import socket
import struct
import sys
import threading
import time

COOKIE = b"vrpn: ver. 07.38  0".ljust(24, b"\0")
HEADER = struct.Struct(">IIIiiI")  # length without padding, seconds, microseconds, sender, type, sequence
SENDER, TYPE, UDP, LOG, DISCONNECT = -1, -2, -3, -4, -5
PATIENCE = 30.0  # s
PLANE = struct.Struct(">4f4f2i")
FIELD = struct.Struct(">3f3f9ff")

Message = collections.namedtuple("Message", "time sender type payload")


def numbers(kind, payload):
    """The numbers of a payload as a tuple, by the name of its type."""
    forms = {
        "vrpn_Tracker Pos_Quat": ">2i7d",
        "vrpn_Tracker Velocity": ">2i8d",
        "vrpn_Button Change": ">2i",
        "vrpn_ForceDevice Force": ">3d",
        "vrpn_ForceDevice SCP": ">7d",
        "vrpn_ForceDevice Plane": PLANE.format,
        "vrpn_ForceDevice Force_Field": FIELD.format,
    }
    if kind == "vrpn_Button States":
        count = struct.unpack_from(">i", payload)[0]
        return struct.unpack(f">{count}i", payload[4:])
    if kind == "vrpn_Analog Channel":
        count = int(struct.unpack_from(">d", payload)[0])
        return struct.unpack(f">{count}d", payload[8:])
    return struct.unpack(forms[kind], payload)


class Connection:
    """One end of a TCP connection that speaks VRPN. Descriptions are sent as names are first used."""

    def __init__(self, sock):
        self.socket = sock
        sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.senders, self.types = {}, {}  # of the peer, by number
        self._our_senders, self._our_types = {}, {}  # by name
        self._sequence = 0
        self._bytes = b""
        self._writing = threading.Lock()
        sock.sendall(COOKIE)
        greeting = self._take(24)
        if not greeting.startswith(b"vrpn: ver. 07."):
            raise ValueError(f"no VRPN 7: {greeting!r}")

    def _take(self, count):
        while len(self._bytes) < count:
            got = self.socket.recv(65536)
            if not got:
                raise ConnectionError("the peer closed")
            self._bytes += got
        taken, self._bytes = self._bytes[:count], self._bytes[count:]
        return taken

    def read(self):
        """The next message; descriptions are learnt and returned too. Raises ConnectionError at the end."""
        length, seconds, micros, sender, kind, _ = HEADER.unpack(self._take(HEADER.size))
        if length < HEADER.size or length > 100000:
            raise ValueError(f"a message of {length} bytes")
        padded = (length + 7) // 8 * 8
        body = self._take(padded - HEADER.size)
        payload, padding = body[: length - HEADER.size], body[length - HEADER.size:]
        if padding.strip(b"\0"):
            raise ValueError("padding that is not zero")
        if kind in (SENDER, TYPE):
            size = struct.unpack_from(">i", payload)[0]
            if size != len(payload) - 4 or payload[-1:] != b"\0":
                raise ValueError(f"a description whose length is wrong: {payload!r}")
            (self.senders if kind == SENDER else self.types)[sender] = payload[4:-1].decode()
        return Message(seconds + 1e-6 * micros, self.senders.get(sender) if kind >= 0 else sender,
                       self.types.get(kind) if kind >= 0 else kind, payload)

    def _write(self, sender, kind, payload):
        now = time.time()
        length = HEADER.size + len(payload)
        with self._writing:
            head = HEADER.pack(length, int(now), int(now % 1 * 1e6), sender, kind, self._sequence)
            self._sequence += 1
            self.socket.sendall(head + payload + b"\0" * (-length % 8))

    def _number(self, known, kind, name):
        if name not in known:
            known[name] = len(known) + 3  # not the peer's numbers
            text = name.encode() + b"\0"
            self._write(known[name], kind, struct.pack(">i", len(text)) + text)
        return known[name]

    def describe(self, device, types):
        self._number(self._our_senders, SENDER, device)
        for name in types:
            self._number(self._our_types, TYPE, name)

    def send(self, device, kind, payload=b""):
        sender = self._number(self._our_senders, SENDER, device)
        self._write(sender, self._number(self._our_types, TYPE, kind), payload)

    def close(self):
        self.socket.close()


class Client:
    """A client of one device, by TCP, or called back by the server as stock clients without tcp:// are."""

    def __init__(self, host, port, device, call_back=False):
        self.device = device
        if call_back:
            with socket.create_server((host, 0)) as listener:
                listener.settimeout(PATIENCE)
                with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as asker:
                    text = f"{host} {listener.getsockname()[1]}\0".encode()
                    asker.sendto(text, (host, port))
                sock = listener.accept()[0]
        else:
            sock = socket.create_connection((host, port), PATIENCE)
        sock.settimeout(PATIENCE)
        self.connection = Connection(sock)

    def wait_for(self, kind, condition=lambda values: True):
        """The first message of a kind about our device whose numbers fulfil a condition."""
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            message = self.connection.read()
            if message.type == kind and message.sender == self.device:
                values = numbers(kind, message.payload) if message.payload else ()
                if condition(values):
                    return values
        raise TimeoutError(f"no {kind} of {self.device}")

    def ping(self):
        self.connection.send(self.device, "vrpn_Base ping_message")
        self.wait_for("vrpn_Base pong_message")

    def send_plane(self, plane, spring, damper=0.0, friction=0.0, index=0, recovery=1):
        payload = PLANE.pack(*plane, spring, damper, friction, 0.0, index, recovery)
        self.connection.send(self.device, "vrpn_ForceDevice Plane", payload)

    def send_field(self, origin, force, jacobian=(0.0,) * 9, radius=1.0):
        self.connection.send(self.device, "vrpn_ForceDevice Force_Field",
                             FIELD.pack(*origin, *force, *jacobian, radius))

    def close(self):
        self.connection.close()


class Server:
    """A server of one device, for one client at a time, on a thread of its own."""

    TYPES = ["vrpn_Tracker Pos_Quat", "vrpn_Tracker Velocity", "vrpn_Base ping_message", "vrpn_Base pong_message",
             "vrpn_Button Change", "vrpn_Button States", "vrpn_Analog Channel"]
    FORCES = ["vrpn_ForceDevice Force", "vrpn_ForceDevice SCP", "vrpn_ForceDevice Plane",
              "vrpn_ForceDevice Force_Field"]

    def __init__(self, device, port=0, forces=False):
        self.device, self.types = device, self.TYPES + (self.FORCES if forces else [])
        self._listener = socket.create_server(("127.0.0.1", port))
        self.port = self._listener.getsockname()[1]
        self._changed = threading.Condition()
        self._connection, self._closing = None, False
        self.heard = []  # (kind, numbers) about our device
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self._closing = True
        try:
            self._listener.shutdown(socket.SHUT_RDWR)
        except OSError:
            pass
        self._listener.close()
        self.drop()
        self._thread.join()

    def drop(self):
        """Ends the connection with the client, without a word."""
        with self._changed:
            if self._connection:
                try:
                    self._connection.socket.shutdown(socket.SHUT_RDWR)
                except OSError:
                    pass

    def _run(self):
        while not self._closing:
            try:
                sock = self._listener.accept()[0]
            except OSError:
                return
            try:
                connection = Connection(sock)
                connection.describe(self.device, self.types)
                with self._changed:
                    self._connection = connection
                    self._changed.notify_all()
                self._listen(connection)
            except (OSError, ValueError):
                pass
            with self._changed:
                self._connection = None
            sock.close()

    def _listen(self, connection):
        while True:
            message = connection.read()
            if message.type == DISCONNECT:
                return
            if message.sender != self.device or not isinstance(message.type, str):
                continue
            if message.type == "vrpn_Base ping_message":
                connection.send(self.device, "vrpn_Base pong_message")
                continue
            values = numbers(message.type, message.payload) if message.payload else ()
            with self._changed:
                self.heard.append((message.type, values))
                self._changed.notify_all()

    def wait_for(self, kind, condition=lambda values: True):
        """The numbers of the first message of a kind that was or will be heard and fulfils a condition."""
        found = []

        def there():
            found[:] = [values for heard, values in self.heard if heard == kind and condition(values)]
            return bool(found)

        with self._changed:
            if not self._changed.wait_for(there, PATIENCE):
                raise TimeoutError(f"no {kind} from the client")
        return found[0]

    def send(self, kind, payload):
        """Sends to the client, if there is one."""
        with self._changed:
            connection = self._connection
        try:
            if connection:
                connection.send(self.device, kind, payload)
        except OSError:
            pass

    def pose(self, position, quaternion, sensor=0):
        self.send("vrpn_Tracker Pos_Quat", struct.pack(">2i7d", sensor, sensor, *position, *quaternion))

    def velocity(self, velocity, sensor=0):
        self.send("vrpn_Tracker Velocity", struct.pack(">2i8d", sensor, sensor, *velocity, 0, 0, 0, 1, 1))

    def button(self, button, down):
        self.send("vrpn_Button Change", struct.pack(">2i", button, down))

    def channels(self, values):
        self.send("vrpn_Analog Channel", struct.pack(f">d{len(values)}d", len(values), *values))


def watch(host, port, device):
    client = Client(host, int(port), device)
    counts, last, told = collections.Counter(), {}, time.monotonic()
    while True:
        message = client.connection.read()
        if message.sender == device:
            counts[message.type] += 1
            last[message.type] = message
        if time.monotonic() - told > 1.0:
            told = time.monotonic()
            for kind, count in sorted(counts.items()):
                print(f"{kind}: {count}, last {numbers(kind, last[kind].payload)}", flush=True)
            counts.clear()


def serve(port, device):
    with Server(device, int(port), forces=True) as server:
        while True:
            turn = math.pi * time.monotonic()
            server.pose((0.05 * math.cos(turn), 0.0, 0.05 * math.sin(turn)), (0, 0, 0, 1))
            time.sleep(0.001)


if __name__ == "__main__":
    commands = {"watch": watch, "serve": serve}
    if len(sys.argv) < 2 or sys.argv[1] not in commands:
        sys.exit(__doc__)
    commands[sys.argv[1]](*sys.argv[2:])
