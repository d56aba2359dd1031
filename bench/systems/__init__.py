"""The systems of the benchmark, written once for every tool.

A module has

    T_END                     end of its trajectory
    coordinates(n)            names, in the order of the model file
    start(n)                  (q, u): coordinates and independent velocities, as floats
    lagrangian(o, q, v)       T - V
    energy(o, q, v)           T + V
    constraints(o, q, v)      velocity constraints f(q, v) = 0, those of position differentiated
    holonomic(o, q)           constraints of position, and the coordinate each gives: [(value, index)]
    independent(n)            places of the independent velocities
    dependent(n)              places of the others, in an order in which elimination without pivoting succeeds
    linear                    whether the constraints are linear in the velocities
    hand                      None, or the compact equations found by a person:
    hand.variables(n)         names of the state z = (q, own velocities)
    hand.state(o, q, v)       z
    hand.velocities(o, z)     v
    hand.rates(o, z)          z'

`o` gives `sin`, `cos`, `sqrt` and `num` (an exact decimal number) of the tool, so that everybody gets the same formulas.
"""

import importlib


def load(name):
    """The module and size of `snake-8`, `disc`, …"""
    stem, _, size = name.partition("-")
    if stem == "appell":
        stem, size = "appell_hamel", ""
    module = importlib.import_module("systems." + stem)
    return Sized(module, int(size) if size else 0)


class Sized:
    """A system of a size."""

    def __init__(self, module, n):
        self.module, self.n = module, n
        self.linear = getattr(module, "LINEAR", True)
        self.t_end = module.T_END
        self.hand = getattr(module, "hand", None)
        self.names = module.coordinates(n)
        self.size = len(self.names)
        self.independent = module.independent(n)
        self.dependent = module.dependent(n)

    def start(self):
        return self.module.start(self.n)

    def lagrangian(self, o, q, v):
        return self.module.lagrangian(o, q, v)

    def energy(self, o, q, v):
        return self.module.energy(o, q, v)

    def constraints(self, o, q, v):
        return self.module.constraints(o, q, v)

    def holonomic(self, o, q):
        f = getattr(self.module, "holonomic", None)
        return f(o, q) if f else []
