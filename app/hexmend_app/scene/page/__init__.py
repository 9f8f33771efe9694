"""Pages of still pictures: layout, captions, colour bar, axes."""
