"""What the pages of SymPy's documentation on mechanics derive, stated anew: are these the equations of the motion?

The pages are prose, and are not installed with SymPy. Their bicycle, four-bar linkage, rolling discs and pendulum in two coordinates are systems of
SymPy's tests too (`test_sympy_examples.py`); the others are here. The verdict is a proof for all states and parameters (`equations.stated`).
"""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from chetaev import System

sp = pytest.importorskip("sympy")
me = pytest.importorskip("sympy.physics.mechanics")
bm = pytest.importorskip("sympy.physics.biomechanics")

N = me.ReferenceFrame("N")


def origin() -> Any:
    found = me.Point("O")
    found.set_vel(N, 0)
    return found


def lagrange(bodies: list[Any], coordinates: list[Any], **keywords: Any) -> Any:
    found = me.LagrangesMethod(me.Lagrangian(N, *bodies), coordinates, bodies=bodies, frame=N, **keywords)
    found.form_lagranges_equations()
    return found


def kane(bodies: list[Any], coordinates: list[Any], speeds: list[Any], loads: list[Any], **keywords: Any) -> Any:
    rates = [q.diff() - u for q, u in zip(coordinates, speeds, strict=True)]
    found = me.KanesMethod(N, coordinates, speeds, rates, **keywords)
    found.kanes_equations(bodies, loads)
    return found


def atwoods_machine() -> Any:
    """Two masses on a string over a pulley without mass."""
    q, u = me.dynamicsymbols("q u")
    m1, m2, g, r = sp.symbols("m1 m2 g r", positive=True)
    O = origin()
    bodies, loads = [], []
    for m, side in ((m1, 1), (m2, -1)):
        P = O.locatenew(f"P{m}", side * (r * N.y - q * N.z))
        P.set_vel(N, -side * u * N.z)
        bodies.append(me.Particle(f"b{m}", P, m))
        loads.append((P, -m * g * N.z))
    return kane(bodies, [q], [u], loads)


def block_with_two_pendulums() -> Any:
    """A block on a spring and a damper, a rod that hangs from it with a torque, a particle that hangs from the rod by a torsion spring."""
    q, u = sp.Matrix(me.dynamicsymbols("q1:4")), sp.Matrix(me.dynamicsymbols("u1:4"))
    F, T = me.dynamicsymbols("F T")
    l, k, c, g, kT, ma, mb, mc, I = sp.symbols("l k c g kT ma mb mc I")
    wall, rod = me.RigidBody("wall", frame=N), me.RigidBody("rod", mass=mb)
    rod.central_inertia = me.inertia(rod.frame, 0, 0, I)
    block, bob = me.Particle("block", mass=ma), me.Particle("bob", mass=mc)
    of_block, of_bob = me.ReferenceFrame("of_block"), me.ReferenceFrame("of_bob")
    block.masscenter.set_vel(of_block, 0)
    bob.masscenter.set_vel(of_bob, 0)
    system = me.System.from_newtonian(wall)
    system.add_joints(
        me.PrismaticJoint("slide", wall, block, q[0], u[0], child_interframe=of_block),
        me.PinJoint("upper", block, rod, q[1], u[1], joint_axis=N.z, child_point=2 * l / 3 * rod.y, parent_interframe=of_block),
        me.PinJoint(
            "lower", rod, bob, q[2], u[2], joint_axis=rod.z, parent_point=-l / 3 * rod.y, child_point=l * of_bob.y, child_interframe=of_bob
        ),
    )
    system.apply_uniform_gravity(-g * N.y)
    system.add_loads(me.Force(block, F * N.x))
    path = me.LinearPathway(wall.masscenter, block.masscenter)
    system.add_actuators(
        me.LinearSpring(k, path), me.LinearDamper(c, path), me.TorqueActuator(T, N.z, rod, wall), me.TorqueActuator(kT * q[2], N.z, rod, of_bob)
    )
    system.form_eoms(explicit_kinematics=True)
    return system.eom_method


def pendulum_below_a_duffing_spring() -> Any:
    """A block on a spring with a cubic part and a damper, with a pendulum."""
    y, th = me.dynamicsymbols("y theta")
    M, m, l, k1, k2, c, g, I, J = sp.symbols("M m l k1 k2 c g I J")
    B = N.orientnew("B", "axis", (th, N.z))
    O = origin()
    upper = O.locatenew("upper", y * N.y)
    upper.set_vel(N, y.diff() * N.y)
    lower = upper.locatenew("lower", l * B.y)
    lower.v2pt_theory(upper, N, B)
    bodies = [
        me.RigidBody("block", upper, N, M, (me.inertia(N, I, I, I), upper)),
        me.RigidBody("bob", lower, B, m, (me.inertia(B, J, 0, J), lower)),
    ]
    path = me.LinearPathway(O, upper)
    loads = me.DuffingSpring(k1, k2, path, 0).to_loads() + me.LinearDamper(c, path).to_loads()
    return lagrange(bodies, [y, th], forcelist=loads + [me.Force(own, own.mass * g * N.y) for own in bodies])


def particle_on_a_sphere_between_elastic_bands() -> Any:
    """A particle on a sphere that two bands pull, the energy a function of their length, with an arc of a great circle in it."""
    th, phi = me.dynamicsymbols("theta phi")
    R, m, k, rest = sp.symbols("R m k L0", positive=True)
    a, b = sp.symbols("a1:4"), sp.symbols("b1:4")
    O = origin()
    P = O.locatenew("P", R * (sp.sin(th) * sp.cos(phi) * N.x + sp.sin(th) * sp.sin(phi) * N.y + sp.cos(th) * N.z))
    P.set_vel(N, P.pos_from(O).dt(N))
    ends = [O.locatenew(name, sum((own * axis for own, axis in zip(at, N, strict=True)), 0 * N.x)) for name, at in (("A", a), ("B", b))]
    # The arc between the radii to both ends, whose points SymPy's WrappingSphere does not find on the sphere.
    arc = R * sp.acos(ends[0].pos_from(O).normalize().dot(ends[1].pos_from(O).normalize()))
    length = arc + sum(P.pos_from(end).magnitude() for end in ends)
    particle = me.Particle("p", P, m)
    particle.potential_energy = k * (length - rest) ** 2 / 2
    return lagrange([particle], [th, phi])


def mass_on_a_muscle() -> Any:
    """A mass that hangs on a muscle, whose forces are De Groote's functions of the length and its rate."""
    q, u = me.dynamicsymbols("q u", real=True)
    m, g = sp.symbols("m g", positive=True)
    O = origin()
    P = O.locatenew("P", q * N.x)
    P.set_vel(N, u * N.x)
    muscle = bm.MusculotendonDeGroote2016(
        "muscle", me.LinearPathway(O, P), bm.FirstOrderActivationDeGroote2016.with_defaults("muscle"),
        tendon_slack_length=sp.Symbol("slack"), peak_isometric_force=sp.Symbol("peak"), optimal_fiber_length=sp.Symbol("fiber"),
        maximal_fiber_velocity=10, optimal_pennation_angle=0, fiber_damping_coefficient=sp.Rational(1, 10),
    )
    return kane([me.Particle("mass", P, m)], [q], [u], [*muscle.to_loads(), me.Force(P, m * g * N.x)])


def arm_on_a_lever() -> Any:
    """An arm of two links whose hand holds a lever that turns against a spring: three equations close the loop, and three of four speeds depend."""
    q, u = me.dynamicsymbols("q1:5"), me.dynamicsymbols("u1:5")
    dx, dy, dz, lA, lC, lD, mA, mC, mD, g, k, c, pull = sp.symbols("dx dy dz lA lC lD mA mC mD g k c pull")
    A, B, C, D = (me.ReferenceFrame(name) for name in "ABCD")
    A.orient_axis(N, q[0], N.z)
    B.orient_axis(N, q[1], N.y)
    C.orient_axis(B, q[2], B.z)
    D.orient_axis(C, q[3], C.y)
    for own, parent, rate in ((A, N, u[0] * N.z), (B, N, u[1] * N.y), (C, B, u[2] * B.z), (D, C, u[3] * C.y)):
        own.set_ang_vel(parent, rate)
    O = origin()
    axle, shoulder = O.locatenew("axle", dx * N.x), O.locatenew("shoulder", dy * N.y + dz * N.z)
    axle.set_vel(N, 0)
    shoulder.set_vel(N, 0)
    grip = axle.locatenew("grip", lA * A.y)
    upper, elbow = shoulder.locatenew("upper", lC / 2 * C.z), shoulder.locatenew("elbow", lC * C.z)
    lower, hand = elbow.locatenew("lower", lD / 2 * D.z), elbow.locatenew("hand", lD * D.z)
    for point, before, frame in ((grip, axle, A), (upper, shoulder, C), (elbow, shoulder, C), (lower, elbow, D), (hand, elbow, D)):
        point.v2pt_theory(before, N, frame)
    bodies = [
        me.RigidBody("lever", axle, A, mA, (me.inertia(A, mA * lA**2 / 12, mA * lA**2 / 2, mA * lA**2 / 12), axle)),
        me.RigidBody("upper_arm", upper, C, mC, (me.inertia(C, mC * lC**2 / 12, mC * lC**2 / 12, mC * lC**2 / 2), upper)),
        me.RigidBody("lower_arm", lower, D, mD, (me.inertia(D, mD * lD**2 / 12, mD * lD**2 / 12, mD * lD**2 / 2), lower)),
    ]
    biceps = me.ForceActuator(pull, me.LinearPathway(upper, lower))
    loads = [me.Force(upper, mC * g * N.z), me.Force(lower, mD * g * N.z), me.Torque(A, (-k * q[0] - c * u[0]) * N.z), *biceps.to_loads()]
    closed = list((hand.pos_from(O) - grip.pos_from(O)).to_matrix(N))
    rates = dict(zip((own.diff() for own in q), u, strict=True))
    found = me.KanesMethod(
        N, [q[0]], [u[0]], [own.diff() - rate for own, rate in zip(q, u, strict=True)], q_dependent=q[1:], u_dependent=u[1:],
        configuration_constraints=closed, velocity_constraints=[own.diff(me.dynamicsymbols._t).xreplace(rates) for own in closed],
        constraint_solver="CRAMER",
    )
    found.kanes_equations(bodies, loads)
    return found


def two_masses_kept_together() -> Any:
    q1, q2 = me.dynamicsymbols("q1 q2")
    found = me.LagrangesMethod(q1.diff() ** 2 + q2.diff() ** 2 - 3 * q1 - 4 * q2, [q1, q2], hol_coneqs=[q1 - q2])
    found.form_lagranges_equations()
    return found


def body_on_a_hinge() -> Any:
    q, u = me.dynamicsymbols("q u")
    parent, child = me.RigidBody("parent"), me.RigidBody("child")
    system = me.System.from_newtonian(parent)
    system.add_joints(
        me.PinJoint("hinge", parent, child, q, u, parent_point=3 * parent.x, child_point=-3 * child.x, joint_axis=parent.z)
    )
    system.form_eoms()
    return system.eom_method


PAGES = [
    atwoods_machine, block_with_two_pendulums, pendulum_below_a_duffing_spring, particle_on_a_sphere_between_elastic_bands, mass_on_a_muscle,
    arm_on_a_lever, two_masses_kept_together, body_on_a_hinge,
]


@pytest.mark.parametrize("page", PAGES, ids=lambda own: own.__name__)
def test_what_a_page_of_sympy_derives(page: Callable[[], Any]) -> None:
    with warnings.catch_warnings():
        # Functions of the time that are given, as F and T, are said to be taken for controls.
        warnings.simplefilter("ignore")
        system = System.from_sympy(page(), derived=True)
    assert system.study(claims="equations.stated")["equations.stated#sympy"].verdict == "proved"


def test_a_wrong_equation_of_a_page_is_refuted() -> None:
    method = atwoods_machine()
    method._f_d = method._f_d * 2
    assert System.from_sympy(method, derived=True).study(claims="equations.stated")["equations.stated#sympy"].verdict == "refuted"


def test_the_acceleration_of_atwoods_machine() -> None:
    f = System.from_sympy(atwoods_machine(), parameters={"m1": 3, "m2": 2, "g": 9.81}).compile()
    # (m1 - m2)/(m1 + m2) g
    np.testing.assert_allclose(f.rhs(0.0, [0.1, 0.2]), [0.2, 9.81 / 5], rtol=1e-14)


def test_a_muscle_pulls_as_sympy_computes_it() -> None:
    method = mass_on_a_muscle()
    numbers = {"m": 0.5, "g": 9.81, "peak": 10.0, "fiber": 0.18, "slack": 0.17}
    free = {own.name: own for own in method.forcing.free_symbols}
    activation = next(own for own in method.forcing.atoms(sp.core.function.AppliedUndef) if own.func.__name__.startswith("a_"))
    # Coefficients of the curves: any numbers serve.
    given = {name: numbers.get(name, 0.3 + 0.01 * place) for place, name in enumerate(sorted(set(free) - {"t"}))}
    f = System.from_sympy(method, parameters=given, controls={activation: sp.Rational(1, 10)}).compile()
    q, u = method.q[0], method.u[0]
    values = {q: 0.4, u: 0.2, activation: 0.1, **{free[name]: value for name, value in given.items()}}
    force = method.forcing[0].doit().xreplace({q.diff(): u}).subs(values).evalf()
    np.testing.assert_allclose(f.rhs(0.0, [0.4, 0.2]), [0.2, float(force) / 0.5], rtol=1e-12)
