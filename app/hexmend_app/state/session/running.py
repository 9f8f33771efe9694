"""Session of a window in which a run is active, as it is saved automatically: as if the run had ended now."""

from __future__ import annotations

from dataclasses import replace

from hexmend_app.state.mesh.document import Change
from hexmend_app.state.mesh.history import RunRecord
from hexmend_app.state.run.worker import IterationFrame
from hexmend_app.state.session.session_data import SessionData
from hexmend_app.translation import tr


def ended_now(data: SessionData, record: RunRecord, newest: IterationFrame) -> SessionData:
    """Return the data of a session in which the active run has ended with its newest iteration.

    Positions of earlier iterations of this run are left out, so that little is written.

    Parameters
    ----------
    data : SessionData
        Made after `newest` was recorded.
    record : RunRecord
        Of the active run.
    newest : IterationFrame
    """
    at = next(k for k, one in enumerate(data.history.records) if one.name == record.name)
    number, state, message = newest.iteration.number, newest.state, tr("cut short")
    ended = replace(data.history.records[at], result=number, end=state, message=message, offsets=())
    records = (*data.history.records[:at], ended, *data.history.records[at + 1 :])
    moments = (*(moment for moment in data.history.moments if moment[0] is not state), (state, at, number))
    before = data.document.changes[: data.document.at + 1]
    document = replace(data.document, changes=(*before, Change(record.title, state)), at=len(before), now=state)
    return replace(data, document=document, history=replace(data.history, records=records, moments=moments))
