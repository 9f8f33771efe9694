#: Needed for the first picture of a mesh: built before the other features.
FIRST = True
