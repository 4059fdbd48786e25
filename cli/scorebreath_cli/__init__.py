"""The command line of scorebreath."""
