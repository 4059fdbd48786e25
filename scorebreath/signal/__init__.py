"""Arrays of samples: level, pitch, resampling, limiting."""
