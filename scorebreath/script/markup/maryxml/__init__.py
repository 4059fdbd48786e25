"""MaryXML, the documents of MaryTTS, in its older and newer forms and as S3 shows it (A9, A12)."""
