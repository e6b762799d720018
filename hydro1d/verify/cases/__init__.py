"""One file a case, or a small family of cases."""
