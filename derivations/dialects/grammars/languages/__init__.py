"""One module for each language: what tells it from others, and what its signs mean, as data. Imports nothing."""
