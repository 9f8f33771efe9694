"""File formats that require VTK, registered through the entry-point group `hexmend.formats`."""
