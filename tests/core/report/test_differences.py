"""Ours minus the thesis's, where meshes have the same counts."""

from hexmend.report.differences import differences_table


def experiment(hexes=100, **columns):
    published = {"local-sd": {"q_min": 0.5, "q_mean": 0.8, "iterations": 10}, "local-nr": {"q_min": 0.6}, "getme": {}}
    return {
        "table": "4.1", "thesis_mesh": "Bridge", "hexes": hexes, "free_nodes": 50,
        "thesis": {"hexes": 100, "free_nodes": 50}, "published": published,
        "columns": {"local-sd": {"q_min": 0.51, "q_mean": 0.79, "iterations": 25}, "getme": {"q_min": 0.9}, **columns},
    }  # fmt: skip


def test_cells_that_both_have_are_compared_and_the_largest_difference_is_named():
    table = differences_table([experiment(**{"local-nr": {"q_min": 0.4}})])
    (row,) = table.rows
    assert row[:2] == ["4.1, Bridge", "3"]
    assert row[2] == "-0.0950, -0.2000 (local-nr)"
    assert row[3] == "-0.0100, -0.0100 (local-sd)"
    assert row[4:] == ["–", "2.5"]
    assert len(table.head) == len(row)


def test_a_run_that_failed_is_no_cell():
    table = differences_table([experiment(**{"local-nr": {"q_min": None}})])
    assert table.rows[0][1] == "2"


def test_meshes_of_other_counts_are_left_out():
    assert differences_table([experiment(hexes=99)]) is None
    assert len(differences_table([experiment(hexes=99), experiment()]).rows) == 1
