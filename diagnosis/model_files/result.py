"""The result of ``furiko diagnose``: verdict, findings and what each engine compiled, as JSON and as text."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from ...models.mechanism import Hinge, Mechanism
from ..finding import CAUSES, Finding

HINGE_NUMBERS = ("armature", "damping", "friction", "stiffness", "rest", "limits")


@dataclass(frozen=True)
class Diagnosis:
    """``verdict``: ``agrees``, ``differs`` or ``unexplained``; ``findings``: the likeliest cause first; ``engines``:
    for each engine what it compiled, or why it did not; ``notes``: what was assumed; ``against``: the name of what the
    file was compared with; ``mechanism``: the planar tree that was read, as :func:`mechanism_to_json` gives it."""

    model: str
    verdict: str
    findings: tuple[Finding, ...]
    engines: Mapping[str, Mapping[str, Any]]
    notes: tuple[str, ...] = ()
    against: str = ""
    mechanism: Mapping[str, Any] = field(default_factory=dict)

    @property
    def exit_status(self) -> int:
        """0 agrees, 1 differs, 3 where no engine could be asked."""
        if self.findings:
            return 1
        return 0 if any(e["status"] == "agrees" for e in self.engines.values()) else 3

    def to_json(self) -> dict[str, Any]:
        """The document that ``furiko diagnose --json`` prints."""
        return {
            "verdict": self.verdict,
            "findings": [finding.to_json() for finding in self.findings],
            "engines": {name: dict(engine) for name, engine in self.engines.items()},
            "model": self.model,
            "against": self.against or None,
            "mechanism": dict(self.mechanism),
            "notes": list(self.notes),
        }

    def text(self) -> str:
        """The text that ``furiko diagnose`` prints."""
        lines = [f"{self.model}: {self.verdict}" + (f" (against {self.against})" if self.against else "")]
        links = self.mechanism.get("links", [])
        lines.append(f"  a planar tree of {len(links)} link{'s' * (len(links) != 1)}")
        for name, engine in self.engines.items():
            says = engine.get("says", "")
            lines.append(f"  {name:16} {engine['status']}" + (f": {says}" if says else ""))
        for finding in self.findings:
            lines.append(f"  {finding.cause} at {finding.where}")
            lines.append(f"      {finding.says}")
            lines.append(f"      {finding.cause}: {CAUSES[finding.cause]}")
        for found in (found for engine in self.engines.values() for found in engine.get("motion", ())):
            lines.append(f"  in its time steps: {found['cause']} at {found['where']}")
            lines.append(f"      {found['says']}")
            lines.append(f"      {found['cause']}: {CAUSES[found['cause']]}")
        lines += [f"  note: {note}" for note in self.notes]
        return "\n".join(lines)


def mechanism_to_json(mechanism: Mechanism) -> dict[str, Any]:
    """A mechanism for a report, SI units: gravity in the file's world; points (along, across) in the links' frames."""
    ideal = Hinge()
    links = []
    for i, (link, hinge) in enumerate(zip(mechanism.links, mechanism.hinges, strict=True)):
        not_ideal = {
            "stops" if name == "limits" else "stops" if name == "limits" else name: getattr(hinge, name)
            for name in HINGE_NUMBERS
            if getattr(hinge, name) != getattr(ideal, name)
        }
        links.append(
            {
                "name": mechanism.link_names[i],
                "joint": hinge.name,
                "on": mechanism.link_names[link.parent] if link.parent >= 0 else None,
                "hinge": list(link.hinge),
                "centre of mass": list(link.com),
                "mass": link.mass,
                "inertia": link.inertia,
                **not_ideal,
            }
        )
    return {"gravity": list(mechanism.gravity_vector), "links": links}
