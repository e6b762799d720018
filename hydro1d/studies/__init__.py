"""Studies of published work, reproduced figure by figure."""
