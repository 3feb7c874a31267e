"""One comparison of one quantity a file."""
