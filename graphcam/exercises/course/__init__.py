"""A course: the students of a roster, and the handouts that each gets."""
