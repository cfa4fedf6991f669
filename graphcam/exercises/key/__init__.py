"""The answer key of a variant: what is right, how far off a careful hand is, what every mistake would answer."""
