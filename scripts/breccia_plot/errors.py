"""The ways a plot ends badly; each carries one line."""


class BadInput(Exception):
    """A folder that is not a run's, or a file in it that is damaged: exit code 2."""


class FileTrouble(Exception):
    """A picture that cannot be written: exit code 4."""


class CannotDraw(Exception):
    """One picture lacks its data; the others are made."""
