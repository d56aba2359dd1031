"""The models that come with Chetaev."""

from __future__ import annotations

import builtins
import json
import os
from collections.abc import Iterator
from typing import Any, overload

from . import chetaev_native as native
from .results import Result, write

_list = builtins.list


class Gallery(Result):
    """Names, titles and files of models; of all models it is a sequence of names."""

    def _listed(self) -> _list[Any]:
        return self._data if isinstance(self._data, _list) else [self._data]

    def __iter__(self) -> Iterator[str]:
        """The names."""
        return iter([str(own["name"]) for own in self._listed()])

    def __len__(self) -> int:
        return len(self._listed())

    def __contains__(self, name: object) -> bool:
        return any(own["name"] == name for own in self._listed())

    @overload
    def __getitem__(self, which: int) -> str: ...

    @overload
    def __getitem__(self, which: slice) -> _list[str]: ...

    def __getitem__(self, which: int | slice) -> str | _list[str]:
        """A name by its number, or several."""
        return [*self][which]


def list() -> Gallery:  # noqa: A001
    """All models.

    Returns
    -------
    Gallery
        A sequence of names; ``to_dict()`` has titles and files too.
    """
    data = json.loads(native.gallery()[0])
    width = max(len(own["name"]) for own in data)
    return Gallery(data, "\n".join(f"{own['name']:<{width}} {own['title']}" for own in data))


def describe(name: str) -> Gallery:
    """The description of a model.

    Parameters
    ----------
    name : str
        As :func:`list` names it.

    Returns
    -------
    Gallery
        Of this model; its text is the description.
    """
    data, _, description = native.gallery(name)
    return Gallery({**json.loads(data), "description": description}, description)


def copy(name: str, folder: str | os.PathLike[str] | None = None) -> Gallery:
    """Writes a model into a new folder, its own name when left out.

    Parameters
    ----------
    name : str
        As :func:`list` names it.
    folder : path, optional
        A folder that does not exist yet; one of the name of the model when left out.

    Returns
    -------
    Gallery
        Of this model, with the folder in its data.
    """
    data, texts, _ = native.gallery(name)
    target = os.fspath(folder if folder is not None else name.rsplit("/", 1)[-1])
    if os.path.exists(target):
        raise FileExistsError(f"{target} exists already; nothing was written")
    for path, text in texts:
        write(os.path.join(target, path), text.encode())
    return Gallery({**json.loads(data), "folder": target}, f"wrote {target}")


def texts(name: str) -> dict[str, Any]:
    """The files of a model, and of the others of its group, by path.

    Parameters
    ----------
    name : str
        As :func:`list` names it.

    Returns
    -------
    dict from str to str
        Texts by the paths of the files.
    """
    return dict(native.gallery(name)[1])
