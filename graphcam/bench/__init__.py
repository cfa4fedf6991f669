"""Speed against error: every construction beside its exact counterpart and the usual alternatives."""
