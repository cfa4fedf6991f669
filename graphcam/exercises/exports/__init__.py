"""Exercises for other systems: question banks, courses, autograders."""
