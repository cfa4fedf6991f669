"""The cam as a part: what a workshop needs to make it, from the exact side."""
