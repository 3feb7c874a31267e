"""Physics engines behind one protocol; nothing else in furiko imports one."""

from .protocol import Engine, EngineInfo, Integrator, ModelFields, Quantity
from .registry import ENGINES, cannot, engine_info, engine_names, engine_version, load_engine
from .shapes import AnyShape

__all__ = [
    "ENGINES",
    "AnyShape",
    "Engine",
    "EngineInfo",
    "Integrator",
    "ModelFields",
    "Quantity",
    "cannot",
    "engine_info",
    "engine_names",
    "engine_version",
    "load_engine",
]
