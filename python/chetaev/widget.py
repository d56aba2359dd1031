"""Live pictures in notebooks: sliders for parameters and for the time. It needs anywidget."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import anywidget
import traitlets

from .asked import number
from .errors import ChetaevError

if TYPE_CHECKING:
    from .system import System

#: The face of it: sliders, and the picture that Python draws.
_SCRIPT = """
function render({ model, el }) {
  const face = document.createElement("div");
  const picture = document.createElement("div");
  const said = document.createElement("pre");
  face.style.cssText = "display:grid;grid-template-columns:auto 1fr auto;gap:0.2em 0.8em;align-items:center;max-width:40em";
  const slider = (name, [low, high], read, write) => {
    const label = document.createElement("label");
    const input = document.createElement("input");
    const value = document.createElement("output");
    label.textContent = name;
    Object.assign(input, { type: "range", min: low, max: high, step: (high - low) / 200 || 1 });
    input.setAttribute("aria-label", name);
    const show = () => { input.value = read(); value.textContent = Number(read()).toPrecision(4); };
    input.addEventListener("input", () => { write(Number(input.value)); model.save_changes(); show(); });
    face.append(label, input, value);
    show();
    return { input, show };
  };
  for (const [name, range] of Object.entries(model.get("ranges"))) {
    slider(name, range, () => model.get("values")[name],
      (own) => model.set("values", { ...model.get("values"), [name]: own }));
  }
  const time = slider("t", model.get("span"), () => model.get("t"), (own) => model.set("t", own));
  const draw = () => {
    picture.innerHTML = model.get("picture");
    said.textContent = model.get("said");
    const [first, last] = model.get("span");
    Object.assign(time.input, { min: first, max: last, step: (last - first) / 200 || 1 });
    time.show();
  };
  for (const name of ["picture", "said", "span", "t"]) model.on(`change:${name}`, draw);
  draw();
  el.append(face, picture, said);
}
export default { render };
"""


def _ends(name: str, given: Any) -> list[float]:
    """The ends of a slider, the lower one first."""
    try:
        low, high = (number(name, own) for own in given)
    except (TypeError, ValueError):
        raise TypeError(f"{name}: the two ends of a slider are needed, not {given!r}") from None
    if not (math.isfinite(low) and math.isfinite(high) and low < high):
        raise ValueError(f"{name}: a slider goes from a number to a larger one, and not from {low:g} to {high:g}")
    return [low, high]


class Widget(anywidget.AnyWidget):
    """A picture of the motion with sliders, made by :meth:`chetaev.System.widget`.

    Attributes
    ----------
    values : dict from str to float
        What the sliders of the parameters say. Python may set it too.
    t : float
        The time of the picture.
    motion : Trajectory
        The motion that is shown.
    """

    _esm = _SCRIPT
    ranges = traitlets.Dict().tag(sync=True)
    values = traitlets.Dict().tag(sync=True)
    span: Any = traitlets.List().tag(sync=True)
    t = traitlets.Float().tag(sync=True)
    picture = traitlets.Unicode().tag(sync=True)
    said = traitlets.Unicode().tag(sync=True)

    def __init__(self, system: System, ranges: Mapping[str, tuple[float, float]], size: tuple[int, int], motion: Mapping[str, Any]) -> None:
        self._system, self._size, self._motion = system, size, dict(motion)
        # Sliders are in the units of the model, as values that are given are.
        factors = dict(system._native.factors)
        known = {name: value / factors.get(name, 1.0) for name, value in system.compile().parameters.items()}
        unknown = [name for name in ranges if name not in known]
        if unknown:
            raise ValueError(f"`{unknown[0]}` is no parameter; there are {', '.join(known)}")
        within = {name: _ends(name, own) for name, own in ranges.items()}
        super().__init__(ranges=within, values={name: known[name] for name in within}, span=[0.0, 0.0])
        self._compute(True)
        self.observe(lambda _: self._compute(False), "values")
        self.observe(lambda _: self._draw(), "t")

    def _compute(self, at_end: bool) -> None:
        """The motion for the values of the sliders; where there is none the last one stays, and the reason is said."""
        try:
            self.motion = self._system.with_values(**self.values).simulate(**self._motion)
        except (ChetaevError, ValueError) as problem:
            self.said = str(problem)
            return
        self.said = "" if self.motion.finished else self.motion.reason
        first, last = float(self.motion.t[0]), float(self.motion.t[-1])
        was_at_end = at_end or self.t == self.span[1]
        self.span = [first, last]
        self.t = last if was_at_end else min(max(self.t, first), last)
        self._draw()

    def _draw(self) -> None:
        width, height = self._size
        # A slider may still stand where an earlier motion ended.
        first, last = sorted(self.span)
        self.picture = self.motion.picture(at=min(max(self.t, first), last), ghosts=4, width=width, height=height).to_svg()

    def render_static(self) -> str:
        """The present picture with its values as HTML, which exported notebooks keep."""
        said = ", ".join(f"{name} = {value:.4g}" for name, value in {**self.values, "t": self.t}.items())
        return f"<figure>{self.picture}<figcaption>{said}</figcaption></figure>"

    def _repr_mimebundle_(self, **keywords: Any) -> Any:
        found = super()._repr_mimebundle_(**keywords)
        if isinstance(found, tuple):
            found[0]["text/html"] = self.render_static()
        elif found is not None:
            found["text/html"] = self.render_static()
        return found
