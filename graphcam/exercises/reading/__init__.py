"""Answers as data: what a student hands in, read without executing anything of it."""
