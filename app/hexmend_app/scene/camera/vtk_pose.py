"""Conversions between a camera pose and a VTK camera."""

from __future__ import annotations

from vtkmodules.vtkRenderingCore import vtkCamera

from hexmend_app.picture.camera import CameraPose


def pose_of(camera: vtkCamera, axis: str = "z") -> CameraPose:
    """Return the pose of a camera; `axis` is the vertical axis, which VTK does not store."""
    return CameraPose(
        camera.GetPosition(),
        camera.GetFocalPoint(),
        camera.GetViewUp(),
        bool(camera.GetParallelProjection()),
        camera.GetParallelScale(),
        axis,
    )


def apply_pose(camera: vtkCamera, pose: CameraPose) -> None:
    """Move a camera to a pose."""
    camera.SetFocalPoint(pose.focal)
    camera.SetPosition(pose.position)
    camera.SetViewUp(pose.up)
    camera.SetParallelProjection(pose.parallel)
    camera.SetParallelScale(pose.scale)
