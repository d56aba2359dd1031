"""Systems stated in SymPy have the accelerations that SymPy derives; expressions go there and back."""

from __future__ import annotations

import pickle
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
import sympy as sp
import sympy.physics.mechanics as me
from hypothesis import given, settings
from hypothesis import strategies as st

from chetaev import ModelError, ModelWarning, System
from chetaev.texts import of_sympy

t = me.dynamicsymbols._t
RNG = np.random.default_rng(11)


def accelerations(system: System, values: dict[str, float], y: np.ndarray) -> np.ndarray:
    """Of the coordinates, at a state (q, q')."""
    return system.compile(**values).rhs(0.0, y)[len(y) // 2 :]


def by_sympy(mass: Any, force: Any, values: dict[Any, float]) -> np.ndarray:
    """The solution of SymPy's own linear equations at a state, in numbers."""
    numbers = [sp.Matrix(own).subs(values).evalf() for own in (mass, force)]
    found = [np.array(own.tolist(), dtype=float) for own in numbers]
    return np.linalg.solve(found[0], found[1]).ravel()


def test_a_pendulum_by_its_lagrangian() -> None:
    th = me.dynamicsymbols("theta")
    g, ell = sp.symbols("g l")
    L = ell**2 * th.diff() ** 2 / 2 + g * ell * sp.cos(th)
    system = System.from_sympy(L, [th], parameters={g: 9.81, ell: Fraction(3, 2)}, initial={"theta": 0.3})
    assert system.coordinates == ["theta"]
    assert system.parameters == {"g": "981/100", "l": "3/2"}
    found = accelerations(system, {}, np.array([0.3, 0.2]))
    np.testing.assert_allclose(found, [-9.81 / 1.5 * np.sin(0.3)], rtol=1e-14)


def test_names_that_a_model_cannot_declare_are_changed() -> None:
    q = me.dynamicsymbols("q_{1}")
    lam, pi = sp.symbols("lambda pi")
    system = System.from_sympy(lam * q.diff() ** 2 / 2 - pi * q**2 / 2, [q], parameters={lam: 2, pi: 3})
    assert system.coordinates == ["q_1"]
    assert set(system.parameters) == {"x_lambda", "x_pi"}
    with pytest.raises(ValueError, match="neither a coordinate nor a parameter"):
        System.from_sympy(q.diff() ** 2 + me.dynamicsymbols("F"), [q])


def test_lagranges_method_with_a_rolling_constraint() -> None:
    # A disc that rolls along a line, an incline, with a torque against it.
    x, phi = me.dynamicsymbols("x phi")
    m, r, g, a, c = sp.symbols("m r g a c", positive=True)
    N = me.ReferenceFrame("N")
    A = N.orientnew("A", "axis", [phi, N.z])
    P = me.Point("P")
    P.set_vel(N, x.diff() * N.x)
    L = m * x.diff() ** 2 / 2 + m * r**2 * phi.diff() ** 2 / 4 + m * g * sp.sin(a) * x
    method = me.LagrangesMethod(
        L, [x, phi], forcelist=[(A, -c * phi.diff() * N.z)], frame=N, nonhol_coneqs=[x.diff() - r * phi.diff()]
    )
    method.form_lagranges_equations()
    numbers = {m: 2.0, r: 0.5, g: 9.81, a: 0.3, c: 0.7}
    system = System.from_sympy(method, parameters=numbers)
    state = np.array([0.1, 0.2, 0.6, 1.2])
    values = {own.diff(): value for own, value in zip((x, phi), state[2:], strict=True)} | {x: 0.1, phi: 0.2} | numbers
    expected = by_sympy(method.mass_matrix_full, method.forcing_full, values)[2:4]
    np.testing.assert_allclose(accelerations(system, {}, state), expected, rtol=1e-12)


def test_a_pendulum_by_kanes_method() -> None:
    q, u = me.dynamicsymbols("q u")
    m, ell, g = sp.symbols("m l g")
    N = me.ReferenceFrame("N")
    A = N.orientnew("A", "Axis", [q, N.z])
    A.set_ang_vel(N, u * N.z)
    O, P = me.Point("O"), me.Point("P")
    O.set_vel(N, 0)
    P.set_pos(O, ell * A.x)
    P.v2pt_theory(O, N, A)
    particle = me.Particle("pa", P, m)
    method = me.KanesMethod(N, q_ind=[q], u_ind=[u], kd_eqs=[q.diff() - u], bodies=[particle], forcelist=[(P, m * g * N.x)])
    method.kanes_equations()
    numbers = {m: 2.0, ell: 1.5, g: 9.81}
    system = System.from_sympy(method, parameters=numbers)
    expected = by_sympy(method.mass_matrix, method.forcing, {q: 0.3, u: 0.7, **numbers})
    np.testing.assert_allclose(accelerations(system, {}, np.array([0.3, 0.7])), expected, rtol=1e-13)


def test_a_particle_on_a_rotating_rod_with_a_velocity_constraint() -> None:
    # Appell's constraint z' = y x' by Kane's method with dependent speeds.
    x, y, z, u, v, w = me.dynamicsymbols("x y z u v w")
    m, g = sp.symbols("m g")
    N = me.ReferenceFrame("N")
    P = me.Point("P")
    P.set_vel(N, u * N.x + v * N.y + w * N.z)
    method = me.KanesMethod(
        N, q_ind=[x, y, z], u_ind=[u, v], u_dependent=[w], velocity_constraints=[w - y * u],
        kd_eqs=[x.diff() - u, y.diff() - v, z.diff() - w], bodies=[me.Particle("p", P, m)], forcelist=[(P, -m * g * N.z)],
    )
    method.kanes_equations()
    numbers = {m: 1.7, g: 9.81}
    system = System.from_sympy(method, parameters=numbers)
    state = np.array([0.2, 0.4, -0.1, 0.8, 1.1, 0.32])
    values = dict(zip((x, y, z, u, v, w), state, strict=True)) | numbers
    expected = by_sympy(method.mass_matrix, method.forcing, values)
    np.testing.assert_allclose(accelerations(system, {}, state), expected, rtol=1e-12)


names = st.sampled_from(["x", "y", "x'", "y'", "a", "b", "t"])
numbers = st.one_of(
    st.integers(-50, 50).map(str), st.fractions(max_denominator=99).map(lambda own: f"({own.numerator}/{own.denominator})")
)


def grown(inner: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    two = st.tuples(inner, inner)
    return st.one_of(
        two.map(lambda own: f"({own[0]} + {own[1]})"),
        two.map(lambda own: f"({own[0]}) * ({own[1]})"),
        inner.map(lambda own: f"(1 + ({own})^2)^(-1)"),
        inner.map(lambda own: f"sin({own})"),
        inner.map(lambda own: f"exp(cos({own}))"),
        inner.map(lambda own: f"sqrt(2 + sin({own}))"),
        inner.map(lambda own: f"abs({own})"),
        st.tuples(inner, st.integers(1, 3)).map(lambda own: f"({own[0]})^{own[1]}"),
    )


SYSTEM = System("any", coordinates=["x", "y"], parameters={"a": 1, "b": {}}, kinetic="1/2 (x'^2 + y'^2)")


@settings(max_examples=60, deadline=None)
@given(st.recursive(st.one_of(names, numbers), grown, max_leaves=8))
def test_expressions_go_to_sympy_and_back(text: str) -> None:
    there = SYSTEM.sympify(text)
    # What comes back is the same expression of the graph, so that it is written the same.
    back = SYSTEM.sympify(of_sympy(there))
    if there != back:
        point = {own: value for own, value in zip(sorted(there.atoms(sp.Function, sp.Symbol, sp.Derivative), key=str), RNG.uniform(0.1, 1, 50), strict=False)}
        difference = (there - back).xreplace(point)
        assert abs(complex(difference.evalf())) < 1e-9


def test_bodies_that_turn_by_no_orientation_are_refused() -> None:
    # Three speeds about the axes of a body are no rates of angles: Lagrange's operator knows nothing of them.
    q, u1, u2, u3 = me.dynamicsymbols("q u1 u2 u3")
    m, i1, i2, i3 = sp.symbols("m i1 i2 i3")
    N, B = me.ReferenceFrame("N"), me.ReferenceFrame("B")
    B.orient_axis(N, N.z, q)
    B.set_ang_vel(N, u1 * B.x + u2 * B.y + u3 * B.z)
    C = me.Point("C")
    C.set_vel(N, 0)
    body = me.RigidBody("top", C, B, m, (me.inertia(B, i1, i2, i3), C))
    method = me.KanesMethod(N, [q], [u1, u2, u3], kd_eqs=[q.diff() - u3])
    method.kanes_equations([body])
    with pytest.raises(ValueError, match="angular velocity of top belongs to no orientation"):
        System.from_sympy(method)


def test_a_wheel_with_the_rolling_in_its_angular_velocity() -> None:
    # A coin upright on a plane: x, y are places of its own, and so is the angle rolled. The heading keeps its rate, and so does the speed.
    h, u, w = me.dynamicsymbols("h u w")
    m, r = sp.symbols("m r", positive=True)
    N = me.ReferenceFrame("N")
    A = N.orientnew("A", "axis", [h, N.z])
    W = me.ReferenceFrame("W")
    A.set_ang_vel(N, w * N.z)
    W.set_ang_vel(N, w * A.z + u / r * A.y)
    C = me.Point("C")
    C.set_vel(N, u * A.x)
    coin = me.RigidBody("coin", C, W, m, (me.inertia(A, m * r**2 / 4, m * r**2 / 2, m * r**2 / 4), C))
    method = me.KanesMethod(N, [h], [w, u], kd_eqs=[h.diff() - w])
    method.kanes_equations([coin], [(W, sp.Symbol("c") * A.y)])
    system = System.from_sympy(method, derived=True)
    assert {"coin_x", "coin_y"} < set(system.coordinates)
    assert system.study(claims="equations.stated")["equations.stated#sympy"].verdict == "proved"
    f = system.with_values(m=2, r=0.5, c=0.3).compile()
    state = dict.fromkeys(f.state, 0.0) | {"h'": 1.5}
    names = list(state)
    # 3/2 m r² times the angular acceleration is the torque; the speed is r times the rate.
    found = dict(zip(names, f.rhs(0.0, np.array(list(state.values())))[len(names) // 2 :]))
    speed = next(own for own in names if own.startswith("u_path"))
    np.testing.assert_allclose(found[speed], 0.3 / (1.5 * 2 * 0.5), rtol=1e-12)


def test_what_comes_back_is_the_users_own() -> None:
    x = me.dynamicsymbols("x")
    m, k = sp.symbols("m k")
    system = System.from_sympy(m * x.diff() ** 2 / 2 - k * x**2 / 2, [x], parameters=[m, k], initial={x: 1, x.diff(t): sp.Rational(1, 3)})
    assert system.initial == {"x": "1", "x'": "1/3"}
    (equation,) = system.derive("routh").to_sympy()["routh"]["equations of motion"]
    assert sp.expand(equation.lhs - equation.rhs - m * x.diff(t, 2) - k * x) == 0
    assert system.sympify("m x'") == m * x.diff(t) == pickle.loads(pickle.dumps(system)).with_values(m=2).sympify("m x'")
    # A time of another name is a time too.
    s = sp.Symbol("s")
    y = sp.Function("y")(s)
    (equation,) = System.from_sympy(y.diff(s) ** 2 / 2 + s * y, [y]).derive("routh").to_sympy()["routh"]["equations of motion"]
    assert sp.expand(equation.lhs - equation.rhs - y.diff(s, 2) + s) == 0


def test_controls_are_stated_by_functions_or_names() -> None:
    x, f = me.dynamicsymbols("x f")
    for controls in ({"f": {}}, {f: {}}, [f]):
        system = System.from_sympy(x.diff() ** 2 / 2 + f * x, [x], controls=controls)
        assert "f = {" in system.text
    assert "sin(t)" in System.from_sympy(x.diff() ** 2 / 2 + f * x, [x], controls={f: sp.sin(t)}).text


def test_a_law_of_one_control_leaves_the_others() -> None:
    q, u, F, G = me.dynamicsymbols("q u F G")
    frame, place = me.ReferenceFrame("N"), me.Point("P")
    place.set_vel(frame, u * frame.x)
    method = me.KanesMethod(frame, [q], [u], [q.diff() - u])
    method.kanes_equations([me.Particle("p", place, 2)], [(place, (F + G) * frame.x)])
    for controls in ({F: sp.sin(t)}, {"F": "sin(t)"}):
        system = System.from_sympy(method, controls=controls)
        assert "G = {" in system.text and "sin(t)" in system.text
    assert "G = {" in System.from_sympy(method, controls=["F"]).text


@pytest.mark.parametrize(
    ("keywords", "said"),
    [
        ({"forces": {"y": 1}}, "no coordinate; there are"),
        ({"parameters": {"mm": 1}}, "no symbol"),
        ({"derived": True}, "a Lagrangian has derived no equations"),
    ],
)
def test_what_does_not_fit_is_refused(keywords: dict[str, Any], said: str) -> None:
    x, m = me.dynamicsymbols("x"), sp.Symbol("m")
    with pytest.raises((TypeError, ValueError), match=said):
        System.from_sympy(m * x.diff() ** 2 / 2, [x], **keywords)


def test_symbols_of_one_name_are_refused() -> None:
    x, m = me.dynamicsymbols("x"), sp.Symbol("m")
    for other in (sp.Symbol("m", positive=True), sp.Symbol("t", real=True)):
        with pytest.raises(ValueError, match="two symbols of the name"):
            System.from_sympy(m * x.diff() ** 2 / 2 - other * x, [x])
    with pytest.warns(UserWarning, match="x is called `x_2`"):
        assert System.from_sympy(m * x.diff() ** 2 / 2 - sp.Symbol("x") * x, [x]).coordinates == ["x"]


def test_objects_state_their_own() -> None:
    x, m = me.dynamicsymbols("x"), sp.Symbol("m")
    method = me.LagrangesMethod(m * x.diff() ** 2 / 2, [x])
    for keywords in ({"forces": {x: 1}}, {"constraints": [x]}, {"coordinates": [x]}):
        with pytest.raises(TypeError):
            System.from_sympy(method, **keywords)
    with pytest.raises(ValueError, match="kanes_equations"):
        u = me.dynamicsymbols("u")
        System.from_sympy(me.KanesMethod(me.ReferenceFrame("N"), [x], [u], [x.diff() - u]))


def test_velocity_constraints_of_a_system_are_taken() -> None:
    q1, q2, u1, u2 = me.dynamicsymbols("q1 q2 u1 u2")
    frame, origin = me.ReferenceFrame("N"), me.Point("O")
    origin.set_vel(frame, 0)
    system = me.System(frame=frame, fixed_point=origin)
    system.add_bodies(me.Particle("p", origin.locatenew("P", q1 * frame.x + q2 * frame.y), sp.Symbol("m")))
    system.add_coordinates(q1, q2)
    system.add_speeds(u1, u2, independent=[True, False])
    system.add_kdes(q1.diff() - u1, q2.diff() - u2)
    system.velocity_constraints = [u2 - q1 * u1]
    assert System.from_sympy(system).constraints == ["velocity_1"]


def test_speeds_of_a_lagrangian_are_put_in() -> None:
    g = sp.Symbol("g")
    wall, bob = me.RigidBody("wall"), me.RigidBody("bob")
    system = me.System.from_newtonian(wall)
    system.add_joints(me.PinJoint("pin", wall, bob, joint_axis=wall.z, child_point=-1 * bob.x))
    system.apply_uniform_gravity(g * wall.x)
    system.form_eoms(eom_method=me.LagrangesMethod)
    with pytest.warns(UserWarning, match="0 = 0"):
        found = System.from_sympy(system, derived=True)
    # A pendulum of length 1: gravity is in it, and no control is.
    numbers = {"bob_izz": 1, "bob_mass": 2, "g": 3}
    np.testing.assert_allclose(accelerations(found, numbers, np.array([0.3, 0.0])), -2 * 3 * np.sin(0.3) / (1 + 2), rtol=1e-13)


def test_functions_that_a_model_does_not_have_are_written_by_others() -> None:
    x = sp.Symbol("x", positive=True)
    for function in (sp.sech, sp.csch, sp.coth, sp.acot, sp.asec, sp.acsc, sp.asech, sp.acsch, sp.acoth):
        at = 0.4 if function is sp.asech else 1.7
        written = sp.sympify(of_sympy(function(x)))
        assert complex(written.subs(sp.Symbol("x"), at)) == pytest.approx(complex(function(at)), rel=1e-14)
    y = me.dynamicsymbols("y")
    assert of_sympy(sp.Derivative(y**3, t)).replace(" ", "") == "3*y**2*y'"
    assert float(sp.sympify(of_sympy(sp.GoldenRatio))) == pytest.approx((1 + 5**0.5) / 2)
    assert sp.Rational(of_sympy(sp.Float("1e-400"))) > 0
    with pytest.raises(ValueError, match="EulerGamma"):
        of_sympy(sp.EulerGamma)


def sprung() -> Any:
    """A particle on a line, with the energy of a spring stated of it."""
    q, u = me.dynamicsymbols("q u")
    m, k = sp.symbols("m k", positive=True)
    frame, origin = me.ReferenceFrame("N"), me.Point("O")
    origin.set_vel(frame, 0)
    place = origin.locatenew("P", q * frame.x)
    place.set_vel(frame, u * frame.x)
    particle = me.Particle("bob", place, m)
    particle.potential_energy = k * q**2 / 2
    system = me.System(frame=frame, fixed_point=origin)
    system.add_bodies(particle)
    system.add_coordinates(q)
    system.add_speeds(u)
    system.add_kdes(q.diff() - u)
    return system


def test_potential_energies_of_bodies_are_in_it_or_said_to_be_left_out() -> None:
    # Lagrange's method of SymPy reads them, Kane's does not.
    system = sprung()
    system.form_eoms(eom_method=me.LagrangesMethod)
    np.testing.assert_allclose(accelerations(System.from_sympy(system), {"m": 2, "k": 3}, np.array([0.4, 0.0])), [-3 * 0.4 / 2], rtol=1e-14)
    system = sprung()
    for _ in range(2):
        with pytest.warns(UserWarning, match="the potential energy of bob is left out"):
            assert "k" not in System.from_sympy(system).parameters
        system.form_eoms()
    with pytest.warns(UserWarning, match="the potential energy of bob is left out"):
        System.from_sympy(system.eom_method)


def test_signs_that_sympy_was_told_are_assumptions() -> None:
    x = me.dynamicsymbols("x")
    m, k = sp.Symbol("m", positive=True), sp.Symbol("k", nonnegative=True)
    # SymPy writes c for the root of c^2 only because it is positive.
    L = sp.sqrt(m**2) * x.diff() ** 2 / 2 - k * x**2 / 2
    system = System.from_sympy(L, [x], parameters={m: 2, k: 0}, assumptions=["k < 5"])
    assert 'assumptions = ["k >= 0", "m > 0", "k < 5"]' in system.text
    assert system.study(claims="model.hessian-regular")["model.hessian-regular"].verdict == "proved"
    with pytest.raises(ValueError, match="assumption `m > 0` does not hold"):
        System.from_sympy(L, [x], parameters={m: -2})


@pytest.mark.parametrize(
    ("keywords", "said"),
    [
        ({"lagrangian": "Derivative(x(t), t)**2/2"}, "the Lagrangian: an expression of SymPy is needed"),
        ({"forces": {"x": "-x"}}, "the force on x: an expression of SymPy is needed"),
        ({"constraints": ["x - y"]}, "constraint_1: an expression of SymPy is needed"),
        ({"constraints": [sp.true]}, "constraint_1: an equation or an expression that vanishes is needed"),
        ({"constraints": {"wall": me.dynamicsymbols("x") > 0}}, "wall: an equation or an expression that vanishes is needed"),
        ({"forces": [1]}, "a mapping from coordinates to expressions is needed, not list"),
        ({"forces": {"x": 1, me.dynamicsymbols("x"): 2}}, "forces: x\\(t\\) is named twice"),
        ({"coordinates": me.dynamicsymbols("x x")}, "coordinates: x\\(t\\) is named twice"),
    ],
)
def test_texts_and_what_is_no_equation_are_refused(keywords: dict[str, Any], said: str) -> None:
    x = me.dynamicsymbols("x")
    with pytest.raises((TypeError, ValueError), match=said):
        System.from_sympy(**{"lagrangian": x.diff() ** 2 / 2, "coordinates": [x], **keywords})


def test_one_constraint_needs_no_list() -> None:
    x, y = me.dynamicsymbols("x y")
    L = (x.diff() ** 2 + y.diff() ** 2) / 2
    for own in (y.diff() - x * x.diff(), sp.Eq(y.diff(), x * x.diff())):
        assert System.from_sympy(L, [x, y], constraints=own).constraints == ["constraint_1"]


def test_equations_that_were_not_formed_are_asked_for() -> None:
    x = me.dynamicsymbols("x")
    with pytest.raises(ValueError, match="form_lagranges_equations"):
        System.from_sympy(me.LagrangesMethod(x.diff() ** 2 / 2, [x]), derived=True)


@pytest.mark.parametrize("seed", range(4))
def test_a_random_system_has_the_accelerations_and_multipliers_that_sympy_solves_for(seed: int) -> None:
    draw = np.random.default_rng(seed)
    q = me.dynamicsymbols("q1:4")
    v = [own.diff() for own in q]
    a = [sp.Rational(int(own), 7) for own in draw.integers(-9, 9, 12)]
    mass = 3 * sp.eye(3) + sp.Matrix(3, 3, lambda i, j: a[(i + j) % 12] * sp.sin(q[i] + q[j]) / 6)
    kinetic = (sp.Matrix(v).T * mass * sp.Matrix(v))[0] / 2
    L = kinetic - a[3] * sp.cos(q[0]) - a[4] * q[1] ** 2 * q[2] / 3 + a[5] * v[0] * q[1] * sp.cos(t)
    constraint = v[2] - a[6] * q[0] * v[1] - a[7] * sp.sin(q[1]) * v[0] - a[8] / 3
    method = me.LagrangesMethod(L, list(q), nonhol_coneqs=[constraint])
    method.form_lagranges_equations()
    state = draw.uniform(-1, 1, 6)
    places, rates = dict(zip(q, state[:3])), dict(zip(v[:2], state[3:5]))
    state[5] = float((v[2] - constraint).subs(rates).subs(places))
    rates[v[2]] = state[5]
    full = [own.subs(rates).subs(places).subs(t, 0.3).evalf() for own in (method.mass_matrix_full, method.forcing_full)]
    expected = np.linalg.solve(*(np.array(own.tolist(), dtype=float) for own in full)).ravel()
    f = System.from_sympy(method).compile()
    np.testing.assert_allclose(f.rhs(0.3, state), expected[:6], atol=1e-13)
    np.testing.assert_allclose(f.reactions(0.3, state), expected[6:], atol=1e-13)


X = me.dynamicsymbols("x")


@pytest.mark.parametrize(
    "own",
    [
        sp.gamma(X), sp.zeta(X), sp.li(X), sp.re(X), sp.arg(X), sp.conjugate(X), sp.sinc(X), sp.erf(X), sp.Max(X, 2), sp.LambertW(X), sp.Chi(X),
        sp.beta(X, 2), sp.floor(X), sp.Mod(X, 2), sp.Heaviside(X), sp.besselj(0, X), sp.factorial(X),
    ],
    ids=lambda own: own.func.__name__,
)
def test_functions_that_a_model_does_not_have_are_no_products(own: Any) -> None:
    """A parameter that is called as the function would make a product of `gamma(x)`."""
    name = own.func.__name__
    g = sp.Symbol(name)
    for potential in (g * X**2 / 2 + own, g * X**2 / 2 + sp.sin(own) / 3):
        with pytest.raises(ModelError, match=f"{name}.*has no place in a model, whose functions are"):
            System.from_sympy(X.diff() ** 2 / 2 - potential, [X], parameters={g: 3})
    with pytest.raises(ModelError, match="put its digits in, as `.evalf"):
        System("s", coordinates=["x"], parameters={"gamma": 2, "k": sp.gamma(sp.Rational(1, 3))}, kinetic="1/2 x'^2", potential="1/2 k x^2")


def test_a_coordinate_may_be_called_as_a_function_of_sympy() -> None:
    gamma, k = me.dynamicsymbols("gamma"), sp.Symbol("zeta")
    f = System.from_sympy(gamma.diff() ** 2 / 2 - k * gamma**2 / 2, [gamma], parameters={k: 4}).compile()
    np.testing.assert_array_equal(f.rhs(0.0, [0.5, 1.0]), [1.0, -2.0])


def test_constraints_on_positions_of_lagranges_method_stay_on_positions() -> None:
    # A pendulum of length a in x and y: from rest at the height 0 its speed at the height y is sqrt(-2 g y).
    x, y = me.dynamicsymbols("x y")
    m, g, a = sp.symbols("m g a")
    L = m * (x.diff() ** 2 + y.diff() ** 2) / 2 - m * g * y
    rod = x**2 + y**2 - a**2
    method = me.LagrangesMethod(L, [x, y], hol_coneqs=[rod], nonhol_coneqs=[])
    method.form_lagranges_equations()
    values: dict[Any, Any] = {m: 1, g: 10, a: 2}
    system = System.from_sympy(method, parameters=values, initial={x: 2}, derived=True, simulation={"tolerance": 1e-12})
    assert system.constraints == ["position_1"]
    motion = system.simulate(t_end=1)
    np.testing.assert_allclose(motion["x"] ** 2 + motion["y"] ** 2, 4, atol=1e-9)
    np.testing.assert_allclose(motion["x'"] ** 2 + motion["y'"] ** 2, -20 * motion["y"], atol=1e-8)
    assert system.study(claims="equations.stated")["equations.stated#sympy"].verdict == "proved"
    with pytest.raises(ModelError):
        # No state of such a length is at x = 3.
        System.from_sympy(method, parameters=values, initial={x: 3}).simulate(t_end=1)


def test_a_system_by_lagranges_method_keeps_its_constraints_on_positions() -> None:
    x, y = me.dynamicsymbols("x y")
    a = sp.Symbol("a")
    frame, origin = me.ReferenceFrame("N"), me.Point("O")
    place = origin.locatenew("P", x * frame.x + y * frame.y)
    origin.set_vel(frame, 0)
    place.set_vel(frame, x.diff() * frame.x + y.diff() * frame.y)
    whole = me.System(frame, origin)
    whole.add_bodies(me.Particle("bob", place, 1))
    whole.add_coordinates(x, y)
    u, v = me.dynamicsymbols("u v")
    whole.add_speeds(u, v)
    whole.add_kdes(x.diff() - u, y.diff() - v)
    whole.add_holonomic_constraints(x**2 + y**2 - a**2)
    whole.form_eoms(me.LagrangesMethod)
    for derived in (False, True):
        system = System.from_sympy(whole, parameters={a: 1}, derived=derived, initial={x: 0.6, x.diff(): 0.8})
        assert system.constraints == ["position_1"]
        # x = 0.6 is on the circle with y = 0.8 or -0.8, and y' is such that the velocity is along it.
        start = system.compile().start
        np.testing.assert_allclose(start[0] ** 2 + start[1] ** 2, 1, atol=1e-12)
        np.testing.assert_allclose(start[0] * start[2] + start[1] * start[3], 0, atol=1e-12)


def test_a_statement_goes_on_in_its_own_symbols() -> None:
    # A coordinate and a parameter of one name: the parameter is called otherwise in the model.
    x, y = me.dynamicsymbols("x y")
    s, k = sp.symbols("x k")
    with pytest.warns(ModelWarning, match="x is called `x_2`"):
        system = System.from_sympy(x.diff() ** 2 / 2 + y.diff() ** 2 / 2 - k * x**2 / 2 - s * y**2 / 2, [x, y], parameters={s: 5, k: 1}, initial={x: 7})
    assert system.with_initial({y: s}).compile().start[1] == 5
    assert system.simulate(initial={y: 2 * s, x.diff(): 3}, t_end=1)["y"][0] == 10
    assert system.with_values(k=2 * s).compile().rhs(0.0, [1.0, 0.0, 0.0, 0.0])[2] == -10
    assert system.compile(k=s + 1).parameters == {"x_2": 5.0}
    la = sp.Symbol("lambda")
    with pytest.warns(ModelWarning):
        system = System.from_sympy(x.diff() ** 2 / 2 - la * x**2 / 2 - k * x, [x], parameters={la: 2, k: 1})
    assert system.with_values(**{"lambda": 3}).parameters["x_lambda"] == system.with_values(x_lambda=3).parameters["x_lambda"] == "3"
    assert system.with_values(k=la * 2).compile().rhs(0.0, [0.0, 0.0])[1] == -4


@pytest.mark.parametrize("name", ["None", "True", "False"])
def test_names_of_constants_of_python_are_names(name: str) -> None:
    q, k = me.dynamicsymbols(name), sp.Symbol("k")
    with pytest.warns(ModelWarning, match=f"called `x_{name}`"):
        system = System.from_sympy(q.diff() ** 2 / 2 - k * q**2 / 2, [q], parameters={k: 2})
    (equation,) = system.derive("routh").to_sympy()["routh"]["equations of motion"]
    assert equation == sp.Eq(q.diff(t, 2) + k * q, 0)
    assert list(system.to_opty().states)[0] == q


@pytest.mark.parametrize("own", [None, [1], sp.Matrix([X]), X > 0, object()])
def test_a_lagrangian_is_an_expression(own: Any) -> None:
    with pytest.raises(TypeError, match="the Lagrangian: an expression of SymPy is needed, not "):
        System.from_sympy(own, [X])


def test_one_coordinate_and_one_equation_need_no_list() -> None:
    assert System.from_sympy(X.diff() ** 2 / 2, X).coordinates == ["x"]
    y = me.dynamicsymbols("y")
    system = System("s", coordinates=["x", "y"], kinetic=(X.diff() ** 2 + y.diff() ** 2) / 2, constraints=sp.Eq(X.diff(), y))
    # x' = y: x'' = y' along each motion.
    rates = system.compile().rhs(0.0, [1.0, 2.0, 2.0, 3.0])
    assert system.constraints == ["constraint_1"] and rates[2] == pytest.approx(3.0)
