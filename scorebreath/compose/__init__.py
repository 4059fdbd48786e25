"""Groups and utterances become placed events, step by step; one file a breathing model."""
