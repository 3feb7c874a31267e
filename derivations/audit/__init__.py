"""Each of the documents' numbered equations against first principles.

May import models, reference and the rest of derivations.
"""
