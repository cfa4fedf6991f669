"""What the records say: grades for a spreadsheet, a report on the group, a page for every student."""
