"""What the task gives: motion laws and phases, the follower, the roller rule, the stations."""
