"""Results: arrays by name, display, SymPy, files, interruption."""

from __future__ import annotations

import hashlib
import json
import os
import pickle
import re
import signal
import subprocess
import sys
import textwrap
import time
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
import sympy as sp
from test_commands import without

import chetaev
from chetaev import System
from chetaev.texts import of_sympy


@pytest.fixture(scope="module")
def sleigh() -> System:
    return System.from_gallery("chaplygin-sleigh")


def test_columns_are_arrays_by_name(sleigh: System) -> None:
    run = sleigh.simulate(t_end=5)
    assert run.names[:4] == ["t", "x", "y", "phi"]
    assert {"x'", "phi''", "lambda_blade", "energy"} <= set(run.keys())
    assert run.finished and run.t[-1] == 5
    assert len(run) == len(run.t) == run.to_numpy().shape[0]
    assert run.drift["energy"] is not None and run.drift["energy"] < 1e-9
    # The yaw rate dies away as W / cosh(k t) (Neimark, Fufaev 1972).
    m, J, a, W = 1.5, 0.4, 0.25, 2.1
    V = W * np.sqrt((J + m * a**2) / m)
    k = m * a * V / (J + m * a**2)
    np.testing.assert_allclose(run["phi'"], W / np.cosh(k * run.t), rtol=1e-8)
    with pytest.raises(KeyError, match="there is no column `z`"):
        run["z"]


def test_results_are_displayed(sleigh: System) -> None:
    study = sleigh.study(claims="energy.integral", t_end=1)
    bundle = study._repr_mimebundle_()
    assert "<details>" in bundle["text/html"] and "proved" in bundle["text/html"]
    assert "energy.integral" in bundle["text/plain"]
    derived = sleigh.derive("maggi")._repr_mimebundle_()
    assert derived["text/latex"].startswith("$$\\begin{aligned}")
    with pytest.raises(TypeError, match="six words"):
        bool(study["energy.integral"])
    page = study.render_static()
    assert page.startswith("<iframe srcdoc=") and "&lt;html" in page


def test_equations_go_to_sympy(sleigh: System) -> None:
    found = sleigh.derive("routh").to_sympy()["routh"]
    assert any(isinstance(own, sp.Equality) for group in found.values() for own in group)
    # Lagrange's operator by SymPy itself goes to the model notation and comes back the same.
    t = sp.Symbol("t", real=True)
    x, y, phi = (sp.Function(name, real=True)(t) for name in ("x", "y", "phi"))
    m, J, a = sp.symbols("m J a")
    T = m * ((x.diff(t) - a * phi.diff(t) * sp.sin(phi)) ** 2 + (y.diff(t) + a * phi.diff(t) * sp.cos(phi)) ** 2) / 2
    left = (T + J * phi.diff(t) ** 2 / 2).diff(phi.diff(t)).diff(t).doit()
    again = sleigh.sympify(of_sympy(left))
    names = {own.name: own for own in again.free_symbols}
    assert sp.expand(again - left.subs({m: names["m"], J: names["J"], a: names["a"]})) == 0


def test_linear_equations_go_to_sympy(sleigh: System) -> None:
    linear = sleigh.linearize()
    E, F = linear.to_sympy()
    assert E.shape == F.shape == (len(linear.variables),) * 2
    assert E.det() != 0
    values = linear.eigenvalues
    assert values is not None
    numbers = {own: {"m": 1.5, "J": 0.4, "a": 0.25, "ahead": 1}[own.name] for own in (E.free_symbols | F.free_symbols)}
    expected = np.linalg.eigvals(np.array((E.inv() * F).subs(numbers), dtype=float))
    np.testing.assert_allclose(np.sort_complex(values), np.sort_complex(expected.astype(complex)), atol=1e-9)


def test_reports_are_saved(sleigh: System, tmp_path: Path) -> None:
    run = sleigh.simulate(t_end=1)
    run.save_report(tmp_path / "report.html")
    assert (tmp_path / "report.html").read_text().lstrip().lower().startswith("<!doctype html")
    study = sleigh.study(claims="energy.integral,motion", t_end=1, out=tmp_path / "out")
    assert sorted(os.listdir(tmp_path / "out")) == ["report.html", "study.json", "trajectory.csv", "trajectory.npz"]
    record = json.loads((tmp_path / "out" / "study.json").read_text())
    assert len(record["files"]) == 3
    assert chetaev.verify(tmp_path / "out" / "study.json").agrees
    assert study.ok


def test_ctrl_c_keeps_what_there_is() -> None:
    script = textwrap.dedent(
        """
        import chetaev, signal, sys, time
        # A shell starts what runs in the background with this signal ignored, and children inherit that.
        signal.signal(signal.SIGINT, signal.default_int_handler)
        system = chetaev.System.from_gallery("double-pendulum")
        print("ready", flush=True)
        try:
            system.simulate(t_end=1e6, tolerance=1e-10)
        except chetaev.Interrupted as stopped:
            print(stopped.result.t[-1] < 1e6, len(stopped.result) > 0, "interrupted" in stopped.result.reason, flush=True)
        """
    )
    child = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True)
    assert child.stdout is not None
    assert child.stdout.readline() == "ready\n"
    time.sleep(1.5)
    began = time.perf_counter()
    child.send_signal(signal.SIGINT)
    line = child.stdout.readline()
    took = time.perf_counter() - began
    child.wait()
    assert line == "True True True\n"
    # Measured 0.1 s alone; other work on the machine takes its share.
    assert took < 1.0


def test_progress_is_told() -> None:
    pytest.importorskip("tqdm")
    System.from_gallery("chaplygin-sleigh").simulate(t_end=1, progress=True)


def test_operations_are_counted(sleigh: System) -> None:
    counted = sleigh.derive("maggi", count=True)
    # m u' − m a w² and (J + m a²) w' + m a u w, and u cos φ, u sin φ.
    assert str(counted).startswith("maggi: 17 operations: 3 + and −, 10 ×, 0 ÷, 2 powers, 0 roots, 2 functions")
    assert len(str(sleigh.derive(all=True, count=True)).splitlines()) > 15


def test_records_are_examined_by_a_program_that_shares_nothing(sleigh: System) -> None:
    study = sleigh.study(claims="energy.integral,model.constraints-integrable", t_end=1)
    found = chetaev.verify(study, independent=True)
    assert found.agrees
    assert {own["outcome"] for own in found.to_dict()} == {"confirmed"}
    false = study.to_dict()
    for own in false["verdicts"]:
        if own["claim"] == "energy.integral":
            own["verdict"] = "refuted"
    assert not chetaev.verify(false, independent=True).agrees
    with pytest.raises(chetaev.OptionError):
        chetaev.verify({"no": "record"}, independent=True)


def test_notebooks_show_results_everywhere(sleigh: System) -> None:
    motion = sleigh.simulate(t_end=1)
    for own in (
        sleigh.derive(), sleigh.study(claims="energy.integral", t_end=1), sleigh.check(), chetaev.explain("energy.integral"),
        motion.picture(), motion.animate(seconds=0.2, width=80, height=60), sleigh.derive(count=True),
    ):
        kind, content = own._mime_()
        assert kind == "text/html" and content == own._repr_mimebundle_()["text/html"]
    # Browsers typeset this without a script, and pages that were saved keep it.
    page = sleigh.derive("maggi")._html()
    assert page.count("<math") >= 2 and "<h4>Maggi&#x27;s equations</h4>" in page and "<!--" not in page
    ElementTree.fromstring(page)


def test_sliders_compute_the_motion_anew(sleigh: System) -> None:
    pytest.importorskip("anywidget")
    live = sleigh.widget(a=(0.1, 0.5), motion={"t_end": 3})
    first = live.picture
    assert first.startswith("<svg") and live.span == [0.0, 3.0] and live.t == 3.0
    live.values = {"a": 0.4}
    assert live.picture != first
    expected = sleigh.with_values(a=0.4).simulate(t_end=3)
    np.testing.assert_array_equal(live.motion["x"], expected["x"])
    live.t = 1.5
    assert live.picture == expected.picture(at=1.5, ghosts=4, width=720, height=405).to_svg()
    bundle = live._repr_mimebundle_()[0]
    assert "a = 0.4, t = 1.5" in bundle["text/html"] and "application/vnd.jupyter.widget-view+json" in bundle
    # What cannot be computed is said, and the last picture stays.
    live.values = {"a": float("nan")}
    assert live.said
    with pytest.raises(ValueError, match="`b` is no parameter"):
        sleigh.widget(b=(0, 1))
    ends: list[tuple[Any, str]] = [((1, 0), "to a larger one"), ((0, float("inf")), "to a larger one"), (1, "two ends"), (("x", 1), "two ends")]
    for wrong, said in ends:
        with pytest.raises((TypeError, ValueError), match=said):
            sleigh.widget(a=wrong)
    live.values = {"a": 0.3}
    live.t = 99
    assert live.picture == sleigh.with_values(a=0.3).simulate(t_end=3).picture(ghosts=4, width=720, height=405).to_svg()


def test_a_motion_is_there_by_name_and_by_axis(sleigh: System) -> None:
    run = sleigh.simulate(t_end=1)
    rows, columns = len(run), len(run.names)
    assert run.y.shape == np.asarray(run).shape == (rows, columns)
    np.testing.assert_array_equal(run.y[:, run.names.index("x'")], run["x'"])
    np.testing.assert_array_equal(run[["x", "y"]], np.stack([run["x"], run["y"]], axis=1))
    assert run[0].shape == (columns,) and run[0:3].shape == (3, columns)
    np.testing.assert_array_equal(run[-1], run.y[-1])
    assert "x" in run and "z" not in run and list(run) == run.names
    assert dict(run)["x"].shape == (rows,)
    assert run.verdicts and all(own.claim for own in run.verdicts)
    assert run.plot("phi'").get_lines()[0].get_label() == "phi'"
    # The energy is 1/2 (m v^2 + (J + m a^2) w^2) and stays: its scale is what it is at the start.
    assert run.scales["energy"] == pytest.approx(run["energy"][0], rel=1e-8)


def test_results_pickle(sleigh: System) -> None:
    run = sleigh.simulate(t_end=1, initial={"phi'": 2})
    again = pickle.loads(pickle.dumps(run))
    np.testing.assert_array_equal(again.y, run.y)
    assert str(again) == str(run) and again.drift == run.drift and again.names == run.names
    # What draws computes the motion again, and it is the same.
    assert again.picture().to_svg() == run.picture().to_svg()
    study = sleigh.study(claims=["energy.integral", "motion"], t_end=1)
    other = pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(study))))
    assert other.to_dict() == study.to_dict() and other.ok == study.ok
    assert other.trajectory is not None and study.trajectory is not None
    np.testing.assert_array_equal(other.trajectory["x"], study.trajectory["x"])


def test_pictures_linear_equations_and_functions_pickle(sleigh: System) -> None:
    def again(own: Any) -> Any:
        return pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(own))))

    picture = sleigh.simulate(t_end=1).picture(ghosts=2)
    assert again(picture).to_svg() == picture.to_svg()
    for linear in (sleigh.linearize(speeds="x' cos(phi) + y' sin(phi),phi'"), sleigh.stability(), sleigh.stability(over="ahead=-2:2")):
        assert type(again(linear)) is type(linear)
        assert again(linear).to_dict() == linear.to_dict() and str(again(linear)) == str(linear)
        assert again(linear).to_latex() == linear.to_latex()
    motion = sleigh.simulate(t_end=1)
    assert repr(again(motion.sol)) == repr(motion.sol) == "<sol(t): y = (x, y, phi, x', y', phi'), t from 0 to 1>"
    pytest.importorskip("casadi")
    exported = sleigh.to_casadi()
    rates = again(exported).rhs(0.0, exported.start, exported.p)
    np.testing.assert_array_equal(np.array(rates), np.array(exported.rhs(0.0, exported.start, exported.p)))
    assert again(exported).parameters == exported.parameters and again(exported).formulation == exported.formulation


def test_membership_is_by_name(sleigh: System) -> None:
    derived = sleigh.derive("maggi")
    assert "maggi" in derived and derived[0] in derived and "routh" not in derived
    study = sleigh.study(claims="energy.integral", t_end=1)
    assert "energy.integral" in study and "model.flat" not in study
    with pytest.raises(KeyError, match="energy.integral"):
        study["energy.integrl"]
    assert "chaplygin-sleigh" in chetaev.gallery.list() and "chaplygin-sleigh" in list(chetaev.gallery.list())


def test_undetermined_multipliers_are_explained() -> None:
    twice = System(
        "twice",
        coordinates=["x", "y"],
        kinetic="1/2 (x'^2 + y'^2)",
        constraints={"a": "x' = y'", "b": "2 x' = 2 y'"},
        initial={"x'": 1, "y'": 1},
    )
    run = twice.simulate(t_end=1)
    sums = [name for name in run.names if "lambda_a" in name]
    assert sums and "lambda_a" not in run
    with pytest.raises(KeyError, match="not determined"):
        run["lambda_a"]


@pytest.mark.parametrize(
    "work",
    [
        "System.from_gallery('double-pendulum').sensitivity('l', [20000.0])",
        "motion.animate(seconds=20, width=1600, height=900)",
        "f.jac(0.0, np.zeros((6_000_000, 6)))",
        "System.from_gallery('watt-governor').follow(over='eps=0.1:1', points=3000, step=1e-5)",
        "System.from_gallery('watt-governor').follow(over='eps=0.1:1', points=2**32 - 1, step=1e-12)",
        "[large.check() for _ in range(100)]",
        "[large.derive('routh') for _ in range(100)]",
        "[large.compile().jac for _ in range(100)]",
        "[System.from_text(text(80_000)) for _ in range(20)]",
        "[Functional.from_gallery('elasticity/p3p1').derive() for _ in range(1000)]",
    ],
)
def test_ctrl_c_ends_long_work(work: str) -> None:
    script = f"""
        import os, signal, threading, time
        import numpy as np
        from chetaev import Functional, System
        def text(count):
            terms = "+".join(f"sin({{k}} x)" for k in range(1, count))
            return f"name = 'sum'\\ncoordinates = ['x']\\nlagrangian = {{{{ T = \\"1/2 x'^2\\", V = '{{terms}}' }}}}"
        large = System.from_text(text(30_000))
        # What runs in the background may have been started with interrupts ignored.
        signal.signal(signal.SIGINT, signal.default_int_handler)
        motion = System.from_gallery("chaplygin-sleigh").simulate(t_end=5)
        f = motion._system.compile()
        f.jac(0.0, np.zeros(6))
        sent = []
        def send():
            sent.append(time.perf_counter())
            os.kill(os.getpid(), signal.SIGINT)
        threading.Timer(0.5, send).start()
        try:
            {work}
        except KeyboardInterrupt:
            print(time.perf_counter() - sent[0])
    """
    done = subprocess.run([sys.executable, "-c", textwrap.dedent(script)], capture_output=True, text=True, check=True)
    # 0.2 s on a machine of its own; a busy one takes turns.
    assert done.stdout and float(done.stdout) < 2, done


def test_masses_are_known_between_the_rows() -> None:
    """A tank that loses a tenth each second: m = 2 exp(-t/10), and x' is free of forces that the sand would bring."""
    tank = System(
        "tank", coordinates=["x"], masses={"m": {"rate": "-m/10", "initial": 2}}, kinetic="1/2 m x'^2", initial={"x'": 1},
        simulation={"output": 40},
    )
    motion = tank.simulate(t_end=3)
    assert motion.sol.names == ["x", "m", "x'"] == tank.state and motion.sol.masses == ["m"]
    times = np.linspace(0, 3, 17)
    np.testing.assert_allclose(motion.sol(times)[1], 2 * np.exp(-times / 10), rtol=1e-9)
    assert motion.sol(1.5).shape == (3,)


def test_results_are_tables_and_sentences_in_notebooks() -> None:
    """Whatever a result shows, it is no raw data: no braces of JSON, no text in a fixed width but what unfolds."""
    sleigh, governor = System.from_gallery("chaplygin-sleigh"), System.from_gallery("watt-governor")
    study = sleigh.study(claims="model,energy.integral,hamilton.stationary", t_end=1)
    shown = {
        "motion": (sleigh.simulate(t_end=1), ["at the start", "largest change", "<code>phi'</code>".replace("'", "&#x27;")]),
        "steady": (sleigh.steady(), ["u = u_0"]),
        "linear": (sleigh.linearize(), ["79/160", "eigenvalues"]),
        "stability": (sleigh.stability(over="ahead=-2:2"), ["&lt; ahead &lt;", "critical value", "<svg"]),
        "curve": (governor.follow(over="eps=0.1:1", points=5), ["Hopf", "11 points"]),
        "sweep": (sleigh.sweep(vary={"a": "0.1:0.5:5"}, t_end=1), ["5 trajectories", "vary_a"]),
        "sensitivity": (sleigh.sensitivity("a", [0.0, 1.0]), ["d x/d a"]),
        "study": (study, ["Decided in exact arithmetic", "It took "]),
    }
    for name, (result, words) in shown.items():
        page = result._repr_mimebundle_()["text/html"]
        assert "<table" in page, name
        for word in words:
            assert word in page, (name, word)
        opened = re.sub(r"<details>.*?</details>", "", page, flags=re.DOTALL)
        assert "<pre>" not in opened and '{"' not in page and "&quot;" not in page, name


def test_evidence_is_all_there_in_sentences() -> None:
    from chetaev import notebook

    verdict = {
        "claim": "a.b", "subject": None, "verdict": "refuted", "detail": "it is not", "method": "exact", "on": "everywhere", "samples": 3, "seed": 17,
        "error_bound": "2^-139", "residual": None, "expected": ["proved"], "seconds": 0.0123, "formulas": ["x^2"], "condition": None,
        "counterexample": {"point": [{"name": "J", "exact": "2", "enclosure": None}], "quantity": "the residual", "residual": ["-1.5", "-1.4"]},
        "of_a_later_version": {"bound": 7},
    }
    said = re.sub(r"<[^>]+>", " ", notebook.evidence(verdict))
    for words in (
        "Decided in exact arithmetic, everywhere.", "3 samples were looked at, drawn with the seed 17.", "at most 2^-139", "The model expects: proved.",
        "It took 0.012 s.", "x^2", "at J = 2: the residual lies between -1.5 and -1.4", "Of a later version: bound 7.",
    ):
        assert words in said, words


def test_pictures_are_of_the_motion_that_is_known(sleigh: System) -> None:
    motion = sleigh.simulate(t_end=1)
    for at in (1.5, -0.1, float("nan")):
        with pytest.raises(ValueError, match="at: the motion is known from t = 0 to 1"):
            motion.picture(at=at)
    for keywords in ({"ghosts": -1}, {"width": 0}, {"height": 10**9}):
        with pytest.raises(ValueError, match=f"{next(iter(keywords))}: a whole number from"):
            motion.picture(**keywords)  # type: ignore[arg-type, unused-ignore]
    for seconds in (-1, float("nan"), float("inf")):
        with pytest.raises(ValueError, match="seconds: a finite number"):
            motion.animate(seconds=seconds)
        with pytest.raises(ValueError, match="budget: a finite number"):
            sleigh.study(claims="energy.integral", budget=seconds)


def test_steady_motions_go_to_sympy_and_latex() -> None:
    """A bead on a hoop that turns: it rests at the bottom, at the top, and where cos θ = g/(l ω²)."""
    theta = sp.Function("theta")(sp.Symbol("t"))
    g, length, w = sp.symbols("g l omega", positive=True)
    T = length**2 * (theta.diff() ** 2 + w**2 * sp.sin(theta) ** 2) / 2
    hoop = System.from_sympy(T + g * length * sp.cos(theta), [theta])
    found = hoop.steady(symbolic=True)
    motions = found.to_sympy()
    places = {own["values"]["theta"] for own in motions.values()}
    assert places == {0, sp.pi, sp.acos(g / (length * w**2)), -sp.acos(g / (length * w**2))}
    for own in motions.values():
        assert own["values"]["theta'"] == 0 and own["equations"] == []
        is_tilted = own["values"]["theta"].has(sp.acos)
        # The cosine is at most one: what is not negative is a multiple of l² ω⁴ - g².
        assert len(own["not_negative"]) == (1 if is_tilted else 0)
        if is_tilted:
            assert sp.rem(own["not_negative"][0], length**2 * w**4 - g**2, g) == 0
    assert "\\theta &= \\pi" in found.to_latex() and "\\dot{\\theta} &= 0" in found.to_latex() and "&\\ge 0" in found.to_latex()
    # Parameters of a family are symbols, and a disc that rolls about in a circle satisfies what its equations say (Routh 1884).
    disc = System.from_gallery("falling-rolling-disc")
    values = disc.steady().to_sympy()["3"]["values"]
    assert {own.name for own in values["psi'"].free_symbols} == {"theta_0", "phi_rate_0"}
    numbers = {own: {"theta_0": 0.3, "phi_rate_0": 1.7}[own.name] for own in values["psi'"].free_symbols}
    state = {"theta": 0.3, "phi'": 1.7, "psi'": float(values["psi'"].subs(numbers))}
    f = disc.with_initial({own: value for own, value in state.items()} | {"theta'": 0, "phi": 0}).compile()
    rates = dict(zip(f.state, f.rhs(0.0, f.start)))
    assert [rates[own] for own in ("phi'", "theta'", "psi'")] == pytest.approx([0, 0, 0], abs=1e-9)


def test_numbers_without_a_formula_have_their_digits() -> None:
    quintic = System("quintic", coordinates=["q"], kinetic="1/2 q'^2", potential="1/6 q^6 - 1/2 q^2 - q")
    (motion,) = quintic.steady().to_sympy().values()
    root = motion["values"]["q"]
    assert list(motion["values"]) == ["q", "q'"]
    assert abs(root - sp.nsolve(sp.Symbol("q") ** 5 - sp.Symbol("q") - 1, 1.2, prec=30)) < 1e-17


def test_texts_are_shown_in_parts(sleigh: System) -> None:
    """What the library writes as a text is shown as headings, formulas and sentences, and nothing of it is lost."""
    doubtful = System("doubtful", coordinates=["x"], parameters={"m": 1, "k": 2}, kinetic="1/2 m x'^2")
    shown = {
        "check": (doubtful.check(), ["<b", "model.toml:9:1", "occurs nowhere", "<table"]),
        "no problems": (System("fine", coordinates=["x"], kinetic="1/2 x'^2").check(), ["There are no errors."]),
        "counts": (sleigh.derive(all=True, count=True), ["<table", "<th", "functions", ">17<", "newton-euler"]),
        "steps": (sleigh.steps(), ["<h4>1. The Lagrangian</h4>", "<code>Lstar = 1/2 m u^2 + 1/2 (J + m a^2) w^2</code>", "C_σ = Σ_i θ_i A^i_σ"]),
        "equal": (sleigh.compare("routh", "maggi"), ["<h4>Routh", "<code>phi&#x27;&#x27; = 0</code>", ">proved</b> equal"]),
        "other": (sleigh.compare("maggi", "vakonomic"), [">refuted</b> residual"]),
        "claim": (chetaev.explain("energy.integral"), ["<h4>The energy is a first integral</h4>", "Requires: model.accelerations-unique"]),
        "form": (chetaev.explain("maggi"), ["<h4>Maggi&#x27;s equations</h4>", ">Unknowns: rates"]),
        "all claims": (chetaev.explain(), ["<summary>model: ", "<code>model.chaplygin</code>"]),
    }
    for name, (result, words) in shown.items():
        page = result._repr_mimebundle_()["text/html"]
        ElementTree.fromstring(f"<div>{page}</div>")
        for word in words:
            assert word in page, (name, word)
        opened = re.sub(r"<details>.*</details>", "", page, flags=re.DOTALL)
        assert "<pre>" not in opened, name
        if name in ("steps", "equal", "other", "claim", "form"):
            plain = re.sub(r"\s|\[|\]", "", "".join(ElementTree.fromstring(f"<div>{page}</div>").itertext()))
            said = re.sub(r"\s|\[|\]", "", str(result))
            assert plain == said if name != "other" else plain == said.replace("refuted:", "refuted"), name
    assert sleigh.steps().to_latex() == sleigh.steps(notation="latex").to_latex() == str(sleigh.steps(notation="latex"))
    assert "<summary>the document</summary>" in sleigh.steps(notation="latex")._html()


def test_where_nothing_can_be_written_nothing_is_computed(sleigh: System, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("no folder")
    out = tmp_path / "file" / "below"
    began = time.perf_counter()
    for work in (
        lambda: sleigh.simulate(t_end=1e6, out=out),
        lambda: sleigh.study(t_end=1e6, out=out),
        lambda: sleigh.principles(compare=True, t_end=1e6, out=out),
        lambda: sleigh.sweep(vary={"a": "0.1:0.5:100"}, t_end=1e6, out=out),
        lambda: chetaev.ensemble(sleigh, parameters={"a": np.linspace(0.1, 0.5, 100)}, t_end=1e6, out=out),
    ):
        with pytest.raises(NotADirectoryError, match="file"):
            work()
    assert time.perf_counter() - began < 5


def falling() -> System:
    """x = 1 - t^2/2, which meets the ground at sqrt(2)."""
    return System(
        "falling", coordinates=["x"], kinetic="1/2 x'^2", potential="x", initial={"x": 1}, events={"ground": {"when": "x"}}, simulation={"t_end": 2},
    )


def test_motions_with_events_are_shown() -> None:
    motion = falling().simulate()
    (met,) = motion.events
    assert met["event"] == "ground" and met["zero"] == "falling"
    assert met["t"] == pytest.approx(2**0.5, rel=1e-9)
    page = motion._repr_mimebundle_()["text/html"]
    assert "1 events" in page and "ground" in page and "1.41421" in page


def test_linear_equations_of_a_family_go_to_sympy() -> None:
    disc = System.from_gallery("bodies/falling-rolling-disc")
    upright = next(own for own in disc.steady().motions if own["free"] == ["speed_1"])
    for linear in (disc.linearize(about=upright["name"]), disc.stability(about=upright["name"])):
        E, F = linear.to_sympy()
        (speed,) = E.free_symbols | F.free_symbols
        assert speed == sp.Symbol("speed_1", real=True)
        # A disc that rolls upright: A (A + m r^2) s^2 = A m g r - C (C + m r^2) (v/r)^2, with A = m r^2/4 and C = m r^2/2.
        m, r, g = 2.0, 0.3, 9.81
        A, C = m * r**2 / 4, m * r**2 / 2
        for v in (0.2, 2.0):
            squared = (A * m * g * r - C * (C + m * r**2) * (v / r) ** 2) / (A * (A + m * r**2))
            found = np.linalg.eigvals(np.array((E.inv() * F).subs(speed, v), dtype=float))
            np.testing.assert_allclose(sorted((found**2).real), sorted([0, 0, squared, squared]), atol=1e-8)


def test_files_that_were_asked_for_are_in_the_data(sleigh: System, command: Any, gallery: Path, tmp_path: Path) -> None:
    path = str(gallery / "chaplygin-sleigh" / "model.toml")

    def theirs(*arguments: str) -> Any:
        return command(*arguments, "--t-end", "1", "--out", str(tmp_path / "theirs"))

    out = tmp_path / "ours"
    motion = sleigh.simulate(t_end=1, out=out).to_dict()
    assert motion["files"] == theirs("simulate", path)["files"] == ["trajectory.csv", "trajectory.npz"]
    study = sleigh.study(claims="motion", t_end=1, out=out).to_dict()
    assert [own["name"] for own in study["files"]] == [own["name"] for own in theirs("study", path, "--claims", "motion")["files"]]
    for own in study["files"]:
        assert hashlib.sha256((out / own["name"]).read_bytes()).hexdigest() == own["sha256"]
    assert study["files"] == json.loads((out / "study.json").read_text())["files"]
    assert sleigh.sweep(vary={"a": [0.1]}, t_end=1, out=out).to_dict()["archive"] == str(out / "sweep.npz")
    assert theirs("sweep", path, "--vary", "a=0.1")["archive"] == str(tmp_path / "theirs" / "sweep.npz")
    principles = sleigh.principles(compare=True, t_end=1, out=out).to_dict()
    wanted = theirs("principles", path, "--compare")
    named = [own["name"] for own in principles["files"]]
    assert named == [own["name"] for own in wanted["files"]] == ["trajectory.csv", "trajectory.npz", "report.html"]
    for own in principles["files"]:
        assert hashlib.sha256((out / own["name"]).read_bytes()).hexdigest() == own["sha256"]
    # The record names the data of the motion a second time, and a page has the seconds that its claims took.
    for own in (principles, study):
        assert own["trajectory"]["files"] == wanted["trajectory"]["files"] == ["trajectory.csv", "trajectory.npz"]
    assert without(principles, "seconds", "sha256", "path") == without(wanted, "seconds", "sha256", "path")
    assert sleigh.simulate(t_end=1).to_dict()["files"] == []


def test_equations_are_results_one_by_one(sleigh: System) -> None:
    derived = sleigh.derive(["routh", "maggi"])
    whole = derived.to_sympy()
    for form in derived:
        assert form.to_sympy() == whole[form.name] and form.to_dict()["formulation"] == form.name
        for title, equations in form.groups.items():
            # Each is what stands at its place: no equation is missing, and none is another's.
            assert [own.to_sympy() for own in equations] == whole[form.name][title]
            for own in equations:
                assert own.to_latex() == own.latex and own.to_dict()["left"] == own.left
                assert set(own._repr_mimebundle_()) == {"text/plain", "text/html", "text/latex"}
        assert form._repr_mimebundle_()["text/latex"].startswith("$$\\begin{aligned}")
    # The constraint of the blade, up to a factor that is a number.
    blade = derived["routh"].groups["constraints"][0].to_sympy()
    t = sp.Symbol("t", real=True)
    x, y, phi = (sp.Function(name, real=True)(t) for name in ("x", "y", "phi"))
    ratio = (blade.lhs - blade.rhs) / (x.diff(t) * sp.sin(phi) - y.diff(t) * sp.cos(phi))
    assert sp.simplify(ratio).is_number
    again = pickle.loads(pickle.dumps(derived))
    assert again[0].equations[0].to_sympy() == derived[0].equations[0].to_sympy()


def test_formulas_of_verdicts_go_to_sympy_and_latex(sleigh: System) -> None:
    study = sleigh.study(claims=["energy.integral", "hamilton.stationary"], t_end=1)
    (energy,) = study.to_sympy()["energy.integral"]
    t = sp.Symbol("t", real=True)
    x, y, phi = (sp.Function(name, real=True)(t).diff(t) for name in ("x", "y", "phi"))
    angle = sp.Function("phi", real=True)(t)
    m, J, a = (sp.Symbol(name, real=True) for name in ("m", "J", "a"))
    kinetic = m * ((x - a * phi * sp.sin(angle)) ** 2 + (y + a * phi * sp.cos(angle)) ** 2) / 2 + J * phi**2 / 2
    assert sp.simplify(energy - kinetic) == 0
    assert study["energy.integral"].to_sympy() == [energy]
    # The multiplier of the extremum is a name that the model does not declare.
    (multiplier,) = study.to_sympy()["hamilton.stationary"]
    assert multiplier == sp.Eq(sp.Function("kappa_blade", real=True)(t), 0)
    shown = study.to_latex()
    assert "\\text{energy.integral: proved}" in shown and "\\dot{\\varphi}" in shown and shown.count("\\begin{aligned}") == 2
    assert study["energy.integral"].to_dict() == study.to_dict()["verdicts"][[own.claim for own in study].index("energy.integral")]
    assert study.verify().agrees


def test_comparisons_go_to_sympy_and_latex(sleigh: System) -> None:
    (same,) = sleigh.compare("routh", "maggi").to_sympy().values()
    assert same == {"x''": 0, "y''": 0, "phi''": 0}
    compared = sleigh.compare("maggi", "vakonomic")
    (other,) = compared.to_sympy().values()
    t = sp.Symbol("t", real=True)
    x, y, phi, kappa = (sp.Function(name, real=True)(t) for name in ("x", "y", "phi", "kappa_blade"))
    m, J, a = (sp.Symbol(name, real=True) for name in ("m", "J", "a"))
    # The extremum of L + kappa f with f = x' sin(phi) - y' cos(phi) turns by kappa ∂f/∂phi about its centre of mass, and slides by kappa'.
    turning = kappa * (x.diff(t) * sp.cos(phi) + y.diff(t) * sp.sin(phi)) / (J + m * a**2)
    assert sp.simplify((other["phi''"] / turning) ** 2) == 1
    assert "\\ddot{\\varphi} &=" in compared.to_latex()
    # Differences that share linear systems are written out, and contain no unknowns.
    board = System.from_gallery("bodies/snakeboard").compare("maggi", "voronets").to_sympy()
    for differences in board.values():
        names = {own.name for value in differences.values() for own in value.free_symbols}
        assert names <= {"t", "Jr", "Jw", "board_mass", "l"}


def test_whatever_stands_for_a_model_is_shown(sleigh: System) -> None:
    functional = chetaev.Functional.from_gallery("fields/plate")
    part, verdict = functional.derive()[0], sleigh.study(claims="model")["model.chaplygin"]
    for own in (sleigh, sleigh.compile(), functional, part, part.equations[0], verdict):
        bundle = own._repr_mimebundle_()
        assert bundle["text/plain"] == repr(own) and own._mime_() == ("text/html", bundle["text/html"])
    assert part.to_sympy() == functional.derive().to_sympy()[part.title]


def test_models_of_the_gallery_are_a_sequence() -> None:
    names = list(chetaev.gallery.list())
    assert chetaev.gallery.list()[:3] == names[:3] and chetaev.gallery.list()[-1] == names[-1]


def test_files_of_a_study_are_verified_with_it(tmp_path: Path) -> None:
    """As the command does with the record: what was changed since is told."""
    sleigh = System.from_gallery("chaplygin-sleigh")
    study = sleigh.study(claims="energy.integral", t_end=1, out=tmp_path)
    beside = chetaev.verify(tmp_path / "study.json").to_dict()
    assert study.verify().to_dict() == beside
    assert {own["claim"] for own in beside} == {"energy.integral", "report.html"}
    (tmp_path / "report.html").write_text("another")
    assert not study.verify().agrees
    assert len(sleigh.study(claims="energy.integral", t_end=1).verify().to_dict()) == 1
