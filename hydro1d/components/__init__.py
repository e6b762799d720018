"""What laws, boundaries and loads share: parameters with units, plug-ins, tables."""
