"""What a solution is handed in as: sheets, note, tables, step player and profile, together in one folder."""
