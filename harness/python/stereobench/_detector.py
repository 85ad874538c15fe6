"""A detector that stays in the caller's process, while drives go on in a worker's processes.

Each process that drives has a connection of its own to the caller. It sends what a Frame is made of, and gets the
detector's answer as JSON.
"""
import contextlib
import json
import os
import socket
from multiprocessing.connection import Connection, wait


class Asker:
    """The detector as the worker knows it.

    control: file number of the socket to the caller, through which new connections are handed over.
    """

    def __init__(self, control):
        self._control = socket.socket(fileno=control)
        self._process = None

    def _connect(self):
        here, there = socket.socketpair()
        with there:
            socket.send_fds(self._control, [b"new"], [there.fileno()])
        self._connection, self._process = Connection(here.detach()), os.getpid()

    def __call__(self, frame):
        if self._process != os.getpid():  # the worker has forked
            self._connect()
        self._connection.send((frame.step, frame.stamp_ns, frame.left, frame.right, frame.setup))
        return json.loads(self._connection.recv_bytes())


def _plain(value):
    """Numbers and arrays of numpy as Python's own."""
    if not hasattr(value, "tolist"):
        raise TypeError(f"a detector's answer cannot hold a {type(value).__name__}")
    return value.tolist()


def _answer(connection, detector):
    """Answers one question. False where the process that asked is gone."""
    from stereobench import _core
    try:
        parts = connection.recv()
    except (EOFError, OSError):
        return False
    text = json.dumps(list(detector(_core.Frame(*parts))), default=_plain)
    with contextlib.suppress(OSError):  # it is gone in the meantime; recv will say so
        connection.send_bytes(text.encode())
    return True


def answer_until(ended, control, detector):
    """Answers all questions in this thread, one after the other. Raises what the detector raises.

    ended: a file with something to read when there are no more questions; control: see Asker.
    """
    connections = []
    try:
        while True:
            ready = wait([ended, control, *connections])
            if ended in ready:
                return
            for one in ready:
                if one is control:
                    connections += [Connection(number) for number in socket.recv_fds(control, 8, 1)[1]]
                elif not _answer(one, detector):
                    connections.remove(one)
                    one.close()
    finally:
        for one in connections:
            one.close()
