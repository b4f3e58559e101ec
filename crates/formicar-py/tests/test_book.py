"""The examples that readers see: of the book, the README, the docstrings and the folder."""

from __future__ import annotations

import doctest
import importlib
import os
import pkgutil
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import formicar

ROOT = Path(__file__).parents[3]
PAGES = ["README.md", "crates/formicar-py/README.md", *sorted(
    str(page.relative_to(ROOT)) for page in (ROOT / "docs/src").glob("python*.md")
)]  # fmt: skip
EXAMPLES = sorted((ROOT / "crates/formicar-py/examples").glob("0*.py"))
MODULES = [module.name for module in pkgutil.iter_modules(formicar.__path__)]


def blocks(page: str) -> list[str]:
    """Return the Python of a page."""
    return re.findall(r"^```python\n(.*?)^```", (ROOT / page).read_text(), re.M | re.S)


@pytest.mark.parametrize("page", PAGES)
def test_a_page_runs_from_top_to_bottom(
    page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    found = blocks(page)
    assert found
    names: dict[str, Any] = {"__name__": "__main__"}
    for i, block in enumerate(found):
        exec(compile(block, f"{page}, block {i + 1}", "exec"), names)


@pytest.mark.parametrize("page", [page for page in PAGES if "docs" in page])
def test_what_a_page_shows_is_what_is_printed(
    page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    text = (ROOT / page).read_text()
    pairs = re.findall(r"^```(python|text)\n(.*?)^```", text, re.M | re.S)
    names: dict[str, Any] = {"__name__": "__main__"}
    for kind, block in pairs:
        if kind == "python":
            capsys.readouterr()
            exec(compile(block, page, "exec"), names)
        else:
            assert capsys.readouterr().out == block


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_an_example_runs(example: Path, tmp_path: Path) -> None:
    environment = {**os.environ, "PYTHONWARNINGS": "error"}
    ran = subprocess.run(
        [sys.executable, example], cwd=tmp_path, env=environment, capture_output=True, text=True,
        check=False,
    )  # fmt: skip
    assert (ran.returncode, ran.stderr) == (0, "")
    assert ran.stdout
    assert len(example.read_text().splitlines()) <= 60


@pytest.mark.parametrize("name", MODULES)
def test_docstrings_show_what_happens(name: str) -> None:
    if name == "ray":
        pytest.importorskip("ray")
    module = importlib.import_module(f"formicar.{name}")
    result = doctest.testmod(module, optionflags=doctest.NORMALIZE_WHITESPACE)
    assert result.failed == 0


def test_the_docstring_of_the_package_is_an_example() -> None:
    result = doctest.testmod(formicar, optionflags=doctest.NORMALIZE_WHITESPACE)
    assert result.failed == 0 and result.attempted > 5


def test_the_notebook_runs_and_shows_its_pictures(tmp_path: Path) -> None:
    import nbformat
    from nbclient import NotebookClient

    notebook = nbformat.read(ROOT / "crates/formicar-py/examples/formicar.ipynb", as_version=4)  # type: ignore[no-untyped-call]
    assert not [output for cell in notebook.cells for output in cell.get("outputs", [])]
    NotebookClient(notebook, timeout=120, resources={"metadata": {"path": tmp_path}}).execute()
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    assert not [output for output in outputs if output["output_type"] == "error"]
    kinds = [kind for output in outputs for kind in output.get("data", {})]
    assert kinds.count("image/png") == 3 and kinds.count("image/svg+xml") == 3
    assert kinds.count("text/html") == 2
