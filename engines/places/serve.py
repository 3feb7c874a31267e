"""The other end of the protocol in Python: an adapter of furiko's in the environment where its engine is.

It needs NumPy and the engine; of furiko it imports models and adapters, none of whose files needs another library.
Requests come on standard input, answers go to standard output; whatever the engine prints goes nowhere.
"""

from __future__ import annotations

import importlib
import os
import traceback
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ...models.errors import EngineMissing, InvalidInput
from ..workers.frames import Frames, framed
from .mechanisms import mechanism_of, spatial, system_of
from .messages import PROTOCOL, Array, decode, encode
from .questions import PLANAR, SPATIAL

Head = Mapping[str, Any]
Answer = tuple[dict[str, Any], dict[str, Any]]


def serve(module: str, planar: str, tree: str = "-", reader: str = "-") -> None:
    """Answer requests about the engine in ``module`` by the classes ``planar``, ``tree`` and ``reader``."""
    source, sink = os.dup(0), os.dup(1)
    nowhere = os.open(os.devnull, os.O_RDWR)
    os.dup2(nowhere, 0)
    os.dup2(nowhere, 1)
    answering = _Answering(module, {"planar": planar, "tree": tree, "reader": reader})
    frames = Frames()
    while True:
        content = frames.next()
        if content is None:
            part = os.read(source, 1 << 16)
            if not part:
                return
            frames.add(part)
            continue
        answer = memoryview(framed(answering.to(content)))
        while answer:
            answer = answer[os.write(sink, answer) :]


class _Answering:
    """The models that were built, and what is asked of them."""

    def __init__(self, module: str, adapters: dict[str, str]) -> None:
        self.module, self.adapters = module, {name: path for name, path in adapters.items() if path != "-"}
        self.models: dict[int, Any] = {}

    def to(self, content: bytes) -> bytes:
        """The content of the answer to a request: whatever goes wrong is an answer, too."""

        try:
            request = decode(content)
            return encode(*getattr(self, f"_{request.head['say']}")(request.head, request.arrays))
        except MemoryError:
            return encode({"say": "error", "kind": "failed", "what": "MemoryError: out of memory", "trace": ""})
        except Exception as error:
            return encode({"say": "error", **self._of(error)})

    def _of(self, error: Exception) -> dict[str, str]:

        words = " ".join(str(error).split())[:2000].encode("utf-8", "replace").decode()
        kinds = ((InvalidInput, "invalid"), (EngineMissing, "missing"), (ImportError, "missing"))
        kind = next((name for type_, name in kinds if isinstance(error, type_)), "failed")
        plain = isinstance(error, InvalidInput | EngineMissing)
        trace = "".join(traceback.format_exception(error))[-8000:].encode("utf-8", "replace").decode()
        return {"kind": kind, "what": words if plain else f"{type(error).__name__}: {words}", "trace": trace}

    def _hello(self, head: Head, arrays: Mapping[str, Array]) -> Answer:

        importlib.import_module(self.module)
        adapter = _named(self.adapters["planar"])
        questions = [name for name in PLANAR if hasattr(adapter, name)]
        return {"say": "hello", "protocol": PROTOCOL, "questions": questions}, {}

    def _build(self, head: Head, arrays: Mapping[str, Array]) -> Answer:

        content = head["mechanism"]
        if content["kind"] == "file":
            made = _named(self.adapters["reader"])(Path(content["path"]), content["language"], ())
        elif content["kind"] == "tree":
            made = _named(self.adapters["tree"])(mechanism_of(content))
        else:
            made = _named(self.adapters["planar"])(system_of(content))
        self.models[int(head["model"])] = made
        return {"say": "built"}, {}

    def _drop(self, head: Head, arrays: Mapping[str, Array]) -> Answer:
        self.models.pop(int(head["model"]), None)
        return {"say": "dropped"}, {}

    def _compiled(self, head: Head, arrays: Mapping[str, Array]) -> Answer:

        model = self.models[int(head["model"])]
        like = mechanism_of(head["like"]) if head.get("like") else None
        found = spatial(model.compiled(like))
        return {"say": "mechanism", "mechanism": found, "joints": list(model.joints())}, {}

    def _bind(self, head: Head, arrays: Mapping[str, Array]) -> Answer:

        bound = self.models[int(head["model"])].bind(mechanism_of(head["mechanism"]))
        self.models[int(head["bound"])] = bound
        return {"say": "built"}, {}

    def _ask(self, head: Head, arrays: Mapping[str, Array]) -> Answer:

        name = str(head["question"])
        question = (SPATIAL if head.get("spatial") else PLANAR)[name]
        words = {word: head[word] for word in question.words}
        model = self.models[int(head["model"])]
        method = getattr(model, name.removeprefix("driven_"))
        given = [arrays[array].copy() for array in question.takes]
        # Everything after the arrays that the protocol of adapters has by name alone is given by name.
        answer = method(*given, **words) if set(words) == {"gravity"} else method(*given, *words.values())
        if name == "fields":
            return {"say": "answer", "dofs": int(answer.dofs), "parents": [int(p) for p in answer.parents]}, {
                field: getattr(answer, field) for field in question.gives
            }
        if question.value:
            return {"say": "answer", "value": float(answer)}, {}
        several = answer if len(question.gives) > 1 else (answer,)
        return {"say": "answer"}, dict(zip(question.gives, several, strict=True))


def _named(path: str) -> Any:
    module, _, name = path.partition(":")
    return getattr(importlib.import_module(module), name)
