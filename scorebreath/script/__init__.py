"""Text in, Script out: words, edges, sentences, spoken forms."""
