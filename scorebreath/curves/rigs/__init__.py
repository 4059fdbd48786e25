"""From channels to a character's own shapes: a rig is a table."""
