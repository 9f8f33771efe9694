"""Copies of VTK props for another render window; windows must not share props, which hold graphics resources."""

from __future__ import annotations

from vtkmodules.vtkRenderingAnnotation import vtkCornerAnnotation
from vtkmodules.vtkRenderingCore import (
    vtkAbstractMapper,
    vtkActor,
    vtkProp,
    vtkProp3D,
    vtkProperty,
    vtkTexture,
    vtkVolume,
)

#: Names of the textures of physically based rendering.
_TEXTURES = ("albedoTex", "materialTex", "normalTex", "emissiveTex", "coatNormalTex", "anisotropyTex")


def copy_prop(prop: vtkProp, ratio: float = 1.0) -> vtkProp:
    """Copy a prop with its mapper, property and textures; data and colour tables are shared.

    Parameters
    ----------
    prop : vtkProp
    ratio : float
        Factor for the widths of lines and the sizes of points.
    """
    copy = prop.NewInstance()
    copy.ShallowCopy(prop)
    has_mapper = isinstance(prop, (vtkActor, vtkVolume)) or prop.GetClassName() == "vtkActor2D"
    if has_mapper and prop.GetMapper() is not None:  # texts and legends create their mappers themselves
        copy.SetMapper(_copy_mapper(prop.GetMapper()))
    if isinstance(prop, vtkActor):
        copy.SetProperty(_copy_property(prop.GetProperty(), ratio))
        if prop.GetBackfaceProperty() is not None:
            copy.SetBackfaceProperty(_copy_property(prop.GetBackfaceProperty(), ratio))
        if prop.GetTexture() is not None:
            copy.SetTexture(_copy_texture(prop.GetTexture()))
    if isinstance(prop, vtkCornerAnnotation):
        copy.CopyAllTextsFrom(prop)
        copy.SetTextProperty(prop.GetTextProperty())
        copy.SetMaximumFontSize(prop.GetMaximumFontSize())
    if isinstance(prop, vtkProp3D):
        copy.SetPropertyKeys(prop.GetPropertyKeys())
    return copy


def _copy_mapper(mapper: vtkAbstractMapper) -> vtkAbstractMapper:
    copy = mapper.NewInstance()
    copy.ShallowCopy(mapper)
    for port in range(mapper.GetNumberOfInputPorts()):
        for index in range(mapper.GetNumberOfInputConnections(port)):
            copy.SetInputConnection(port, mapper.GetInputConnection(port, index))
    return copy


def _copy_property(value: vtkProperty, ratio: float) -> vtkProperty:
    copy = vtkProperty()
    copy.DeepCopy(value)
    copy.SetLineWidth(value.GetLineWidth() * ratio)
    copy.SetPointSize(value.GetPointSize() * ratio)
    for name in _TEXTURES:
        if value.GetTexture(name) is not None:
            copy.SetTexture(name, _copy_texture(value.GetTexture(name)))
    return copy


def _copy_texture(texture: vtkTexture) -> vtkTexture:
    copy = texture.NewInstance()
    copy.SetInputConnection(texture.GetInputConnection(0, 0))
    copy.SetInterpolate(texture.GetInterpolate())
    copy.SetRepeat(texture.GetRepeat())
    copy.SetMipmap(texture.GetMipmap())
    copy.SetColorMode(texture.GetColorMode())
    copy.SetUseSRGBColorSpace(texture.GetUseSRGBColorSpace())
    return copy
