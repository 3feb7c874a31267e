"""Planted faults in model files, engines, readers and runs, and sound models that look as if they had one.

Everything is made from a mechanism drawn at random. A fault is in a model file, or in a real engine that was built on
the faulty mechanism and is asked through an adapter that knows only the sound one: never in the equations under test.
"""
