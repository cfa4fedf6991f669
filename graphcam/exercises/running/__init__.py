"""Students' code, run where it can do no harm; what comes out of it is untrusted data."""
