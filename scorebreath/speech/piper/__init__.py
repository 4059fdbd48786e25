"""Piper: neural voices (VITS) that give the exact length of every phone, in a worker; `joe` comes as a package."""
