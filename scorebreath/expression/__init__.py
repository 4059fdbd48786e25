"""What a face does while it speaks and breathes: rules as tables, from placed events."""
