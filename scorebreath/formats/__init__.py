"""One file a format; each writer takes a stream."""
