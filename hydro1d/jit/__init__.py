"""The compiler: from passes in plain Python on named records to machine code. It knows no physics."""
