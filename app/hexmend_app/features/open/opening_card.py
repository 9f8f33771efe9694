"""Card after opening a mesh: what it is, what is wrong with it, and what to do next."""

from __future__ import annotations

from collections.abc import Sequence

from hexmend.doctor import Finding
from hexmend_app.state.mesh.document import State
from hexmend_app.translation import tr
from hexmend_app.widgets.wording import counted, figure

#: Minimum scaled Jacobian above which a mesh without invalid hexes is called sound.
_SOUND = 0.2


def card(name: str, state: State, findings: Sequence[Finding]) -> tuple[str, str]:
    """Return title and text of the card.

    Parameters
    ----------
    name : str
        Name of the file.
    state : State
        The mesh as opened.
    findings : sequence of Finding
        Of the doctor, as far as they are known.
    """
    mesh, summary = state.mesh, state.summary
    hexes = counted(summary.hexes, "hex")
    counts = {"inverted": figure(summary.inverted), "invalid": figure(summary.invalid)}
    title = tr("{name}: {hexes}, {inverted} inverted, {invalid} invalid", name=name, hexes=hexes, **counts)
    least = figure(summary.scaled_jacobian_min, 3)
    sentences = [tr("{verdict} Minimum scaled Jacobian {least}.", verdict=_verdict(state), least=least)]
    if mesh.materials is not None:
        sentences.append(f"{counted(len(mesh.materials.names), 'material')}.")
    sentences += mesh.notes
    if findings:
        sentences.append(tr("The doctor found: {findings}", findings=" ".join(one.message for one in findings)))
    return title, " ".join(sentences)


def _verdict(state: State) -> str:
    summary = state.summary
    if summary.inverted:
        locked = summary.locked_inverted
        if locked == summary.inverted:
            return tr(
                "Solvers reject this mesh. Fixed nodes keep all inverted hexes inverted: let the boundary slide, or "
                "unpin nodes."
            )
        locked_part = tr(", of which fixed nodes lock {count}", count=figure(locked)) if locked else ""
        return tr("Solvers reject inverted hexes{locked}. Run Mend to untangle them.", locked=locked_part)
    if summary.invalid:
        hexes = counted(summary.invalid, "hex")
        return tr("Solvers may reject {hexes} invalid inside, between valid corners. Run Mend.", hexes=hexes)
    if summary.scaled_jacobian_min < _SOUND:
        return tr("No hex is invalid, but some have a low quality. Run Mend to improve them.")
    return tr("No hex is invalid.")
