"""What the fluid does to a rigid aggregate: models, the eleven elementary problems, and motion."""
