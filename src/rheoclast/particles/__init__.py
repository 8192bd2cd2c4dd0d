"""What exists: spheres, their contacts, and measures of an aggregate's shape."""
