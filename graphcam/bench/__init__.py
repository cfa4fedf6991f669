"""Speed against error: every construction beside its exact counterpart and beside what a user would take instead."""
