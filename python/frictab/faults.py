"""What can be wrong with a file or a call, and what is said where states lie outside."""


class FrictabError(ValueError):
    """A file that cannot be read, or states that do not fit a table or law."""


class OutsideWarning(UserWarning):
    """States lie beyond what a table or law was made for; the text counts them."""
