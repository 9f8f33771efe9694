"""Comparison of methods with rules of motion, without a window."""

import numpy as np
import pytest

from hexmend import METHODS, MotionRules, StoppingCriteria, smooth
from hexmend_app.features.compare.feature import FeatureCompare
from hexmend_app.state.session import session_data
from tests.app.features.smooth.test_feature import two_materials

SHORT = StoppingCriteria(max_iterations=3, tolerance=0)
RULES = MotionRules(interfaces="free", fix=("inside",))


@pytest.fixture
def host(hosted):
    return hosted(two_materials())


def compared(host, qtbot, rules=RULES):
    comparison = host.session.comparison
    comparison.start([METHODS["local-sd"](), METHODS["laplacian"]()], SHORT, rules)
    qtbot.waitUntil(lambda: not comparison.busy)
    return comparison


def test_methods_are_compared_with_the_rules_and_their_meshes_have_none(host, qtbot):
    mesh, comparison = host.session.document.now.mesh, compared(host, qtbot)
    for result in comparison.results:
        expected = smooth(mesh, METHODS[result.row.method](), SHORT, interfaces="free", fix=("inside",))
        np.testing.assert_array_equal(result.state.mesh.points, expected.mesh.points)
        assert result.row.after == expected.after
        assert not result.state.mesh.node_rules.rules
        assert result.row.mesh is result.state.mesh
    inside = mesh.node_sets["inside"]
    np.testing.assert_array_equal(comparison.results[0].state.mesh.points[inside], mesh.points[inside])


def test_the_feature_compares_with_the_rules_of_the_next_run(host, qtbot):
    session = host.session
    feature = FeatureCompare(host)
    session.run_setup.set_rules(RULES)
    feature.panel.model.tick(["local-sd"])
    feature.run()
    qtbot.waitUntil(lambda: not session.comparison.busy)
    assert session.comparison.to_data().rules == RULES


def test_rules_that_do_not_fit_fail_every_method(host, qtbot):
    comparison = compared(host, qtbot, MotionRules(fix=("nowhere",)))
    assert [result.row.outcome for result in comparison.results] == ["failed", "failed"]
    assert "nowhere" in comparison.results[0].row.message
    assert comparison.results[0].state is None


def test_sessions_have_the_rules_of_a_comparison(host, qtbot, tmp_path):
    compared(host, qtbot)
    session_data.write(tmp_path / "a.hexmend", host.session.to_data())
    data = session_data.read(tmp_path / "a.hexmend")
    assert data.comparison.rules == RULES
    assert [row.method for row in data.comparison.rows] == ["local-sd", "laplacian"]
