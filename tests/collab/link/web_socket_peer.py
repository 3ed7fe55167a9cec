"""A WebSocket client of Python's standard library alone, for the test that our server speaks more than a dialect of
its own.

usage: web_socket_peer.py PORT CERTIFICATE      exit code 0, or a traceback
"""
import base64
import hashlib
import os
import socket
import ssl
import struct
import sys

BINARY, CLOSE, PING, PONG = 2, 8, 9, 10
PATIENCE = 120  # s


def receive(stream, size):
    got = b""
    while len(got) < size:
        part = stream.recv(size - len(got))
        assert part, "the server has ended the connection"
        got += part
    return got


def shake_hands(stream):
    key = base64.b64encode(os.urandom(16)).decode()
    stream.sendall((f"GET /icome HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: keep-alive, Upgrade\r\n"
                    f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n"
                    f"Sec-WebSocket-Extensions: permessage-deflate; client_max_window_bits\r\n\r\n").encode())
    head = b""
    while not head.endswith(b"\r\n\r\n"):
        head += receive(stream, 1)
    first, *lines = head.decode().strip().split("\r\n")
    fields = {name.lower(): value.strip() for name, value in (line.split(":", 1) for line in lines)}
    assert first.split()[1] == "101", first
    wanted = hashlib.sha1((key + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11").encode()).digest()
    assert fields["sec-websocket-accept"] == base64.b64encode(wanted).decode(), fields
    assert fields["upgrade"].lower() == "websocket", fields
    assert "sec-websocket-extensions" not in fields, fields


def send(stream, kind, payload, is_last=True):
    size = len(payload)
    length = (bytes([0x80 | size]) if size < 126 else
              b"\xfe" + struct.pack(">H", size) if size < 65536 else b"\xff" + struct.pack(">Q", size))
    mask = os.urandom(4)
    repeated = (mask * (size // 4 + 1))[:size]
    masked = (int.from_bytes(payload, "big") ^ int.from_bytes(repeated, "big")).to_bytes(size, "big")
    stream.sendall(bytes([(0x80 if is_last else 0) | kind]) + length + mask + masked)


def receive_piece(stream):
    """Returns (is it the last piece, kind, payload)."""
    first, second = receive(stream, 2)
    assert first & 0x70 == 0 and second & 0x80 == 0, "reserved bits, or masked by the server"
    size = second
    if size == 126:
        size, = struct.unpack(">H", receive(stream, 2))
    elif size == 127:
        size, = struct.unpack(">Q", receive(stream, 8))
    return bool(first & 0x80), first & 0x0F, receive(stream, size)


def receive_frame(stream):
    is_last, kind, payload = receive_piece(stream)
    assert kind != 0
    while not is_last:
        is_last, next_kind, piece = receive_piece(stream)
        if next_kind == PING:
            send(stream, PONG, piece)
            is_last = False
            continue
        assert next_kind == 0, next_kind
        payload += piece
    return kind, payload


def main():
    port, certificate = int(sys.argv[1]), sys.argv[2]
    context = ssl.create_default_context(cafile=certificate)
    with socket.create_connection(("127.0.0.1", port), timeout=PATIENCE) as plain:
        with context.wrap_socket(plain, server_hostname="localhost") as stream:
            assert stream.version() in ("TLSv1.2", "TLSv1.3"), stream.version()
            shake_hands(stream)
            send(stream, BINARY, b"hello")
            assert receive_frame(stream) == (BINARY, b"hello")
#In two pieces with a ping between them.
            send(stream, BINARY, b"first, ", is_last=False)
            send(stream, PING, b"there?")
            send(stream, 0, b"second")
            assert receive_frame(stream) == (PONG, b"there?")
            assert receive_frame(stream) == (BINARY, b"first, second")
            for size in (0, 125, 126, 65535, 65536, 300_000):
                payload = os.urandom(size)
                send(stream, BINARY, payload)
                assert receive_frame(stream) == (BINARY, payload), size
            send(stream, CLOSE, struct.pack(">H", 1000) + b"enough")
            kind, payload = receive_frame(stream)
            assert kind == CLOSE and payload[:2] == struct.pack(">H", 1000), (kind, payload)
            assert stream.recv(1) == b""


main()
