"""Plots: values as matplotlib figures, and as pictures in a notebook; one module for each kind of value."""
