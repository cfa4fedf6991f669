"""From a task to a solution: the constructions drawn, the same cam computed, and the two beside each other."""
