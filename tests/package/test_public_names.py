"""What ``import furiko`` promises: every name is there, is documented, and means the same to a type checker."""

import ast
import inspect
from pathlib import Path

import pytest

import furiko

SOURCE = ast.parse(Path(furiko.__file__).read_text(encoding="utf-8"))


def typed():
    """Names and modules that a type checker sees."""
    (block,) = (node for node in SOURCE.body if isinstance(node, ast.If))
    return {name.name: node.module for node in block.body if node.level for name in node.names}


def test_one_list_three_times():
    assert list(furiko._HOMES) == sorted(furiko.__all__) == furiko.__all__
    assert typed() == furiko._HOMES


@pytest.mark.parametrize("name", furiko.__all__)
def test_a_name_is_there_and_documented(name):
    found = getattr(furiko, name)
    assert name in dir(furiko)
    assert inspect.getdoc(found)
    if not inspect.isclass(found):
        assert all(
            parameter.annotation is not inspect.Parameter.empty
            for parameter in inspect.signature(found).parameters.values()
        )


def test_an_unknown_name_is_an_attribute_error():
    with pytest.raises(AttributeError, match="'furiko' has no attribute 'simulat'"):
        furiko.simulat  # noqa: B018
