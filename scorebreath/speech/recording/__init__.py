"""Speech that was recorded: a take, its transcript, and which word is where in it."""
