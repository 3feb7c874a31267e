"""The engines that furiko has adapters for, as data: which there are, what each can do, how it computes.

May import engines/info.py.
"""
