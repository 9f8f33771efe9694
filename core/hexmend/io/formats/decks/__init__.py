"""What the readers of decks of cards share: fields of lines, nodes and elements by their numbers, and coordinates."""
