"""HTML pages that open from disk: nothing fetched, nothing run."""
