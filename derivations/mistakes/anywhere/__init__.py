"""Mistakes in the derivation of any planar mechanism, as what each adds to the energies or to the rows.

May import algebra and steps.
"""
