"""Global methods: all free nodes move at once."""
