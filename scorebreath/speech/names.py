"""Help with names that do not exist."""

from __future__ import annotations

from collections.abc import Iterable


def did_you_mean(wanted: str, known: Iterable[str], most: int = 3) -> str:
    """A tail for an error message that lists the closest names, or nothing.

    >>> did_you_mean("formel", ["casual", "formal"])
    '; did you mean formal?'
    >>> did_you_mean("xyz", ["casual", "formal"])
    ''
    """
    from difflib import get_close_matches

    by_case = {name.lower(): name for name in known}
    close = get_close_matches(wanted.lower(), by_case, n=most, cutoff=0.5)
    if not close:
        prefixed = sorted(name for name in by_case if wanted and name.startswith(wanted.lower()[:2]))
        close = prefixed[:most]
    return f"; did you mean {' or '.join(by_case[name] for name in close)}?" if close else ""
