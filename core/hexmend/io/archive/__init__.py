"""Archives of plain data and arrays, as a zip file or a folder."""
