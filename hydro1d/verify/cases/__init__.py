"""One file a case, or a small family of cases: each file lists them under `CASES`."""
