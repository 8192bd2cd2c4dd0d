"""What the contacts do with the loads: materials, contact laws, bonds, and the load on every contact."""
