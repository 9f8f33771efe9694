"""File formats of the viewer, registered through the entry-point group `hexmend.formats`."""
