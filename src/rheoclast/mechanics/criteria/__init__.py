"""Failure criteria: each tells how near its loads bring a contact to failure. One criterion per file."""
