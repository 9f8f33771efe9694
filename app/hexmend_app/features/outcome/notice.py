"""Notice at the end of a run: what it has changed."""

from __future__ import annotations

from hexmend.quality import Summary
from hexmend_app.state.mesh.run_record import RunRecord
from hexmend_app.translation import tr
from hexmend_app.widgets.wording import counted, figure


def notice(record: RunRecord, before: Summary, after: Summary) -> tuple[str, str]:
    """Return title and text of the notice.

    Parameters
    ----------
    record : RunRecord
        The run, which has ended with a result.
    before, after : Summary
        Of the mesh before the run and of its result.
    """
    if not record.result:
        return tr("Initial mesh kept: no iteration was better"), record.message
    inverted, invalid = (
        figure(now) if then == now else f"{figure(then)} → {figure(now)}"
        for then, now in ((before.inverted, after.inverted), (before.invalid, after.invalid))
    )
    counts = tr("{inverted} inverted · {invalid} invalid", inverted=inverted, invalid=invalid)
    minima = tr("q min {q} · scaled Jacobian min {j}", q=figure(after.q_min, 3), j=figure(after.scaled_jacobian_min, 3))
    seconds = record.rows[-1]["seconds"]
    digits = 2 if seconds < 10 else 1 if seconds < 100 else 0
    effort = f"{counted(record.newest, 'iteration')} · {seconds:.{digits}f} s"
    reason = record.message.partition(". ")[0].rstrip(".")
    kept = "" if record.result == record.newest else tr(" · iteration {number} was kept", number=record.result)
    return f"{counts} · {minima}", f"{effort} · {reason}{kept}"
