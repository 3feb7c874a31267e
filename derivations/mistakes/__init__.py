"""The catalogue of mistakes: every operator at every place of a derivation."""
