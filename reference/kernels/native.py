"""Machine code of this processor from a module of LLVM's instructions. Needs llvmlite, not numba."""

from __future__ import annotations

from typing import Any

from ...models.errors import missing

try:
    from llvmlite import binding
except ImportError as error:
    raise missing("llvmlite", error) from error


def processor(name: str | None = None) -> Any:
    """LLVM's description of the processor that code is for: of this one, or of one of that name."""
    binding.initialize_native_target()
    binding.initialize_native_asmprinter()
    features = binding.get_host_cpu_features().flatten() if name is None else ""
    return binding.Target.from_default_triple().create_target_machine(
        opt=2, cpu=name or binding.get_host_cpu_name(), features=features, jit=True
    )


def loaded(module: Any, target: Any) -> Any:
    """The module as machine code in memory; the code lives as long as the engine that is returned."""
    engine = binding.create_mcjit_compiler(module, target)
    engine.finalize_object()
    return engine
