"""The equations of one formulation as the record states them: state, unknowns, linear systems for shared parts, the matrix by the unknowns."""
from expressions import ZERO, NotCheckable, Parser, gradient, sub, substitute, sym, symbols
from systems import solve_series

N = 4  # Taylor coefficients of the state along the motion


def equation(text, names, rate):
    left, right = text.split("=", 1)
    return sub(Parser(left, names, rate).read(), Parser(right, names, rate).read())


class Form:
    """The equations of one formulation, read."""

    def __init__(self, system, entry):
        self.state = {(x["name"].rstrip("'"), x["name"].count("'")): x["definition"] for x in entry["state"]}
        if None in self.state.values():
            raise NotCheckable("the state has data of its own")
        names = {n: e for n, e in system.names.items() if (n, 0) not in self.state}
        implicit, solved = [], {(u, 0) for u in entry["unknowns"]}
        for text in entry["definitions"]:
            left, right = text.split(" = ", 1)
            # An unknown that an equation before it has is one of the same linear system.
            if left.isidentifier() and (left, 0) not in symbols(implicit):
                names[left] = Parser(right, names, system.rate).read()
            else:
                implicit.append(equation(text, names, system.rate))
        self.velocities = [Parser(text, names, system.rate).read() for text in entry["velocities"]]
        own = [sub(sym(x, 1), e) for x, e in zip(system.q, self.velocities) if (x, 1) not in self.state]
        self.stated = [equation(text, names, system.rate) for text in entry["equations"]]
        # What the equations say of q' alone is a condition on the state: q' is what the velocities say.
        by_state = {(x, 1): e for x, e in zip(system.q, self.velocities) if (x, 1) not in self.state}
        hidden = [e for e in substitute(self.stated, by_state) if e not in self.stated] if by_state else []
        self.residuals = implicit + own + self.stated + hidden
        shared = names | dict(system.quasi)
        self.defined = {n: Parser(d, shared, system.rate).read() for (n, k), d in self.state.items() if n not in system.q}
        known = set(self.state) | {(x, 0) for x in [*system.q, *system.masses, *system.parameters, "t"]}
        found = {s for s in symbols(self.residuals + self.velocities) if s not in known and s[0] not in system.controls}
        stated = {s for s in found if "'" * s[1] and s[0] + "'" * s[1] in entry["unknowns"] or s in solved}
        self.parts = sorted(s for s in found - stated if s[1] == 0)
        self.rates = sorted(s for s in found - set(self.parts) if (s[0], s[1] - 1) in self.state or (s[0] in system.q and s[1] == 1)
                            or s[0][:3] in ("Dq_", "Dv_") or s[0] in system.masses)
        self.others = sorted(found - set(self.rates) - set(self.parts))
        self.systems = self.blocks(implicit)
        self.complete(system)

    def blocks(self, implicit):
        """Linear systems for parts, each as many equations as new unknowns; parts that depend on rates are unknowns too."""
        out, rows, done = [], [], set()
        for e in implicit:
            rows.append(e)
            new = sorted((symbols(rows) & set(self.parts)) - done)
            if len(new) == len(rows):
                if symbols(rows) & set(self.rates + self.others):
                    self.others += new
                out.append((new, rows, [gradient(r, new) for r in rows]))
                done |= set(new)
                rows = []
        if rows or set(self.parts) - done:
            raise NotCheckable("parts that no linear system determines")
        return out

    def complete(self, system):
        """Rates of variables that conditions tie, the matrix, and the variables that must be constant."""
        unknown = lambda e: symbols([e]) & set(self.rates + self.others)
        tied = symbols([e for e in self.residuals if not unknown(e)])
        known = {r[0] for r in self.rates}
        self.rates += [(n, k + 1) for n, k in self.state if (n, k) in tied and (n, k + 1) not in self.rates and "Dv_" + n not in known]
        self.rates += [(n, 1) for n, _ in self.parts if (n, 0) in tied and (n, 0) not in self.others]
        self.constant = [s for s in self.state if (s[0], s[1] + 1) not in self.rates and "Dv_" + s[0] not in known]
        of = {"Dq_": 0, "Dv_": 1}
        below = [(s[0][3:], of[s[0][:3]]) if s[0][:3] in of else (s[0], s[1] - 1) for s in self.rates]
        self.rows, self.is_condition = [], []
        for e in self.residuals:
            self.is_condition.append(not unknown(e))
            self.rows.append(gradient(e, self.rates + self.others) if unknown(e) else gradient(e, below) + [ZERO] * len(self.others))
        # Accelerations beside another state are those of the motion, and so are multipliers that the constraints determine.
        known = lambda s: s in self.parts or s[0] in system.q or (not system.is_reduced and s[0].startswith("lambda_"))
        self.free = [s for s in self.others if not known(s)]
        if symbols([x for row, c in zip(self.rows, self.is_condition) if not c for x in row[len(self.rates):]]) & set(self.free):
            raise NotCheckable("unknowns that occur nonlinearly")

    def put(self, system, p):
        """The variables of the state along the motion; primes are by a parameter tau where they are w_x = dx/dtau. What comes
        back vanishes where the velocities by the state, and their rates, are those of the motion."""
        system.move(p)
        for x in system.q:
            p.curves["Dq_" + x], p.curves["Dv_" + x] = p.coefficients(x, 1, N), p.coefficients(x, 2, N)
        # Parts may be needed for what the state is, and the state for other parts.
        missing, unsolved = dict(self.defined), list(self.systems)
        while missing or unsolved:
            before = len(missing), len(unsolved)
            open_ = lambda es: symbols(es) & ({(n, k) for n in missing for k in (0, 1)} | {s for new, _, _ in unsolved for s in new})
            for name in [n for n, e in missing.items() if not open_([e])]:
                p.curves[name] = p.series([missing.pop(name)], N)[0]
            for block in [b for b in unsolved if open_(b[1]) <= set(b[0])]:
                self.solve_parts(p, N, [block])
                unsolved.remove(block)
            if before == (len(missing), len(unsolved)):
                raise NotCheckable("parts and variables that need each other")
        same = [(a - b) % p.p for e, q in zip(self.velocities, system.q) for a, b in zip(p.series([e], 2)[0], p.coefficients(q, 1, 2))]
        slow = [x for x in system.q if "w_" + x in self.defined]
        if slow:
            factor = p.value(self.defined["w_" + slow[0]]) * p.inverse(p.curves[slow[0]][1]) % p.p
            for name in self.defined:
                p.curves[name] = [c * pow(factor, k, p.p) % p.p for k, c in enumerate(p.curves[name])][:2]
        return same

    def solve_parts(self, p, n, blocks=None):
        for new, rows, slopes in self.systems if blocks is None else blocks:
            p.jets |= {s: [0] for s in new}
            b = [[-c % p.p for c in x] for x in p.series(rows, n)]
            matrix = [p.series(row, n) for row in slopes]
            for s, x in zip(new, solve_series(matrix, b, n, p.p)):
                p.jets[s], p.jets[s[0], 1] = x, [c * k % p.p for k, c in enumerate(x)][1:]
