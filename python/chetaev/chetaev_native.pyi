# Generated from the native part by `cargo xtask python --stub`. What stands here is changed in crates/python.

"""
What `chetaev` is made of; the package in `python/chetaev` is its face.
"""

from chetaev.shapes import Matrix, Numbers, Vector
from collections.abc import Callable, Mapping
from numpy import float64
from numpy.typing import ArrayLike, NDArray
from os import PathLike
from typing import Any, Final, SupportsFloat, SupportsIndex, final

__all__ = ["VERSION", "Compiled", "Function", "Functional", "Linear", "Model", "Outcome", "Sweep", "checker", "explain", "gallery", "robot", "verify"]

VERSION: Final[str]
"""
The version of the package.
"""

@final
class Compiled:
    """
    The equations of motion of a system with the values of its parameters, compiled when they are first asked for. The state y is
    (coordinates, masses with a law of their own, velocities).
    """
    @property
    def constraints(self, /) -> list[str]:
        """
        Names of the constraints, one for each component of reactions and residuals.
        """
    @property
    def definitions(self, /) -> list[str]:
        """
        Names of what the model defines, one for each component of the definitions.
        """
    def function(self, /, what: str, parameters: "list[float] | None" = None) -> Function:
        """
        One of the functions, with these values of the parameters, in their order.
        """
    @property
    def parameters(self, /) -> list[tuple[str, float]]:
        """
        Names and values of the free parameters.
        """
    @property
    def state(self, /) -> list[str]:
        """
        Names of the components of the state: coordinates, masses with a law of their own, velocities.
        """

@final
class Function:
    """
    A compiled function f(t, y, out=None).

    Parameters
    ----------
    t : float
        The time.
    y : array of shape (n,), or (…, n) for many states at once
        States.
    out : array of doubles of the shape of the result, optional
        Where the values are written.

    Returns
    -------
    array
        The values; where the equations have no solution they are not finite: not a number, or infinite where a number is divided by zero.
    """
    def __call__(self, /, t: ArrayLike, y: ArrayLike, out: NDArray[float64] | None = None) -> NDArray[float64]: ...
    def __reduce__(self, /) -> tuple[Any, tuple[tuple[str, str, list[tuple[str, str]], list[tuple[str, str]]], str, list[float]]]: ...
    def __repr__(self, /) -> str: ...
    @property
    def address(self, /) -> int:
        """
        Where the function `void f(double t, double *y, double *values, double *data)` is, for callers that know C only: Numba,
        numbalsoda, SUNDIALS. `data` is that of this object.
        """
    @property
    def ctypes(self, /) -> Any:
        """
        The function at `address` as `ctypes` has it.
        """
    @property
    def data(self, /) -> Vector:
        """
        What such a caller hands over as `data`: which function is meant, then the parameters in their order. It is one array, in which the parameters
        may be changed: for all calls by the address that hand it over, and not for calls of this object. It serves as long as it lives itself; by a
        copy of it the values are not a number once it and this object are gone.
        """
    @property
    def is_native(self, /) -> bool:
        """
        Whether machine code runs.
        """

@final
class Functional:
    """
    A functional that was read without errors. Its texts are kept, and are read again for every question: what was read belongs to one
    thread.
    """
    def check(self, /) -> tuple[str, str, bool]:
        """
        Everything wrong or doubtful, as it is printed and as JSON; and whether there are errors.
        """
    def derive(self, /, notation: str) -> str:
        """
        Euler equations and conditions on the boundary in a notation: `derive`.
        """
    @property
    def dimensions(self, /) -> int:
        """
        The number of dimensions of space.
        """
    @property
    def fields(self, /) -> list[tuple[str, str, str | None, str]]:
        """
        Name, kind, piece of the boundary or `None`, and description of each field that is varied.
        """
    @staticmethod
    def from_file(path: str, overrides: "list[tuple[str, str]]") -> Functional:
        """
        Reads a model file, with what it includes; `overrides` are names and values of parameters and sizes.
        """
    @staticmethod
    def from_text(text: str, path: str | None, overrides: "list[tuple[str, str]]") -> Functional:
        """
        Reads a model from its text. Files that it includes are looked for as if it stood at `path`; nothing is included without one.
        """
    @staticmethod
    def from_texts(path: str, text: str, includes: "list[tuple[str, str]]", overrides: "list[tuple[str, str]]") -> Functional:
        """
        Reads a model again from what `texts` gave.
        """
    @property
    def level(self, /) -> str | None:
        """
        Its level in a hierarchy, as written.
        """
    @property
    def name(self, /) -> str:
        """
        Its name.
        """
    @property
    def parameters(self, /) -> list[tuple[str, str | None]]:
        """
        Names of the parameters with the texts of their values, or `None`.
        """
    def study(self, /, claims: str, tell: Callable[[str, float | None], None] | None = None) -> tuple[str, str, str, bool]:
        """
        Claims with their verdicts: the record as JSON, the summary, the report, and whether everything is as the model expects.
        """
    def text(self, /) -> str:
        """
        The model file with the values that were set written into it.
        """
    def texts(self, /) -> tuple[str, str, list[tuple[str, str]], list[tuple[str, str]]]:
        """
        Path, text, included files and overrides: enough to read the model again anywhere.
        """
    def warnings(self, /) -> str:
        """
        Warnings as they are printed; an empty text where there are none.
        """

@final
class Linear:
    """
    The answer to `linearize` and `stability`.
    """
    def control(self, /) -> str:
        """
        The matrices in numbers as a program for python-control.
        """
    def equations(self, /) -> str:
        """
        Linear equations, polynomial and eigenvalues in words.
        """
    def json(self, /) -> str:
        """
        All of it as JSON.
        """
    def latex(self, /) -> str:
        """
        The matrices in LaTeX.
        """
    def mat(self, /) -> bytes:
        """
        The matrices in numbers as a file of MATLAB.
        """
    def npz(self, /) -> bytes:
        """
        The matrices in numbers as a NumPy archive.
        """
    def picture(self, /) -> str | None:
        """
        Eigenvalues over the range as SVG; none without a range.
        """
    def ranges(self, /) -> str:
        """
        Stability in words.
        """

@final
class Model:
    """
    A model that was read without errors.
    """
    def along(self, /, tell: Callable[[str, float | None], None] | None = None) -> tuple[str, str]:
        """
        Linear equations along the motion from the initial state, in words and as JSON: `linearize --along`.
        """
    def check(self, /) -> tuple[str, str, bool]:
        """
        Everything wrong or doubtful, as it is printed and as JSON; and whether there are errors.
        """
    def compare(self, /, a: str, b: str, tell: Callable[[str, float | None], None] | None = None) -> tuple[str, list[str]]:
        """
        Two formulations held against each other, and notes: `derive --compare`.
        """
    def compile(self, /) -> Compiled:
        """
        The equations of motion as functions of numbers.
        """
    @property
    def constraints(self, /) -> list[str]:
        """
        Names of the constraints.
        """
    @property
    def coordinates(self, /) -> list[str]:
        """
        Names of the coordinates.
        """
    def count(self, /, names: "list[str]", all: bool, tell: Callable[[str, float | None], None] | None = None) -> tuple[str, list[str]]:
        """
        The operations of the equations of formulations, a line for each, and notes: `derive --count`.
        """
    def derive(self, /, names: "list[str]", all: bool, notation: str, tell: Callable[[str, float | None], None] | None = None) -> tuple[str, list[str]]:
        """
        The equations of formulations in a notation, and notes: `derive`.
        """
    @property
    def factors(self, /) -> list[tuple[str, float]]:
        """
        Factors by which numbers in units that are no SI base units become such, by the names of parameters.
        """
    def follow(self, /, about: str | None, over: str | None, orbit: bool, period: str | None, points: SupportsIndex, step: SupportsFloat | SupportsIndex, tell: Callable[[str, float | None], None] | None = None) -> tuple[str, str, str | None]:
        """
        Steady motions or periodic orbits over a range of a parameter, in words, as JSON and as SVG: `follow`.
        """
    @property
    def following(self, /) -> list[tuple[str, str]]:
        """
        Parameters that follow from others, each with what it is in terms of free ones.
        """
    @staticmethod
    def from_file(path: str, overrides: "list[tuple[str, str]]") -> Model:
        """
        Reads a model file, with what it includes; `overrides` are names and values of parameters and sizes.
        """
    @staticmethod
    def from_text(text: str, path: str | None, overrides: "list[tuple[str, str]]") -> Model:
        """
        Reads a model from its text. Files that it includes are looked for as if it stood at `path`; nothing is included without one.
        """
    @staticmethod
    def from_texts(path: str, text: str, includes: "list[tuple[str, str]]", overrides: "list[tuple[str, str]]") -> Model:
        """
        Reads a model again from what `texts` gave.
        """
    @property
    def initial(self, /) -> list[tuple[str, str, bool]]:
        """
        Initial values as they are stated: name, value, whether it is a guess.
        """
    def lowered(self, /) -> str:
        """
        The model with its bodies, joints and contacts written out as coordinates, energies and constraints.
        """
    @property
    def masses(self, /) -> list[str]:
        """
        Names of the masses that are states: those whose law states their rate.
        """
    @property
    def name(self, /) -> str:
        """
        Its name.
        """
    @property
    def parameters(self, /) -> list[tuple[str, str | None]]:
        """
        Names of the parameters with the texts of their values, or `None`.
        """
    def principles(self, /, asked: Mapping[str, object], compare: bool, tell: Callable[[str, float | None], None] | None = None) -> Outcome:
        """
        What the variational principles state: `principles`.
        """
    def sensitivity(self, /, by: str, second: bool, times: "list[float]", project: bool = False, tell: Callable[[str, float | None], None] | None = None) -> tuple[list[str], list[list[float]]]:
        """
        Names of columns and rows of numbers: `simulate --sensitivity`.
        """
    def simulate(self, /, asked: Mapping[str, object], tell: Callable[[str, float | None], None] | None = None) -> Outcome:
        """
        The motion alone: `simulate`.
        """
    def stability(self, /, wanted: Mapping[str, object], tell: Callable[[str, float | None], None] | None = None) -> Linear:
        """
        Linear equations about a steady motion and their stability: `linearize` and `stability`.
        """
    def stability_map(self, /, over: str, about: str | None = None, at: str | None = None, tell: Callable[[str, float | None], None] | None = None) -> tuple[str, str, str]:
        """
        Stability over two parameters, in words, as JSON and as SVG: `stability --over` with two.
        """
    def start(self, /) -> tuple[float, list[float]]:
        """
        The time and the consistent state from which the motion starts: coordinates, masses with a law of their own, velocities.
        """
    def steady(self, /, symbolic: bool, tell: Callable[[str, float | None], None] | None = None) -> tuple[str, str]:
        """
        All steady motions in words and as JSON: `steady`.
        """
    def steps(self, /, names: "list[str]", all: bool, notation: str, tell: Callable[[str, float | None], None] | None = None) -> tuple[str, list[str]]:
        """
        The derivations of formulations step by step, and notes: `derive --steps`.
        """
    def study(self, /, asked: Mapping[str, object], tell: Callable[[str, float | None], None] | None = None) -> Outcome:
        """
        Claims and motion: `study`.
        """
    def sweep(self, /, asked: Mapping[str, object], varied: Mapping[str, object], tell: Callable[[str, float | None], None] | None = None) -> Sweep:
        """
        Many trajectories, ready to be computed: `sweep`.
        """
    def sympy(self, /, texts: "list[str]", variables: "list[str]") -> str:
        """
        A Python module whose list `found["all"]` has these expressions in SymPy; variables of a state that is not the model's may occur.
        """
    def text(self, /) -> str:
        """
        The model file with the values that were set written into it.
        """
    def texts(self, /) -> tuple[str, str, list[tuple[str, str]], list[tuple[str, str]]]:
        """
        Path, text, included files and overrides: enough to read the model again anywhere.
        """
    @property
    def units(self, /) -> list[tuple[str, str]]:
        """
        Units as they are stated, by the names of coordinates, parameters and masses.
        """
    def warnings(self, /) -> str:
        """
        Warnings as they are printed; an empty text where there are none.
        """

@final
class Outcome:
    """
    Claims with their verdicts, and the motion.
    """
    def columns(self, /) -> tuple[list[str], Matrix]:
        """
        Names of the columns, and the columns as the rows of one array.
        """
    def csv(self, /) -> str:
        """
        The trajectory as CSV.
        """
    def events(self, /) -> str | None:
        """
        The events met as CSV; `None` where the model states none.
        """
    def film(self, /, seconds: SupportsFloat | SupportsIndex | None, size: tuple[SupportsIndex, SupportsIndex], tell: Callable[[str, float | None], None] | None = None) -> bytes:
        """
        The moving picture as a GIF of so many seconds.
        """
    @property
    def has_motion(self, /) -> bool:
        """
        Whether there is a motion.
        """
    @property
    def interrupted(self, /) -> bool:
        """
        Whether Ctrl-C ended it.
        """
    def low(self, /) -> list[Vector]:
        """
        What the doubles of the columns leave out, of a run in double-double arithmetic.
        """
    @property
    def notices(self, /) -> list[str]:
        """
        What a reader must know.
        """
    def npz(self, /) -> bytes:
        """
        The trajectory as a NumPy archive.
        """
    def page(self, /, files: "list[str]") -> str:
        """
        The report, one HTML page.
        """
    def picture(self, /, format: str, at: SupportsFloat | SupportsIndex | None, ghosts: SupportsIndex, size: tuple[SupportsIndex, SupportsIndex]) -> bytes:
        """
        A picture at a time, the end where there is none, with the bodies at so many earlier times: `svg` or `png`.
        """
    def record(self, /, files: "list[str]") -> str:
        """
        The record of a study as JSON; `files` lie beside it.
        """
    def run(self, /, files: "list[str]") -> str:
        """
        The record of the motion as JSON.
        """
    def scene(self, /) -> str:
        """
        The description of the picture, `scene.json`.
        """
    @property
    def status(self, /) -> int:
        """
        The exit status that the command line would have.
        """
    def story(self, /) -> str:
        """
        What the variational principles say.
        """
    def summary(self, /) -> str:
        """
        The summary for a terminal.
        """

@final
class Sweep:
    """
    A sweep that is derived and compiled.
    """
    @property
    def columns(self, /) -> list[str]:
        """
        Names of the columns.
        """
    def compute(self, /, first: SupportsIndex, last: SupportsIndex, threads: SupportsIndex | None = None, stop_on_failure: bool = False, tell: Callable[[str, float | None], None] | None = None) -> tuple[Numbers, list[NDArray[Any]], list[tuple[int, str]], bool]:
        """
        Computes the trajectories with the numbers first to last, without the last.
        """
    @property
    def count(self, /) -> int:
        """
        Number of trajectories.
        """
    def description(self, /) -> list[tuple[str, str]]:
        """
        What makes this sweep another than others.
        """
    @property
    def events(self, /) -> list[str]:
        """
        Names of the events of the model.
        """
    def keep(self, /, folder: str | PathLike[str], threads: SupportsIndex | None = None, stop_on_failure: bool = False, tell: Callable[[str, float | None], None] | None = None) -> tuple[int, str | None, tuple[Numbers, list[NDArray[Any]], list[tuple[int, str]]] | None, bool]:
        """
        The sweep in a folder as the command keeps it: what is there is taken over, and what is missing computed.
        """

def checker() -> list[tuple[str, str]]:
    """
    Names and texts of the files of the checker, a program in Python that shares nothing with this one.
    """

def explain(claim: str | None = None) -> tuple[str, str]:
    """
    What a claim or a formulation states, in words and as JSON; all claims without a name.
    """

def gallery(name: str | None = None) -> tuple[str, list[tuple[str, str]], str]:
    """
    The models that come with Chetaev as JSON; of one model, its texts by path.
    """

def robot(path: str, text: str) -> tuple[str, list[tuple[int, str]]]:
    """
    A model text from the description of a robot in URDF or MJCF, and what of it was not understood, by line.
    """

def verify(record: str, budget: SupportsFloat | SupportsIndex, tell: Callable[[str, float | None], None] | None = None, checksum: Callable[[str], str | None] | None = None) -> tuple[str, bool]:
    """
    Replays the verdicts of a record within a budget, and holds the files beside it against their checksums where a function from names to these
    is given; the lines as JSON, and whether all agree.
    """
