"""Where the drawn and the exact side meet: every drawn quantity beside its exact value, and how far it may be off."""
