"""Sweeps: extremes and feasibility of millions of cams at once, by the same formulas as those of one cam."""
