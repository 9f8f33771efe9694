"""The pace at which iterations are shown is chosen in a menu and stored."""

from hexmend_app.state.run.pace import Pace
from hexmend_app.state.settings import settings


def test_a_pace_is_chosen_in_the_menu_and_stored(window):
    pace = Pace.EVERY
    action = window.action(f"pace_{pace.value}")
    action.trigger()
    window.refresh()
    assert window.session.run.pace is pace
    assert [one for one in Pace if window.action(f"pace_{one.value}").isChecked()] == [pace]
    assert Pace(settings.RUN_PACE.get()) is pace
    assert "Iterations in the view" in [one.text().replace("&", "") for one in _menu(window, "Smooth").actions()]


def _menu(window, title):
    return next(one.menu() for one in window.menuBar().actions() if one.text().replace("&", "") == title)
