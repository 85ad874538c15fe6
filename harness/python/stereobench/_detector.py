"""A detector stays in the caller's process. Drives go on there, or in a worker's processes.

Each process of a worker that drives has a connection of its own to the caller, and memory that both see. It puts pictures there, says
what else a Frame is made of, and gets the detector's answer as JSON.
"""
import contextlib
import json
import math
import mmap
import os
import socket
import threading
from multiprocessing.connection import Connection, wait

import numpy as np


#: What results call a detector in Python.
CALLABLE = "callable"

_here = threading.local()  # .detector: what drives of this thread ask
_is_registered = []
_registers = threading.Lock()


def check(detector):
    """Raises TypeError unless it can be called, or is None."""
    if detector is not None and not callable(detector):
        raise TypeError(f"detector: expected a callable (got {type(detector).__name__})")


@contextlib.contextmanager
def called_here(detector):
    """The name under which drives in this thread ask a detector, with pictures that are not copied."""
    from stereobench import _core
    check(detector)
    with _registers:
        if not _is_registered:
            _core._register_detector(CALLABLE, lambda frame: _here.detector(frame))
            _is_registered.append(CALLABLE)
    before, _here.detector = getattr(_here, "detector", None), detector
    try:
        yield CALLABLE
    finally:
        _here.detector = before


class Asker:
    """The detector as the worker's processes know it. The worker itself never asks, and so hands on no connection.

    control: file number of the socket to the caller, through which new connections are handed over.
    """

    def __init__(self, control):
        os.set_inheritable(control, False)
        self._control = socket.socket(fileno=control)
        self._connection, self._memory = None, b""

    def _connect(self, size):
        """size: of the memory, bytes."""
        memory = os.memfd_create("stereobench")
        os.ftruncate(memory, size)
        here, there = socket.socketpair()
        with there:
            socket.send_fds(self._control, [b"new"], [there.fileno(), memory])
        self._connection, self._memory = Connection(here.detach()), mmap.mmap(memory, size)
        os.close(memory)

    def __call__(self, frame):
        left, right = frame.left, frame.right
        if len(self._memory) != left.nbytes + right.nbytes:
            self._connect(left.nbytes + right.nbytes)
        self._memory[:left.nbytes], self._memory[left.nbytes:] = left.data, right.data
        self._connection.send((frame.step, frame.stamp_ns, left.shape, right.shape, frame.setup))
        return json.loads(self._connection.recv_bytes())


def _accept(control):
    """{connection: its memory} of what is handed over; empty where nothing is."""
    numbers = socket.recv_fds(control, 8, 2)[1]
    if not numbers:
        return {}
    connection, memory = numbers
    try:
        return {Connection(connection): mmap.mmap(memory, 0)}
    finally:
        os.close(memory)


def _plain(value):
    """Numbers and arrays of numpy as Python's own."""
    if not hasattr(value, "tolist"):
        raise TypeError(f"a detector's answer cannot hold a {type(value).__name__}")
    return value.tolist()


def _answer(connection, memory, detector):
    """Answers one question. False where the process that asked is gone."""
    from stereobench import _core
    try:
        step, stamp_ns, left, right, setup = connection.recv()
    except (EOFError, OSError):
        return False
    pictures = np.frombuffer(memory, np.uint8)
    split = math.prod(left)
    frame = _core.Frame(step, stamp_ns, pictures[:split].reshape(left), pictures[split:].reshape(right), setup)
    text = json.dumps(list(detector(frame)), default=_plain)
    with contextlib.suppress(OSError):  # it is gone in the meantime; recv will say so
        connection.send_bytes(text.encode())
    return True


def answer_until(ended, control, detector):
    """Answers all questions in this thread, one after the other. Raises what the detector raises.

    ended: a file with something to read when there are no more questions; control: see Asker.
    """
    memories = {}
    try:
        while True:
            ready = wait([ended, control, *memories])
            if ended in ready:
                return
            for one in ready:
                if one is control:
                    memories.update(_accept(control))
                elif not _answer(one, memories[one], detector):
                    del memories[one]
                    one.close()
    finally:
        for one in memories:
            one.close()
