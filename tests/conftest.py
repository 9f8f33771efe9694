"""What all tests share."""

from hypothesis import settings

settings.register_profile("hexmend", deadline=None, max_examples=40)
settings.load_profile("hexmend")
