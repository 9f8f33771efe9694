"""What scripts rely on: a mesh or its file, settings by name, values of metrics, the worst hexes, short texts."""

import re

import numpy as np
import pytest

import hexmend as hx
from hexmend.errors import FileError, ParameterError
from hexmend.quality import METRICS, worst_hexes

MESH = hx.gallery.make("bridge-sharp", size=500, scramble=0.4, seed=1)


def test_a_mesh_is_smoothed_by_the_default_method_where_none_is_named():
    result = hx.smooth(MESH)
    assert result.method == "mend"
    assert result.after.inverted == 0 < result.before.inverted
    assert next(hx.iterate(MESH)).number == 1


def test_a_file_is_smoothed_with_settings_by_their_names(tmp_path):
    hx.write(tmp_path / "in.inp", MESH)
    by_name = hx.smooth(str(tmp_path / "in.inp"), max_iterations=3, boundary="slide")
    assert by_name.parameters["boundary"] == "slide"
    assert by_name.iterations <= 3
    whole = hx.smooth(hx.read(tmp_path / "in.inp"), hx.Mend(boundary="slide"), hx.StoppingCriteria(max_iterations=3))
    np.testing.assert_array_equal(by_name.mesh.points, whole.mesh.points)


def test_settings_go_before_what_the_method_and_the_limits_say():
    method, stop = hx.LocalSteepestDescent(p=4, order="natural"), hx.StoppingCriteria(max_iterations=9, tolerance=0)
    run = hx.iterate(MESH, method, stop, p=3, max_iterations=2)
    assert (run.smoother.p, run.smoother.order) == (3, "natural")
    assert [it.number for it in run] == [1, 2]
    assert run.result().stages[0].stop == hx.StoppingCriteria(max_iterations=2, tolerance=0)
    assert (method.p, stop.max_iterations) == (4, 9)


def test_limits_by_name_hold_for_every_stage_of_a_recipe():
    result = hx.smooth(MESH, hx.Recipe.of("laplacian", "local-sd"), max_iterations=1, keep_last=True)
    assert [stage.iterations for stage in result.stages] == [1, 1]
    assert all(stage.stop.keep_last for stage in result.stages)


@pytest.mark.parametrize(("smoother", "settings", "words"), [
    ("mend", {"max_itertions": 3}, "mend has no parameter 'max_itertions': did you mean max_iterations"),
    ("laplacian", {"bounday": "slide"}, "laplacian has no parameter 'bounday': did you mean boundary"),
    ("mend", {"boundary": "slid"}, "boundary = 'slid' is unknown: expected one of fixed, slide"),
    ("mend", {"max_iterations": -1}, "max_iterations = -1 is out of range"),
    (hx.Recipe.of("getme"), {"boundary": "slide"}, "recipe has no parameter 'boundary': set it for the methods of its stages; "
     "known: keep_last, max_it"),
    ("laplacian", {"goal": "shape"}, "laplacian has no parameter 'goal': it is a parameter of mend; known: "),
    ("mend", {"interface": "slide"}, "mend has no parameter 'interface': did you mean interfaces? known: "),
    ("mend", {"goal": "scaled_jacobain"}, "time-step; did you mean scaled-jacobian?"),
    ("mendd", {}, "there is no method 'mendd': did you mean mend"),
])  # fmt: skip
def test_settings_that_nobody_has_are_refused(smoother, settings, words):
    with pytest.raises(ParameterError, match=re.escape(words)):
        hx.smooth(MESH, smoother, **settings)


def test_what_is_no_mesh_or_no_method_is_said(tmp_path):
    with pytest.raises(TypeError, match=r"int is not a mesh: expected a hexmend.Mesh or the path of a file"):
        hx.smooth(3)
    with pytest.raises(TypeError, match=r"int is not a method: expected a hexmend.Smoother, a Recipe or a name"):
        hx.smooth(MESH, 3)
    with pytest.raises(FileError, match=r"nowhere\.vtu"):
        hx.smooth(tmp_path / "nowhere.vtu")


def test_a_mesh_gives_the_values_of_every_metric():
    figures = hx.measure(MESH.points, MESH.hexes)
    for name, metric in METRICS.items():
        np.testing.assert_array_equal(MESH.quality(name), metric.of(MESH.points, MESH.hexes, figures))
    np.testing.assert_array_equal(MESH.quality("scaled_jacobian"), figures.scaled_jacobian)
    np.testing.assert_array_equal(MESH.quality("q"), figures.q)
    with pytest.raises(ParameterError, match="there is no metric 'colour'"):
        MESH.quality("colour")


@pytest.mark.parametrize("metric", ["q", "scaled_jacobian", "skew"])
def test_the_worst_hexes_are_those_of_the_worst_values(metric):
    values = METRICS[metric.replace("_", "-")].better * MESH.quality(metric)
    inverted = hx.measure(MESH.points, MESH.hexes).inverted
    expected = np.concatenate([np.sort(values[inverted]), np.sort(values[~inverted])])
    np.testing.assert_array_equal(values[MESH.worst(7, metric)], expected[:7])
    assert len(MESH.worst()) == 10
    assert len(MESH.worst(10**6)) == MESH.n_hexes
    np.testing.assert_array_equal(MESH.worst(7, metric), worst_hexes(MESH, 7, metric))


def test_worst_hexes_need_a_better_end_and_a_count():
    with pytest.raises(ParameterError, match="of volume neither a high nor a low value is better"):
        MESH.worst(3, "volume")
    with pytest.raises(ParameterError, match="count = -1 is out of range"):
        MESH.worst(-1)


def test_choices_are_named_with_underscores_too():
    assert hx.iterate(MESH, goal="scaled_jacobian").smoother == hx.Mend(goal="scaled-jacobian")


def test_a_representation_is_one_line_with_its_figures():
    mesh = hx.gallery.make("bridge-sharp", size=500, scramble=0.4, seed=1)
    assert repr(mesh) == "<Mesh bridge-sharp-500: 500 hexes, 726 nodes>"
    inverted, invalid = mesh.quality().inverted, mesh.quality().invalid
    assert repr(mesh) == f"<Mesh bridge-sharp-500: 500 hexes, 726 nodes, {invalid} invalid>"
    assert "invalid" not in repr(mesh.with_points(mesh.points + 1.0))  # which nobody has measured
    assert repr(hx.gallery.make("cube", size=1).replace(name="")) == "<Mesh: 1 hex, 8 nodes>"
    assert repr(mesh.replace(name="a\nb\x1b[2J")) == "<Mesh a b?[2J: 500 hexes, 726 nodes>"
    result = hx.smooth(mesh, "local-sd", max_iterations=2)
    q = f"q min {result.before.q_min:.4f} -> {result.after.q_min:.4f}"
    counts = f"{inverted} -> {result.after.inverted} inverted, {invalid} -> {result.after.invalid} invalid"
    assert repr(result) == f"<Result of local-sd: {counts}, {q}; 2 iterations, max-iterations>"
    assert repr(result.mesh).endswith(f"{result.after.invalid} invalid>")
    counts = f"{inverted} inverted, {invalid} invalid"
    assert repr(result.before).startswith(f"<Summary: 500 hexes, 726 nodes, {counts}; q min ")
    run = hx.iterate(mesh, "local-sd")
    first = next(run)
    assert repr(run) == f"<Run of local-sd: iteration 1 of at most 300, {first.invalid} invalid>"
    then = f"{first.inverted} inverted, {first.invalid} invalid"
    assert repr(first).startswith(f"<Iteration 1: {then}; q min {first.q_min:.4f}, q mean ")
    assert repr(hx.measure(mesh.points, mesh.hexes)).startswith(f"<ElementQuality of 500 hexes: {counts}; ")
    for value in (mesh, result, result.before, first):
        assert "\n" not in repr(value)


def test_a_name_that_is_nearly_right_is_suggested():
    for wrong, right in {"smoth": "smooth", "gallry": "gallery", "StopingCriteria": "StoppingCriteria"}.items():
        with pytest.raises(AttributeError, match=rf"no attribute '{wrong}': did you mean {right}\?$"):
            getattr(hx, wrong)
    with pytest.raises(ParameterError, match=r"no metric 'scaled-jacobain': did you mean scaled-jacobian\?"):
        MESH.quality("scaled_jacobain")


def test_a_mesh_in_the_wrong_place_is_named_with_the_right_one(tmp_path):
    mesh = hx.gallery.make("cube", size=8)
    with pytest.raises(TypeError, match=r"given Mesh and str: expected a path, then a hexmend\.Mesh"):
        hx.write(mesh, str(tmp_path / "a.vtu"))
    with pytest.raises(TypeError, match=r"that of a result is result\.mesh"):
        hx.smooth(hx.smooth(mesh))
    assert repr(hx.METRICS).startswith("<metrics: q, scaled-jacobian, ")
