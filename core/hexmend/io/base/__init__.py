"""Parts that all readers and writers share: a file's content, its format, and the helpers that check them."""
