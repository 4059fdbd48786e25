"""Pictures and pages about a Score."""
