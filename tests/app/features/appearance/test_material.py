"""Colours by material in the panel and the menu."""

import numpy as np
import pytest
from PySide6.QtWidgets import QComboBox

from hexmend.gallery import make
from hexmend_app.features.appearance.feature import FeatureAppearance
from hexmend_app.picture import Range
from hexmend_app.widgets.inputs.segmented import Segmented
from tests.app.driving import named
from tests.app.hosting import PlainHost, action


@pytest.fixture
def host(qapp):
    hexes = {"low": np.arange(32), "high": np.arange(32, 64)}
    host = PlainHost(make("cube", size=64).replace(hex_sets=hexes))
    host.feature = FeatureAppearance(host)
    yield host
    host.session.close()


def test_the_menu_switches_between_the_material_and_the_metric_before(host):
    view, switch = host.session.view, action(host.feature, "colour_by_material")
    view.colour_by("scaled-jacobian")
    host.feature.refresh()
    assert switch.enabled()
    switch.handle(True)
    assert (view.look.colours.metric, view.look.colours.range) == ("material", Range.FITTED)
    assert switch.checked()
    switch.handle(False)
    assert view.look.colours.metric == "scaled-jacobian"


@pytest.mark.parametrize("range", [Range.FULL, Range.ACCEPTABLE, Range.FITTED, (0.1, 0.5)])
def test_the_range_is_as_before_after_colours_by_material(host, range):
    view, switch = host.session.view, action(host.feature, "colour_by_material")
    view.change(colours={"metric": "q", "range": range})
    host.feature.refresh()
    for _ in (1, 2):
        switch.handle(True)
        switch.handle(False)
        assert (view.look.colours.metric, view.look.colours.range) == ("q", range)


def test_another_metric_after_the_material_has_a_range_of_its_own(host):
    view, panel = host.session.view, host.feature.panel
    view.change(colours={"metric": "q", "range": (0.1, 0.5)})
    host.feature.refresh()
    panel.choose_metric("material")
    panel.choose_metric("scaled-jacobian")
    assert view.look.colours.range is Range.FULL


def test_controls_of_values_are_disabled_for_materials(host):
    panel = host.feature.panel
    controls = [named(panel, QComboBox, "Colour map"), named(panel, Segmented, "Range")]
    panel.choose_metric("material")
    assert not any(control.isEnabled() for control in controls)
    panel.choose_metric("q")
    assert all(control.isEnabled() for control in controls)


def test_a_mesh_of_one_material_does_not_offer_the_switch(qapp):
    host = PlainHost(make("cube", size=8))
    assert not action(FeatureAppearance(host), "colour_by_material").enabled()
    host.session.close()
