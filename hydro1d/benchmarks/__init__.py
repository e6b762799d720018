"""How fast is it: hydro1d beside a C reference, plain numpy and what the memory allows."""
