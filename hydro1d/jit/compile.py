"""From a pass in plain Python to object code: numba types and lowers it, LLVM optimises it for this processor."""

from __future__ import annotations

import contextlib
import functools
import gc
import re
import threading
from collections.abc import Iterator
from typing import Any, NamedTuple

import llvmlite.binding as llvm

from hydro1d.jit.refusals import UNRESOLVED, NotCompilable, callers_of_themselves, makers_of_objects, noticed

INTEGERS = 4  # of a pass, behind the arguments that all share
# What machine code may call: the mathematics of the C library.
_LIBRARY = re.compile(
    r"(a?(sin|cos|tan)h?|atan2|exp|expm1|exp2|log|log1p|log2|log10|pow|sqrt|cbrt|hypot|fmod|floor|ceil|trunc|round|rint"
    r"|erf|erfc|lgamma|copysign|fabs|fmin|fmax|fma|memset|memcpy|memmove|llvm\..*)f?"
)
_PYTHON = re.compile(r"_?Py|numba_(gil|unpickle|do_raise)|NRT_")
_ADDRESS = re.compile(r"numba\.dynamic\.globals|inttoptr \(i64 \d+ to")  # of this process
_target: Any = None
_compiling = threading.RLock()


class MachineCode(NamedTuple):
    """Object code with one public symbol, ``kernel``; why it would not run in another process, else ""; and what must
    stay alive as long as it runs."""

    code: bytes
    perishes: str = ""
    holds: Any = None


def machine_code(make: Any, shared: Any, is_integer: list[bool], is_leaf: bool) -> MachineCode:
    """Compile the function that ``make`` returns, given `fresh.Copies`.

    ``shared`` is the numba type of its first argument, read from a table; ``is_integer`` tells which of its fields are
    integers and no arrays. A leaf promises that none of the arrays overlap, and calls nothing by address. Raises
    NotCompilable.
    """
    from numba import types

    from hydro1d.jit.fresh import Copies

    copies = Copies()
    kinds = (shared, *(types.int64,) * (INTEGERS if is_leaf else 0))
    with noticed(copies), _compiling, _only_lowered():
        dispatcher = copies.compiled(make(copies), error_model="numpy", fastmath={"contract", "arcp"})
        dispatcher.compile(kinds)
        text = dispatcher.inspect_llvm(kinds)
    if UNRESOLVED in text:
        raise NotCompilable(callers_of_themselves(text, copies.owners.values()), RuntimeError("it calls itself"))
    made = _emit(text, is_integer, is_leaf)
    if made is None:
        raise NotCompilable(makers_of_objects(text, copies.owners.values()), RuntimeError("it makes a Python object"))
    return made._replace(holds=copies) if made.perishes else made


@contextlib.contextmanager
def _only_lowered() -> Iterator[None]:
    """Keep numba from optimising: that comes once, for a pass with all that it calls, when it is known that no arrays overlap.

    Loops that numba had unrolled would not vectorise any more. Nor is there looking for garbage meanwhile: numba makes
    millions of objects and keeps most of them, and that takes 5 to 8 % of its time.
    """
    import numba

    config: Any = numba.config
    numba.njit(_nothing).compile(())  # numba sets its own machine up, with the level that it was given
    was_on, before = gc.isenabled(), config.OPT
    gc.disable()
    config.OPT = type(before)(0)
    try:
        yield
    finally:
        config.OPT = before
        if was_on:
            gc.enable()


def _nothing() -> None:
    pass


def _emit(text: str, is_integer: list[bool], is_leaf: bool) -> MachineCode | None:
    """None where it would need Python."""
    native = next(
        function.name
        for function in llvm.parse_assembly(text).functions
        if not function.is_declaration and function.linkage == llvm.Linkage.external
    )
    module = llvm.parse_assembly(_with_entry(text, native, is_integer, is_leaf))
    machine = target_machine()
    tuning = llvm.create_pipeline_tuning_options(speed_level=3)
    tuning.loop_vectorization = tuning.loop_interleaving = True
    tuning.inlining_threshold = 10_000 if is_leaf else 225
    passes = llvm.create_pass_builder(machine, tuning)
    for function in module.functions:
        if not function.is_declaration and function.name != "kernel":
            function.linkage = "internal"
            if is_leaf:
                function.add_function_attribute("noinline" if function.name == "body" else "alwaysinline")
    if is_leaf:  # all into `body`, which knows that no arrays overlap, and only then that into the entry
        first = llvm.create_new_module_pass_manager()
        first.add_always_inliner_pass()
        first.add_sroa_pass()
        first.run(module, passes)
        module = llvm.parse_assembly(re.sub(r"\bnoinline\b", "alwaysinline", str(module)))
    passes.getModulePassManager().run(module, passes)
    needed = [function.name for function in module.functions if function.is_declaration]
    if any(_PYTHON.match(name) for name in needed):
        return None
    strange = ", ".join(name for name in needed if not _LIBRARY.fullmatch(name))
    perishes = f"it calls {strange}, which only numba knows" if strange else ""
    if _ADDRESS.search(str(module)):
        perishes = "it holds an address (of an array of more than 1 MB, or of a function of another library)"
    return MachineCode(machine.emit_object(module), perishes)


def _with_entry(code: str, native: str, is_integer: list[bool], is_leaf: bool) -> str:
    """numba's module with an entry that takes the table of the shared argument.

    numba calls the C library's square root, which keeps a loop from being vectorised; LLVM's own is the same number.
    """
    code = re.sub(r"@sqrt\b", "@llvm.sqrt.f64", code)
    if "@llvm.sqrt.f64" in code and "declare double @llvm.sqrt.f64" not in code:
        code += "\ndeclare double @llvm.sqrt.f64(double)\n"
    return f"{code}\n{(_leaf if is_leaf else _caller)(_quoted(native), is_integer)}"


def _leaf(native: str, is_integer: list[bool]) -> str:
    """The entry of a pass, which reads the table once and hands on a copy.

    On the way the arrays are arguments that promise LLVM what numba cannot: that none of them overlap.
    """
    kinds = ["i64" if integer else "ptr" for integer in is_integer]
    own = ", ".join(f"i64 %i{k}" for k in range(INTEGERS))
    place = "getelementptr i64, ptr {} , i64 {}"
    reads = [f"  %t{k} = {place.format('%table', k)}\n  %a{k} = load {kind}, ptr %t{k}" for k, kind in enumerate(kinds)]
    writes = [f"  %c{k} = {place.format('%copy', k)}\n  store {kind} %a{k}, ptr %c{k}" for k, kind in enumerate(kinds)]
    passed = ", ".join(f"{kind} %a{k}" for k, kind in enumerate(kinds))
    return "\n".join([
        f"define internal i32 @body({passed.replace('ptr ', 'ptr noalias ')}, {own}) {{",
        f"  %copy = alloca [{len(kinds)} x i64]\n  %result = alloca ptr\n  %error = alloca ptr",
        *writes,
        f"  %status = call i32 @{native}(ptr %result, ptr %error, ptr %copy, {own})\n  ret i32 %status\n}}",
        f"define i32 @kernel(ptr %table, {own}) {{",
        *reads,
        f"  %status = call i32 @body({passed}, {own})\n{_RAISED}}}\n",
    ])  # fmt: skip


def _caller(native: str, _is_integer: list[bool]) -> str:
    """The entry of what calls passes."""
    flushes = "x86_64" in llvm.get_process_triple()
    flush, restore, declarations = _FLUSH if flushes else ("", "", "")
    return f"""
{declarations}
define i32 @kernel(ptr noalias readonly %table) {{
  %result = alloca ptr
  %error = alloca ptr
{flush}
  %status = call i32 @{native}(ptr %result, ptr %error, ptr %table)
{restore}
{_RAISED}}}
"""


# 1 where an exception was raised: numba's functions answer with 0, or -2 for None, where none was.
_RAISED = """  %something = icmp ne i32 %status, 0
  %other = icmp ne i32 %status, -2
  %both = and i1 %something, %other
  %raised = zext i1 %both to i32
  ret i32 %raised
"""


def _quoted(name: str) -> str:
    return name if re.fullmatch(r"[\w.$-]+", name) else f'"{name}"'


# Ahead of a wave the motion fades into numbers below 1e-308, on which these processors take a hundred times as long: inside
# a kernel such numbers count as zero (bits 6 and 15 of the control register).
_FLUSH = (
    """  %before = alloca i32
  %inside = alloca i32
  call void @llvm.x86.sse.stmxcsr(ptr %before)
  %control = load i32, ptr %before
  %flushing = or i32 %control, 32832
  store i32 %flushing, ptr %inside
  call void @llvm.x86.sse.ldmxcsr(ptr %inside)""",
    "  call void @llvm.x86.sse.ldmxcsr(ptr %before)",
    "declare void @llvm.x86.sse.stmxcsr(ptr)\ndeclare void @llvm.x86.sse.ldmxcsr(ptr)",
)


def target_machine() -> Any:
    """LLVM's description of this processor, for code and for its cache."""
    global _target
    if _target is None:
        llvm.initialize_native_target()
        llvm.initialize_native_asmprinter()
        _target = llvm.Target.from_default_triple()
    return _target.create_target_machine(cpu=llvm.get_host_cpu_name(), features=features(), opt=3, reloc="pic")


@functools.cache
def features() -> str:
    """This processor's, and its whole vector registers: LLVM is shy of them for the sake of code that uses few."""
    return ",".join([llvm.get_host_cpu_features().flatten(), "-prefer-256-bit"])
