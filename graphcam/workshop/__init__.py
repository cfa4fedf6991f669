"""The cam as a part: drawings and files with which a workshop makes it, from the exact side."""
