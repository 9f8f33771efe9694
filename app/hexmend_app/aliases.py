"""Former names of modules, which scripts saved by earlier versions import; new scripts use the present names."""

MODULES = {
    "hexmend_app.features.convergence.file": "hexmend_app.features.convergence.chart_file",
    "hexmend_app.features.histogram.file": "hexmend_app.features.histogram.histogram_file",
    "hexmend_app.features.inspect.file": "hexmend_app.features.hex_inspector.worst_file",
    "hexmend_app.features.inspect": "hexmend_app.features.hex_inspector",
    "hexmend_app.picture.cut_planes": "hexmend_app.picture.cut_shapes",
    "hexmend_app.scene.export": "hexmend_app.scene.page",
    "hexmend_app.scene.export.film": "hexmend_app.scene.film.film",
    "hexmend_app.scene.export.run_film": "hexmend_app.scene.film.run_film",
    "hexmend_app.scene.export.still": "hexmend_app.scene.page.still_picture",
    "hexmend_app.state.clip": "hexmend_app.picture.cut_shapes",
    "hexmend_app.state.look": "hexmend_app.picture.appearance",
    "hexmend_app.state.rerun": "hexmend_app.state.run.rerun",
    "hexmend_app.state.scene": "hexmend_app.picture",
    "hexmend_app.state.scene.toml": "hexmend_app.picture.scene_files",
    "hexmend_app.state.session_data": "hexmend_app.state.session.session_data",
}
