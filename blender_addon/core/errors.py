"""What can go wrong, each as one sentence: what was expected, what was found, what to do."""

from __future__ import annotations


class ExportError(OSError):
    """A medial axis could not be written; no file was changed."""
