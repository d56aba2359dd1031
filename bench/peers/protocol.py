"""How a participant talks: one JSON object a line, questions on standard input, answers on standard output.

    {"do": "prepare", "item": ..., "system": ..., "form": ..., "variant": ..., "tolerance": ..., "states": ..., ...}
        -> {"ok": true, "answer": [...], "info": {...}}
    {"do": "measure"}  -> {"ok": true, "seconds": ..., "wall": ..., "parts": {...}}
    {"do": "quit"}     -> {"ok": true, "memory": bytes, "before": bytes}

or {"ok": false, "reason": "..."}. Seconds are those of the processor, per unit of the item (evaluation, trajectory, derivation).
"""

import json
import os
import resource
import sys
import time
import traceback

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))


def memory():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024


def children():
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * 1024


class Clock:
    """Seconds of the processor, those of children that have ended included, and of the wall."""

    def __init__(self):
        self.cpu, self.wall = Clock.now(), time.perf_counter()

    @staticmethod
    def now():
        t = os.times()
        return time.process_time() + t.children_user + t.children_system

    def lap(self):
        cpu, wall = Clock.now(), time.perf_counter()
        found = cpu - self.cpu, wall - self.wall
        self.cpu, self.wall = cpu, wall
        return found


def per_unit(work, units, least=0.05):
    """Calls `work` until it has used `least` seconds; seconds per unit."""
    calls, done = 1, None
    while True:
        clock = Clock()
        for _ in range(calls):
            work()
        cpu, wall = clock.lap()
        if cpu >= least or calls > 1 << 24:
            return {"seconds": cpu / calls / units, "wall": wall / calls / units}
        calls = max(2 * calls, int(1.2 * calls * least / max(cpu, 1e-9)))


def serve(items):
    """Answers questions; `items[name](request)` gives (answer, info, measure)."""
    out = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    before = memory()
    measure = None

    def reply(value):
        try:
            text = json.dumps(value, allow_nan=False)
        except ValueError:
            # JSON has no such numbers; an answer with them is wrong.
            text = json.dumps(json.loads(json.dumps(value), parse_constant=lambda _: None))
        out.write(text + "\n")
        out.flush()

    for line in sys.stdin:
        request = json.loads(line)
        try:
            if request["do"] == "prepare":
                if request["item"] not in items:
                    raise NotImplementedError("this participant has no " + request["item"])
                before = memory()
                answer, info, measure = items[request["item"]](request)
                reply({"ok": True, "answer": answer, "info": info})
            elif request["do"] == "measure":
                reply({"ok": True, **measure()})
            else:
                reply({"ok": True, "memory": memory(), "before": before, "children": children()})
                return
        except BaseException as problem:  # whatever it is becomes a row with its reason
            traceback.print_exc()
            reply({"ok": False, "reason": f"{type(problem).__name__}: {problem}"[:400]})


def plain(rows):
    return [[float(x) for x in row] for row in rows]
