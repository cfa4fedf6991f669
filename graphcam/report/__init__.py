"""The files of a solution: sheets, note, tables, step player and profile, together in one folder."""
