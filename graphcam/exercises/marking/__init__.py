"""Marking: a submission beside the answer key, what explains it, and what the student is told."""
