"""The Score: events, document, codecs, takes."""
