"""What a voice said, given another melody or effort afterwards: no time moves, and what is not asked for stays."""
