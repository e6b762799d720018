"""All that is compiled, and the only place that knows numba and LLVM.

Kernels are plain Python functions on floats and pointers. `build` turns them into machine code: numba types and lowers
them, LLVM optimises them for this processor, the object code is kept in a cache folder, and later runs load it from
there without importing numba. With ``NUMBA_DISABLE_JIT=1`` the same functions run as Python, on arrays instead of pointers.
"""
