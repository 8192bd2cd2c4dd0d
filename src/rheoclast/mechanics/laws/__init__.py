"""Contact laws: each gives the bonds of an aggregate. One law per file."""
