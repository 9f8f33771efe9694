"""GETMe, the geometric element transformation method."""
