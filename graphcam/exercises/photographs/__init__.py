"""Photographs of worksheets: whose each is, what is read off it, and what becomes of it."""
