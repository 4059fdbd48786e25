"""Speech breathing for talking characters: text in; breath, voice and animation curves out."""
