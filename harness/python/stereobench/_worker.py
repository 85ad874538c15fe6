"""A process of its own for `run` and `sweep`, which fork: the caller's may have rendered, or have threads.

Reads a call as JSON from standard input, and answers in JSON on standard output.
"""
import json
import os
import subprocess
import sys


def call(function, scenario, *arguments):
    """What _core's function says of a scenario (dict): "json" and "broken". Raises what it raises."""
    package = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    path = os.pathsep.join(filter(None, [package, os.environ.get("PYTHONPATH")]))
    words = json.dumps([function, scenario._made_of, arguments])
    done = subprocess.run([sys.executable, "-m", "stereobench._worker"], input=words, stdout=subprocess.PIPE, text=True,
                          env=os.environ | {"PYTHONPATH": path})
    from stereobench import _core
    if done.returncode != 0:
        raise _core.RunCrash(f"the process of {function.strip('_')} ended with {done.returncode}")
    answer = json.loads(done.stdout)
    if "error" in answer:
        raise {"Error": _core.Error, "RunCrash": _core.RunCrash}.get(answer["error"], ValueError)(answer["message"])
    return answer


def main():
    from stereobench import _core
    function, made_of, arguments = json.loads(sys.stdin.read())
    try:
        outcome = getattr(_core, function)(_core.Scenario(*made_of), *arguments)
        answer = {"json": outcome.json, "broken": outcome.broken}
    except (RuntimeError, ValueError) as error:
        answer = {"error": type(error).__name__, "message": str(error)}
    sys.stdout.write(json.dumps(answer))


if __name__ == "__main__":
    main()
