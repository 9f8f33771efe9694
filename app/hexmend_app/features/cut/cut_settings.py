"""Cuts that the panel has or proposes."""

from __future__ import annotations

from dataclasses import dataclass

from hexmend_app.picture.cut import Cut, CutKind


@dataclass(frozen=True)
class CutPanelSettings:
    """The current or proposed cuts, one of each kind, and which of them is selected."""

    cuts: tuple[Cut, ...]
    kind: CutKind

    def __post_init__(self) -> None:
        if [cut.kind for cut in self.cuts] != list(CutKind) or not all(cut.absolute for cut in self.cuts):
            raise ValueError(f"the proposed cuts are not one of each kind: expected {', '.join(CutKind)}")

    @property
    def by_kind(self) -> dict[CutKind, Cut]:
        """The cuts by their kind."""
        return dict(zip(CutKind, self.cuts, strict=True))
