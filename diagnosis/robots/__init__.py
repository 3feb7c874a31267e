"""A user's robot in each engine, in space: does the engine hold what the file says, and compute what it holds?

:mod:`.moving_links` describes a mechanism so that two readings of it can be compared, whatever frames they use;
:mod:`.fields` compares them, in the bodies' own frames where these are the same (:mod:`.own_frames`);
:mod:`.measures` holds an engine's answers against the truth of what it holds;
:mod:`.misreadings` finds the mistake in reading that makes furiko's own reader read what the engine read.
May import: models, reference, engines, and the rest of diagnosis but for ``model_files``.
"""
