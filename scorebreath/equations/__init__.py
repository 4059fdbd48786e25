"""The papers' equations and the physiology: one function an equation, numbers in and out."""
