"""Generators of stages, walked to their end."""


def walked(walk):
    """Return what a generator yields, as a list, and what it returns."""
    steps = []
    while True:
        try:
            steps.append(next(walk))
        except StopIteration as end:
            return steps, end.value
