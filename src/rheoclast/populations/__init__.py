"""Many orientations, many aggregates: samples and their statistics."""
