"""Every command is a method, every option a keyword, every result the JSON of the command."""

from __future__ import annotations

import inspect
import json
import keyword
import re
import subprocess
from pathlib import Path
from typing import Any

import pytest
from conftest import program

import chetaev
from chetaev import System

#: Commands that are no methods, and why.
NOT_METHODS = {
    "new": "a model to start from is a file for an editor",
    "import": "a model text that is read and gone on with in an editor",
    "completions": "a script for a shell",
    "help": "help(System)",
}
#: Options that are no keywords, and why.
NOT_KEYWORDS = {
    "json": "to_dict()",
    "help": "help()",
    "version": "__version__",
    "set": "keyword of from_file, from_text and from_gallery",
    "as": "Derivation.to(notation)",
    "time": "the time that a call takes is measured around it",
    "compare": "of derive: the method compare",
    "colour": "a matter of terminals",
}
#: The same of one command.
NOT_KEYWORDS_OF = {
    ("study", "all"): "all verdicts are in the result",
    ("study", "show"): "all verdicts are in the result",
    ("principles", "all"): "all verdicts are in the result",
    ("check", "lowered"): "the method lowered",
    ("derive", "steps"): "the method steps",
    ("linearize", "along"): "the method along",
    ("stability", "plot"): "the method picture of its result",
    ("follow", "plot"): "the method picture of its result",
    ("simulate", "sensitivity"): "the method sensitivity",
    ("simulate", "second"): "a keyword of the method sensitivity",
}


def said(*arguments: str) -> str:
    path = program()
    if path is None:
        pytest.fail("the command line is not built: cargo build -p chetaev-cli, or CHETAEV_PROGRAM names it")
    return subprocess.run([str(path), *arguments], capture_output=True, text=True, check=True).stdout


def commands() -> list[str]:
    _, _, rest = said("--help").partition("Commands:")
    block, _, _ = rest.partition("Options:")
    return re.findall(r"^  ([a-z][a-z-]*)\b", block, re.MULTILINE)


def options(command: str) -> set[str]:
    _, _, rest = said(command, "--help").partition("Options:")
    return set(re.findall(r"^ {2,6}(?:-\w, )?--([a-z][a-z-]*)", rest, re.MULTILINE))


def method(command: str) -> Any:
    name = command.replace("-", "_")
    return getattr(System, name, None) or getattr(chetaev, name, None)


def test_every_command_is_a_method() -> None:
    found = commands()
    assert {"study", "derive", "check", "explain"} <= set(found)
    missing = [own for own in found if method(own) is None and own not in NOT_METHODS]
    assert missing == []
    assert not [own for own in NOT_METHODS if own in found and hasattr(System, own)]


def test_every_option_is_a_keyword() -> None:
    missing = []
    for command in commands():
        own = method(command)
        if own is None or not callable(own):
            continue
        known = inspect.signature(own).parameters
        for option in options(command) - set(NOT_KEYWORDS):
            name = option.replace("-", "_")
            name += "_" if keyword.iskeyword(name) else ""
            if name not in known and (command, option) not in NOT_KEYWORDS_OF:
                missing.append(f"{command} --{option}")
    assert missing == []


def without(data: Any, *keys: str) -> Any:
    """The data without what depends on clocks and places."""
    if isinstance(data, dict):
        return {key: without(own, *keys) for key, own in data.items() if key not in keys}
    return [without(own, *keys) for own in data] if isinstance(data, list) else data


MODEL = "chaplygin-sleigh"


@pytest.fixture(scope="module")
def sleigh(gallery: Path) -> System:
    return System.from_file(gallery / MODEL / "model.toml")


def test_studies_are_the_record(sleigh: System, command: Any, gallery: Path, tmp_path: Path) -> None:
    path = str(gallery / MODEL / "model.toml")
    claims = "model,energy.integral,motion.constraint-drift"
    theirs = command("study", path, "--claims", claims, "--t-end", "3", "--out", str(tmp_path / "a"))
    ours = sleigh.study(claims=claims, t_end=3, out=tmp_path / "b")
    leave = ("seconds", "files")
    assert without(ours.to_dict(), *leave) == without(theirs, *leave)
    written = json.loads((tmp_path / "b" / "study.json").read_text())
    assert without(written, "seconds") | {"files": []} == without(theirs, "seconds") | {"files": []}
    # The tables are the same bytes.
    for name in ("trajectory.csv", "trajectory.npz"):
        assert (tmp_path / "a" / name).read_bytes() == (tmp_path / "b" / name).read_bytes()
    assert ours["energy.integral"].verdict == "proved"
    assert ours.ok


def test_motions_are_the_record(sleigh: System, command: Any, gallery: Path, tmp_path: Path) -> None:
    path = str(gallery / MODEL / "model.toml")
    theirs = command("simulate", path, "--t-end", "2 pi", "--tolerance", "1e-9", "--out", str(tmp_path))
    ours = sleigh.simulate(t_end="2 pi", tolerance=1e-9)
    assert without(ours.to_dict(), "files") == without(theirs, "files")


def test_equations_are_the_json(sleigh: System, gallery: Path) -> None:
    path = str(gallery / MODEL / "model.toml")
    for arguments, ours in [
        (["--formulation", "maggi"], sleigh.derive("maggi")),
        (["--formulation", "voronets", "--formulation", "routh"], sleigh.derive(["voronets", "routh"])),
        ([], sleigh.derive()),
    ]:
        theirs = json.loads(said("derive", path, *arguments, "--as", "json"))
        assert ours.to_dict() == theirs
    assert sleigh.derive("maggi").to_latex() == said("derive", path, "--formulation", "maggi", "--as", "latex")
    assert str(sleigh.compare("maggi", "routh")).rstrip() == said("derive", path, "--compare", "maggi", "routh").rstrip()


def test_other_results_are_the_json(sleigh: System, command: Any, gallery: Path) -> None:
    path = str(gallery / MODEL / "model.toml")
    assert sleigh.check().to_dict() == command("check", path)
    assert sleigh.linearize().to_dict() == command("linearize", path)
    assert sleigh.along().to_dict() == command("linearize", path, "--along")
    governor = str(gallery / "watt-governor" / "model.toml")
    assert System.from_file(governor).follow(over="eps=0.1:1").to_dict() == command("follow", governor, "--over", "eps=0.1:1")
    varied = sleigh.sensitivity("a", [0.0, 1.0, 2.0])
    assert varied["d x/d a"][0] == 0.0 and len(varied["d phi'/d a"]) == 3
    assert sleigh.stability(over="ahead=-2:2").to_dict() == command("stability", path, "--over", "ahead=-2:2")
    assert chetaev.explain().to_dict() == command("explain")
    assert chetaev.explain("energy.integral").to_dict() == command("explain", "energy.integral")
    assert chetaev.gallery.list().to_dict() == command("gallery")
    assert chetaev.gallery.describe(MODEL).to_dict() == command("gallery", "describe", MODEL)


def test_pictures_are_those_of_the_command(sleigh: System, gallery: Path, tmp_path: Path) -> None:
    path = str(gallery / MODEL / "model.toml")
    for end in ("svg", "png", "json"):
        arguments = ["--t-end", "3", "--at", "2", "--ghosts", "3", "--width", "320"]
        said("plot", path, *arguments, "--out", str(tmp_path / f"a.{end}"))
        sleigh.plot(t_end=3, at=2, ghosts=3, width=320, out=tmp_path / f"b.{end}")
        assert (tmp_path / f"a.{end}").read_bytes() == (tmp_path / f"b.{end}").read_bytes()
    said("film", path, "--t-end", "3", "--width", "120", "--height", "80", "--out", str(tmp_path / "a.gif"))
    film = sleigh.film(t_end=3, width=120, height=80, out=tmp_path / "b.gif")
    assert (tmp_path / "a.gif").read_bytes() == (tmp_path / "b.gif").read_bytes()
    assert "data:image/gif;base64," in film._repr_mimebundle_()["text/html"]


def test_principles_are_the_record(command: Any, gallery: Path) -> None:
    path = gallery / "particle-y-dx" / "model.toml"
    leave = ("seconds", "files")
    theirs = command("principles", str(path))
    ours = System.from_file(path).principles()
    assert without(ours.to_dict(), *leave) == without(theirs, *leave)
    assert str(ours)


def test_records_are_verified(sleigh: System) -> None:
    study = sleigh.study(claims="energy.integral", t_end=1)
    assert chetaev.verify(study).agrees
    false = study.to_dict()
    for own in false["verdicts"]:
        if own["claim"] == "energy.integral":
            own["verdict"] = "refuted"
    found = chetaev.verify(false)
    assert not found.agrees
    assert "DISAGREES" in str(found)


def test_the_story_of_a_name_that_is_none() -> None:
    with pytest.raises(chetaev.OptionError, match="did you mean energy.integral"):
        chetaev.explain("energy.integra")
