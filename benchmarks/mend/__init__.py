"""Quality that `mend` and other methods reach."""
