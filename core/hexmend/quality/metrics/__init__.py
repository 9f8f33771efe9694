"""Quality metrics: `metrics.json` declares Hexmend's own; every module registers what it defines in METRICS."""
