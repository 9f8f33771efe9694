"""Parts that the readers of decks of cards share: fields of lines, nodes and elements by number, and coordinates."""
