"""The report of a collection of meshes: tables of Hexmend and other programs, as Markdown, CSV and an HTML page."""
