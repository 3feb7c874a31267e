"""Physics engines behind one protocol; nothing else in furiko imports one."""

from .protocol import BareCall, Engine, EngineInfo, Integrator, ModelFields, Native, Quantity
from .registry import ENGINES, cannot, engine_info, engine_names, engine_version, load_engine
from .shapes import AnyShape

__all__ = [
    "ENGINES",
    "AnyShape",
    "BareCall",
    "Engine",
    "EngineInfo",
    "Integrator",
    "ModelFields",
    "Native",
    "Quantity",
    "cannot",
    "engine_info",
    "engine_names",
    "engine_version",
    "load_engine",
]
