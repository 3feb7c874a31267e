"""A fault in a module's source, for as long as a test lasts."""

import inspect


def plant(monkeypatch, module, name, old, new):
    """Replace ``module.name`` by the same function with ``old`` written as ``new``; ``old`` must be there once."""
    source = inspect.getsource(getattr(module, name))
    assert source.count(old) == 1, (name, old)
    scope = dict(vars(module))
    exec(compile(source.replace(old, new), module.__file__, "exec", flags=0x1000000), scope)
    monkeypatch.setattr(module, name, scope[name])
