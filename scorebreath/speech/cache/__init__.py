"""What voices have said, kept by what they were asked for: a text compiled again speaks nothing again."""
