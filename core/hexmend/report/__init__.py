"""Reports: records for programs, tables and documents for readers."""
