"""Reads text as a user's file with an engine."""

import pytest

from furiko.engines.model_files.robot import ROBOT_READERS


@pytest.fixture
def read(tmp_path):
    """Writes a file and has an engine read it."""

    def made(engine, text, folders=()):
        language = "urdf" if "<robot" in text else "mjcf"
        path = tmp_path / f"model.{'xml' if language == 'mjcf' else 'urdf'}"
        path.write_text(text)
        return ROBOT_READERS[engine].load(path, language, folders)

    return made
