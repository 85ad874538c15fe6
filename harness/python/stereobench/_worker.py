"""A process of its own for what forks: the caller's may have rendered, or have threads.

A call is JSON on standard input, its answer JSON on standard output.
"""
import contextlib
import json
import os
import socket
import subprocess
import sys

from stereobench import _detector

def _process(control):
    """The interpreter that works. control: a socket that it inherits, or None."""
    package = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    path = os.pathsep.join(filter(None, [package, os.environ.get("PYTHONPATH")]))
    return subprocess.Popen([sys.executable, "-m", "stereobench._worker"], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                            pass_fds=[] if control is None else [control.fileno()], env=os.environ | {"PYTHONPATH": path})


def _answer_of(words, detector):
    """(answer, exit code) of a worker. words: function, scenario and arguments."""
    here, there = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    with here:
        with there:
            process = _process(None if detector is None else there)
            call = json.dumps([*words, None if detector is None else there.fileno()])
        with process:
            try:
                with contextlib.suppress(BrokenPipeError):
                    process.stdin.write(call.encode())
                    process.stdin.close()
                if detector is not None:
                    _detector.answer_until(process.stdout, here, detector)
                return process.stdout.read(), process.wait()
            except BaseException:
                process.kill()
                raise


def call(function, *arguments, scenario=None, detector=None):
    """What a function of _core gives. Raises what it raises, and what the detector raises.

    scenario: a Scenario, its first argument; detector: a callable that takes the place of the scenario's.
    """
    _detector.check(detector)
    text, code = _answer_of([function, scenario and scenario._made_of, arguments], detector)
    from stereobench import _core
    if code != 0:
        raise _core.RunCrash(f"the process of {function.strip('_')} ended with {code}")
    answer = json.loads(text)
    if "error" in answer:
        kinds = {"Error": _core.Error, "RunCrash": _core.RunCrash, "TypeError": TypeError, "ValueError": ValueError}
        raise kinds.get(answer["error"], RuntimeError)(answer["message"])
    return answer["value"]


def main():
    answers = os.fdopen(os.dup(sys.stdout.fileno()), "w")
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # commands talk there
    from stereobench import _core
    function, made_of, arguments, control = json.loads(sys.stdin.read())
    name = ""
    if control is not None:
        name = _detector.CALLABLE
        _core._register_detector(name, _detector.Asker(control))
    try:
        first = [] if made_of is None else [_core.Scenario(*made_of, name)]
        answer = {"value": getattr(_core, function)(*first, *arguments)}
    except Exception as error:  # the caller raises it
        answer = {"error": type(error).__name__, "message": str(error)}
    json.dump(answer, answers)
    answers.close()


if __name__ == "__main__":
    main()
