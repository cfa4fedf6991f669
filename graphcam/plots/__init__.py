"""Plots: values as figures of matplotlib and as pictures of a notebook, one module for each kind of value."""
