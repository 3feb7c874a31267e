"""Up to which length, ratio, speed and step an engine can be trusted.

May import models, records, reference, engines and checks.
"""
