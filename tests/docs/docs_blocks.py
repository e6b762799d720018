"""Code blocks of a Markdown page, and how each kind is tried."""

from __future__ import annotations

import contextlib
import doctest
import io
import os
import re
import shlex
import shutil
import subprocess
import sys
import tomllib
import types
from pathlib import Path
from typing import NamedTuple

from hydro1d import load_deck
from hydro1d.cli import main

KINDS = ("python", "pycon", "toml", "console")
INSTALLS = ("python3", "pip")  # the README's own commands are tried by continuous integration
READERS = ("ncdump", "h5dump")
BASE = """
[material.foam]
law = "trilinear"
density = 51.6
modulus = 22e6
plateau_stress = 0.8e6
densification_strain = 0.689
locking_modulus = 40e6
[left]
type = "pressure"
pulse = "constant"
peak = 1e6
[right]
type = "wall"
[time]
end = 8e-3
"""


class Block(NamedTuple):
    """A fenced block: its language, text, and the line of the page it starts on, counted from 1."""

    kind: str
    text: str
    line: int

    @property
    def file(self) -> str | None:
        """The file that the block is, if its first line says so: ``# my_foam.py``."""
        found = re.match(r"# ([\w.-]+\.(?:py|toml|csv))\n", self.text)
        return found[1] if found else None


def blocks(page: Path) -> list[Block]:
    """The blocks of a page that can be tried; one after a comment ``<!-- not run: why -->`` is left out."""
    found, lines = [], page.read_text(encoding="utf-8").split("\n")
    fence, kind, start, skip = "", "", 0, False
    for number, line in enumerate(lines):
        opening = re.match(r"(`{3,}|~{3,}|:{3,})(.*)$", line)
        if not fence and opening:
            fence, kind, start = opening[1], opening[2].strip(), number + 1
            skip = number > 0 and lines[number - 1].startswith("<!-- not run:")
        elif fence and line.strip() == fence:
            if kind in KINDS and not skip:
                found.append(Block(kind, "\n".join(lines[start:number]) + "\n", start + 1))
            fence = ""
    assert not fence, f"{page}: a block is not closed"
    return found


class Session:
    """The blocks of one page, tried in order in one folder and one namespace."""

    def __init__(self, page: Path) -> None:
        self.page = page
        self.module = types.ModuleType("page_" + re.sub(r"\W", "_", page.stem))
        self.source = Path(f"{self.module.__name__}.py").resolve()
        self.module.__file__ = str(self.source)
        sys.modules[self.module.__name__] = self.module
        python = {block.line: block.text for block in blocks(page) if block.kind == "python"}
        text, line = "", 1
        for start, code in sorted(python.items()):  # at the page's own line numbers
            text += "\n" * (start - line) + code
            line = start + code.count("\n")
        self.source.write_text(text, encoding="utf-8")

    def try_block(self, block: Block) -> None:
        """Raise AssertionError, or the block's own error."""
        if block.file is not None:
            Path(block.file).write_text(block.text, encoding="utf-8")
        getattr(self, f"_{block.kind}")(block)

    def _python(self, block: Block) -> None:
        code = compile("\n" * (block.line - 1) + block.text, str(self.source), "exec")
        with contextlib.redirect_stdout(io.StringIO()):
            exec(code, self.module.__dict__)

    def _pycon(self, block: Block) -> None:
        name, flags = f"{self.page.name}:{block.line}", doctest.ELLIPSIS
        test = doctest.DocTestParser().get_doctest(block.text, {}, name, str(self.page), block.line - 1)
        test.globs, said = self.module.__dict__, io.StringIO()
        doctest.DocTestRunner(optionflags=flags, verbose=False).run(test, out=said.write, clear_globs=False)
        assert not said.getvalue(), said.getvalue()

    def _toml(self, block: Block) -> None:
        data = tomllib.loads(block.text)
        if block.file is not None:
            return
        if "deck" in data:  # a sweep
            from hydro1d.sweep import load_sweep

            path = Path("block.sweep.toml")
            path.write_text(block.text, encoding="utf-8")
            load_sweep(path)
            return
        base = tomllib.loads(BASE)
        if "material" in data:
            base["material"] = data["material"]
        material = next(iter(base["material"]))
        base["layer"] = [{"material": material, "thickness": 1.0, "zones": 10}]
        load_deck({**base, **data})

    def _console(self, block: Block) -> None:
        commands = re.split(r"^\$ ", block.text, flags=re.MULTILINE)
        assert commands[0] == "", f"{self.page.name}:{block.line}: a console block starts with $"
        code = 0
        for number, command in enumerate(commands[1:], 1):
            line, _, expected = command.partition("\n")
            if line == "echo $?":
                assert expected.strip() == str(code), f"{self.page.name}:{block.line}: exit code {code}"
                continue
            asked = commands[number + 1 : number + 2] and commands[number + 1].startswith("echo $?")
            done = run(line)
            if done is None:
                continue
            code, said = done
            assert code == 0 or asked, f"{self.page.name}:{block.line}: {line}\n{said}"
            assert not expected.strip() or matches(expected, said), f"{self.page.name}:{block.line}: {line}\n{said}"


def run(line: str) -> tuple[int, str] | None:
    """Exit code and output of a command; None for those that are not tried here."""
    words = shlex.split(line)
    given = {}
    while re.match(r"[A-Z_0-9]+=", words[0]):
        name, _, value = words.pop(0).partition("=")
        given[name] = value
    if words[0] in INSTALLS or words[0].startswith(".venv/"):
        return None
    if words[0] in READERS and shutil.which(words[0]) is None:
        return None
    if words[0] == "hydro1d" and not given:
        said = io.StringIO()
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            code = main(words[1:])
        return code, said.getvalue()
    if words[0] == "hydro1d":
        words[:1] = [sys.executable, "-m", "hydro1d.cli"]
    if words[:1] == ["python"] and words[1].startswith("tools/"):
        words[0] = sys.executable
    assert words[0] in (*READERS, sys.executable), f"unknown command {line!r}"
    done = subprocess.run(
        words, env={**os.environ, **given}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=120
    )
    return done.returncode, done.stdout


def matches(expected: str, said: str) -> bool:
    """Whether the output is as the page shows it; … stands for anything in a line, or, alone, for any lines."""
    pattern = ""
    for line in expected.strip("\n").split("\n"):
        text = "[^\n]*".join(re.escape(part) for part in line.split("…"))
        pattern += "(?:[^\n]*\n)*" if line.strip() == "…" else text + " *\n"
    return re.fullmatch(pattern, said.rstrip("\n") + "\n") is not None
