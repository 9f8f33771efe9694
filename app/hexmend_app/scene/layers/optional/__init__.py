"""Layers that users switch on and off; all modules are imported, and register their layers in `LAYERS`."""
