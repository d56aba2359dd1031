"""Models: files, texts, keywords, errors, pickles."""

from __future__ import annotations

import pickle
import re
import subprocess
import sys
import time
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import chetaev
from chetaev import ModelError, System
from chetaev.texts import exact, toml


def skate(**sections: object) -> System:
    usual: dict[str, object] = {
        "parameters": {"m": 1, "J": Fraction(2, 5)},
        "initial": {"x'": 1, "phi'": 0.5},
        "simulation": {"t_end": 2},
    }
    usual.update(sections)
    return System(
        "skate",
        coordinates=["x", "y", "phi"],
        kinetic="1/2 m (x'^2 + y'^2) + 1/2 J phi'^2",
        constraints={"blade": "y' cos(phi) = x' sin(phi)"},
        **usual,
    )


def test_keywords_state_what_a_file_states() -> None:
    system = skate()
    assert system.coordinates == ["x", "y", "phi"]
    assert system.constraints == ["blade"]
    assert system.parameters == {"m": "1", "J": "2/5"}
    again = System.from_text(system.text)
    assert again.parameters == system.parameters
    assert again.derive("maggi").to_dict() == system.derive("maggi").to_dict()


def test_floats_are_the_decimals_that_they_print_as() -> None:
    assert skate(parameters={"m": 0.1, "J": 1e-3}).parameters == {"m": "1/10", "J": "1/1000"}


def test_values_are_replaced_exactly(gallery: Path) -> None:
    system = System.from_file(gallery / "chaplygin-sleigh" / "model.toml", set={"a": 0.3})
    assert system.parameters["a"] == "3/10"
    assert system.with_values(a=Fraction(1, 3)).parameters["a"] == "1/3"


def test_an_error_has_its_place_and_prints_it() -> None:
    with pytest.raises(ModelError) as caught:
        System.from_text('name = "wrong"\ncoordinates = ["x"]\n[lagrangian]\nT = "1/2 mas x\'^2"\n')
    error = caught.value
    assert (error.line, error.text) == (4, "mas")
    assert error.column == 10
    assert error.file.endswith("model.toml")
    assert "mas" in str(error) and "^" in str(error) and "4" in str(error)
    assert isinstance(error, ValueError) and isinstance(error, chetaev.ChetaevError)
    again = pickle.loads(pickle.dumps(error))
    assert (again.line, str(again)) == (4, str(error))


def test_a_missing_file_is_an_error_of_the_system() -> None:
    with pytest.raises(OSError, match="nowhere.toml"):
        System.from_file("nowhere.toml")


def test_wrong_options_say_which() -> None:
    with pytest.raises(chetaev.OptionError, match="euler"):
        skate().simulate(method="euler")
    with pytest.raises(chetaev.OptionError, match="energie"):
        skate().study(claims="energie")
    with pytest.raises(ModelError):
        skate().simulate(t_end="2 +")


def test_systems_pickle(gallery: Path) -> None:
    system = System.from_file(gallery / "chaplygin-sleigh" / "model.toml", set={"a": "1/3"})
    again = pickle.loads(pickle.dumps(system))
    assert again.parameters == system.parameters
    assert again.text == system.text


def test_values_are_written_exactly() -> None:
    assert [exact(x) for x in (3, 0.1, Fraction(-1, 3), "2 pi", 1e-20)] == ["3", "0.1", "-1/3", "2 pi", "1e-20"]
    for wrong in (True, float("nan"), float("inf"), None, object()):
        with pytest.raises((TypeError, ValueError)):
            exact(wrong)
    assert toml({"a": 1, "b": {"x'": "q\"\\", "c": [1, "d"], "e": None}}) == (
        'a = 1\n\n[b]\n"x\'" = "q\\"\\\\"\nc = [1, "d"]\ne = {}\n'
    )


def test_the_package_is_imported_quickly() -> None:
    def seconds(statement: str) -> float:
        began = time.perf_counter()
        subprocess.run([sys.executable, "-c", statement], check=True)
        return time.perf_counter() - began

    # On a machine with other work only the quickest of several says what it takes.
    took = min(seconds("import chetaev") - seconds("pass") for _ in range(5))
    assert took < 0.15
    subprocess.run([sys.executable, "-c", "import chetaev, sys; assert 'numpy' not in sys.modules"], check=True)


def test_robots_are_read(tmp_path: Path) -> None:
    robot = tmp_path / "arm.urdf"
    robot.write_text(
        '<robot name="arm"><link name="ground"/><link name="upper"><inertial><mass value="2"/><origin xyz="0 0 -0.5"/>'
        '<inertia ixx="0.2" iyy="0.2" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>'
        '<joint name="shoulder" type="revolute"><parent link="ground"/><child link="upper"/><axis xyz="0 1 0"/>'
        '<limit lower="-1" upper="1" effort="1" velocity="1"/></joint><transmission name="drive"/></robot>'
    )
    with pytest.warns(chetaev.ModelWarning, match="transmission"):
        arm = System.from_urdf(robot)
    assert arm.coordinates == ["shoulder"]
    robot.write_text("<robot")
    with pytest.raises(chetaev.ModelError) as broken:
        System.from_urdf(robot)
    assert (broken.value.file, broken.value.line) == (str(robot), 1)
    robot.write_text('<robot name="a">\n <link name="b"><inertial>\n  <mass value="x"/></inertial></link>\n</robot>\n')
    with pytest.raises(chetaev.ModelError) as found:
        System.from_urdf(robot)
    wrong = found.value
    assert (wrong.file, wrong.line, wrong.column) == (str(robot), 3, 3)
    assert wrong.text == '<mass value="x"/></inertial></link>' and "^^^" in str(wrong)


def test_arguments_of_a_wrong_kind_are_named() -> None:
    with pytest.raises(TypeError, match="name: a text"):
        System.from_gallery(None)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="system: a System"):
        chetaev.ensemble("sleigh", initial={"x": [1.0]})  # type: ignore[arg-type]
    sleigh = System.from_gallery("chaplygin-sleigh")
    for flags in ({"project": "no"}, {"keep_integrals": "False"}):
        with pytest.raises(TypeError, match="True or False"):
            sleigh.simulate(t_end=1, **flags)  # type: ignore[arg-type]


def test_values_are_given_in_the_units_of_the_model() -> None:
    """A pendulum of 50 cm: what is computed is in SI units, sliders and given values are in centimetres. θ(t) does not depend on the mass."""
    text: dict[str, Any] = {
        "coordinates": {"th": "rad"}, "kinetic": "1/2 m l^2 th'^2", "potential": "-m g l cos(th)", "initial": {"th": 0.3},
    }
    units = {"l": {"value": 50, "unit": "cm"}, "g": {"value": 9.81, "unit": "m/s^2"}, "m": {"value": 200, "unit": "g"}}
    system = System("u", parameters=units, **text)
    assert (system.parameters["l"], system.parameters["m"]) == ("1/2", "1/5")
    plain = System("u", parameters={"l": 0.5, "g": 9.81, "m": 0.2}, **text)
    pytest.importorskip("anywidget")
    live = system.widget(l=(40, 60), motion={"t_end": 1})
    assert live.values == {"l": 50.0}
    wanted = plain.simulate(t_end=1)["th"][-1]
    assert abs(live.motion["th"][-1] - wanted) < 1e-9


def test_python_says_what_is_wrong_with_a_file(tmp_path: Path) -> None:
    for read in (System.from_file, chetaev.Functional.from_file):
        with pytest.raises(FileNotFoundError) as found:
            read(tmp_path / "nowhere.toml")
        assert found.value.errno is not None and found.value.filename
        with pytest.raises(IsADirectoryError):
            read(tmp_path)


def test_numbers_of_python_are_taken() -> None:
    big = skate(parameters={"m": 132712440018000000000, "J": Decimal("0.4")})
    assert big.parameters == {"m": "132712440018000000000", "J": "2/5"}
    one = System("one", coordinates=["x"], kinetic="1/2 x'^2", constraints="x' = 1")
    assert one.constraints == ["constraint_1"]


@pytest.mark.parametrize(
    ("keywords", "kind"), [({"tolerance": "small"}, ValueError), ({"tolerance": []}, TypeError), ({"branch": -1}, ValueError), ({"branch": "a"}, TypeError)]
)
def test_a_wrong_keyword_is_named(keywords: dict[str, object], kind: type[Exception]) -> None:
    with pytest.raises(kind, match=next(iter(keywords))):
        skate().simulate(**keywords)  # type: ignore[arg-type]
    assert skate().simulate(tolerance="1e-6", t_end=1).finished  # type: ignore[arg-type]


def test_an_error_without_a_place_has_none() -> None:
    with pytest.raises(ModelError) as found:
        chetaev.Functional.from_gallery("chaplygin-sleigh")
    assert found.value.line is None and found.value.file is None and found.value.hint is None


def test_no_claims_are_no_question() -> None:
    with pytest.raises(ValueError, match="claims"):
        skate().study(claims=[])


def test_equal_systems_are_equal() -> None:
    assert skate() == skate() and hash(skate()) == hash(skate())
    assert skate() != skate().with_values(m=2) and skate().with_values(m=2) == skate().with_values(m=2)
    assert skate().velocities == ["x'", "y'", "phi'"] and skate().initial == {"x'": "1", "phi'": "0.5"}


def test_a_system_says_its_state_and_units() -> None:
    cart = System.from_gallery("sand-cart")
    assert cart.state == cart.compile().state
    assert cart.masses == ["load"]
    stated = System(
        "s", coordinates={"x": {"unit": "m"}}, parameters={"m": {"value": 2, "unit": "kg"}, "k": {"value": 3, "unit": "kg/s^2"}},
        kinetic="1/2 m x'^2", potential="1/2 k x^2",
    )
    assert stated.units == {"x": "m", "m": "kg", "k": "kg/s^2"}
    assert skate().units == {} and skate().state == ["x", "y", "phi", "x'", "y'", "phi'"]


def oscillator(**sections: Any) -> System:
    """x'' = -k x."""
    return System("o", **{"coordinates": ["x"], "parameters": {"k": 1}, "kinetic": "1/2 x'^2", "potential": "1/2 k x^2", **sections})


def test_numbers_of_numpy_are_values() -> None:
    # The value of a long double is the decimal that it prints as, as that of a float.
    assert exact(np.longdouble("0.1")) == str(np.longdouble("0.1"))
    assert oscillator(parameters={"k": np.array(2.0)}).parameters == oscillator().with_values(k=np.array(2.0)).parameters == {"k": "2"}
    assert oscillator(coordinates=np.array(["x"])).coordinates == ["x"]
    with pytest.raises(TypeError, match="no value where an array is masked"):
        oscillator().with_values(k=np.ma.masked)
    for wrong in (np.longdouble("nan"), np.longdouble("inf")):
        with pytest.raises(ValueError, match="no finite number"):
            exact(wrong)
    with pytest.raises(TypeError, match="not clongdouble"):
        exact(np.clongdouble(1j))


def test_a_parameter_may_be_called_self() -> None:
    system = System("s", coordinates=["x"], parameters={"self": 1}, kinetic="1/2 x'^2", potential="1/2 self x^2")
    assert system.with_values(**{"self": 4}).parameters == {"self": "4"}
    assert system.compile(**{"self": 4}).rhs(0.0, [1.0, 0.0])[1] == -4.0
    pytest.importorskip("anywidget")
    assert system.with_initial({"x": 1}).widget(motion={"t_end": 1}, **{"self": (1, 2)}).values == {"self": 1.0}


@pytest.mark.parametrize(
    ("work", "said"),
    [
        (lambda system: system.linearize(about="rest", at=5), "at: a text is needed, not 5"),
        (lambda system: system.linearize(about=3), "about: a text is needed, not 3"),
        (lambda system: system.linearize(speeds=[1]), "speeds: a text, or a list of texts, is needed"),
        (lambda system: system.stability(over=1), "over: a text is needed, not 1"),
        (lambda system: system.stability_map(over=1), "over: a text is needed, not 1"),
        (lambda system: system.follow(period=1), "period: a text is needed, not 1"),
        (lambda system: system.study(claims=[3]), "claims: a text, or a list of texts, is needed"),
        (lambda system: system.derive([3]), "formulation: a text, or a list of texts, is needed"),
        (lambda system: system.simulate(initial=[1]), "initial: a mapping from names to values is needed, not list"),
        (lambda system: system.with_initial("x"), "initial: a mapping from names to values is needed, not str"),
        (lambda system: system.sweep(vary=[1]), "vary: a mapping from names to values is needed, not list"),
        (lambda system: system.sweep(rows=[[1]]), "rows: a path, a mapping from names to arrays, or a table"),
    ],
)
def test_a_keyword_of_another_kind_is_told_by_its_name(work: Any, said: str) -> None:
    with pytest.raises(TypeError, match=re.escape(said)):
        work(oscillator())


COMMENTED = """# A point on a spring.
name = "spring"
coordinates = ["x"]

[parameters]
m = 2 # mass
k = { value = 3, description = "stiffness" } # of the spring
J = "2 m"

[lagrangian]
T = "1/2 m x'^2" # of Newton
V = "1/2 k x^2"

[initial]
x = 1
"""


def test_the_text_has_what_was_set() -> None:
    system = System.from_text(COMMENTED, set={"k": 5}).with_values(m=Fraction(1, 3)).with_initial({"x'": "sqrt(2)", "x": 0.5})
    expected = COMMENTED.replace("m = 2 #", 'm = "1/3" #').replace("value = 3", "value = 5").replace("x = 1", "x = 0.5\n\"x'\" = \"sqrt(2)\"")
    assert system.text == expected
    again = System.from_text(system.text)
    assert again.parameters == system.parameters == {"m": "1/3", "k": "5", "J": "2/3"}
    assert again.initial == {"x": "0.5", "x'": "sqrt(2)"}
    assert "1/3" in system._repr_mimebundle_()["text/html"]
    assert System.from_text(COMMENTED).text == COMMENTED


def test_the_text_of_keywords_and_of_bodies_has_what_was_set() -> None:
    point = System("point", coordinates=["x"], parameters={"m": 2, "c": None}, kinetic="1/2 m x'^2")
    assert System.from_text(point.with_values(m=4, c=1).text).parameters == {"m": "4", "c": "1"}
    wheel = System(
        "wheel", parameters={"r": 0.3}, bodies={"wheel": {"shape": "disc", "mass": 2, "radius": "r"}},
        contacts={"road": {"type": "rolling", "body": "wheel", "coordinates": ["x", "y", "heading", "lean", "roll"]}},
    )
    changed = wheel.with_values(r="1/4", wheel_mass=3, g=2)
    assert System.from_text(changed.text).parameters == changed.parameters == {"r": "1/4", "wheel_mass": "3", "g": "2"}


def test_what_the_text_has_no_place_for_is_told() -> None:
    """One of a family: its line states all of them."""
    text = """
        name = "row"
        sizes = { N = 2 }
        indices = { i = "1..N" }
        coordinates = ["x_{i}"]
        parameters = { "m_{i}" = 1 }
        lagrangian = { T = "sum(i = 1..N, 1/2 m_{i} x_{i}'^2)" }
    """
    system = System.from_text(text)
    assert system.with_values(N=3).text == text.replace("N = 2", "N = 3")
    changed = system.with_values(m_1=4)
    assert changed.parameters == {"m_1": "4", "m_2": "1"}
    with pytest.raises(ModelError, match="`m_1`"):
        _ = changed.text
    assert "m_{i}" in changed._repr_mimebundle_()["text/html"]
    assert pickle.loads(pickle.dumps(changed)).parameters == changed.parameters


@pytest.mark.parametrize("content", [{}, {"a": 1}, "1"])
def test_an_unknown_section_is_refused_whatever_it_has(content: Any) -> None:
    with pytest.raises(ModelError, match="`konstraints` is no key of a model file"):
        System("point", coordinates=["x"], kinetic="1/2 x'^2", konstraints=content)


def test_an_empty_section_says_nothing() -> None:
    point = System("point", coordinates=["x"], kinetic="1/2 x'^2", constraints={}, parameters={}, initial={}, simulation={}, steady={})
    assert point.constraints == [] and point.parameters == {} and point.check().ok
