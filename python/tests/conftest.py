"""What the tests share."""

from __future__ import annotations

import json
import os
import subprocess
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]


def program() -> Path | None:
    """The command line, as the Rust tests have built it or as `CHETAEV_PROGRAM` names it."""
    named = os.environ.get("CHETAEV_PROGRAM")
    found = Path(named) if named else ROOT / "target" / "debug" / "chetaev"
    return found if found.exists() else None


@pytest.fixture(scope="session")
def command() -> Any:
    """Runs the command line; gives its JSON."""
    path = program()
    if path is None:
        pytest.fail("the command line is not built: cargo build -p chetaev-cli, or CHETAEV_PROGRAM names it")

    def run(*arguments: str, cwd: Path | None = None) -> Any:
        done = subprocess.run([str(path), *arguments, "--json"], cwd=cwd, capture_output=True, text=True, check=False)
        return json.loads(done.stdout)

    return run


@pytest.fixture(scope="session")
def gallery() -> Path:
    """The models of the gallery."""
    return ROOT / "gallery"
