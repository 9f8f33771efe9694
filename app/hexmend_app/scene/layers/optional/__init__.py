"""Layers that users switch on and off; every module here is imported, and registers what it defines in `LAYERS`."""
