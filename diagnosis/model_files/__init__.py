"""``furiko diagnose``: a model file of the user's, in every engine that reads it, against the theory."""
