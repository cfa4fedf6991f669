"""Tasks: what an assignment gives, as frozen dataclasses, and the files that they are read from."""
