#!/usr/bin/env python3
"""Tampered records: each is false for a reason that is plain, and the checker must reject each.

    python3 checker/tamper.py study.json ... [--only TEXT] [--seed N]

For each record the claims that the checker confirms are changed, one at a time: verdicts swapped, signs and coefficients of equations, of
integrals, densities and multipliers, terms added and equations dropped, conditions and dimensions replaced, counterexamples moved off the
constraints or emptied, the lowered model given another force. The exit status is 1 where a false record passes.
"""
import copy
import json
import pathlib
import re
import sys

import check_study
from check_study import CONFIRMED, REJECTED, System, full

# The rates of these are determined by their equations once, so that none may be dropped.
LEAN = ("maggi", "kane", "boltzmann-hamel", "voronets", "volterra-first", "gibbs-appell")


def moving(record):
    """A coordinate of the system, by whose value no quantity kept by all motions may be changed."""
    return System(record["model"]["flat"]).q[0]


def of_verdict(record, verdict):
    """Changes of one verdict: pairs of a word and what is put into it."""
    word, claim, x = verdict["verdict"], verdict["claim"], moving(record)
    fake = {"point": [{"name": x, "exact": "1", "enclosure": None}], "quantity": "the residual", "residual": ["1", "2"]}
    if word == "proved":
        yield "refuted without a point", {"verdict": "refuted"}
        yield "refuted at a made-up point", {"verdict": "refuted", "counterexample": fake}
    else:
        yield "proved", {"verdict": "proved", "condition": None}
    if word == "refuted":
        own = verdict["counterexample"]
        yield "a residual with zero", {"counterexample": own | {"residual": ["-1", "1"]}}
        moved = [p | {"enclosure": [str(float(e) + 1) for e in p["enclosure"]]} if p["enclosure"] else p for p in own["point"]]
        if moved != own["point"]:
            yield "a point off the constraints", {"counterexample": own | {"point": moved}}
    yield from of_formulas(verdict, claim, x)
    if claim in ("hamilton.endpoints", "hamilton.constants"):
        yield "other dimensions", {"detail": "".join(str(int(c) + 1) if c.isdigit() else c for c in verdict["detail"])}
    if word == "conditional" and claim == "variation.hoelder" and verdict["condition"] != "on the motions":
        yield "a narrower condition", {"condition": verdict["condition"] + f" and delta_{x} = 0"}
    if word == "conditional" and claim == "hamilton.stationary":
        yield "another condition", {"condition": f"{x} = 0"}


def of_formulas(verdict, claim, x):
    formulas = verdict["formulas"]
    put = lambda i, text: {"formulas": formulas[:i] + [text] + formulas[i + 1:]}
    if verdict["verdict"] != "proved" or not formulas:
        return
    if claim == "noether.integral":
        yield "a term added", put(0, f"{formulas[0]} + t")
        yield "a coordinate added", put(0, f"2 ({formulas[0]}) - {x}")
        yield "a constant", put(0, "1")
    if claim == "energy.integral":
        yield "a term added", put(0, f"{formulas[0]} - {x}")
        yield "another factor", put(0, f"2 ({formulas[0]})")
    if claim == "measure.invariant":
        yield "another density", put(0, f"({formulas[0]}) (1 + t^2)")
    if claim == "chaplygin.multiplier" and len(formulas) > 2:
        yield "another multiplier", put(2, f"({formulas[2]}) (2 + {verdict['detail'].split('equations of motion in ')[1].split()[0]}^2)")
    if claim == "cartan.form":
        for i, text in enumerate(formulas):
            yield f"coefficient {i} of other sign", put(i, f"-({text})")
    if claim == "variation.suslov":
        yield "a term added", put(0, f"{formulas[0]} + delta_{x}")
    if claim in ("hamilton.stationary", "formulation.vakonomic-coincides") and formulas[0].startswith("kappa_"):
        yield "kappa with a term added", put(0, f"{formulas[0]} + t")


def of_equations(entry, coordinates):
    """Changes of the equations of a formulation; what q' is must not be another."""
    own = {x + "'" for x in coordinates}
    for i, text in enumerate(entry["equations"]):
        left, right = text.split(" = ", 1)
        if any(u in text for u in entry["unknowns"]):
            yield f"a term added to equation {i}", {"equations": changed(entry["equations"], i, f"{left} = {right} + 1")}
        if left in own and right != "0":
            yield f"a coefficient of equation {i}", {"equations": changed(entry["equations"], i, f"{left} = 2 ({right})")}
            yield f"a sign of equation {i}", {"equations": changed(entry["equations"], i, f"{left} = -({right})")}
    if entry["formulation"] in LEAN:
        yield "an equation dropped", {"equations": entry["equations"][1:]}
    for i, text in enumerate(entry["velocities"]):
        if not text.endswith("'"):
            yield f"velocity {i}", {"velocities": changed(entry["velocities"], i, f"2 ({text}) + 1")}
    for i, x in enumerate(entry["state"]):
        if "'" not in x["name"]:
            yield f"variable {i}", {"state": changed(entry["state"], i, x | {"definition": f"2 ({x['definition']}) + 1"})}


def of_functional(record):
    """Changes of a record of a functional: triples of a word, the beginning of the claim, and the record."""
    flat, own = record["model"]["flat"], record["functional"]
    put = lambda text: record | {"model": record["model"] | {"flat": text}}
    field = re.search(r'\[fields\]\n"(\w+)" = \{ "kind" = "(\w+)"', flat)
    index = {"scalar": "", "vector": "_1", "symmetric": "_11", "matrix": "_11"}[field[2]]
    for k, line in enumerate(own["euler"]):
        for word, text in (("of other sign", f"-({line['zero']})"), ("with a term added", f"{line['zero']} + 1")):
            entry = own | {"euler": changed(own["euler"], k, line | {"zero": text})}
            yield f"the equation of {line['of']} {word}", "functional.euler", record | {"functional": entry}
    more = f"{field[1]}{index}^3"
    yield "a term added to the density", "functional", put(flat.replace('density = "', f'density = "{more} + ', 1))
    labels = re.search(r"^yields = \[(.*)\]$", flat, re.M)
    if labels and labels[1]:
        rest = ", ".join(labels[1].split(", ")[1:])
        yield "an equation left out of those that follow", "functional.euler", put(flat.replace(labels[0], f"yields = [{rest}]", 1))
    on = re.search(r'\[boundary\]\n"[^"]*" = \{ "density" = "', flat)
    if on:
        yield "a term added on the boundary", "functional", put(flat.replace(on[0], f"{on[0]}{more} + ", 1))
    for word, before, after in (("another flux", '"flux" = "', '"flux" = "2 '), ("another value", '"value" = "-', '"value" = "'),
                                ("another special value", '"at" = { "beta" = "', '"at" = { "beta" = "1/3 + ')):
        if before in flat:
            claim = {"flux": "duality", "valu": "solution", "at\" ": "degeneration"}.get(before[1:5], "degeneration")
            yield word, f"functional.{claim}", put(flat.replace(before, after, 1))
    for k, verdict in enumerate(record["verdicts"]):
        for word, change in of_current(verdict, more):
            yield word, full(verdict), record | {"verdicts": changed(record["verdicts"], k, verdict | change)}
        if " modulo " in verdict["detail"] and verdict["claim"] == "functional.duality":
            entry = verdict | {"detail": verdict["detail"].split(" modulo ")[0]}
            yield "no equations named", full(verdict), record | {"verdicts": changed(record["verdicts"], k, entry)}


def of_current(verdict, more):
    """Changes of a current, of its defect, and of the exponents of a scaling."""
    if verdict["claim"] != "functional.noether":
        return
    for i, text in enumerate(verdict["formulas"]):
        caption, _, right = text.partition(": ")
        head, _, right = right.rpartition("solutions: ") if caption == "the defect" else ("", "", right)
        caption += ": " + (head + "solutions: " if head else "")
        for word, other in (("of other sign", f"-({right})"), ("with a term added", f"{right} + {more}"), ("twice", f"2 ({right})")):
            yield f"{caption}{word}", {"formulas": changed(verdict["formulas"], i, caption + other)}
    exponent = re.search(r"with the exponent (-?[0-9/]+)", verdict["detail"])
    if exponent:
        yield "another exponent", {"detail": verdict["detail"].replace(exponent[0], f"with the exponent {exponent[1]}1")}


def changed(items, i, item):
    return items[:i] + [item] + items[i + 1:]


def tampered(record, confirmed):
    """Triples of a word, the claim it touches, and the record."""
    if record.get("functional"):
        for word, claim, false in of_functional(record):
            if any(own.startswith(claim) for own in confirmed):
                yield word, claim, false
        for k, verdict in enumerate(record["verdicts"]):
            if full(verdict) in confirmed:
                word = "refuted" if verdict["verdict"] == "proved" else "proved"
                yield word, full(verdict), record | {"verdicts": changed(record["verdicts"], k, verdict | {"verdict": word})}
        return
    for k, verdict in enumerate(record["verdicts"]):
        if full(verdict) in confirmed:
            for word, change in of_verdict(record, verdict):
                yield word, full(verdict), record | {"verdicts": changed(record["verdicts"], k, verdict | change)}
    for k, entry in enumerate(record["equations"]):
        claim = f"formulation.equivalent#{entry['formulation']}"
        if claim in confirmed:
            for word, change in of_equations(entry, System(record["model"]["flat"]).q):
                yield word, claim, record | {"equations": changed(record["equations"], k, entry | change)}
    flat, x = record["model"]["flat"], moving(record)
    for term in (f"{x}^3", f"t {x}", f"{x} {x}'^2"):
        text = flat.replace('"L" = "', f'"L" = "{term} + ', 1)
        yield f"{term} added to L", "formulation.equivalent#maggi", record | {"model": record["model"] | {"flat": text}}


def main(arguments):
    options = {a: b for a, b in zip(arguments, arguments[1:]) if a.startswith("--")}
    files = [a for i, a in enumerate(arguments) if not a.startswith("--") and (i == 0 or not arguments[i - 1].startswith("--"))]
    seed, count, passed = int(options.get("--seed", 1)), 0, []
    for name in files:
        record = json.loads(pathlib.Path(name).read_text(encoding="utf-8"))
        lines = check_study.check(record, seed)
        wrong = [line for line in lines if line[2] == REJECTED]
        passed += [(name, "as it was written", line[0]) for line in wrong]
        confirmed = {line[0] for line in lines if line[2] == CONFIRMED and options.get("--only", "") in line[0]}
        for word, claim, false in tampered(record, confirmed):
            count += 1
            if not any(line[2] == REJECTED for line in check_study.check(copy.deepcopy(false), seed, claim)):
                passed.append((name, word, claim))
    for name, word, claim in passed:
        print(f"not rejected: {name}: {claim}: {word}" if word != "as it was written" else f"rejected: {name}: {claim}")
    print(f"{count - len(passed)} of {count} tampered records rejected")
    return 1 if passed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
