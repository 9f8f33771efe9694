"""The pace at which iterations are shown is chosen in a menu and stored."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from hexmend.run import StoppingCriteria
from hexmend_app.state.run.pace import Pace
from hexmend_app.state.settings import settings
from tests.app.driving import choose
from tests.patience import PATIENCE


def test_a_pace_is_chosen_in_the_menu_and_stored(window):
    pace = Pace.EVERY
    action = window.action(f"pace_{pace.value}")
    action.trigger()
    window.refresh()
    assert window.session.run.view.pace is pace
    assert [one for one in Pace if window.action(f"pace_{one.value}").isChecked()] == [pace]
    assert Pace(settings.RUN_PACE.get()) is pace
    assert "Iterations in the view" in [one.text().replace("&", "") for one in _menu(window, "Smooth").actions()]


def _menu(window, title):
    return next(one.menu() for one in window.menuBar().actions() if one.text().replace("&", "") == title)


@pytest.mark.slow
def test_actions_and_sessions_have_the_result_and_not_what_is_shown_on_the_way(window, qtbot):
    session = window.session
    session.run.set_pace(Pace.EASED)
    choose(window, "local-sd", StoppingCriteria(max_iterations=8, tolerance=0))
    for act in (window.action("cut").trigger, session.to_data):
        with qtbot.waitSignal(session.run.ended, timeout=PATIENCE):
            window.refresh()
            window.action("run").trigger()
        qtbot.waitUntil(lambda: session.document.now is not session.document.recorded, timeout=PATIENCE)
        act()
        assert session.document.now is session.document.recorded
        assert not session.run.view.eased.active


@pytest.mark.slow
def test_keys_that_move_the_camera_leave_the_easing_and_others_end_it(window, qtbot):
    session, view = window.session, window.canvas.interactor
    session.run.set_pace(Pace.EASED)
    choose(window, "local-sd", StoppingCriteria(max_iterations=8, tolerance=0))
    with qtbot.waitSignal(session.run.ended, timeout=PATIENCE):
        window.refresh()
        window.action("run").trigger()
    assert session.run.view.eased.active
    direction = window.canvas.viewport.camera.GetDirectionOfProjection()
    QTest.keyClick(view, Qt.Key.Key_Right, Qt.KeyboardModifier.ShiftModifier)
    QTest.keyClick(view, Qt.Key.Key_Right)
    QTest.keyPress(view, Qt.Key.Key_Shift)
    window.action("fit").trigger()
    assert window.canvas.viewport.camera.GetDirectionOfProjection() != direction
    assert session.run.view.eased.active
    QTest.keyClick(view, Qt.Key.Key_Q)
    assert not session.run.view.eased.active
    assert session.document.now is session.document.recorded
